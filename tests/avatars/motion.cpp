/// Poses, other rates, fewer keys, other skeletons.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "avatars/cycle.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"
#include "avatars/retarget.hpp"
#include "city/random.hpp"

namespace vicus::avatars {
namespace {

using city::Clip;
using city::Pose;
using city::Skeleton;
using glm::quat;
using glm::vec3;

quat about(float angle, vec3 axis = {0, 0, 1}) {
  return glm::angleAxis(angle, axis);
}

city::JointTransform moved(float x, float y, float z) {
  return {quat(1, 0, 0, 0), vec3(x, y, z), vec3(1)};
}

/// Hips with two legs of two bones, feet and toes; `stretch` makes it taller. It faces +x.
Skeleton legs(float stretch = 1, bool mixamo = false) {
  Skeleton s;
  const auto name = [&](const char* ours, const char* theirs) { return std::string(mixamo ? theirs : ours); };
  s.joints.push_back({name("Hips", "mixamorig:Hips"), city::kNone, moved(0, 0, 0.95F * stretch)});
  for (const int side : {1, -1}) {
    const std::string word = side > 0 ? "Left" : "Right";
    const auto first = static_cast<uint32_t>(s.joints.size());
    s.joints.push_back({name((word + "UpperLeg").c_str(), ("mixamorig:" + word + "UpLeg").c_str()), 0,
                        moved(0, 0.1F * static_cast<float>(side) * stretch, 0)});
    s.joints.push_back({name((word + "LowerLeg").c_str(), ("mixamorig:" + word + "Leg").c_str()), first,
                        moved(0, 0, -0.45F * stretch)});
    s.joints.push_back({name((word + "Foot").c_str(), ("mixamorig:" + word + "Foot").c_str()), first + 1,
                        moved(0, 0, -0.42F * stretch)});
    s.joints.push_back({name((word + "Toe").c_str(), ("mixamorig:" + word + "ToeBase").c_str()), first + 2,
                        moved(0.14F * stretch, 0, -0.05F * stretch)});
  }
  return s;
}

/// Swinging legs while the hips go ahead at `speed`, from a stand that lasts a second to another.
Clip walk(const Skeleton& skeleton, double seconds, double speed, float toward = 0) {
  constexpr double kRate = 60;
  std::vector<Pose> poses;
  const quat turn = about(toward);
  for (int k = 0; k <= static_cast<int>(seconds * kRate); ++k) {
    const double t = k / kRate;
    const double moving = std::clamp(std::min(t - 1, seconds - 1 - t), 0.0, 1.0);
    Pose pose = restPose(skeleton);
    const double gone = speed * std::max(0.0, std::min(t, seconds - 1) - 1);
    const auto phase = static_cast<float>(2 * std::numbers::pi * t / 1.1);
    pose[0].translation = turn * (pose[0].translation + vec3(static_cast<float>(gone), 0, 0));
    pose[0].rotation = turn;
    const auto swing = static_cast<float>(0.45 * moving);
    pose[1].rotation = about(swing * std::sin(phase), {0, 1, 0});
    pose[5].rotation = about(-swing * std::sin(phase), {0, 1, 0});
    poses.push_back(pose);
  }
  return clipOf(skeleton, poses, seconds, false);
}

TEST(Pose, LinearAndSteppedKeys) {
  const Skeleton s = legs();
  Clip clip;
  clip.duration = 2, clip.loops = false;
  clip.tracks.push_back({});
  city::Track& t = clip.tracks[0];
  t.translationTimes = {0, 1, 2}, t.translations = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  Pose pose;
  samplePose(s, clip, 0.25, pose);
  EXPECT_NEAR(pose[0].translation.x, 0.25F, 1e-6F);
  samplePose(s, clip, 1.5, pose);
  EXPECT_NEAR(pose[0].translation.y, 1, 1e-6F);
  t.interpolation = city::Interpolation::Stepped;
  samplePose(s, clip, 0.99, pose);
  EXPECT_EQ(pose[0].translation, vec3(0));
  samplePose(s, clip, 1.99, pose);
  EXPECT_EQ(pose[0].translation, vec3(1, 0, 0));
  EXPECT_EQ(pose[1].translation, s.joints[1].rest.translation) << "joints without keys stand at rest";
}

TEST(Pose, ShorterArcAtEvenSpeed) {
  city::Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const auto rotation = [&] {
      return unitRotation(quat(static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-1, 1)),
                               static_cast<float>(random.uniform(-1, 1)), static_cast<float>(random.uniform(-1, 1))));
    };
    const quat a = rotation(), b = rotation();
    const auto angle = [](const quat& p, const quat& q) {
      return 2 * std::acos(std::min(1.0F, std::abs(glm::dot(p, q))));
    };
    const float whole = angle(a, b);
    EXPECT_LE(whole, std::numbers::pi_v<float> + 1e-3F);
    EXPECT_NEAR(angle(a, between(a, b, 0.3F)), 0.3F * whole, 2e-3F);
    EXPECT_NEAR(angle(between(a, -b, 0.5F), between(a, b, 0.5F)), 0, 2e-3F) << "b and −b are one rotation";
  }
}

