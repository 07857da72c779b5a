/// The materials that Norvic is built of.
#pragma once

#include <cstdint>
#include <vector>

#include "city/material.hpp"
#include "city/vertex.hpp"

namespace vicus::assets::norvic {

/// Index of each material in the list that `paletteMaterials` gives, and so in City::materials.
enum Paint : city::MaterialId {
  kPlaster,
  kPlasterOchre,
  kPlasterRose,
  kLimewash,
  kLimewashGrey,
  kBrick,
  kBrickDark,
  kRubble,
  kFlint,
  kAshlar,
  kTimber,
  kOak,
  kPlanks,
  kTile,
  kTileBrown,
  kSlate,
  kThatch,
  kLead,
  kCobbles,
  kGlass,
  kLeadGlass,
  kDoor,
  kDoorGreen,
  kShutter,
  kIron,
  kWoolRed,
  kWoolStraw,
  kBark,
  kLeaves,
  kLeavesDark,
  kPaintCount
};

/// The materials in the order of `Paint`.
std::vector<city::Material> paletteMaterials();

}  // namespace vicus::assets::norvic
