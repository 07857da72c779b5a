// Based on: GEOS 3.11 (MakeValid; constrained Delaunay of polygons). What is convex or plainly valid does not go
// through it, which is most of a town.
#include "assets/import/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "assets/import/geos.hpp"

namespace vicus::assets {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// > 0: c lies left of a → b.
double orientation(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return cross(b - a, c - a);
}

bool withinBox(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
         p.y <= std::max(a.y, b.y);
}

int sign(double v) {
  return v > 0 ? 1 : v < 0 ? -1 : 0;
}

/// Do the closed segments ab and cd have a point in common?
bool segmentsMeet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const int abc = sign(orientation(a, b, c)), abd = sign(orientation(a, b, d));
  const int cda = sign(orientation(c, d, a)), cdb = sign(orientation(c, d, b));
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && withinBox(a, b, c)) || (abd == 0 && withinBox(a, b, d)) || (cda == 0 && withinBox(c, d, a)) ||
         (cdb == 0 && withinBox(c, d, b));
}

/// Without repeated points, the closing point and spikes (a → b → a). Fewer than three points: nothing.
Ring withoutRepeats(const Ring& raw) {
  Ring out;
  for (const glm::dvec2& p : raw) {
    const glm::dvec2 q = snapped(p);
    if (!out.empty() && out.back() == q) continue;
    out.push_back(q);
    while (out.size() >= 3 && out[out.size() - 3] == out.back()) out.resize(out.size() - 2);
  }
  while (out.size() > 1 && out.front() == out.back()) out.pop_back();
  while (out.size() >= 3 && out[1] == out.back()) {  // a spike at the seam
    out.erase(out.begin());
    out.pop_back();
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
  }
  if (out.size() < 3) out.clear();
  return out;
}

void wind(Ring& ring, bool counterClockwise) {
  if ((signedArea(ring) > 0) != counterClockwise) std::reverse(ring.begin(), ring.end());
}

/// Drops empty rings, winds the rest; false where the outer ring is gone or too small.
bool tidy(Polygon& p) {
  for (size_t i = 0; i < p.rings.size(); ++i) {
    p.rings[i] = withoutRepeats(p.rings[i]);
    if (i == 0 && p.rings[0].empty()) return false;
    wind(p.rings[i], i == 0);
  }
  std::erase_if(p.rings, [](const Ring& r) { return r.empty(); });
  return !p.rings.empty();
}

struct PointHash {
  size_t operator()(const glm::dvec2& p) const {
    return std::hash<double>()(p.x) * 0x9e3779b97f4a7c15ULL ^ std::hash<double>()(p.y);
  }
};

/// Appends the triangles of a valid polygon. GEOS 3.11 misjudges some holes that touch their outline, and then covers
/// too much or too little: such polygons are halved across their longer side until it succeeds.
bool cutIntoTriangles(const Geos& geos, const Polygon& polygon, int depth,
                      std::vector<std::array<glm::dvec2, 3>>& out) {
  constexpr int kDeepest = 8;
  const size_t before = out.size();
  const auto geometry = geos.own(geos.polygon(polygon));
  if (!geometry) return false;
  if (const auto triangles = geos.own(GEOSConstrainedDelaunayTriangulation_r(geos.handle(), geometry.get()))) {
    double covered = 0;
    bool good = true;
    const int count = GEOSGetNumGeometries_r(geos.handle(), triangles.get());
    for (int t = 0; good && t < count; ++t) {
      const Ring corners =
          geos.ring(GEOSGetExteriorRing_r(geos.handle(), GEOSGetGeometryN_r(geos.handle(), triangles.get(), t)));
      good = corners.size() == 3;
      if (!good) break;
      const double twice = orientation(corners[0], corners[1], corners[2]);
      covered += std::abs(twice) / 2;
      if (twice > 0) out.push_back({corners[0], corners[1], corners[2]});
      if (twice < 0) out.push_back({corners[0], corners[2], corners[1]});
    }
    const double whole = area(polygon);
    if (good && std::abs(covered - whole) <= 1e-6 * whole + 1e-6) return true;
  }
  out.resize(before);
  if (depth == kDeepest) return false;

  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const glm::dvec2& p : polygon.rings[0]) low = glm::min(low, p), high = glm::max(high, p);
  // Through the middle of a hole where there is one, so that it becomes part of the outline.
  const glm::dvec2 middle = polygon.rings.size() > 1 ? centroid({{polygon.rings[1]}}) : (low + high) / 2.0;
  const bool alongX = high.x - low.x >= high.y - low.y;
  for (const bool first : {true, false}) {
    glm::dvec2 from = low - 1.0, to = high + 1.0;
    (first ? to : from)[alongX ? 0 : 1] = middle[alongX ? 0 : 1];
    const auto half = geos.own(geos.polygon({{{from, {to.x, from.y}, to, {from.x, to.y}}}}));
    if (!half) return false;
    const auto piece = geos.own(GEOSIntersection_r(geos.handle(), geometry.get(), half.get()));
    if (!piece) return false;
    std::vector<Polygon> parts;
    geos.collect(piece.get(), parts);
    for (Polygon& part : parts) {
      for (size_t r = 0; r < part.rings.size(); ++r) wind(part.rings[r], r == 0);
      if (!cutIntoTriangles(geos, part, depth + 1, out)) return false;
    }
  }
  return true;
}

}  // namespace

