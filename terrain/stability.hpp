/// The stiff and extreme cases of terrain, as rows of the report's stability table.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::terrain {

/// Runs every ROAM case; takes about a second. Deterministic.
std::vector<city::StabilityRow> roamStability();

}  // namespace vicus::terrain
