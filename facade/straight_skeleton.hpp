/// Straight skeletons of footprints: where the slopes of a roof with equal pitches meet.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace vicus::facade {

using Ring = std::vector<glm::dvec2>;

/// The part of the plan that lies behind one edge: what a slope over that edge covers.
struct SkeletonFace {
  uint32_t ring = 0, edge = 0;  ///< edge k goes from corner k to the next
  /// Counter-clockwise; the edge's two ends first. z is the distance to the edge's line, metres; 0 at the edge.
  std::vector<glm::dvec3> polygon;
};

/// How a skeleton was found.
enum class SkeletonWay : uint8_t { Wavefront, Exact };

struct Skeleton {
  std::vector<SkeletonFace> faces;  ///< one for each edge, by ring and edge
  double reach = 0;                 ///< the largest z
  SkeletonWay way = SkeletonWay::Wavefront;
};

/// Of a polygon with holes: outer ring counter-clockwise, holes clockwise, metres, simple, no two corners nearer than
/// 1 mm. Faces cover the polygon to 1e-6 of its area and are flat to 1e-6 of its size. Found by a wavefront in doubles
/// and checked; where the check fails, by CGAL with exact predicates. Nothing where that fails too.
std::optional<Skeleton> straightSkeleton(std::span<const Ring> rings);

/// The same by one way alone, for tests and measurements.
std::optional<Skeleton> straightSkeletonBy(SkeletonWay way, std::span<const Ring> rings);

}  // namespace vicus::facade
