/// Triangles of simple polygons with holes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vicus::facade {

/// Three indices for each triangle, counter-clockwise, into the rings' points one ring after another. `rings`: the
/// outer ring counter-clockwise, holes clockwise, simple. Corners in line give no triangle of their own. Where rings
/// touch or cross the triangles still end, and cover what they can. Time grows with the square of the corners.
std::vector<uint32_t> triangulate(std::span<const std::vector<glm::dvec2>> rings);

}  // namespace vicus::facade
