/// What house LOD knows of a city's building types: worked out once, for the plan and for what is drawn from.
#pragma once

#include <span>
#include <vector>

#include "city/knob.hpp"
#include "houselod/levels.hpp"
#include "houselod/texture_plan.hpp"

namespace vicus::houselod {

struct HouseTypes {
  std::vector<TypeLevels> levels;  ///< one for each type; `detail` is its pictures' where it has any
  TexturePlan pictures;
};

/// Pictures within `house_lod.picture_mb`; none where that knob is 0 or not declared.
HouseTypes lookAtTypes(std::span<const city::BuildingGeometry> types, const city::Knobs& knobs);

}  // namespace vicus::houselod
