/// Where errors of the ground's mesh show most.
#pragma once

#include <vector>

#include "city/city.hpp"

namespace vicus::plan {

/// Errors under what stands on the ground count twice: it stands within half the wanted error of the drawn ground.
constexpr float kWeightUnderThings = 2;
/// Errors along the field's border count four times: there the mesh meets the country beyond, which does not follow it.
constexpr float kWeightOfBorder = 4;

/// For each sample of the city's terrain how much an error there weighs, ≥ 1, row by row; empty without terrain.
std::vector<float> groundWeights(const city::City& city);

}  // namespace vicus::plan
