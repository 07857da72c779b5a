/// Tighter bounds of building types than a box: their slabs between a few heights.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "city/building_geometry.hpp"

namespace vicus::culling {

/// Contains everything of a building between two heights: a rectangle of its own frame up to `top`.
struct BuildingSlab {
  glm::dvec2 min{0}, max{0};
  double top = 0;
};

/// The highest first, together containing all of the type; at most five: walls up to the eaves, three of the roof, what
/// stands above the ridge. Without triangles one slab: the bounds.
std::vector<BuildingSlab> slabsOf(const city::BuildingGeometry& type);

}  // namespace vicus::culling
