/// Culling with the map on the plan: first the nearest walls throw their shadows, then everything is looked up.
#pragma once

#include "culling/cull_map.hpp"

namespace vicus::culling {

CullMapStats cullOnPlan(const city::City& city, const Occluders& occluders, const CullMapOptions& options,
                        city::FramePlan& plan, CullMapView* shown);

}  // namespace vicus::culling
