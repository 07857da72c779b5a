/// Motions of one skeleton played on another.
///
/// Based on: Gleicher 1998, "Retargetting Motion to New Characters" (rotations kept, translation of the root scaled).
/// Departures: bones are matched by what their names mean; skeletons that rest differently (arms out or down) are
/// brought together by the shortest turn of each bone.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "city/avatars.hpp"

namespace vicus::avatars {

/// Bones that people have, whatever their files call them.
enum class Bone : uint8_t {
  Hips,
  Spine,
  Chest,
  Neck,
  Head,
  LeftCollar,
  LeftUpperArm,
  LeftLowerArm,
  LeftHand,
  RightCollar,
  RightUpperArm,
  RightLowerArm,
  RightHand,
  LeftUpperLeg,
  LeftLowerLeg,
  LeftFoot,
  LeftToe,
  RightUpperLeg,
  RightLowerLeg,
  RightFoot,
  RightToe,
};
constexpr size_t kBones = 21;

/// For each bone the joint that stands for it; kNone where the skeleton has none. Knows the names of CMU's and
/// Biovision's files, Mixamo, Blender's and KayKit's rigs and ours, upper and lower case as one. Of several spine
/// joints the first is the spine and the last the chest.
std::array<uint32_t, kBones> bonesOf(const city::Skeleton& skeleton);

/// Whether a skeleton has what walking needs: hips and both legs with feet.
bool canWalk(const std::array<uint32_t, kBones>& bones);

/// The clip of `source` as poses of `target`, with keys `framesPerSecond` apart. Joints of the target that the source
/// lacks stay as they rest; the hips' way is scaled by the legs' lengths. Without hips in both the clip comes back
/// empty.
city::Clip retarget(const city::Skeleton& source, const city::Clip& clip, const city::Skeleton& target,
                    double framesPerSecond = 60);

}  // namespace vicus::avatars
