/// The surfaces that imported buildings are made of, until their sources say more.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "city/city.hpp"

namespace vicus::assets {

/// What a surface is finished with. While a city is put together the number is its MaterialId; `keepUsedMaterials`
/// turns that into the city's own list.
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
  BrickDark,
  Flint,
  Planks,
  Thatch,
  Lead,
  FacadePlasterShutters,
  Count
};

constexpr city::MaterialId id(Finish finish) {
  return static_cast<city::MaterialId>(finish);
}

/// What a building looks like: the rules that it is built by, and finishes. Finishes that a scene states take the place
/// of the rules' own.
struct Style {
  std::string rules = "limestone_south";    ///< a style of assets/styles, or a file
  Finish facade = Finish::FacadeLimestone;  ///< walls with windows (one bay of a storey for each repeat), where no
                                            ///< rules are followed
  Finish plain = Finish::Ashlar;            ///< walls without
  Finish roof = Finish::Tile;
  bool plainStated = false, roofStated = false;
  std::vector<std::pair<std::string, double>> parameters;  ///< of the rules, in the units that these write

  bool operator==(const Style&) const = default;
};

/// Style of a building: by what its sources say of its material ("dressed stone", "brique", …; empty: nothing), else
/// one of those usual where footprints come from, chosen by `variant`.
Style styleFor(std::string_view material, uint32_t variant);
/// The same with brick where nothing is said.
Style brickStyleFor(std::string_view material);
/// The rules for walls that a scene describes by a finish alone.
std::string rulesFor(Finish facade);
/// Name of a finish, which is also the name of its built-in material.
std::string_view nameOf(Finish finish);

/// Whole bays along a wall of `length` metres, 2.6 m wide each as near as it goes; 0 where it is too short for one.
int baysIn(double length);
/// Whole storeys in `height` metres, 2.9 m each as near as it goes, at least 1.
int storeysIn(double height);
/// Walls under this have no windows: metres.
constexpr double kSmallestFacadeLength = 1.8;
constexpr double kSmallestFacadeHeight = 2.0;

/// Material number of entry `i` of a city's own materials while it is put together: they follow the finishes.
constexpr city::MaterialId ownMaterial(size_t i) {
  return static_cast<city::MaterialId>(static_cast<size_t>(Finish::Count) + i);
}
/// So many own materials a city may have.
constexpr size_t kMostOwnMaterials = 60000;

/// Fills City::materials with the finishes and own materials that its building types and meshes use, and renumbers
/// these.
void keepUsedMaterials(city::City& city, std::span<const city::Material> own);

}  // namespace vicus::assets
