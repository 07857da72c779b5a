#include "scenegraph/ground_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vicus::scenegraph {
namespace {

/// Joins consecutive rings of `count` vertices each, outward-growing, counter-clockwise from above.
void joinRings(GroundMesh& mesh, uint32_t count, uint32_t rings) {
  for (uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (uint32_t i = 0; i < count; ++i) {
      const uint32_t a = ring * count + i, b = ring * count + (i + 1) % count;
      const uint32_t c = b + count, d = a + count;
      mesh.indices.insert(mesh.indices.end(), {a, d, c, a, c, b});
    }
}

/// A plane as rings about its centre, each half as far again as the one before.
GroundMesh plane(double level, glm::dvec2 about) {
  GroundMesh mesh;
  mesh.centre = glm::dvec3(about, level);
  mesh.followsEye = true;
  constexpr uint32_t kSectors = 64;
  uint32_t rings = 0;
  const auto addRing = [&](double radius) {
    for (uint32_t i = 0; i < kSectors; ++i) {
      const double angle = 2 * std::numbers::pi * i / kSectors;
      mesh.vertices.push_back(
          {glm::vec3(glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), 0)), glm::vec2(0.5f), 1});
    }
    ++rings;
  };
  addRing(0);
  for (double radius = 4; radius < kGroundReach; radius *= 1.5) addRing(radius);
  addRing(kGroundReach);
  joinRings(mesh, kSectors, rings);
  return mesh;
}

/// Samples along the field's border, counter-clockwise from the south-west corner, every `stride` samples and always
/// at corners.
std::vector<glm::ivec2> border(glm::ivec2 size, int stride) {
  std::vector<glm::ivec2> out;
  const glm::ivec2 last = size - 1;
  for (int c = 0; c < last.x; c += stride) out.emplace_back(c, 0);
  for (int r = 0; r < last.y; r += stride) out.emplace_back(last.x, r);
  for (int c = last.x; c > 0; c -= stride) out.emplace_back(c, last.y);
  for (int r = last.y; r > 0; r -= stride) out.emplace_back(0, r);
  return out;
}

bool wholeBorder(const city::HeightField& field) {
  for (const glm::ivec2& p : border(field.size, 1))
    if (!std::isfinite(field.at(p.x, p.y))) return false;
  return true;
}

GroundMesh ringsAbout(const city::HeightField& field) {
  GroundMesh mesh;
  const glm::dvec2 half = 0.5 * field.extent();
  // Every sample of the border where there are not too many; the ring tucked under the border hides what is left out.
  constexpr int kMostSamplesOfASide = 512;
  const int stride = 1 + (std::max(field.size.x, field.size.y) - 2) / kMostSamplesOfASide;
  const std::vector<glm::ivec2> edge = border(field.size, stride);
  double mean = 0;
  for (const glm::ivec2& p : edge) mean += static_cast<double>(field.at(p.x, p.y)) / static_cast<double>(edge.size());
  mesh.centre = glm::dvec3(field.origin + half, mean);

  const double levelAfter = std::max(600.0, 4.0 * std::abs(static_cast<double>(field.maxHeight - field.minHeight)));
  constexpr double kBeyondAfter = 150;
  uint32_t rings = 0;
  const auto addRing = [&](double outward, double sunk) {
    const double t = std::clamp(outward / levelAfter, 0.0, 1.0);
    const double level = t * t * (3 - 2 * t);
    for (const glm::ivec2& p : edge) {
      const glm::dvec2 at = field.spacing * glm::dvec2(p) - half;
      const glm::dvec2 away = glm::length(at) > 0 ? at / glm::length(at) : glm::dvec2(1, 0);
      const double height = static_cast<double>(field.at(p.x, p.y)) - mean;
      mesh.vertices.push_back({glm::vec3(glm::dvec3(at + outward * away, (1 - level) * height - sunk)),
                               glm::vec2(glm::dvec2(p) / glm::dvec2(field.size - 1)),
                               static_cast<float>(std::clamp(outward / kBeyondAfter, 0.0, 1.0))});
    }
    ++rings;
  };
  addRing(-0.5 * std::min(field.spacing.x, field.spacing.y), 0.5 + 0.01 * levelAfter * (stride - 1));
  addRing(0, 0);
  for (double outward = 25; outward < kGroundReach; outward *= 1.6) addRing(outward, 0);
  addRing(kGroundReach, 0);
  joinRings(mesh, static_cast<uint32_t>(edge.size()), rings);
  return mesh;
}

}  // namespace

GroundMesh groundMesh(const city::City& city) {
  const bool hasTerrain = city.terrain && !city.terrain->empty();
  if (hasTerrain && wholeBorder(*city.terrain)) return ringsAbout(*city.terrain);
  const glm::dvec2 about = city.extent.empty() ? glm::dvec2(0) : glm::dvec2(city.extent.centre());
  if (hasTerrain) return plane(static_cast<double>(city.terrain->minHeight) - 1, about);
  double lowest = INFINITY;
  for (const city::Instance& i : city.buildings.instances) lowest = std::min(lowest, i.position.z);
  for (const city::Monument& m : city.monuments) lowest = std::min(lowest, m.position.z);
  for (const city::Instance& i : city.trees.instances) lowest = std::min(lowest, i.position.z);
  return plane(std::isfinite(lowest) ? lowest : 0, about);
}

}  // namespace vicus::scenegraph
