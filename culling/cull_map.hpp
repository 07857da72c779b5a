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

namespace vicus::culling {

/// A wall that hides: upright, opaque from `bottom` to `top`, drawn on the right of a → b. In the building's frame.
struct OccluderWall {
  glm::dvec2 a{0}, b{0};
  float bottom = 0, top = 0;
  double reach = 0;                 ///< metres that storeys above stand out before it; an eye nearer may be inside them
  uint32_t previous = city::kNone;  ///< wall of the same building whose b is this a (the very same point)
  uint32_t next = city::kNone;      ///< wall whose a is this b
};

/// The walls of all building types, and which of them hide in which building: worked out once for a city.
struct Occluders {
  std::vector<OccluderWall> walls;
  std::vector<city::Range> ofType;  ///< in `walls`, one for each building type
  std::vector<float> recess;        ///< for each type: metres that the opaque surface may lie behind a wall's face
  std::vector<uint32_t> firstOfBuilding;  ///< in `stands`; one more than there are buildings
  std::vector<uint8_t> stands;            ///< 1: this wall of this building stands in the ground over its whole length
  uint64_t standing = 0;                  ///< ones in `stands`
  bool terrain = false;                   ///< what a line of sight meets beneath a wall is the height field
  double lowest = 0;                      ///< without terrain: nothing in the city reaches lower
  double highest = 0;                     ///< no building, tree or monument reaches higher
};

/// Chooses the walls: a type's occluder lines whose foot is at or below its ground, as high as the lines above them go
/// on without a gap. Points of lines that lie within `kSamePoint` become one. A building's wall stands where the
/// terrain is nowhere below its foot, so that no line of sight passes beneath it; in a city without terrain, where
/// nothing reaches below its foot.
Occluders occludersOf(const city::City& city);
constexpr double kSamePoint = 1e-3;  ///< metres; corners of a closed building that differ by rounding

struct CullMapOptions {
  /// Columns of the whole horizon, a multiple of 4. Few: less is hidden. Many: more time. 8 192 is a column each 0.04°.
  uint32_t columns = 8192;
  /// The plan holds only what is within the view's edges, and only that part of the horizon is needed.
  bool onlyInView = true;
};

/// What one view's culling did.
struct CullMapStats {
  uint64_t boxTests = 0;   ///< boxes tested against the horizon
  uint64_t occluders = 0;  ///< walls drawn into it
  std::string_view off;    ///< why nothing was culled; empty where the walk was made
  bool gaveUp = false;     ///< the walk found too little hidden and left the rest as it was
};

/// Takes out of the plan's buildings, trees, monuments and tiles what cannot be seen because walls of buildings of the
/// plan stand before it; runs that are dropped get DropReason::Occluded. Nothing is culled for an eye above all roofs,
/// under the ground, outside a terrain and not above it, or not finite.
///
/// Conservative: a box is dropped only if each point of it, moved by up to 1/64 of a pixel, lies behind such walls.
CullMapStats cullOccluded(const city::City& city, const Occluders& occluders, const CullMapOptions& options,
                          city::FramePlan& plan);

}  // namespace vicus::culling
