#include "culling/exact_visibility.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace vicus::culling {
namespace {

using Real = long double;
using Point = std::array<Real, 4>;  // clip coordinates

/// Six linear forms of a clip position that are all ≥ 0 within clip space.
constexpr std::array<Point, 6> kInequalities = {
    {{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 0}}};

Real valueAt(const Point& inequality, const Point& p) {
  return inequality[0] * p[0] + inequality[1] * p[1] + inequality[2] * p[2] + inequality[3] * p[3];
}

/// The part of a convex polygon where the inequality holds. What cannot be compared is kept.
std::vector<Point> cut(const std::vector<Point>& polygon, const Point& inequality) {
  std::vector<Point> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point& a = polygon[i];
    const Point& b = polygon[(i + 1) % polygon.size()];
    const Real va = valueAt(inequality, a), vb = valueAt(inequality, b);
    const bool aOut = va < 0, bOut = vb < 0;
    if (!aOut) kept.push_back(a);
    if (aOut == bOut) continue;
    const Real t = va / (va - vb);
    Point crossing;
    for (size_t k = 0; k < 4; ++k) crossing[k] = a[k] + t * (b[k] - a[k]);
    kept.push_back(crossing);
  }
  return kept;
}

}  // namespace

bool isSurfaceInClipSpace(const glm::dmat4& clipFromRelative, const glm::dvec3& origin, const city::Aabbf& box) {
  if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) return false;

  std::array<Point, 8> corners;
  for (size_t i = 0; i < 8; ++i) {
    const auto side = [&](size_t axis) {
      const auto k = static_cast<glm::length_t>(axis);
      return static_cast<Real>(i >> axis & 1 ? box.max[k] : box.min[k]) - static_cast<Real>(origin[k]);
    };
    const Real x = side(0), y = side(1), z = side(2);
    for (size_t row = 0; row < 4; ++row) {
      const auto entry = [&](glm::length_t column) {
        return static_cast<Real>(clipFromRelative[column][static_cast<glm::length_t>(row)]);
      };
      corners[i][row] = entry(0) * x + entry(1) * y + entry(2) * z + entry(3);
    }
  }

  // Most boxes lie beyond one of the inequalities with all their corners.
  const auto allBeyond = [&](const Point& inequality) {
    return std::all_of(corners.begin(), corners.end(), [&](const Point& p) { return valueAt(inequality, p) < 0; });
  };
  if (std::any_of(kInequalities.begin(), kInequalities.end(), allBeyond)) return false;

  // Corner i has its x, y, z at the box's maximum where bits 0, 1, 2 of i are set.
  static constexpr size_t kFaces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  return std::any_of(std::begin(kFaces), std::end(kFaces), [&](const auto& face) {
    std::vector<Point> polygon = {corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]};
    for (const Point& inequality : kInequalities) polygon = cut(polygon, inequality);
    return !polygon.empty();
  });
}

}  // namespace vicus::culling
