/// The inner loop of frustum culling, inline for the hierarchies that call it by the ten thousand.
#pragma once

#include <bit>
#include <cstring>

#include "culling/frustum.hpp"

namespace vicus::culling {

/// Signed distance of one corner of a box from a plane; `corner` is the plane's `farthest` or `nearest`.
inline float cornerDistance(const BoxTest& test, const BoxTest::Plane& plane, const city::Aabbf& box,
                            const std::array<uint32_t, 3>& corner) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&box);
  float x, y, z;
  std::memcpy(&x, bytes + corner[0], sizeof x);
  std::memcpy(&y, bytes + corner[1], sizeof y);
  std::memcpy(&z, bytes + corner[2], sizeof z);
  return plane.x * (x - test.originX) + plane.y * (y - test.originY) + plane.z * (z - test.originZ) + plane.distance;
}

/// `classify` for a box without NaN.
inline Containment classifyOrdered(const BoxTest& test, const city::Aabbf& box, uint32_t& mask) {
  for (uint32_t rest = mask; rest != 0; rest &= rest - 1) {
    const auto index = static_cast<size_t>(std::countr_zero(rest));
    const BoxTest::Plane& plane = test.planes[index];
    if (cornerDistance(test, plane, box, plane.farthest) < 0) return Containment::Outside;
    if (cornerDistance(test, plane, box, plane.nearest) >= 0) mask &= ~(1u << index);
  }
  return mask == 0 ? Containment::Inside : Containment::Crossing;
}

}  // namespace vicus::culling
