/// Outlines on the plan that move.
#pragma once

#include <span>
#include <vector>

#include "facade/straight_skeleton.hpp"

namespace vicus::facade {

/// Where corner `i` of a ring goes when the edge before it and the edge after it move outward (to their right) by
/// `by[edge]` metres. Sharp corners move at most three times that far.
glm::dvec2 movedCorner(const Ring& ring, std::span<const double> by, size_t i);

/// Whether no two edges of the rings cross, and none turns over on its neighbour. Time grows with the square of the
/// corners.
bool isSimple(std::span<const Ring> rings);

/// Whether `p` lies inside a closed line of any winding; on the line either answer may come.
bool isInside(std::span<const glm::dvec2> ring, glm::dvec2 p);

}  // namespace vicus::facade
