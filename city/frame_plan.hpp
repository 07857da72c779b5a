/// Everything decided for one view of one frame, as plain data.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "city/avatars.hpp"
#include "city/instance.hpp"
#include "city/roam_frame.hpp"
#include "city/view_state.hpp"

namespace vicus::city {

/// Why something is not drawn.
enum class DropReason : uint8_t { Frustum, Occluded };

struct DroppedRange {
  Range range;
  DropReason reason;
};

/// What is drawn of one instance set: runs of instances in ascending order, never touching or overlapping; and the rest
/// with reasons. Drawn and dropped runs together cover the set exactly once.
struct SetPlan {
  std::vector<Range> drawn;
  std::vector<DroppedRange> dropped;
  uint64_t drawnCount = 0;  ///< instances in `drawn`
  uint64_t inFrustumCount = 0;
};

/// A person as one frame shows him.
struct AvatarDraw {
  uint32_t person = 0;     ///< number among the people
  uint32_t character = 0;  ///< index into People::characters
  uint32_t dress = 0;      ///< index into its dresses
  uint8_t level = 0;       ///< of the mesh; kAvatarMeshLevels: the impostor
  Role role = Role::Idle;
  float phase = 0;         ///< of the clip, 0 to 1
  glm::dvec3 position{0};  ///< metres from the city's origin, on the ground between the feet
  float heading = 0;       ///< radians counter-clockwise from east
  float scale = 1;
  Aabbf bounds;              ///< of the body in any pose, metres from the city's origin
  uint32_t firstMatrix = 0;  ///< in AvatarPlan::matrices, one for each joint; of meshes
};

/// The people of one frame.
struct AvatarPlan {
  std::vector<AvatarDraw> drawn;  ///< by person
  /// Skin matrices by row: from the mesh at rest to the posed one.
  std::vector<std::array<glm::vec4, 3>> matrices;
  uint64_t inFrustum = 0;
  uint64_t posesMade = 0;  ///< the others were kept from frames before
  /// No joint lies farther from where it would be at the full rate, in pixels, and no surface from the full mesh.
  double pixelError = 0;
};

/// A house between two levels: both are drawn, and each pixel shows one of them.
struct HouseFade {
  uint32_t building = 0;
  float share = 0;  ///< 0 to under 1: of its pixels that show its level; the others show full detail
};

/// How much of each house one frame draws (houselod/levels.hpp).
struct HouseLodPlan {
  double inverseScalar = 0;      ///< what things on walls slide by; 0: nothing slides
  std::vector<uint8_t> levels;   ///< by building, those of drawn ones count; empty: all at full detail
  std::vector<HouseFade> fades;  ///< drawn buildings, ascending
};

/// Time that one step of the plan took.
struct StageTime {
  std::string_view name;
  double milliseconds = 0;
};

struct PlanCounts {
  uint64_t tiles = 0, tilesDrawn = 0;  ///< tiles with anything on them
  uint64_t instances = 0, instancesInFrustum = 0, instancesOccluded = 0,
           instancesDrawn = 0;  ///< buildings and monuments
  uint64_t instancesFlat = 0;   ///< buildings drawn without anything on their walls
  uint64_t treesDrawn = 0;
  uint64_t avatarsDrawn = 0, avatarPoses = 0;  ///< people drawn, and those of them whose pose was made anew
  uint64_t boxTests = 0;                       ///< boxes tested against the frustum
  uint64_t horizonTests = 0;                   ///< boxes tested against the cull map
  uint64_t occluders = 0;                      ///< walls drawn into it
};

struct ShadowPlan;  // city/shadow_plan.hpp

struct FramePlan {
  ViewState view;
  SetPlan buildings;
  SetPlan trees;
  HouseLodPlan houseLod;
  std::vector<uint32_t> monuments;  ///< drawn, ascending
  std::vector<uint32_t> tiles;      ///< drawn: tiles whose ground or content may be seen, in Morton order (ascending)
  AvatarPlan avatars;               ///< people
  std::optional<RoamFrame> roam;    ///< the ground; none: the drawn tiles' ground at full detail
  /// What throws shadows into this view, the nearest cascade first; empty: no shadow maps. Shared with the planner's
  /// state: a cascade whose plan is the same object is drawn the same.
  std::vector<std::shared_ptr<const ShadowPlan>> shadows;
  PlanCounts counts;
  std::vector<StageTime> stages;  ///< in the order run
};

}  // namespace vicus::city
