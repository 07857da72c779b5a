/// The kinds of house of Norvic, each in a few sizes.
///
/// A house's frame: x along its front from −width/2 to width/2, the front at y = −depth/2 facing −y, z = 0 the height
/// of the street at its door. Foundation walls reach 1.5 m below that, so that no slope shows a gap. Jetties (upper
/// storeys that stand out over the street) reach beyond the footprint; eaves and verges too.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "city/building_geometry.hpp"

namespace vicus::assets::norvic {

enum class HouseKind : uint8_t {
  JettiedTall,   ///< three storeys of timber framing, gable to the street
  Jettied,       ///< two storeys of timber framing, gable to the street
  TimberRow,     ///< eaves to the street, jettied upper storey, in rows
  BrickRow,      ///< three storeys, brick below and timber above, in rows
  Hall,          ///< broad house with a tall hall window
  Merchant,      ///< stone, three storeys, hipped roof
  SteppedGable,  ///< brick with a stepped gable to the street
  Cottage,       ///< one and a half storeys under thatch
  Workshop,      ///< flint and brick with a shop front and an awning
  Inn,           ///< broad, jettied, with a passage to its yard
  Warehouse,     ///< brick, gable with loading doors and a hoist
  Barn,          ///< boarded, with great doors
  Dovecote,      ///< small square tower under a pyramid
  Almshouses,    ///< a row of low dwellings under one roof
  TowerHouse,    ///< stone, four storeys, narrow
  FlintHouse,    ///< flint with brick edges, two storeys, detached
};
constexpr int kHouseKinds = 16;

std::string_view nameOf(HouseKind kind);

/// One size and finish of a kind of house.
struct HouseVariant {
  HouseKind kind{};
  uint32_t geometry = 0;  ///< in HouseCatalogue::geometry
  float width = 0;        ///< of the footprint, metres
  float depth = 0;
  float frontReach = 0;      ///< how far it stands out over the street beyond its footprint
  bool sideWindows = false;  ///< windows in its sides: for corners
  float sideReach = 0;       ///< eaves or verge beyond its side walls
};

struct HouseCatalogue {
  std::vector<city::BuildingGeometry> geometry;
  std::vector<HouseVariant> variants;         ///< grouped by kind
  std::vector<uint32_t> byKind[kHouseKinds];  ///< indices of `variants`, widest first
};

/// All kinds in all sizes; materials are those of the palette.
HouseCatalogue makeHouseCatalogue();

constexpr float kFoundationDepth = 1.5f;  ///< metres that walls reach below the door's height

}  // namespace vicus::assets::norvic
