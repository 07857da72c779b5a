/// The surfaces that imported buildings are made of, until their sources say more.
#pragma once

#include <cstdint>
#include <string_view>

#include "city/city.hpp"

namespace vicus::assets {

/// What a surface is finished with. While a city is put together the number is its MaterialId; `keepUsedFinishes` turns
/// that into the city's own list.
enum class Finish : city::MaterialId {
  Plaster,
  Limewash,
  Brick,
  Ashlar,
  Rubble,
  Timber,
  Tile,
  Slate,
  Concrete,
  Glass,
  Door,
  FacadeLimestone,
  FacadePlaster,
  FacadeBrick,
  Count
};

constexpr city::MaterialId id(Finish finish) {
  return static_cast<city::MaterialId>(finish);
}

/// Walls with windows (one bay of a storey for each repeat), walls without, and roofs.
struct Style {
  Finish facade = Finish::FacadePlaster;
  Finish plain = Finish::Plaster;
  Finish roof = Finish::Tile;

  bool operator==(const Style&) const = default;
};

/// Style of a building: by what its sources say of its material ("dressed stone", "brique", …; empty: nothing), else
/// one of those usual where footprints come from, chosen by `variant`.
Style styleFor(std::string_view material, uint32_t variant);
/// The same with brick where nothing is said.
Style brickStyleFor(std::string_view material);

/// Whole bays along a wall of `length` metres, 2.6 m wide each as near as it goes; 0 where it is too short for one.
int baysIn(double length);
/// Whole storeys in `height` metres, 2.9 m each as near as it goes, at least 1.
int storeysIn(double height);
/// Walls under this have no windows: metres.
constexpr double kSmallestFacadeLength = 1.8;
constexpr double kSmallestFacadeHeight = 2.0;

/// Fills City::materials with the finishes that its building types use, and renumbers these.
void keepUsedFinishes(city::City& city);

}  // namespace vicus::assets
