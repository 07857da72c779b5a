/// Parts that the generated cities share: from plans to a City.
#pragma once

#include <span>

#include "assets/norvic/landscape.hpp"
#include "assets/norvic/quarter.hpp"
#include "city/city.hpp"

namespace vicus::assets::norvic {

/// The instance of a house: its front at the height of the street before it.
city::Instance standHouse(const Plot& plot, const HouseCatalogue& houses, const city::HeightField& terrain);
city::Instance standTree(const TreeSpot& tree, const city::HeightField& terrain);

/// The light of a summer's afternoon where Norwich lies: 24 August 1390, half past two by the sun.
void setSummerAfternoon(city::Environment& environment);

/// The quarters' streets as one graph; roads that two quarters share are joined where their exits meet.
city::StreetGraph joinStreets(std::span<const QuarterPlan> quarters, const Landscape& land,
                              const city::HeightField& terrain);

}  // namespace vicus::assets::norvic
