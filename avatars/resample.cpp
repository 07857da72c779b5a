#include "avatars/resample.hpp"

#include <algorithm>
#include <cmath>

#include "avatars/pose.hpp"

namespace vicus::avatars {

using city::Clip;
using city::Pose;
using city::Skeleton;
using city::Track;
using glm::quat;
using glm::vec3;

namespace {

constexpr size_t kMostFrames = 100'000;

/// How far the joints below each joint reach from it at rest, metres: what its rotation moves.
std::vector<float> reachOf(const Skeleton& skeleton) {
  const auto at = characterFromJoints(skeleton, restPose(skeleton));
  std::vector<float> reach(at.size(), 0.0F);
  for (size_t j = 0; j < at.size(); ++j)
    for (uint32_t up = skeleton.joints[j].parent; up < j; up = skeleton.joints[up].parent) {
      reach[up] = std::max(reach[up], glm::distance(vec3(at[up][3]), vec3(at[j][3])));
      if (skeleton.joints[up].parent >= up) break;
    }
  return reach;
}

/// Radians between two rotations.
float angleBetween(const quat& a, const quat& b) {
  return 2 * std::acos(std::min(1.0F, std::abs(glm::dot(unitRotation(a), unitRotation(b)))));
}

/// Keeps of a list of keys those without which some other would be farther than `tolerance` from where linear
/// interpolation puts it: from each kept key the longest run that holds.
template <typename Value, typename Mix, typename Distance>
void thin(std::vector<float>& times, std::vector<Value>& values, float tolerance, const Mix& mix,
          const Distance& distance) {
  const size_t count = std::min(times.size(), values.size());
  if (count < 3) return;
  std::vector<size_t> kept{0};
  const auto holds = [&](size_t from, size_t to) {
    for (size_t k = from + 1; k < to; ++k) {
      const float span = times[to] - times[from];
      const float f = span > 0 ? (times[k] - times[from]) / span : 0.0F;
      if (!(distance(mix(values[from], values[to], f), values[k]) <= tolerance)) return false;
    }
    return true;
  };
  while (kept.back() + 1 < count) {
    size_t next = kept.back() + 1;
    while (next + 1 < count && next - kept.back() < 64 && holds(kept.back(), next + 1)) ++next;
    kept.push_back(next);
  }
  // Two equal keys are one.
  if (kept.size() == 2 && !(distance(values[kept[0]], values[kept[1]]) > 0)) kept.pop_back();
  for (size_t k = 0; k < kept.size(); ++k) times[k] = times[kept[k]], values[k] = values[kept[k]];
  times.resize(kept.size()), values.resize(kept.size());
}

Clip thinned(const Skeleton& skeleton, const Clip& clip, const std::vector<float>& reach, double tolerance) {
  Clip out = clip;
  const auto mixVec = [](const vec3& a, const vec3& b, float f) { return glm::mix(a, b, f); };
  const auto distanceVec = [](const vec3& a, const vec3& b) { return glm::distance(a, b); };
  const auto length = static_cast<float>(tolerance);
  for (Track& t : out.tracks) {
    if (t.interpolation == city::Interpolation::Stepped || t.joint >= skeleton.joints.size()) continue;
    const float arm = std::max(reach[t.joint], 0.02F);
    thin(t.rotationTimes, t.rotations, length / arm, between, angleBetween);
    thin(t.translationTimes, t.translations, length, mixVec, distanceVec);
    thin(t.scaleTimes, t.scales, length / arm, mixVec, distanceVec);
  }
  return out;
}

}  // namespace

std::vector<Pose> posesOf(const Skeleton& skeleton, const Clip& clip, size_t count) {
  std::vector<Pose> poses(std::max<size_t>(count, 1));
  const size_t steps = clip.loops ? poses.size() : std::max<size_t>(poses.size() - 1, 1);
  for (size_t k = 0; k < poses.size(); ++k)
    samplePose(skeleton, clip, clip.duration * static_cast<double>(k) / static_cast<double>(steps), poses[k]);
  return poses;
}

Clip clipOf(const Skeleton& skeleton, const std::vector<Pose>& poses, double duration, bool loops) {
  Clip clip;
  clip.duration = duration, clip.loops = loops;
  if (poses.empty()) return clip;
  const size_t keys = poses.size() + (loops && poses.size() > 1 ? 1 : 0);
  const size_t steps = std::max<size_t>(keys - 1, 1);
  for (uint32_t j = 0; j < skeleton.joints.size(); ++j) {
    const city::JointTransform& rest = skeleton.joints[j].rest;
    bool turns = false, moves = false, grows = false;
    for (const Pose& p : poses) {
      turns |= angleBetween(p[j].rotation, rest.rotation) > 1e-6F;
      moves |= p[j].translation != rest.translation;
      grows |= p[j].scale != rest.scale;
    }
    if (!turns && !moves && !grows) continue;
    Track& track = clip.tracks.emplace_back();
    track.joint = j;
    for (size_t k = 0; k < keys; ++k) {
      const city::JointTransform& at = poses[k % poses.size()][j];
      const auto time = static_cast<float>(duration * static_cast<double>(k) / static_cast<double>(steps));
      if (turns) track.rotationTimes.push_back(time), track.rotations.push_back(at.rotation);
      if (moves) track.translationTimes.push_back(time), track.translations.push_back(at.translation);
      if (grows) track.scaleTimes.push_back(time), track.scales.push_back(at.scale);
    }
  }
  return clip;
}

Clip resample(const Skeleton& skeleton, const Clip& clip, double framesPerSecond) {
  if (!(framesPerSecond > 0) || !(clip.duration > 0)) return clip;
  const double frames = std::min(std::ceil(clip.duration * framesPerSecond), static_cast<double>(kMostFrames));
  const auto count = static_cast<size_t>(std::max(frames, 1.0)) + (clip.loops ? 0 : 1);
  Clip out = clipOf(skeleton, posesOf(skeleton, clip, count), clip.duration, clip.loops);
  out.name = clip.name, out.stride = clip.stride;
  return out;
}

double largestDistance(const Skeleton& skeleton, const Clip& a, const Clip& b, size_t samples) {
  const double duration = std::max(a.duration, b.duration);
  double largest = 0;
  Pose poseA, poseB;
  for (size_t k = 0; k < std::max<size_t>(samples, 1); ++k) {
    const double time = duration * static_cast<double>(k) / static_cast<double>(std::max<size_t>(samples, 1));
    samplePose(skeleton, a, time, poseA), samplePose(skeleton, b, time, poseB);
    const auto atA = characterFromJoints(skeleton, poseA), atB = characterFromJoints(skeleton, poseB);
    for (size_t j = 0; j < atA.size(); ++j)
      largest = std::max(largest, static_cast<double>(glm::distance(vec3(atA[j][3]), vec3(atB[j][3]))));
  }
  return largest;
}

size_t keyCount(const Clip& clip) {
  size_t count = 0;
  for (const Track& t : clip.tracks) count += t.rotationTimes.size() + t.translationTimes.size() + t.scaleTimes.size();
  return count;
}

Compressed compress(const Skeleton& skeleton, const Clip& clip, double tolerance) {
  Compressed out{clip, 0, keyCount(clip), keyCount(clip)};
  if (!(tolerance > 0)) return out;
  size_t mostKeys = 2;
  for (const Track& t : clip.tracks)
    mostKeys = std::max({mostKeys, t.rotationTimes.size(), t.translationTimes.size(), t.scaleTimes.size()});
  const size_t samples = std::min(3 * mostKeys, size_t{3000});
  const std::vector<float> reach = reachOf(skeleton);
  // The errors of a chain's joints add up: each joint's share is halved until their sum holds.
  for (double share = 0.5 * tolerance; share > tolerance / 1024; share /= 2) {
    Clip fewer = thinned(skeleton, clip, reach, share);
    const double error = largestDistance(skeleton, clip, fewer, samples);
    if (!(error <= tolerance)) continue;
    out.error = error, out.keysAfter = keyCount(fewer), out.clip = std::move(fewer);
    break;
  }
  return out;
}

}  // namespace vicus::avatars
