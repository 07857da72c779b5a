/// Based on: Eberly 2002, "Triangulation by Ear Clipping" (holes are joined to the outer ring by bridges, then ears are
/// cut off). Departs from it where no ear is left, which only crossing rings or rounding bring about: then the corner
/// that comes nearest to an ear is cut, so that it always ends.
#include "facade/triangulate.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::facade {
namespace {

using glm::dvec2;

double turn(dvec2 a, dvec2 b, dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inTriangle(dvec2 a, dvec2 b, dvec2 c, dvec2 p) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// The corner of `loop` from which the hole's rightmost corner can be seen.
size_t bridgeTo(const std::vector<dvec2>& points, const std::vector<uint32_t>& loop, dvec2 hole) {
  // The nearest edge to the right of the hole, at its height.
  double nearest = INFINITY;
  size_t at = loop.size();
  for (size_t i = 0; i < loop.size(); ++i) {
    const dvec2 a = points[loop[i]], b = points[loop[(i + 1) % loop.size()]];
    if (!(a.y <= hole.y && b.y >= hole.y) || a.y == b.y) continue;
    const double x = a.x + (hole.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x < hole.x - 1e-9 || x >= nearest) continue;
    nearest = x, at = a.x > b.x ? i : (i + 1) % loop.size();
  }
  if (at == loop.size()) {  // touching rings: the nearest corner will do
    for (size_t i = 0; i < loop.size(); ++i)
      if (at == loop.size() || glm::length(points[loop[i]] - hole) < glm::length(points[loop[at]] - hole)) at = i;
    return at;
  }
  // Reflex corners within the triangle hide that end; of these the one at the smallest angle is seen.
  const dvec2 onEdge(nearest, hole.y), end = points[loop[at]];
  double best = INFINITY;
  size_t seen = at;
  for (size_t i = 0; i < loop.size(); ++i) {
    const dvec2 p = points[loop[i]];
    if (p == end || p.x < hole.x) continue;
    const bool inside = end.y > hole.y ? inTriangle(hole, onEdge, end, p) : inTriangle(hole, end, onEdge, p);
    if (!inside) continue;
    const double angle = std::abs(p.y - hole.y) / std::max(1e-12, p.x - hole.x);
    if (angle < best) best = angle, seen = i;
  }
  return seen;
}

}  // namespace

std::vector<uint32_t> triangulate(std::span<const std::vector<dvec2>> rings) {
  std::vector<dvec2> points;
  std::vector<std::vector<uint32_t>> loops;
  for (const auto& ring : rings) {
    std::vector<uint32_t>& loop = loops.emplace_back();
    for (const dvec2 p : ring) {
      loop.push_back(static_cast<uint32_t>(points.size()));
      points.push_back(p);
    }
  }
  std::vector<uint32_t> triangles;
  if (loops.empty() || loops[0].size() < 3) return triangles;
  std::vector<uint32_t> loop = loops[0];

  // Holes from the right to the left, each joined by a bridge there and back.
  const auto rightmost = [&](const std::vector<uint32_t>& l) {
    return static_cast<size_t>(
        std::max_element(l.begin(), l.end(), [&](uint32_t a, uint32_t b) { return points[a].x < points[b].x; }) -
        l.begin());
  };
  std::vector<std::vector<uint32_t>> holes(loops.begin() + 1, loops.end());
  std::erase_if(holes, [](const auto& h) { return h.size() < 3; });
  std::sort(holes.begin(), holes.end(),
            [&](const auto& a, const auto& b) { return points[a[rightmost(a)]].x > points[b[rightmost(b)]].x; });
  for (const std::vector<uint32_t>& hole : holes) {
    const size_t from = rightmost(hole);
    const size_t at = bridgeTo(points, loop, points[hole[from]]);
    std::vector<uint32_t> insert;
    for (size_t i = 0; i <= hole.size(); ++i) insert.push_back(hole[(from + i) % hole.size()]);
    insert.push_back(loop[at]);
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(at) + 1, insert.begin(), insert.end());
  }

  size_t i = 0, since = 0;
  while (loop.size() > 3) {
    const size_t n = loop.size();
    i %= n;
    const auto earness = [&](size_t k, bool& clear) {
      const dvec2 a = points[loop[(k + n - 1) % n]], b = points[loop[k]], c = points[loop[(k + 1) % n]];
      const double area = turn(a, b, c);
      clear = area > 0;
      for (size_t j = 0; clear && j < n; ++j) {
        const dvec2 p = points[loop[j]];
        if (p == a || p == b || p == c) continue;
        clear = !inTriangle(a, b, c, p);
      }
      return area;
    };
    bool clear = false;
    const double area = earness(i, clear);
    size_t cut = i;
    if (!clear) {
      if (area == 0) {  // in line: no triangle, and no loss
        loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
        since = 0;
        continue;
      }
      if (++since <= n) {
        ++i;
        continue;
      }
      double largest = -INFINITY;
      for (size_t k = 0; k < n; ++k) {
        bool unused = false;
        if (const double a = earness(k, unused); a > largest) largest = a, cut = k;
      }
    }
    if (turn(points[loop[(cut + n - 1) % n]], points[loop[cut]], points[loop[(cut + 1) % n]]) > 0)
      triangles.insert(triangles.end(), {loop[(cut + n - 1) % n], loop[cut], loop[(cut + 1) % n]});
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(cut));
    since = 0;
    i = cut;
  }
  if (turn(points[loop[0]], points[loop[1]], points[loop[2]]) > 0)
    triangles.insert(triangles.end(), loop.begin(), loop.end());
  return triangles;
}

}  // namespace vicus::facade
