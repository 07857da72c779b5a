/// Reading buildings from stiff and extreme coordinates: figures for the report's table, which the tests check too.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::assets {

/// Rows of the part "coordinates". Squares with sides of 20 m, laid out on the ellipsoid or in a metric CRS, go through
/// the importer; the figure is the largest error of a side in metres. The scale of UTM, 0.9996 to 1.0010, allows
/// 0.02 m of it. Deterministic; takes some tenths of a second.
std::vector<city::StabilityRow> importStability();

}  // namespace vicus::assets
