/// People for a city: who they are, where they walk and stand.
#pragma once

#include <vector>

#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets::people {

struct Population {
  uint32_t count = 300;
  uint32_t seed = 1;
  std::vector<city::Character> characters;  ///< at least one
};

/// Gives a finished city people: ways along its streets, most of them where the town is densest; without streets over a
/// grid of what can be walked there; and groups on paved ground, or beside the streets where none is known to be paved.
/// Says in `diagnostics` (of `file`) what could not be had. Deterministic.
void populate(city::City& city, Population population, const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::assets::people
