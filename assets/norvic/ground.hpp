/// What covers the ground of Norvic, as a raster.
#pragma once

#include <span>
#include <vector>

#include "assets/norvic/landscape.hpp"
#include "assets/norvic/quarter.hpp"
#include "city/height_field.hpp"

namespace vicus::assets::norvic {

/// Which field a place lies in, outside towns.
struct Parcel {
  city::Ground ground = city::Ground::Field;
  double toEdge = 0;  ///< metres to the hedge or baulk at its edge
  uint32_t number = 0;
};
Parcel parcelAt(glm::dvec2 p, uint32_t seed);

/// Paints fields, then town grounds, gardens, greens, streets and squares, and banks and water last of all.
city::GroundCover paintGround(const Landscape& land, std::span<const QuarterPlan> quarters, double spacing,
                              uint32_t seed);

}  // namespace vicus::assets::norvic