bool insideRing(const Ring& ring, glm::dvec2 p) {
  bool inside = false;
  for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
        p.x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
      inside = !inside;
  return inside;
}

glm::dvec2 snapped(glm::dvec2 p) {
  return {std::nearbyint(p.x / kSnap) * kSnap, std::nearbyint(p.y / kSnap) * kSnap};
}

glm::dvec3 snapped(glm::dvec3 p) {
  return {snapped(glm::dvec2(p)), std::nearbyint(p.z / kSnap) * kSnap};
}

double signedArea(std::span<const glm::dvec2> ring) {
  double twice = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) twice += orientation(ring[0], ring[i], ring[i + 1]);
  return twice / 2;
}

double area(const Polygon& polygon) {
  double sum = 0;
  for (size_t i = 0; i < polygon.rings.size(); ++i) sum += (i == 0 ? 1 : -1) * std::abs(signedArea(polygon.rings[i]));
  return sum;
}

glm::dvec2 centroid(const Polygon& polygon) {
  // Moments of the triangles from one point, so that nothing is lost far from the origin.
  glm::dvec2 moment(0);
  double total = 0;
  const glm::dvec2 o = polygon.rings.at(0).at(0);
  for (const Ring& ring : polygon.rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i] - o, b = ring[(i + 1) % ring.size()] - o;
      const double w = cross(a, b);
      total += w;
      moment += w * (a + b) / 3.0;
    }
  return std::abs(total) > 0 ? o + moment / total : o;
}

bool isConvex(std::span<const glm::dvec2> ring) {
  if (ring.size() < 3) return false;
  // Left turns only, and once around: the direction's x changes sign twice.
  int changes = 0;
  bool turned = false;
  int lastSign = 0, firstSign = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
    const double turn = orientation(a, b, c);
    if (turn < 0 || (turn == 0 && glm::dot(b - a, c - b) <= 0)) return false;
    turned = turned || turn > 0;
    const int s = sign(b.x - a.x);
    if (s == 0) continue;
    if (firstSign == 0) firstSign = s;
    if (lastSign != 0 && s != lastSign) ++changes;
    lastSign = s;
  }
  if (lastSign != firstSign) ++changes;
  return turned && changes <= 2;
}

bool isPlainlyValid(const Polygon& polygon) {
  struct Edge {
    glm::dvec2 a, b;
    size_t ring, index, size;
  };
  std::vector<Edge> edges;
  for (size_t r = 0; r < polygon.rings.size(); ++r) {
    const Ring& ring = polygon.rings[r];
    if (ring.size() < 3) return false;
    for (size_t i = 0; i < ring.size(); ++i) edges.push_back({ring[i], ring[(i + 1) % ring.size()], r, i, ring.size()});
  }
  for (size_t i = 0; i < edges.size(); ++i)
    for (size_t j = i + 1; j < edges.size(); ++j) {
      const Edge &e = edges[i], &f = edges[j];
      const bool next = e.ring == f.ring && f.index == e.index + 1;
      const bool previous = e.ring == f.ring && e.index == 0 && f.index + 1 == f.size;
      if (next || previous) {
        // Neighbours may only meet at their corner: the far end must not lie back on the other edge.
        const glm::dvec2 far = next ? f.b : f.a;
        if (orientation(e.a, e.b, far) == 0 && withinBox(e.a, e.b, far)) return false;
        const glm::dvec2 own = next ? e.a : e.b;
        if (orientation(f.a, f.b, own) == 0 && withinBox(f.a, f.b, own)) return false;
      } else if (segmentsMeet(e.a, e.b, f.a, f.b)) {
        return false;
      }
    }
  for (size_t r = 1; r < polygon.rings.size(); ++r) {
    if (!insideRing(polygon.rings[0], polygon.rings[r][0])) return false;
    for (size_t q = 1; q < polygon.rings.size(); ++q)
      if (q != r && insideRing(polygon.rings[q], polygon.rings[r][0])) return false;
  }
  return true;
}

CleanedPolygons cleanPolygon(const Polygon& raw) {
  CleanedPolygons out;
  for (const Ring& ring : raw.rings)
    for (const glm::dvec2& p : ring)
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        out.problem = "a coordinate is not a number";
        return out;
      }
  Polygon p = raw;
  if (!tidy(p)) {
    out.problem = "fewer than three different points";
    return out;
  }
  // The quick test is quadratic; beyond this many edges the library's sweep is faster.
  constexpr size_t kQuickEdges = 120;
  size_t edges = 0;
  for (const Ring& ring : p.rings) edges += ring.size();
  if (edges <= kQuickEdges && isPlainlyValid(p)) {
    out.polygons.push_back(std::move(p));
  } else {
    const Geos geos;
    const auto geometry = geos.own(geos.polygon(p));
    if (geometry && GEOSisValid_r(geos.handle(), geometry.get()) == 1) {
      out.polygons.push_back(std::move(p));
    } else if (geometry) {
      out.repaired = true;
      if (const auto valid = geos.own(GEOSMakeValid_r(geos.handle(), geometry.get())))
        geos.collect(valid.get(), out.polygons);
      std::erase_if(out.polygons, [](Polygon& q) { return !tidy(q); });
    }
  }
  double whole = 0;
  for (const Polygon& q : out.polygons) whole += area(q);
  std::erase_if(out.polygons, [](const Polygon& q) { return area(q) < kSmallestArea; });
  if (out.polygons.empty())
    out.problem = whole > 0 || !out.repaired ? "its area is under 0.1 m²" : "its outline encloses no area";
  return out;
}

