// Motions made by code.
//
// Based on: Perry and Burnfield 2010, "Gait Analysis" (phases of the step: heel strike, flat foot, heel rise, swing,
// and their shares of a cycle).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "assets/people/joints.hpp"
#include "assets/people/townspeople.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"

namespace vicus::assets::people {
namespace {

using glm::quat;
using glm::vec2;
using glm::vec3;

constexpr float kTau = 2 * std::numbers::pi_v<float>;
constexpr float kThigh = 0.43F, kShin = 0.40F;          // metres
constexpr float kHipBelowHips = 0.03F, kAnkle = 0.08F;  // metres
constexpr float kStride = 1.16F, kCycle = 0.96F;        // metres and seconds: 1.2 m/s, an even walk
constexpr float kStance = 0.62F;                        // of a cycle that a foot bears
constexpr size_t kPoses = 48;

/// Turns about the axis across the body: positive swings what hangs down back.
quat back(float angle) {
  return glm::angleAxis(angle, vec3(0, 1, 0));
}
quat aside(float angle) {
  return glm::angleAxis(angle, vec3(1, 0, 0));
}
quat round(float angle) {
  return glm::angleAxis(angle, vec3(0, 0, 1));
}

/// Where a foot's ankle is (ahead of the hip's middle, above the ground) and how far its toes point up, radians.
struct FootState {
  vec2 ankle;
  float pitch;
  float toes;  // bent up against the foot
};

/// From the foot's own frame, ankle at the origin, toes ahead.
vec2 turned(vec2 p, float pitch) {
  return {p.x * std::cos(pitch) - p.y * std::sin(pitch), p.x * std::sin(pitch) + p.y * std::cos(pitch)};
}

/// A foot through its cycle: bears from 0 to kStance, its contact with the ground moving back as the body goes ahead.
FootState footAt(float u) {
  constexpr float kAhead = 0.29F;                  // of the ankle at heel strike, flat
  constexpr float kStrike = 0.30F, kRise = 0.95F;  // radians that the toes point up, the heel stands up
  constexpr float kFlatFrom = 0.10F, kFlatTo = 0.36F;
  const vec2 heel(-0.05F, -kAnkle), ball(0.13F, -0.05F);
  const auto stand = [&](float at) { return vec2(kAhead - kStride * at, kAnkle); };
  if (u < kFlatFrom) {  // rolls over the heel
    const float pitch = kStrike * (1 - u / kFlatFrom);
    return {stand(u) + heel - turned(heel, pitch), pitch, 0};
  }
  if (u < kStance) {  // flat, then rolls over the ball
    const float f = std::clamp((u - kFlatTo) / (kStance - kFlatTo), 0.0F, 1.0F);
    const float pitch = -kRise * f * f;
    return {stand(u) + ball - turned(ball, pitch), pitch, -pitch};
  }
  // Swings ahead: from where it left the ground to where it will strike.
  const float f = (u - kStance) / (1 - kStance), ease = f * f * (3 - 2 * f);
  const vec2 from = stand(kStance) + ball - turned(ball, -kRise), to = stand(0) + heel - turned(heel, kStrike);
  vec2 ankle = glm::mix(from, to, ease);
  ankle.y += 0.045F * std::sin(std::numbers::pi_v<float> * f);
  return {ankle, glm::mix(-kRise, kStrike, ease), kRise * std::max(0.0F, 1 - 3 * f)};
}

/// Bends a leg so that its ankle is where it should be; the hip stands `height` over the ground.
void bendLeg(city::Pose& pose, uint32_t upper, float height, const FootState& foot) {
  const vec2 d(foot.ankle.x, foot.ankle.y - height);
  const float reach = std::clamp(glm::length(d), 0.2F, kThigh + kShin - 1e-4F);
  const float swing = std::atan2(d.x, -d.y);
  const float atHip = std::acos((kThigh * kThigh + reach * reach - kShin * kShin) / (2 * kThigh * reach));
  const float atKnee = std::acos((kThigh * kThigh + kShin * kShin - reach * reach) / (2 * kThigh * kShin));
  const float thigh = -(swing + atHip), knee = std::numbers::pi_v<float> - atKnee;
  pose[upper].rotation = back(thigh);
  pose[upper + 1].rotation = back(knee);
  pose[upper + 2].rotation = back(-foot.pitch - thigh - knee);
  pose[upper + 3].rotation = back(-foot.toes);
}

/// Hips' height over the ground at which both legs reach their feet.
float hipsFor(float u) {
  const float bob = 0.012F * std::cos(2 * kTau * (u - 0.30F));
  float height = 0.94F - 0.022F + bob;
  for (const float leg : {u, u + 0.5F}) {
    const FootState foot = footAt(leg - std::floor(leg));
    const float most = (kThigh + kShin) * 0.998F;
    const float above = std::sqrt(std::max(most * most - foot.ankle.x * foot.ankle.x, 0.0F));
    height = std::min(height, foot.ankle.y + above + kHipBelowHips);
  }
  return height;
}

city::Pose walking(float u, bool carrying) {
  city::Pose pose = avatars::restPose(townSkeleton());
  // Smoothed over a tenth of a cycle: the legs' reach alone would make the hips jerk.
  float height = 0;
  for (int k = -4; k <= 4; ++k) height += hipsFor(u + 0.0125F * static_cast<float>(k) + 1) / 9;
  const float lowest = hipsFor(u);
  height = std::min(height, lowest);
  pose[Hips].translation.z = height;
  pose[Hips].translation.y = 0.018F * std::cos(kTau * (u - 0.31F));  // over the foot that bears
  bendLeg(pose, LeftUpperLeg, height - kHipBelowHips, footAt(u - std::floor(u)));
  const float other = u + 0.5F;
  bendLeg(pose, RightUpperLeg, height - kHipBelowHips, footAt(other - std::floor(other)));
  const float swing = std::cos(kTau * u);  // the left leg is ahead at 0
  pose[Spine].rotation = back(0.04F) * round(0.05F * swing);
  pose[Chest].rotation = round(0.07F * swing);
  pose[Neck].rotation = round(-0.08F * swing);
  pose[Head].rotation = back(-0.02F + 0.015F * std::cos(2 * kTau * u));
  if (carrying) {
    for (const auto& [arm, side] : {std::pair{LeftUpperArm, 1.0F}, std::pair{RightUpperArm, -1.0F}}) {
      pose[arm].rotation = aside(side * 0.10F) * back(-0.35F);
      pose[arm + 1].rotation = round(-side * 0.35F) * back(-1.15F);
      pose[arm + 2].rotation = back(-0.1F);
    }
    return pose;
  }
  pose[LeftUpperArm].rotation = aside(0.09F) * back(0.06F + 0.38F * swing);
  pose[RightUpperArm].rotation = aside(-0.09F) * back(0.06F - 0.38F * swing);
  pose[LeftLowerArm].rotation = back(-0.30F + 0.20F * swing);
  pose[RightLowerArm].rotation = back(-0.30F - 0.20F * swing);
  return pose;
}

/// Standing: feet apart, the weight a little on one leg, breathing; `talking` with the hands.
city::Pose standing(float u, bool talking) {
  city::Pose pose = avatars::restPose(townSkeleton());
  const float breath = std::sin(kTau * 2 * u), slow = std::sin(kTau * u);
  pose[Hips].translation.z = 0.9365F + 0.001F * breath;
  for (const auto& [leg, at] : {std::pair{LeftUpperLeg, 0.04F}, std::pair{RightUpperLeg, -0.05F}})
    bendLeg(pose, leg, pose[Hips].translation.z - kHipBelowHips, {{at, kAnkle}, 0, 0});
  pose[Spine].rotation = round(0.03F * slow) * back(0.02F);
  pose[Chest].rotation = back(0.015F * breath) * round(0.04F * slow);
  pose[Head].rotation = round(0.22F * std::sin(kTau * u + 1)) * back(0.04F * std::sin(kTau * 3 * u));
  pose[LeftUpperArm].rotation = aside(0.12F) * back(0.02F * breath);
  pose[RightUpperArm].rotation = aside(-0.12F) * back(0.02F * breath);
  pose[LeftLowerArm].rotation = back(-0.25F);
  pose[RightLowerArm].rotation = back(-0.25F);
  if (talking) {
    const float beat = std::sin(kTau * 4 * u), wave = 0.5F + 0.5F * std::sin(kTau * u - 1);
    pose[RightUpperArm].rotation = aside(-0.22F - 0.12F * wave) * back(-0.35F * wave - 0.08F * beat * wave);
    pose[RightLowerArm].rotation = round(0.3F * wave) * back(-0.5F - 0.9F * wave + 0.22F * beat * wave);
    pose[LeftUpperArm].rotation = aside(0.16F) * back(-0.15F + 0.06F * beat * (1 - wave));
    pose[LeftLowerArm].rotation = round(-0.4F) * back(-1.0F - 0.15F * beat * (1 - wave));
    pose[Head].rotation = round(0.12F * slow) * back(0.07F * beat * wave);
  }
  return pose;
}

}  // namespace

std::string_view nameOf(city::Role role) {
  constexpr std::string_view kNames[] = {"walk", "idle", "talk", "carry"};
  return kNames[static_cast<size_t>(role)];
}

city::Clip makeClip(city::Role role) {
  const bool moves = role == city::Role::Walk || role == city::Role::Carry;
  std::vector<city::Pose> poses;
  for (size_t k = 0; k < kPoses; ++k) {
    const float u = static_cast<float>(k) / static_cast<float>(kPoses);
    poses.push_back(moves ? walking(u, role == city::Role::Carry) : standing(u, role == city::Role::Talk));
  }
  const double duration = moves ? static_cast<double>(kCycle) : role == city::Role::Talk ? 5.0 : 6.0;
  city::Clip clip = avatars::clipOf(townSkeleton(), poses, duration, true);
  clip.name = nameOf(role);
  if (moves) clip.stride = static_cast<double>(kStride);
  return clip;
}

}  // namespace vicus::assets::people
