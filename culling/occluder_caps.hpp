/// Gables and roof slopes that go on above a wall: what they add to what the wall hides.
#pragma once

#include <vector>

#include "culling/occluders.hpp"

namespace vicus::culling {

/// The caps of a type's walls, ordered by wall. Their points are appended to `points`.
std::vector<OccluderCap> capsOf(const city::BuildingGeometry& type, const std::vector<OccluderWall>& walls,
                                std::vector<glm::dvec3>& points);

}  // namespace vicus::culling
