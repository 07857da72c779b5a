/// What stands once: castle, cathedral, churches, bridges, gates, town walls, market crosses.
#pragma once

#include <span>

#include "assets/norvic/landscape.hpp"
#include "assets/norvic/quarter.hpp"
#include "city/city.hpp"

namespace vicus::assets::norvic {

/// Adds the monuments of all quarters to the city. Its terrain is there already. Meshes that are alike are shared.
void addMonuments(city::City& city, const Landscape& land, std::span<const QuarterPlan> quarters);

}  // namespace vicus::assets::norvic
