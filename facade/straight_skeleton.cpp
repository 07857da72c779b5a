// The sure way is CGAL's Straight_skeleton_2 over exact predicates; the quick one is wavefront.cpp, some twenty times
// faster on footprints, and believed only after a check.
#include "facade/straight_skeleton.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/create_straight_skeleton_from_polygon_with_holes_2.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "facade/wavefront.hpp"

namespace vicus::facade {
namespace {

using glm::dvec2;
using glm::dvec3;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

double area(std::span<const dvec2> ring) {
  double sum = 0;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

/// Faces flat, wound right, and together as large as the polygon.
bool holds(const Skeleton& skeleton, std::span<const Ring> rings) {
  double whole = 0, sum = 0, size = 0;
  for (const Ring& ring : rings) {
    whole += area(ring);
    for (const dvec2 p : ring) size = std::max(size, glm::length(p - rings[0][0]));
  }
  for (const SkeletonFace& face : skeleton.faces) {
    const Ring& ring = rings[face.ring];
    const dvec2 a = ring[face.edge], along = glm::normalize(ring[(face.edge + 1) % ring.size()] - a);
    std::vector<dvec2> plan;
    for (const dvec3& p : face.polygon) {
      plan.emplace_back(p);
      const dvec2 d = dvec2(p) - a;
      if (!(std::abs(along.x * d.y - along.y * d.x - p.z) <= 1e-6 * size)) return false;
    }
    const double part = area(plan);
    if (!(part >= -1e-9 * whole)) return false;
    sum += part;
  }
  return std::abs(sum - whole) <= 1e-6 * whole;
}

std::optional<Skeleton> exactSkeleton(std::span<const Ring> rings) {
  using Polygon = CGAL::Polygon_2<Kernel>;
  const auto polygonOf = [&](const Ring& ring) {
    Polygon polygon;
    for (const dvec2 p : ring) polygon.push_back({p.x - rings[0][0].x, p.y - rings[0][0].y});
    return polygon;
  };
  CGAL::Polygon_with_holes_2<Kernel> polygon(polygonOf(rings[0]));
  for (size_t i = 1; i < rings.size(); ++i) polygon.add_hole(polygonOf(rings[i]));
  if (!polygon.outer_boundary().is_simple() || !polygon.outer_boundary().is_counterclockwise_oriented())
    return std::nullopt;
  for (const Polygon& hole : polygon.holes())
    if (!hole.is_simple() || !hole.is_clockwise_oriented()) return std::nullopt;
  const auto found = CGAL::create_interior_straight_skeleton_2(polygon, Kernel());
  if (!found) return std::nullopt;

  // Faces come with their contour edge; which of ours that is, its start tells.
  Skeleton out;
  out.way = SkeletonWay::Exact;
  for (uint32_t r = 0; r < rings.size(); ++r)
    for (uint32_t e = 0; e < rings[r].size(); ++e) out.faces.push_back({r, e, {}});
  for (auto face = found->faces_begin(); face != found->faces_end(); ++face) {
    auto edge = face->halfedge();
    const auto first = edge;
    while (edge->is_bisector() && edge->next() != first) edge = edge->next();
    const auto pointOf = [&](const auto& vertex) {
      return dvec3(vertex->point().x() + rings[0][0].x, vertex->point().y() + rings[0][0].y, vertex->time());
    };
    std::vector<dvec3> polygonOfFace{pointOf(edge->opposite()->vertex()), pointOf(edge->vertex())};
    for (auto h = edge->next(); h != edge->prev(); h = h->next()) polygonOfFace.push_back(pointOf(h->vertex()));
    SkeletonFace* mine = nullptr;
    double nearest = 1e-6;
    for (SkeletonFace& f : out.faces) {
      const double off = glm::length(rings[f.ring][f.edge] - dvec2(polygonOfFace[0]));
      if (off < nearest) nearest = off, mine = &f;
    }
    if (!mine || !mine->polygon.empty()) return std::nullopt;
    for (const dvec3& p : polygonOfFace) out.reach = std::max(out.reach, p.z);
    mine->polygon = std::move(polygonOfFace);
  }
  for (const SkeletonFace& f : out.faces)
    if (f.polygon.empty()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<Skeleton> straightSkeletonBy(SkeletonWay way, std::span<const Ring> rings) {
  if (rings.empty()) return std::nullopt;
  for (const Ring& ring : rings)
    if (ring.size() < 3) return std::nullopt;
  std::optional<Skeleton> found;
  try {
    found = way == SkeletonWay::Wavefront ? skeletonByWavefront(rings) : exactSkeleton(rings);
  } catch (const std::exception&) {
    return std::nullopt;  // CGAL's assertions
  }
  if (found && !holds(*found, rings)) return std::nullopt;
  return found;
}

std::optional<Skeleton> straightSkeleton(std::span<const Ring> rings) {
  if (auto quick = straightSkeletonBy(SkeletonWay::Wavefront, rings)) return quick;
  return straightSkeletonBy(SkeletonWay::Exact, rings);
}

}  // namespace vicus::facade