std::vector<Polygon> polygonise(std::span<const Ring> lines) {
  const Geos geos;
  std::vector<GEOSGeometry*> strings;
  for (const Ring& line : lines) {
    if (line.size() < 2) continue;
    GEOSCoordSequence* points = GEOSCoordSeq_create_r(geos.handle(), static_cast<unsigned>(line.size()), 2);
    for (size_t i = 0; i < line.size(); ++i)
      GEOSCoordSeq_setXY_r(geos.handle(), points, static_cast<unsigned>(i), line[i].x, line[i].y);
    if (GEOSGeometry* string = GEOSGeom_createLineString_r(geos.handle(), points)) strings.push_back(string);
  }
  std::vector<Polygon> out;
  const auto all = geos.own(GEOSGeom_createCollection_r(geos.handle(), GEOS_MULTILINESTRING, strings.data(),
                                                        static_cast<unsigned>(strings.size())));
  if (!all) return out;
  const auto noded = geos.own(GEOSUnaryUnion_r(geos.handle(), all.get()));
  if (!noded) return out;
  const GEOSGeometry* parts[] = {noded.get()};
  if (const auto faces = geos.own(GEOSPolygonize_r(geos.handle(), parts, 1))) geos.collect(faces.get(), out);
  for (Polygon& face : out)
    for (size_t r = 0; r < face.rings.size(); ++r) wind(face.rings[r], r == 0);
  return out;
}

std::vector<uint32_t> cornersOf(std::span<const glm::dvec2> ring, std::span<const uint8_t> group, double tolerance) {
  const auto n = static_cast<uint32_t>(ring.size());
  std::vector<uint32_t> all(n);
  for (uint32_t i = 0; i < n; ++i) all[i] = i;
  // Begin at the corner that turns most: it stays in any case.
  uint32_t start = 0;
  double best = -1;
  for (uint32_t i = 0; i < n; ++i) {
    const glm::dvec2 in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
    const double turn = std::abs(std::atan2(cross(in, out), glm::dot(in, out)));
    if (turn > best) best = turn, start = i;
  }
  // Greedily lengthen the current edge while all points that it passes stay near it.
  std::vector<uint32_t> kept{start};
  uint32_t from = start;
  for (uint32_t step = 1; step < n; ++step) {
    const uint32_t here = (start + step) % n, next = (here + 1) % n;
    bool drop = group[(here + n - 1) % n] == group[here];
    const glm::dvec2 a = ring[from], chord = ring[next] - a;
    const double length = glm::length(chord);
    for (uint32_t k = (from + 1) % n; drop && k != next; k = (k + 1) % n) {
      const glm::dvec2 d = ring[k] - a;
      const double along = glm::dot(d, chord);
      drop = length > 0 && along >= 0 && along <= length * length && std::abs(cross(chord, d)) <= tolerance * length;
    }
    if (drop) continue;
    kept.push_back(here);
    from = here;
  }
  if (kept.size() < 3) return all;
  std::sort(kept.begin(), kept.end());
  return kept;
}

Triangulation triangulate(const Polygon& polygon) {
  Triangulation out;
  if (polygon.rings.empty()) return out;
  for (const Ring& ring : polygon.rings) out.points.insert(out.points.end(), ring.begin(), ring.end());
  if (polygon.rings.size() == 1 && isConvex(polygon.rings[0])) {
    const Ring& ring = polygon.rings[0];
    for (uint32_t i = 2; i < ring.size(); ++i)
      if (orientation(ring[0], ring[i - 1], ring[i]) > 0) out.triangles.insert(out.triangles.end(), {0, i - 1, i});
    return out;
  }
  std::unordered_map<glm::dvec2, uint32_t, PointHash> indexOf;
  for (uint32_t i = 0; i < out.points.size(); ++i) indexOf.emplace(out.points[i], i);
  const Geos geos;
  std::vector<std::array<glm::dvec2, 3>> triangles;
  if (!cutIntoTriangles(geos, polygon, 0, triangles)) return out;
  for (const auto& t : triangles)
    for (const glm::dvec2& p : t) {
      const auto [found, isNew] = indexOf.emplace(p, static_cast<uint32_t>(out.points.size()));
      if (isNew) out.points.push_back(p);
      out.triangles.push_back(found->second);
    }
  return out;
}

}  // namespace vicus::assets
