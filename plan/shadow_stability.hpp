/// Shadow maps and the sun in stiff and extreme cases, for tests and the report.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::plan {

/// Rows of the part "light": the sun at the poles, in the zenith, below the horizon, at dates that are none; cascades
/// of the least and the largest extent, far from the origin and seen from far away.
std::vector<city::StabilityRow> shadowStability();

}  // namespace vicus::plan
