/// Axis-aligned boxes.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace vicus::city {

/// Axis-aligned box in metres. A default box is empty: it contains nothing and extending it by a point gives that
/// point.
template <typename T>
struct Box {
  using Point = glm::vec<3, T>;
  Point min{std::numeric_limits<T>::infinity()};
  Point max{-std::numeric_limits<T>::infinity()};

  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  Point centre() const { return (min + max) * T(0.5); }
  Point size() const { return max - min; }
  void extend(const Point& p) { min = glm::min(min, p), max = glm::max(max, p); }
  void extend(const Box& b) { min = glm::min(min, b.min), max = glm::max(max, b.max); }
  bool contains(const Point& p) const {
    return p.x >= min.x && p.y >= min.y && p.z >= min.z && p.x <= max.x && p.y <= max.y && p.z <= max.z;
  }
  bool operator==(const Box&) const = default;
};

/// Box in double, for extents.
using Aabb = Box<double>;
/// Box in float, for what is tested by the million. Made from doubles only by `outward`, so it never loses a point.
using Aabbf = Box<float>;

/// The smallest float box that contains `box`: each side is rounded away from the centre.
inline Aabbf outward(const Aabb& box) {
  Aabbf out;
  if (box.empty()) return out;
  for (int k = 0; k < 3; ++k) {
    const float lo = static_cast<float>(box.min[k]);
    const float hi = static_cast<float>(box.max[k]);
    out.min[k] = static_cast<double>(lo) > box.min[k] ? std::nextafter(lo, -INFINITY) : lo;
    out.max[k] = static_cast<double>(hi) < box.max[k] ? std::nextafter(hi, INFINITY) : hi;
  }
  return out;
}

}  // namespace vicus::city
