#include "houselod/levels.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "houselod/slide.hpp"

namespace vicus::houselod {
namespace {

using glm::vec2;
using glm::vec3;

/// Steps are a quarter of an octave wide, from a centimetre: an item stays at most a fifth farther than it must.
constexpr double kStepsPerOctave = 4, kSmallestReach = 0.01;

float reachOfStep(int step) {
  return static_cast<float>(kSmallestReach * std::exp2(step / kStepsPerOctave));
}

int stepOfReach(float reach) {
  if (!(reach > kSmallestReach)) return 0;
  const double exact = std::log2(static_cast<double>(reach) / kSmallestReach) * kStepsPerOctave;
  int step = static_cast<int>(std::clamp(std::ceil(exact - 1e-4), 0.0, static_cast<double>(kMostSteps - 1)));
  return step;
}

float cross(vec2 a, vec2 b) {
  return a.x * b.y - a.y * b.x;
}

float distanceToSegment(vec2 p, vec2 a, vec2 b) {
  const vec2 d = b - a;
  const float length2 = glm::dot(d, d);
  const float t = length2 > 0 ? std::clamp(glm::dot(p - a, d) / length2, 0.0f, 1.0f) : 0;
  return glm::distance(p, a + t * d);
}

/// A plane's flat triangles in its own two axes.
class Outline {
 public:
  Outline(const city::BuildingGeometry& type, const city::Plane& plane) : type_(type) {
    const vec3 n = plane.normal;
    u_ = glm::normalize(glm::cross(std::abs(n.z) > 0.9f ? vec3(0, 1, 0) : vec3(0, 0, 1), n));
    v_ = glm::cross(n, u_);
    float area = 0;
    for (uint32_t i = plane.flat.first; i < plane.flat.end(); ++i) {
      corners_.push_back(at(type.indices[i]));
      low_ = glm::min(low_, corners_.back()), high_ = glm::max(high_, corners_.back());
    }
    for (size_t t = 0; t + 2 < corners_.size(); t += 3)
      area += 0.5f * std::abs(cross(corners_[t + 1] - corners_[t], corners_[t + 2] - corners_[t]));
    rectangle_ = !corners_.empty() && area > 0.999f * (high_.x - low_.x) * (high_.y - low_.y);
  }

  /// Metres that the item's triangles lie beside the outline at most.
  float overhangOf(const city::Range& indices) const {
    if (corners_.empty()) return 0;
    float most = 0;
    for (uint32_t i = indices.first; i < indices.end(); ++i) {
      const vec2 p = at(type_.indices[i]);
      const vec2 out = glm::max(glm::max(low_ - p, p - high_), vec2(0));
      most = std::max(most, rectangle_ ? glm::length(out) : distance(p));
    }
    return most;
  }

 private:
  vec2 at(uint32_t vertex) const {
    const vec3& p = type_.vertices[vertex].position;
    return {glm::dot(p, u_), glm::dot(p, v_)};
  }
  float distance(vec2 p) const {
    float least = std::numeric_limits<float>::max();
    for (size_t t = 0; t + 2 < corners_.size(); t += 3) {
      const vec2 &a = corners_[t], &b = corners_[t + 1], &c = corners_[t + 2];
      const float turn = cross(b - a, c - a);
      if (cross(b - a, p - a) * turn >= 0 && cross(c - b, p - b) * turn >= 0 && cross(a - c, p - c) * turn >= 0)
        return 0;
      least = std::min({least, distanceToSegment(p, a, b), distanceToSegment(p, b, c), distanceToSegment(p, c, a)});
    }
    return least;
  }

