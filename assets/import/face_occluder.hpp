/// A wall in its own plane, and what it hides for sure.
#pragma once

#include <optional>
#include <vector>

#include "assets/import/shells.hpp"
#include "city/building_geometry.hpp"

namespace vicus::assets {

/// Axes of a face: u level and to the right seen from outside, v up the slope. For a level face u runs along its
/// longest edge.
struct Axes {
  glm::dvec3 u, v;
};

Axes axesOf(const Face& face, const std::vector<glm::dvec3>& points);

/// The largest level band of an upright wall that it covers over its whole width: from the highest point of its lower
/// edge to the lowest of its upper one. Nothing where the outline goes back on itself.
std::optional<city::OccluderLine> occluderOf(const Face& face, const Axes& axes, const std::vector<glm::dvec3>& points);

}  // namespace vicus::assets
