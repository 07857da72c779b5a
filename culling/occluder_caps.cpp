#include "culling/occluder_caps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vicus::culling {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

constexpr double kLargestOverhang = 1.5;   ///< metres: eaves farther out are no longer this wall's
constexpr double kThickestRoof = 0.6;      ///< metres that a slope may lie above the wall that carries it
constexpr double kWholeArea = 0.998;       ///< share of its convex outline that a surface must fill
constexpr double kFlattestSlope = 0.02;    ///< rise over run
constexpr double kSmallestSurface = 0.25;  ///< m²

/// A flat surface without holes: its corners counter-clockwise seen from outside.
struct Outline {
  city::PlaneKind kind;
  dvec3 normal;
  std::vector<dvec3> corners;
};

/// The convex outline of a plane's triangles; nothing where they do not fill it, are not flat or hardly there.
std::optional<Outline> outlineOf(const city::BuildingGeometry& type, const city::Plane& plane) {
  const city::Range range = plane.flat.count > 0 ? plane.flat : plane.cut;
  if (range.count == 0 || !plane.solid) return std::nullopt;
  const dvec3 normal = glm::normalize(dvec3(plane.normal));
  const dvec3 side = std::abs(normal.z) > 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
  const dvec3 u = glm::normalize(glm::cross(side, normal)), v = glm::cross(normal, u);
  struct Corner {
    dvec2 at;
    dvec3 place;
  };
  std::vector<Corner> all;
  double area = 0;
  const auto place = [&](uint32_t i) { return dvec3(type.vertices[type.indices[i]].position); };
  const double level = glm::dot(place(range.first), normal);
  for (uint32_t i = range.first; i + 2 < range.end(); i += 3) {
    area += 0.5 * glm::dot(glm::cross(place(i + 1) - place(i), place(i + 2) - place(i)), normal);
    for (uint32_t k = i; k < i + 3; ++k) {
      const dvec3 p = place(k);
      if (std::abs(glm::dot(p, normal) - level) > 2e-3) return std::nullopt;
      all.push_back({{glm::dot(p, u), glm::dot(p, v)}, p});
    }
  }
  // Andrew 1979, "Another Efficient Algorithm for Convex Hulls in Two Dimensions".
  std::sort(all.begin(), all.end(),
            [](const Corner& a, const Corner& b) { return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y; });
  std::vector<Corner> hull;
  const auto turn = [](dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
  const auto half = [&](auto first, auto last) {
    const size_t base = hull.size();
    for (auto it = first; it != last; ++it) {
      while (hull.size() >= base + 2 && turn(hull[hull.size() - 2].at, hull.back().at, it->at) <= 1e-6) hull.pop_back();
      hull.push_back(*it);
    }
    hull.pop_back();
  };
  half(all.begin(), all.end());
  half(all.rbegin(), all.rend());
  double whole = 0;
  for (size_t i = 2; i < hull.size(); ++i) whole += 0.5 * turn(hull[0].at, hull[i - 1].at, hull[i].at);
  if (hull.size() < 3 || area < kSmallestSurface || area < kWholeArea * whole || area > whole / kWholeArea)
    return std::nullopt;
  Outline out{plane.kind, normal, {}};
  for (const Corner& c : hull) out.corners.push_back(c.place);
  return out;
}

/// In the frame of a wall: x along it, y into the building, z from its top.
struct WallFrame {
  explicit WallFrame(const OccluderWall& w)
      : a(w.a), along(glm::normalize(w.b - w.a)), length(glm::distance(w.a, w.b)), wall(w) {}
  dvec3 local(dvec3 p) const {
    const dvec2 d = dvec2(p) - a;
    return {glm::dot(d, along), along.x * d.y - along.y * d.x + wall.reach, p.z - static_cast<double>(wall.top)};
  }
  /// The half-space above a plane that contains the wall's direction, rising inward with `slope` through (y, z).
  dvec4 above(double slope, double y, double z) const {
    // z − z0 − slope · (y − y0) > 0, its normal of unit length.
    const dvec2 in(-along.y, along.x);
    const double scale = 1 / std::sqrt(1 + slope * slope);
    const dvec3 normal = scale * dvec3(-slope * in, 1);
    const double constant = slope * (glm::dot(a, in) - wall.reach + y) - z - static_cast<double>(wall.top);
    return {normal, scale * constant};
  }
  dvec2 a, along;
  double length;
  const OccluderWall& wall;
};

}  // namespace

std::vector<OccluderCap> capsOf(const city::BuildingGeometry& type, const std::vector<OccluderWall>& walls,
                                std::vector<dvec3>& points) {
  std::vector<Outline> outlines;
  for (const city::Plane& plane : type.planes) {
    if (plane.kind != city::PlaneKind::Roof && plane.kind != city::PlaneKind::Gable) continue;
    if (auto outline = outlineOf(type, plane)) outlines.push_back(std::move(*outline));
  }
  std::vector<OccluderCap> caps;
  for (uint32_t w = 0; w < walls.size(); ++w) {
    const WallFrame frame(walls[w]);
    for (const Outline& outline : outlines) {
      std::vector<dvec3> local;
      for (const dvec3& p : outline.corners) local.push_back(frame.local(p));
      const size_t n = local.size();
      const bool upright = std::abs(outline.normal.z) < 1e-3;
      // The lower edge: level, along the wall, at its top or out before it. Seen from outside it runs with the wall.
      size_t edge = n;
      for (size_t i = 0; i < n && edge == n; ++i) {
        const dvec3 p = local[i], q = local[(i + 1) % n];
        if (q.x - p.x > 0.1 && std::abs(q.y - p.y) <= kSamePoint && std::abs(q.z - p.z) <= kSamePoint &&
            p.y <= kSamePoint && p.y >= -kLargestOverhang)
          edge = i;
      }
      if (edge == n) continue;
      const dvec3 eave = local[edge], eaveEnd = local[(edge + 1) % n];
      OccluderCap cap{w, {}, {dvec4(0, 0, 0, 1), dvec4(0, 0, 0, 1)}};
      if (upright) {
        if (std::abs(eave.y) > kSamePoint || std::abs(eave.z) > kSamePoint) continue;
      } else {
        // Rise over run into the building; the slope faces straight out.
        const dvec2 in(-frame.along.y, frame.along.x);
        const double slope = -glm::dot(dvec2(outline.normal), in) / outline.normal.z;
        if (outline.normal.z <= 0 || slope < kFlattestSlope ||
            std::abs(glm::dot(dvec2(outline.normal), frame.along)) > 1e-3)
          continue;
        const double gap = eave.z - slope * eave.y;  // the slope's height above the wall's top
        if (gap < -kSamePoint || gap > kThickestRoof) continue;
        // It carries on over the whole wall.
        if (eave.x > kSamePoint || eaveEnd.x < frame.length - kSamePoint) continue;
        cap.above[0] = frame.above(slope, eave.y, eave.z);
        if (eave.y < -kSamePoint)
          cap.above[1] = frame.above(eave.z / eave.y, eave.y, eave.z);  // else one looks in under the eave
        else if (std::abs(eave.z) > kSamePoint)
          continue;
      }
      cap.points.first = static_cast<uint32_t>(points.size());
      for (size_t i = 0; i < n; ++i) points.push_back(outline.corners[(edge + 1 + i) % n]);
      cap.points.count = static_cast<uint32_t>(n);
      caps.push_back(cap);
    }
  }
  return caps;
}

}  // namespace vicus::culling