  const city::BuildingGeometry& type_;
  vec3 u_{1, 0, 0}, v_{0, 0, 1};
  std::vector<vec2> corners_;
  vec2 low_{std::numeric_limits<float>::max()}, high_{std::numeric_limits<float>::lowest()};
  bool rectangle_ = false;
};

constexpr city::Knob kKnobs[] = {
    {"house_lod", 1, 0, 1, "on/off", "Draws far walls flat, without what sticks out of them and goes into them.",
     "off: every house at full detail", "on is the most"},
    {"house_lod.scalar", 256, 0, 1e9, "m for each m",
     "A thing on a wall begins to slide into it at so many times its depth and is gone at four times that.",
     "walls grow windows and doors as one comes near", "all houses at full detail from everywhere"},
    {"house_lod.slide", 1, 0, 1, "on/off", "Things on walls slide into them before they are left out.",
     "off: they stay as they are until they are left out", "on: nothing springs out of a wall"},
    {"house_lod.drop", 1, 0, 1, "on/off", "Things that lie in their walls are left out.",
     "off: slides things and draws them all the same, for comparison", "on is the most"},
    {"house_lod.fade", 1, 0, 1, "on/off", "Full detail and flat walls share a house's pixels over a band of distance.",
     "off: a wall becomes flat from one frame to the next", "on: nothing pops"},
};

constexpr city::Knob kPictureKnobs[] = {
    {"house_lod.picture_mb", 32, 0, 2048, "MB", "Memory for pictures of walls with all that is on them.",
     "houses stay at full detail until half a metre is a pixel",
     "a longer start; pictures are at most 40 texels a metre"},
};

/// Metres from which on a type's walls are flat.
double wallsFlatFrom(const TypeLevels& type, const LevelView& view) {
  return std::max(flatFrom(type.openings, view.inverse), static_cast<double>(type.detail) * view.pixelsPerSlope);
}

}  // namespace

std::span<const city::Knob> pictureKnobs() {
  return kPictureKnobs;
}

TypeLevels levelsOf(const city::BuildingGeometry& type) {
  TypeLevels levels;
  std::vector<int> steps(type.externalGeometry.size(), -1);  // those of walls that stay whole have none
  for (const city::Plane& plane : type.planes) {
    if (staysWhole(plane)) continue;
    levels.flat |= plane.flat != plane.cut || plane.externalGeometry.count > 0 || plane.externalOpenings.count > 0;
    for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
      levels.openings = std::max(levels.openings, type.externalOpenings[i].depth);
    if (plane.externalGeometry.count == 0) continue;
    const Outline outline(type, plane);
    for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i) {
      const city::ExternalItem& item = type.externalGeometry[i];
      steps[i] = stepOfReach(std::max(item.depth, outline.overhangOf(item.indices)));
    }
  }
  bool used[kMostSteps] = {};
  for (const int step : steps)
    if (step >= 0) used[step] = true;
  uint8_t number[kMostSteps] = {};
  for (size_t k = 0; k < kMostSteps; ++k) {
    if (!used[k]) continue;
    number[k] = static_cast<uint8_t>(levels.reaches.size());
    levels.reaches.push_back(reachOfStep(static_cast<int>(k)));
  }
  for (const int step : steps) levels.stepOf.push_back(step >= 0 ? number[step] : 0);
  if (levels.flat) levels.detail = kDetailWithoutPicture;
  return levels;
}

Level levelAt(const TypeLevels& type, const LevelView& view, double distance) {
  if (!type.flat || !(distance >= wallsFlatFrom(type, view))) return kFullDetail;
  size_t gone = 0;
  while (gone < type.reaches.size() && distance >= flatFrom(type.reaches[gone], view.inverse)) ++gone;
  return static_cast<Level>(1 + gone);
}

double flatShareAt(const TypeLevels& type, const LevelView& view, double distance) {
  if (!type.flat) return 0;
  const double from = wallsFlatFrom(type, view);
  if (!(distance >= from) || !std::isfinite(from)) return 0;
  if (distance >= from * kFadeBand) return 1;
  return (distance - from) / (from * (kFadeBand - 1));
}

std::span<const city::Knob> houseLodKnobs() {
  return kKnobs;
}

}  // namespace vicus::houselod
