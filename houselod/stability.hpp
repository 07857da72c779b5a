/// The stiff and extreme cases of house LOD, as rows of the report's stability table.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::houselod {

/// Runs every case; takes milliseconds. Deterministic.
std::vector<city::StabilityRow> houseLodStability();

}  // namespace vicus::houselod
