/// The cull map in stiff and extreme cases: figures for the report's table, which the tests check too.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::culling {

/// The rows of the part "cull map". The main figure is the number of boxes of which some point can be seen, by casting
/// rays at every other box, and which were dropped all the same: it must be 0. Deterministic; takes a few seconds.
std::vector<city::StabilityRow> cullMapStability();

}  // namespace vicus::culling
