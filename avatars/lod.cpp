#include "avatars/lod.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "avatars/impostor.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"

namespace vicus::avatars {

using glm::vec3;

namespace {

constexpr city::Knob kKnobs[] = {
    {"avatars.shown", 1, 0, 1, "on/off", "Shows the people.", "off: empty streets", "on is the most"},
    {"avatars.number", 0, 0, 100'000, "people", "How many people there are; 0 is as many as the scene says.",
     "0: as the scene says", "each frame takes longer"},
    {"avatar_lod", 1, 0, 1, "on/off", "Poses people less often and draws them coarser the farther away they are.",
     "off: everybody is posed for every frame and drawn in full", "on is the most"},
    {"avatar_lod.rate", 60, 1, 1000, "poses a second",
     "How often people within 10 m are posed anew; farther ones less often, so that the error stays the same.",
     "people jerk", "each frame poses everybody"},
    {"avatar_lod.pixel_error", 1, 0.05, 100, "px", "Largest distance of a coarser body from the full one.",
     "more triangles", "people turn into cards near the eye"},
};

constexpr double kFullRateWithin = 10;  // metres
constexpr double kSlowest = 1;          // poses a second

/// Distance from a point to a triangle (Ericson 2005, "Real-Time Collision Detection", §5.1.5).
float distanceTo(const vec3& p, const vec3& a, const vec3& b, const vec3& c) {
  const vec3 ab = b - a, ac = c - a, ap = p - a;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return glm::distance(p, a);
  const vec3 bp = p - b;
  const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return glm::distance(p, b);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return glm::distance(p, a + ab * (d1 / (d1 - d3)));
  const vec3 cp = p - c;
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return glm::distance(p, c);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return glm::distance(p, a + ac * (d2 / (d2 - d6)));
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return glm::distance(p, b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const float sum = va + vb + vc;
  return sum > 0 ? glm::distance(p, a + ab * (vb / sum) + ac * (vc / sum)) : glm::distance(p, a);
}

}  // namespace

std::span<const city::Knob> avatarKnobs() {
  return kKnobs;
}

double poseRate(const LodSettings& settings, double distance) {
  if (!(distance > kFullRateWithin)) return settings.rate;
  const double halves = std::ceil(std::log2(distance / kFullRateWithin));
  return std::max(settings.rate * std::exp2(-halves), std::min(kSlowest, settings.rate));
}

double poseTime(const LodSettings& settings, double rate, double offset, double time) {
  if (!settings.on || !(rate > 0) || !std::isfinite(time)) return time;
  return std::min((std::floor(time * rate + offset) - offset) / rate, time);
}

LevelErrors levelErrorsOf(const city::Character& character) {
  LevelErrors out;
  for (size_t k = 1; k < city::kAvatarMeshLevels; ++k)
    out.metres[k] = std::max(out.metres[k - 1], meshDistance(character.levels[0], character.levels[k]));
  // A card is seen from one of so many directions: half a turn between them moves what is at the body's rim; and its
  // texels have a size.
  const vec3 size = character.bounds.empty() ? vec3(1) : character.bounds.size();
  const double rim = 0.5 * static_cast<double>(std::min(size.x, size.y));
  out.metres.back() =
      std::max(out.metres[city::kAvatarMeshLevels - 1], rim * std::sin(std::numbers::pi / kImpostorDirections) +
                                                            0.5 * static_cast<double>(size.z) / kImpostorHeight);
  for (const city::Clip& clip : character.clips) {
    if (!(clip.duration > 0)) continue;
    constexpr size_t kSteps = 48;
    const auto poses = posesOf(character.skeleton, clip, kSteps);
    const double dt = clip.duration / static_cast<double>(clip.loops ? kSteps : kSteps - 1);
    std::vector<glm::mat4> before;
    for (const city::Pose& pose : poses) {
      const auto now = characterFromJoints(character.skeleton, pose);
      for (size_t j = 0; j < before.size(); ++j)
        out.fastest =
            std::max(out.fastest, static_cast<double>(glm::distance(vec3(now[j][3]), vec3(before[j][3]))) / dt);
      before = now;
    }
  }
  return out;
}

uint8_t levelFor(const LodSettings& settings, const LevelErrors& errors, double pixelsPerMetre) {
  if (!settings.on) return 0;
  for (size_t level = errors.metres.size(); level-- > 1;)
    if (errors.metres[level] * pixelsPerMetre <= settings.pixelError) return static_cast<uint8_t>(level);
  return 0;
}

double meshDistance(const city::AvatarMesh& full, const city::AvatarMesh& coarse) {
  float largest = 0;
  for (const city::AvatarVertex& v : full.vertices) {
    float nearest = std::numeric_limits<float>::infinity();
    for (size_t i = 0; i + 2 < coarse.indices.size(); i += 3)
      nearest = std::min(nearest, distanceTo(v.position, coarse.vertices[coarse.indices[i]].position,
                                             coarse.vertices[coarse.indices[i + 1]].position,
                                             coarse.vertices[coarse.indices[i + 2]].position));
    if (!coarse.indices.empty()) largest = std::max(largest, nearest);
  }
  return static_cast<double>(largest);
}

}  // namespace vicus::avatars
