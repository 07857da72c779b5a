/// The joints of our townspeople, in the order of their skeletons.
#pragma once

#include <cstdint>

namespace vicus::assets::people {

enum Joint : uint32_t {
  Hips,
  Spine,
  Chest,
  Neck,
  Head,
  LeftUpperArm,
  LeftLowerArm,
  LeftHand,
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
  RightToe
};

}  // namespace vicus::assets::people
