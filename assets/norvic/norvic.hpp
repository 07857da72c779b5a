/// The generated default city.
#pragma once

#include <cstdint>

#include "assets/load_city.hpp"
#include "city/city.hpp"

namespace vicus::assets {

struct NorvicOptions {
  uint32_t houses =
      0;  ///< 0: the town as designed, 2 048 m × 2 048 m; else it grows by quarters to exactly this many houses
  uint32_t seed = 1;
};

/// Norvic: a walled medieval town on a river. Deterministic for a seed.
city::City generateNorvic(const NorvicOptions& options, const Progress& progress = {});

/// The published walkthrough's size (Willmott et al. 2001, §3.1.4, §4.1.1): 800 houses, 222 912 ± 2 % building
/// triangles, 401 × 401 heights over 2 048 m × 2 048 m.
city::City generateNorwich2001(uint32_t seed = 1, const Progress& progress = {});

}  // namespace vicus::assets
