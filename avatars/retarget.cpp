#include "avatars/retarget.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "avatars/pose.hpp"
#include "avatars/resample.hpp"

namespace vicus::avatars {

using city::kNone;
using glm::quat;
using glm::vec3;

namespace {

constexpr size_t at(Bone bone) {
  return static_cast<size_t>(bone);
}

/// Lower case, letters and digits alone, without what comes before the last colon.
std::string plainName(std::string_view name) {
  if (const size_t colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

/// −1 left, 1 right, 0 neither; the side is taken out of the name.
int takeSide(std::string_view name, std::string& plain) {
  for (const auto& [word, side] : {std::pair{"left", -1}, std::pair{"right", 1}})
    if (const size_t where = plain.find(word); where != std::string::npos) {
      plain.erase(where, std::string_view(word).size());
      return side;
    }
  // "upperarm.l", "arm_L", "L_arm", and "LHipJoint", which CMU has beside "LeftHip".
  const size_t size = name.size();
  if (size > 2 && (name[size - 2] == '.' || name[size - 2] == '_')) {
    const char c = name[size - 1];
    if (c == 'l' || c == 'L' || c == 'r' || c == 'R') {
      plain.pop_back();
      return c == 'l' || c == 'L' ? -1 : 1;
    }
  }
  if (size > 2 && (name[0] == 'L' || name[0] == 'R' || name[0] == 'l' || name[0] == 'r') &&
      (name[1] == '_' || name[1] == '.')) {
    plain.erase(0, 1);
    return name[0] == 'L' || name[0] == 'l' ? -1 : 1;
  }
  return 0;
}

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

quat rotationOf(const glm::mat4& m) {
  return unitRotation(
      glm::quat_cast(glm::mat3(glm::normalize(vec3(m[0])), glm::normalize(vec3(m[1])), glm::normalize(vec3(m[2])))));
}

/// The shortest turn from one direction to another.
quat turnBetween(const vec3& from, const vec3& to) {
  const float lengths = glm::length(from) * glm::length(to);
  if (!(lengths > 0)) return {1, 0, 0, 0};
  const float cosine = glm::dot(from, to) / lengths;
  if (cosine < -0.9999F) return {1, 0, 0, 0};  // which way round, nobody knows
  const vec3 axis = glm::cross(from, to) / lengths;
  return unitRotation(quat(1 + cosine, axis.x, axis.y, axis.z));
}

/// The bone at whose joint each bone ends; none where it ends nowhere.
std::optional<Bone> endOf(Bone bone) {
  switch (bone) {
    case Bone::LeftCollar:
    case Bone::LeftUpperArm:
    case Bone::LeftLowerArm:
    case Bone::RightCollar:
    case Bone::RightUpperArm:
    case Bone::RightLowerArm:
    case Bone::LeftUpperLeg:
    case Bone::LeftLowerLeg:
    case Bone::LeftFoot:
    case Bone::RightUpperLeg:
    case Bone::RightLowerLeg:
    case Bone::RightFoot:
      return static_cast<Bone>(static_cast<uint8_t>(bone) + 1);
    default:
      return std::nullopt;
  }
}

/// Height of the hips over the lowest joint at rest.
float hipsHeight(const std::vector<glm::mat4>& rest, uint32_t hips) {
  float lowest = rest[hips][3].z;
  for (const glm::mat4& m : rest) lowest = std::min(lowest, m[3].z);
  return rest[hips][3].z - lowest;
}

}  // namespace

std::array<uint32_t, kBones> bonesOf(const city::Skeleton& skeleton) {
  std::array<uint32_t, kBones> bones;
  bones.fill(kNone);
  const auto& joints = skeleton.joints;
  const auto set = [&](Bone bone, uint32_t joint) {
    if (bones[at(bone)] == kNone) bones[at(bone)] = joint;
  };
  const auto onSide = [&](Bone left, int side, uint32_t joint) {
    const auto right = static_cast<Bone>(at(left) + 4);
    set(side < 0 ? left : right, joint);
  };
  // A "shoulder" is the collar bone where the same side has an arm beside it, else the upper arm.
  bool armsNamed = false;
  for (const city::Joint& j : joints) {
    std::string plain = plainName(j.name);
    if (takeSide(j.name, plain) != 0 && isOneOf(plain, {"arm", "upperarm", "uparm"})) armsNamed = true;
  }
  for (uint32_t j = 0; j < joints.size(); ++j) {
    std::string plain = plainName(joints[j].name);
    const int side = takeSide(joints[j].name, plain);
    if (side == 0) {
      if (isOneOf(plain, {"hips", "hip", "pelvis"})) set(Bone::Hips, j);
      if (isOneOf(plain, {"neck"})) set(Bone::Neck, j);
      if (isOneOf(plain, {"head"})) set(Bone::Head, j);
      if (plain.starts_with("spine") || plain.starts_with("chest") ||
          isOneOf(plain, {"lowerback", "abdomen", "torso"})) {
        if (bones[at(Bone::Spine)] == kNone)
          bones[at(Bone::Spine)] = j;
        else
          bones[at(Bone::Chest)] = j;
      }
      continue;
    }
    if (isOneOf(plain, {"collar", "clavicle"}) || (plain == "shoulder" && armsNamed)) onSide(Bone::LeftCollar, side, j);
    if (isOneOf(plain, {"arm", "upperarm", "uparm"}) || (plain == "shoulder" && !armsNamed))
      onSide(Bone::LeftUpperArm, side, j);
    if (isOneOf(plain, {"forearm", "lowerarm", "elbow"})) onSide(Bone::LeftLowerArm, side, j);
    if (isOneOf(plain, {"hand", "wrist"})) onSide(Bone::LeftHand, side, j);
    if (isOneOf(plain, {"upleg", "upperleg", "thigh", "hip"})) onSide(Bone::LeftUpperLeg, side, j);
    if (isOneOf(plain, {"leg", "lowerleg", "shin", "knee", "calf"})) onSide(Bone::LeftLowerLeg, side, j);
    if (isOneOf(plain, {"foot", "ankle"})) onSide(Bone::LeftFoot, side, j);
    if (isOneOf(plain, {"toe", "toes", "toebase"})) onSide(Bone::LeftToe, side, j);
  }
  return bones;
}

bool canWalk(const std::array<uint32_t, kBones>& bones) {
  for (const Bone b : {Bone::Hips, Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot, Bone::RightUpperLeg,
                       Bone::RightLowerLeg, Bone::RightFoot})
    if (bones[at(b)] == kNone) return false;
  return true;
}

city::Clip retarget(const city::Skeleton& source, const city::Clip& clip, const city::Skeleton& target,
                    double framesPerSecond) {
  city::Clip out;
  out.name = clip.name, out.duration = clip.duration, out.loops = clip.loops;
  const auto from = bonesOf(source), to = bonesOf(target);
  const uint32_t sourceHips = from[at(Bone::Hips)], targetHips = to[at(Bone::Hips)];
  if (sourceHips == kNone || targetHips == kNone) return out;

  // At rest: where both stand, and the turns that bring the target's bones to the source's directions.
  const auto sourceRest = characterFromJoints(source, restPose(source));
  const auto targetRest = characterFromJoints(target, restPose(target));
  std::vector<uint32_t> driver(target.joints.size(), kNone);
  std::vector<quat> carried(target.joints.size(), quat(1, 0, 0, 0));  // target's rest as the source's joint sees it
  quat limb(1, 0, 0, 0);
  for (size_t b = 0; b < kBones; ++b) {
    if (to[b] == kNone || from[b] == kNone) continue;
    const std::optional<Bone> end = endOf(static_cast<Bone>(b));
    if (end && to[at(*end)] != kNone && from[at(*end)] != kNone)
      limb = turnBetween(vec3(targetRest[to[at(*end)]][3] - targetRest[to[b]][3]),
                         vec3(sourceRest[from[at(*end)]][3] - sourceRest[from[b]][3]));
    else if (b <= at(Bone::Head))
      limb = quat(1, 0, 0, 0);  // trunks stand upright in both; hands and toes go with the bone before them
    driver[to[b]] = from[b];
    carried[to[b]] = glm::conjugate(rotationOf(sourceRest[from[b]])) * limb * rotationOf(targetRest[to[b]]);
  }
  const float sourceHeight = hipsHeight(sourceRest, sourceHips), targetHeight = hipsHeight(targetRest, targetHips);
  const float scale = sourceHeight > 0 ? targetHeight / sourceHeight : 1.0F;

  const double wanted = clip.duration > 0 && framesPerSecond > 0 ? std::ceil(clip.duration * framesPerSecond) : 0;
  const auto frames = static_cast<size_t>(std::clamp(wanted, 0.0, 100'000.0)) + (clip.loops && wanted >= 1 ? 0 : 1);
  std::vector<city::Pose> poses;
  for (const city::Pose& pose : posesOf(source, clip, frames)) {
    const auto sourceNow = characterFromJoints(source, pose);
    city::Pose& made = poses.emplace_back(restPose(target));
    std::vector<quat> now(target.joints.size());
    for (size_t j = 0; j < target.joints.size(); ++j) {
      const uint32_t parent = target.joints[j].parent;
      const quat above = parent < j ? now[parent] : quat(1, 0, 0, 0);
      now[j] =
          driver[j] == kNone ? above * target.joints[j].rest.rotation : rotationOf(sourceNow[driver[j]]) * carried[j];
      made[j].rotation = unitRotation(glm::conjugate(above) * now[j]);
    }
    // The hips' height over the ground and way over it, by the legs' lengths.
    const vec3 hips = vec3(sourceNow[sourceHips][3]) * scale;
    const glm::mat4 above = [&] {
      const uint32_t parent = target.joints[targetHips].parent;
      return parent < targetHips ? characterFromJoints(target, made)[parent] : glm::mat4(1);
    }();
    made[targetHips].translation = vec3(glm::inverse(above) * glm::vec4(hips, 1));
  }
  out = clipOf(target, poses, clip.duration, clip.loops);
  out.name = clip.name, out.stride = clip.stride * static_cast<double>(scale);
  return out;
}

}  // namespace vicus::avatars