TEST(Pose, BlendingEndsAtBoth) {
  const Skeleton s = legs();
  const Clip clip = walk(s, 4, 1);
  Pose a, b;
  samplePose(s, clip, 1.7, a), samplePose(s, clip, 2.1, b);
  const Pose half = blendPoses(a, b, 0.5F);
  EXPECT_EQ(blendPoses(a, b, 0)[1].translation, a[1].translation);
  EXPECT_NEAR(std::abs(glm::dot(blendPoses(a, b, 1)[1].rotation, b[1].rotation)), 1, 1e-6F);
  EXPECT_NEAR(half[0].translation.x, 0.5F * (a[0].translation.x + b[0].translation.x), 1e-6F);
}

TEST(Resample, KeepsThePosesAtItsKeys) {
  const Skeleton s = legs();
  const Clip clip = walk(s, 6, 1.2);
  const Clip same = resample(s, clip, 60);
  EXPECT_LT(largestDistance(s, clip, same, 361), 1e-4);
  EXPECT_LT(largestDistance(s, clip, resample(s, clip, 20), 1000), 0.01);
  EXPECT_EQ(resample(s, clip, 0).tracks.size(), clip.tracks.size());
}

TEST(Compress, TheStatedErrorHolds) {
  const Skeleton s = legs();
  const Clip clip = walk(s, 8, 1.2);
  size_t before = keyCount(clip);
  for (const double tolerance : {0.001, 0.003, 0.01}) {
    const Compressed c = compress(s, clip, tolerance);
    EXPECT_LE(c.error, tolerance);
    EXPECT_LE(largestDistance(s, clip, c.clip, 1777), 1.05 * tolerance)
        << "between the samples that it was measured at";
    EXPECT_LT(c.keysAfter, before) << "fewer the more may be lost";
    EXPECT_EQ(c.keysAfter, keyCount(c.clip));
    before = c.keysAfter;
  }
  EXPECT_EQ(compress(s, clip, 0).keysAfter, keyCount(clip));
}

TEST(Bones, NamesOfManyFiles) {
  const auto at = [](const Skeleton& s, Bone b) {
    const uint32_t j = bonesOf(s)[static_cast<size_t>(b)];
    return j == city::kNone ? std::string() : s.joints[j].name;
  };
  const auto named = [](std::initializer_list<const char*> names) {
    Skeleton s;
    for (const char* n : names) s.joints.push_back({n, s.joints.empty() ? city::kNone : 0, {}});
    return s;
  };
  const Skeleton cmu = named({"Hips", "LHipJoint", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe", "lowerback", "Chest",
                              "Chest2", "Neck", "Head", "LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"});
  EXPECT_EQ(at(cmu, Bone::LeftUpperLeg), "LeftHip");
  EXPECT_EQ(at(cmu, Bone::LeftUpperArm), "LeftShoulder");
  EXPECT_EQ(at(cmu, Bone::LeftCollar), "LeftCollar");
  EXPECT_EQ(at(cmu, Bone::Spine), "lowerback");
  EXPECT_EQ(at(cmu, Bone::Chest), "Chest2");
  const Skeleton mixamo = named({"mixamorig:Hips", "mixamorig:LeftShoulder", "mixamorig:LeftArm",
                                 "mixamorig:LeftForeArm", "mixamorig:RightUpLeg", "mixamorig:RightLeg"});
  EXPECT_EQ(at(mixamo, Bone::LeftCollar), "mixamorig:LeftShoulder");
  EXPECT_EQ(at(mixamo, Bone::LeftUpperArm), "mixamorig:LeftArm");
  EXPECT_EQ(at(mixamo, Bone::RightLowerLeg), "mixamorig:RightLeg");
  const Skeleton kaykit = named({"hips", "upperarm.l", "lowerarm.r", "wrist.l", "hand.l", "upperleg.r", "foot.l",
                                 "toes.l", "control-foot-roll.l", "IK-foot.l"});
  EXPECT_EQ(at(kaykit, Bone::LeftUpperArm), "upperarm.l");
  EXPECT_EQ(at(kaykit, Bone::RightLowerArm), "lowerarm.r");
  EXPECT_EQ(at(kaykit, Bone::LeftHand), "wrist.l");
  EXPECT_EQ(at(kaykit, Bone::LeftFoot), "foot.l");
}

