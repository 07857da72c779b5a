#include "facade/outline.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::facade {
namespace {

using glm::dvec2;

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

bool segmentsCross(dvec2 a, dvec2 b, dvec2 c, dvec2 d) {
  const auto side = [](dvec2 p, dvec2 q, dvec2 r) { return cross(q - p, r - p); };
  const double ac = side(c, d, a), bc = side(c, d, b), ca = side(a, b, c), da = side(a, b, d);
  return ac * bc <= 0 && ca * da <= 0 && (ac != 0 || bc != 0);
}

}  // namespace

dvec2 movedCorner(const Ring& ring, std::span<const double> by, size_t i) {
  const size_t n = ring.size(), before = (i + n - 1) % n;
  const dvec2 p = ring[i];
  const dvec2 u = glm::normalize(p - ring[before]), v = glm::normalize(ring[(i + 1) % n] - p);
  const dvec2 nu(u.y, -u.x), nv(v.y, -v.x);
  const double sine = cross(u, v), most = 3 * std::max(std::abs(by[before]), std::abs(by[i]));
  if (most == 0) return p;
  // q = p + nu a + u s = p + nv b + v t
  dvec2 moved = (nu * by[before] + nv * by[i]) / 2.0;
  if (std::abs(sine) > 0.05) {
    const dvec2 between = nv * by[i] - nu * by[before];
    moved = nu * by[before] + u * (cross(between, v) / sine);
  }
  const double length = glm::length(moved);
  if (!(length > 0)) return p;
  return p + moved * std::min(1.0, most / length);
}

bool isSimple(std::span<const Ring> rings) {
  struct Edge {
    dvec2 a, b;
    size_t ring, number, count;
  };
  std::vector<Edge> edges;
  for (size_t r = 0; r < rings.size(); ++r)
    for (size_t i = 0; i < rings[r].size(); ++i)
      edges.push_back({rings[r][i], rings[r][(i + 1) % rings[r].size()], r, i, rings[r].size()});
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t k = i + 1; k < edges.size(); ++k) {
      const Edge &e = edges[i], &f = edges[k];
      if (e.ring == f.ring && (f.number == e.number + 1 || (e.number == 0 && f.number + 1 == f.count))) continue;
      if (segmentsCross(e.a, e.b, f.a, f.b)) return false;
    }
  return true;
}

bool isInside(std::span<const dvec2> ring, dvec2 p) {
  bool inside = false;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

}  // namespace vicus::facade
