/// Frustum culling in stiff and extreme cases: figures for the report's table, which the tests check too.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::culling {

/// The rows of the parts "coordinates", "view" and "frustum". The main figure is the number of boxes that can be seen,
/// by `isSurfaceInClipSpace`, and were culled all the same: it must be 0. Deterministic; takes a second or two.
std::vector<city::StabilityRow> frustumStability();

}  // namespace vicus::culling