TEST(Retarget, ToItselfChangesNothing) {
  const Skeleton s = legs();
  const Clip clip = walk(s, 5, 1.1);
  EXPECT_LT(largestDistance(s, clip, retarget(s, clip, s), 500), 1e-3);
}

TEST(Retarget, ToATallerOneWithOtherNamesKeepsTheAngles) {
  const Skeleton from = legs(), to = legs(1.5F, true);
  const Clip clip = walk(from, 5, 1.1), made = retarget(from, clip, to);
  Pose a, b;
  for (const double t : {0.3, 1.8, 2.2, 3.9}) {
    samplePose(from, clip, t, a), samplePose(to, made, t, b);
    const auto atA = characterFromJoints(from, a), atB = characterFromJoints(to, b);
    for (size_t j = 0; j < atA.size(); ++j)
      EXPECT_LT(glm::distance(1.5F * vec3(atA[j][3]), vec3(atB[j][3])), 2e-3F) << from.joints[j].name << " at " << t;
  }
}

TEST(Retarget, ArmsOutToArmsDown) {
  // The source rests with its arm out, the target with it down: a raised arm is raised on both.
  Skeleton out, down;
  for (Skeleton* s : {&out, &down}) s->joints.push_back({"Hips", city::kNone, moved(0, 0, 1)});
  out.joints.push_back({"LeftArm", 0, moved(0, 0.2F, 0.4F)});
  out.joints.push_back({"LeftForeArm", 1, moved(0, 0.3F, 0)});
  down.joints.push_back({"LeftArm", 0, moved(0, 0.2F, 0.4F)});
  down.joints.push_back({"LeftForeArm", 1, moved(0, 0, -0.3F)});
  Pose raised = restPose(out);
  raised[1].rotation = about(std::numbers::pi_v<float> / 2, {1, 0, 0});  // from +y to +z
  const Clip made = retarget(out, clipOf(out, {raised}, 0, false), down);
  Pose pose;
  samplePose(down, made, 0, pose);
  const auto at = characterFromJoints(down, pose);
  EXPECT_LT(glm::distance(vec3(at[2][3] - at[1][3]), vec3(0, 0, 0.3F)), 1e-4F);
}

TEST(Cycle, CutOutOfAWalkItLoopsAheadOnTheSpot) {
  const Skeleton s = legs();
  for (const float toward : {0.0F, 2.0F}) {
    const auto cycle = cutCycle(s, walk(s, 9, 1.3, toward));
    ASSERT_TRUE(cycle);
    EXPECT_NEAR(cycle->duration, 1.1, 0.05);
    EXPECT_NEAR(cycle->stride, 1.3 * cycle->duration, 0.02);
    Pose first, last;
    samplePose(s, *cycle, 0, first), samplePose(s, *cycle, cycle->duration - 1e-4, last);
    const auto a = characterFromJoints(s, first), b = characterFromJoints(s, last);
    for (size_t j = 0; j < a.size(); ++j) EXPECT_LT(glm::distance(vec3(a[j][3]), vec3(b[j][3])), 0.01F) << j;
    const vec3 across = vec3(a[1][3] - a[5][3]);
    EXPECT_NEAR(across.x, 0, 0.02F) << "it faces +x";
    EXPECT_GT(across.y, 0.1F);
  }
  EXPECT_FALSE(cutCycle(s, walk(s, 9, 0))) << "who stays has no cycle";
  EXPECT_FALSE(cutCycle(s, walk(s, 1, 1))) << "too short";
}

TEST(Cycle, SlipIsWhatTheLegsDoNotDo) {
  const Skeleton s = legs();
  Clip still;
  still.duration = 1;
  still.tracks.push_back({});
  still.tracks[0].rotationTimes = {0}, still.tracks[0].rotations = {quat(1, 0, 0, 0)};
  EXPECT_NEAR(footContact(s, still).slip, 0, 1e-6);
  EXPECT_NEAR(footContact(s, still, 1.2).slip, 0.6, 1e-4) << "half a stride each";
  EXPECT_NEAR(footContact(s, still).highest, 0, 1e-5);
}

TEST(Cycle, FeetAreSettledOnTheGround) {
  const Skeleton s = legs();
  Pose high = restPose(s);
  high[0].translation.z += 0.3F;
  Clip clip = clipOf(s, {high, high}, 1, true);
  EXPECT_NEAR(footContact(s, clip).highest, 0.3, 1e-5);
  settleFeet(s, clip);
  EXPECT_NEAR(footContact(s, clip).highest, 0, 1e-5);
}

}  // namespace
}  // namespace vicus::avatars
