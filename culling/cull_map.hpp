/// What stands in front of what, seen from the eye: culling of all that buildings hide.
///
/// Based on: Wonka and Schmalstieg 1999, "Occluder Shadows for Fast Walkthroughs of Urban Environments"; Downs, Möller
/// and Séquin 2001, "Occlusion Horizons for Driving through Urban Scenery"; Willmott et al. 2001, §3.2.
///
/// Departures: the map is a horizon – the shadows of the paper's plan, but by direction instead of by place – built
/// while the city is walked from near to far, so that one row of columns stands for the whole plan out to the horizon;
/// no graphics card takes part. Whole bounding boxes are tested instead of centres (§3.2.8), a column counts as covered
/// only where it is covered over its whole width, and walls that share corners cover columns together. docs/cull-map.md
/// draws the geometry.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/view_state.hpp"
#include "culling/occluders.hpp"

namespace vicus::culling {

/// Which map: the horizon by direction, the grid on the plan, or the latter as it was published in 2001.
enum class CullMapKind : uint8_t { Horizon, Plan, Published };

struct CullMapOptions {
  /// Columns of the whole horizon, a multiple of 4. Few: less is hidden. Many: more time. 8 192 is a column each 0.04°.
  uint32_t columns = 8192;
  /// The plan holds only what is within the view's edges, and only that part of the horizon is needed.
  bool onlyInView = true;
  CullMapKind kind = CullMapKind::Horizon;
  /// Of the plan's grids, to a side. Few: coarse shadows hide less. Many: more time.
  uint32_t cells = 256;
  /// Walls whose shadows are drawn on the plan, the nearest first.
  uint32_t budget = 512;
};

/// What one view's culling did.
struct CullMapStats {
  uint64_t boxTests = 0;   ///< boxes tested against the horizon
  uint64_t occluders = 0;  ///< walls drawn into it
  std::string_view off;    ///< why nothing was culled; empty where the walk was made
  bool gaveUp = false;     ///< the walk found too little hidden and left the rest as it was
};

/// What a person may look at: made only where it is asked for.
struct CullMapView {
  uint32_t columns = 0;        ///< of the horizon
  std::vector<float> slopes;   ///< for each column; see `Horizon::slopes`
  uint32_t cells = 0;          ///< of the plan's innermost grid, to a side, the eye in the middle
  double cellSize = 0;         ///< metres
  std::vector<float> heights;  ///< above the eye, row by row from the south; −∞ where nothing is hidden
  struct Line {
    glm::dvec3 a, b;
  };
  std::vector<Line> occluders;  ///< tops of the chosen walls, metres from the city's origin
};

/// Takes out of the plan's buildings, trees, monuments, people and tiles what cannot be seen because walls of buildings
/// of the plan stand before it; runs that are dropped get DropReason::Occluded. Nothing is culled for an eye above all
/// roofs, under the ground, outside a terrain and not above it, or not finite.
///
/// Conservative: a box is dropped only if each point of it, moved by up to 1/64 of a pixel, lies behind such walls.
CullMapStats cullOccluded(const city::City& city, const Occluders& occluders, const CullMapOptions& options,
                          city::FramePlan& plan, CullMapView* shown = nullptr);

}  // namespace vicus::culling
