/// The step that chooses how much of each house is drawn.
#pragma once

#include <memory>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "houselod/house_types.hpp"

namespace vicus::plan {

/// What is known of a city's houses, worked out once.
struct HouseLodScene {
  bool on = false;
  bool slide = true, drop = true, fade = true;
  double scalar = 0;
  std::shared_ptr<const houselod::HouseTypes> types;  ///< null where the knob is off
  uint32_t flatTypes = 0;                             ///< those that have more than one level
};

/// Off where the knob `house_lod` is, and where no wall has anything on it.
HouseLodScene lookAtHouses(const city::City& city, const city::Knobs& knobs);

/// Fills the plan's `houseLod` for the buildings that it draws. An instance's distance is that of its bounds.
void chooseLevels(const city::City& city, const HouseLodScene& scene, city::FramePlan& plan);

}  // namespace vicus::plan
