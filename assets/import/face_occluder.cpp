#include "assets/import/face_occluder.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::assets {

Axes axesOf(const Face& face, const std::vector<glm::dvec3>& points) {
  glm::dvec3 u = glm::cross(glm::dvec3(0, 0, 1), face.normal);
  if (glm::length(u) < 0.02) {
    double longest = 0;
    const auto& ring = face.rings[0];
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec3 d = points[ring[(i + 1) % ring.size()]] - points[ring[i]];
      if (glm::length(d) > longest) longest = glm::length(d), u = d;
    }
    u -= face.normal * glm::dot(u, face.normal);
  }
  u = glm::normalize(u);
  return {u, glm::cross(face.normal, u)};
}

std::optional<city::OccluderLine> occluderOf(const Face& face, const Axes& axes,
                                             const std::vector<glm::dvec3>& points) {
  if (std::abs(face.normal.z) > 0.01 || face.rings.size() != 1 || face.rings[0].empty() || face.bothSides || face.bent)
    return std::nullopt;
  const auto& ring = face.rings[0];
  const size_t n = ring.size();
  const auto along = [&](size_t i) { return glm::dot(points[ring[i % n]], axes.u); };
  size_t left = 0, right = 0;
  for (size_t i = 0; i < n; ++i) {
    if (along(i) < along(left)) left = i;
    if (along(i) > along(right)) right = i;
  }
  constexpr double kSame = 0.02;  // metres: points over each other at either end
  if (along(right) - along(left) < 0.1) return std::nullopt;
  // Counter-clockwise from outside: the lower edge runs to the right, the upper one back.
  double bottom = -INFINITY, top = INFINITY;
  for (size_t i = left; i % n != right; ++i) {
    if (along(i + 1) < along(i) - kSame) return std::nullopt;
  }
  for (size_t i = right; i % n != left; ++i) {
    if (along(i + 1) > along(i) + kSame) return std::nullopt;
  }
  // Points at the ends belong to the upright sides: the lower edge takes their lowest, the upper one their highest.
  double leftLow = INFINITY, leftHigh = -INFINITY, rightLow = INFINITY, rightHigh = -INFINITY;
  for (size_t i = 0; i < n; ++i) {
    const double z = points[ring[i]].z;
    if (along(i) < along(left) + kSame) leftLow = std::min(leftLow, z), leftHigh = std::max(leftHigh, z);
    if (along(i) > along(right) - kSame) rightLow = std::min(rightLow, z), rightHigh = std::max(rightHigh, z);
  }
  bottom = std::max(leftLow, rightLow), top = std::min(leftHigh, rightHigh);
  for (size_t i = left; i % n != right; ++i)
    if (along(i) >= along(left) + kSame && along(i) <= along(right) - kSame)
      bottom = std::max(bottom, points[ring[i % n]].z);
  for (size_t i = right; i % n != left; ++i)
    if (along(i) >= along(left) + kSame && along(i) <= along(right) - kSame) top = std::min(top, points[ring[i % n]].z);
  if (!(top - bottom > 0.1)) return std::nullopt;
  city::OccluderLine line;
  line.a = glm::vec2(points[ring[left]]), line.b = glm::vec2(points[ring[right]]);
  line.bottom = static_cast<float>(bottom), line.top = static_cast<float>(top);
  return line;
}

}  // namespace vicus::assets
