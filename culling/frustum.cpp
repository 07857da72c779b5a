#include "culling/frustum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "culling/box_distance.hpp"

namespace vicus::culling {
namespace {

/// Relative error that an entry of a matrix may have: it is a product of two or three matrices of four terms each.
constexpr double kMatrixRounding = 16 * std::numeric_limits<double>::epsilon();
/// A plane whose direction is less certain than this is left out; 2⁻²² is a quarter of the test's own slack.
constexpr double kLargestTilt = 0x1p-22;
/// Farther planes cut nothing off and would overflow in float.
constexpr double kFarthestPlane = 1e30;

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Adds the plane dot(a + sign · b, (p, 1)) ≥ 0.
void addPlane(Frustum& frustum, const glm::dvec4& a, const glm::dvec4& b, double sign) {
  const glm::dvec4 row = a + sign * b;
  const double length = glm::length(glm::dvec3(row));
  // The sum may cancel: what is left is worth no more than the rounding of its addends.
  const double normalRounding = kMatrixRounding * (largest(glm::dvec3(a)) + largest(glm::dvec3(b)));
  const double distanceRounding = kMatrixRounding * (std::abs(a.w) + std::abs(b.w));
  const bool certain = length > 0 && normalRounding <= kLargestTilt * length;
  const double distance = (row.w + distanceRounding) / length;
  const glm::dvec3 normal = glm::dvec3(row) / length;
  if (!certain || !(std::abs(distance) <= kFarthestPlane) || !(std::abs(glm::dot(normal, normal) - 1) < 1e-9)) return;
  frustum.planes[frustum.count++] = {normal, distance};
}

/// The smallest float that is not less than `v`.
float roundUp(double v) {
  const auto f = static_cast<float>(v);
  return static_cast<double>(f) < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

Frustum frustumFromClip(const glm::dmat4& clipFromRelative, const glm::dvec3& origin) {
  const glm::dmat4 rows = glm::transpose(clipFromRelative);
  Frustum frustum;
  frustum.origin = origin;
  for (glm::length_t i = 0; i < 16; ++i)
    if (!std::isfinite(rows[i / 4][i % 4])) return frustum;
  addPlane(frustum, rows[3], rows[0], 1);        // left: x ≥ −w
  addPlane(frustum, rows[3], rows[0], -1);       // right: x ≤ w
  addPlane(frustum, rows[3], rows[1], 1);        // bottom: y ≥ −w
  addPlane(frustum, rows[3], rows[1], -1);       // top: y ≤ w
  addPlane(frustum, rows[3], rows[2], -1);       // near, depth being reversed: z ≤ w
  addPlane(frustum, rows[2], glm::dvec4(0), 1);  // far: z ≥ 0
  return frustum;
}

Frustum frustumOf(const city::ViewState& view) {
  return frustumFromClip(city::clipFromEyeRelative(view), view.eye);
}

BoxTest boxTestFor(const Frustum& frustum, const city::Aabbf& reach) {
  const glm::vec3 origin(frustum.origin);
  const glm::dvec3 exactOrigin(origin);
  double farthest = 0;
  if (!reach.empty()) {
    const glm::dvec3 lo = glm::abs(glm::dvec3(reach.min) - exactOrigin),
                     hi = glm::abs(glm::dvec3(reach.max) - exactOrigin);
    farthest = glm::length(glm::max(lo, hi));
  }

  BoxTest test;
  test.originX = origin.x, test.originY = origin.y, test.originZ = origin.z;
  test.slack = 0x1p-20 * farthest;
  for (uint32_t i = 0; i < frustum.count; ++i) {
    const FrustumPlane& from = frustum.planes[i];
    const double distance = from.distance + glm::dot(from.normal, exactOrigin - frustum.origin);
    const glm::vec3 normal(from.normal);
    BoxTest::Plane& plane = test.planes[i];
    plane.x = normal.x, plane.y = normal.y, plane.z = normal.z;
    plane.distance = roundUp(distance + test.slack + 0x1p-20 * std::abs(distance));
    for (int axis = 0; axis < 3; ++axis) {
      const auto step = static_cast<uint32_t>(static_cast<size_t>(axis) * sizeof(float));
      const auto low = static_cast<uint32_t>(offsetof(city::Aabbf, min)) + step;
      const auto high = static_cast<uint32_t>(offsetof(city::Aabbf, max)) + step;
      const bool rising = normal[axis] >= 0;
      plane.farthest[static_cast<size_t>(axis)] = rising ? high : low;
      plane.nearest[static_cast<size_t>(axis)] = rising ? low : high;
    }
    test.allPlanes |= 1u << i;
  }
  return test;
}

Containment classify(const BoxTest& test, const city::Aabbf& box, uint32_t& mask) {
  const bool hasNan = std::isnan(box.min.x + box.min.y + box.min.z) || std::isnan(box.max.x + box.max.y + box.max.z);
  if (hasNan) return Containment::Crossing;
  if (box.empty()) return Containment::Outside;
  return classifyOrdered(test, box, mask);
}

}  // namespace vicus::culling
