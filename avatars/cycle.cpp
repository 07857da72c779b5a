#include "avatars/cycle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "avatars/pose.hpp"
#include "avatars/resample.hpp"
#include "avatars/retarget.hpp"

namespace vicus::avatars {

using city::kNone;
using city::Pose;
using glm::mat4;
using glm::quat;
using glm::vec3;

namespace {

constexpr double kRate = 60;  // frames a second that cycles are cut in

/// Where the joints are, without where on the ground and whither the hips face.
struct Shape {
  std::vector<vec3> joints;
  glm::vec2 hips;
};

std::vector<Shape> shapesOf(const city::Skeleton& skeleton, const std::vector<Pose>& poses, uint32_t hips,
                            uint32_t left, uint32_t right) {
  std::vector<Shape> shapes;
  for (const Pose& pose : poses) {
    const auto at = characterFromJoints(skeleton, pose);
    const vec3 across = vec3(at[left][3] - at[right][3]);
    const float angle = std::atan2(-across.x, across.y);  // of what is ahead, from +x
    const quat back = glm::angleAxis(-angle, vec3(0, 0, 1));
    Shape& shape = shapes.emplace_back();
    shape.hips = glm::vec2(at[hips][3]);
    for (const mat4& m : at) shape.joints.push_back(back * (vec3(m[3]) - vec3(shape.hips, 0)));
  }
  return shapes;
}

double difference(const Shape& a, const Shape& b) {
  double sum = 0;
  for (size_t j = 0; j < a.joints.size(); ++j) sum += static_cast<double>(glm::distance(a.joints[j], b.joints[j]));
  return sum / static_cast<double>(std::max<size_t>(a.joints.size(), 1));
}

/// Puts a turn and a shift of the character before the root joint's own transform.
void moveRoot(city::JointTransform& root, const quat& turn, const vec3& shift) {
  root.rotation = unitRotation(turn * root.rotation);
  root.translation = turn * root.translation + shift;
}

}  // namespace

std::optional<city::Clip> cutCycle(const city::Skeleton& skeleton, const city::Clip& clip,
                                   const CycleOptions& options) {
  const auto bones = bonesOf(skeleton);
  if (!canWalk(bones)) return std::nullopt;
  const uint32_t hips = bones[static_cast<size_t>(Bone::Hips)];
  const auto shortest = static_cast<size_t>(options.shortest * kRate),
             longest = static_cast<size_t>(options.longest * kRate);
  const auto count = static_cast<size_t>(std::min(clip.duration, 600.0) * kRate);
  if (count < 2 * shortest || shortest < 4) return std::nullopt;
  city::Clip once = clip;
  once.loops = false;
  std::vector<Pose> poses = posesOf(skeleton, once, count);
  const std::vector<Shape> shapes = shapesOf(skeleton, poses, hips, bones[static_cast<size_t>(Bone::LeftUpperLeg)],
                                             bones[static_cast<size_t>(Bone::RightUpperLeg)]);

  // Speed over the ground in the fastest stretch of the shortest cycle's length.
  const auto way = [&](size_t from, size_t to) {
    return static_cast<double>(glm::distance(shapes[from].hips, shapes[to].hips));
  };
  double fastest = 0;
  for (size_t k = 0; k + shortest < count; ++k)
    fastest = std::max(fastest, way(k, k + shortest) / static_cast<double>(shortest));
  if (!(fastest * kRate > 0.05)) return std::nullopt;

  size_t begin = 0, length = 0;
  double best = std::numeric_limits<double>::infinity();
  for (size_t b = 1; b + shortest + 1 < count; ++b)
    for (size_t l = shortest; l <= longest && b + l + 1 < count; ++l) {
      if (way(b, b + l) < options.leastSpeed * fastest * static_cast<double>(l)) continue;
      // Alike where it joins, and just after: the same pose passed the other way round is no match.
      const double d = difference(shapes[b], shapes[b + l]) + 0.5 * difference(shapes[b + 1], shapes[b + l + 1]) +
                       0.5 * difference(shapes[b - 1], shapes[b + l - 1]);
      if (d < best) best = d, begin = b, length = l;
    }
  if (length == 0) return std::nullopt;

  // The way over the ground goes out, evenly; what is ahead becomes +x.
  const glm::vec2 from = shapes[begin].hips, travelled = shapes[begin + length].hips - from;
  const quat turn = glm::angleAxis(-std::atan2(travelled.y, travelled.x), vec3(0, 0, 1));
  std::vector<Pose> cycle;
  for (size_t k = 0; k <= length; ++k) {
    Pose pose = poses[begin + k];
    const glm::vec2 gone = from + travelled * (static_cast<float>(k) / static_cast<float>(length));
    for (uint32_t j = 0; j < pose.size(); ++j)
      if (skeleton.joints[j].parent >= j) moveRoot(pose[j], turn, turn * vec3(-gone, 0));
    cycle.push_back(std::move(pose));
  }
  // The last third goes over to what comes before the beginning, so that the end is the beginning.
  const size_t third = std::min(length / 3, begin);
  for (size_t k = length - third; k <= length && third > 0; ++k) {
    const float f = static_cast<float>(k - (length - third)) / static_cast<float>(third);
    const size_t before = begin - (length - k);
    Pose earlier = poses[before];
    const glm::vec2 gone = from + travelled * (-static_cast<float>(length - k) / static_cast<float>(length));
    for (uint32_t j = 0; j < earlier.size(); ++j)
      if (skeleton.joints[j].parent >= j) moveRoot(earlier[j], turn, turn * vec3(-gone, 0));
    cycle[k] = blendPoses(cycle[k], earlier, f * f * (3 - 2 * f));
  }
  cycle.pop_back();
  city::Clip out = clipOf(skeleton, cycle, static_cast<double>(length) / kRate, true);
  out.name = clip.name, out.stride = static_cast<double>(glm::length(travelled));
  return out;
}

namespace {

struct Feet {
  std::vector<std::array<vec3, 2>> left, right;  ///< for each time: ankle and toe (the ankle twice without a toe)
  float restAnkle = 0, restToe = 0;
};

std::optional<Feet> feetOf(const city::Skeleton& skeleton, const city::Clip& clip, size_t samples) {
  const auto bones = bonesOf(skeleton);
  if (!canWalk(bones)) return std::nullopt;
  const auto joint = [&](Bone b, Bone instead) {
    const uint32_t j = bones[static_cast<size_t>(b)];
    return j == kNone ? bones[static_cast<size_t>(instead)] : j;
  };
  const uint32_t la = joint(Bone::LeftFoot, Bone::LeftFoot), lt = joint(Bone::LeftToe, Bone::LeftFoot);
  const uint32_t ra = joint(Bone::RightFoot, Bone::RightFoot), rt = joint(Bone::RightToe, Bone::RightFoot);
  const auto rest = characterFromJoints(skeleton, restPose(skeleton));
  Feet feet;
  feet.restAnkle = std::min(rest[la][3].z, rest[ra][3].z), feet.restToe = std::min(rest[lt][3].z, rest[rt][3].z);
  for (const Pose& pose : posesOf(skeleton, clip, samples)) {
    const auto at = characterFromJoints(skeleton, pose);
    feet.left.push_back({vec3(at[la][3]), vec3(at[lt][3])});
    feet.right.push_back({vec3(at[ra][3]), vec3(at[rt][3])});
  }
  return feet;
}

constexpr size_t kFootSamples = 240;

/// How far a foot is over the ground: the lower of ankle and toe, each over its height at rest.
float heightOf(const Feet& feet, const std::array<vec3, 2>& foot) {
  return std::min(foot[0].z - feet.restAnkle, foot[1].z - feet.restToe);
}

}  // namespace

void settleFeet(const city::Skeleton& skeleton, city::Clip& clip) {
  const std::optional<Feet> feet = feetOf(skeleton, clip, kFootSamples);
  if (!feet) return;
  // The lower foot bears; the median of its heights is no outlier.
  std::vector<float> heights;
  for (size_t k = 0; k < feet->left.size(); ++k)
    heights.push_back(std::min(heightOf(*feet, feet->left[k]), heightOf(*feet, feet->right[k])));
  std::nth_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2), heights.end());
  const float over = heights[heights.size() / 2];
  const uint32_t hips = bonesOf(skeleton)[static_cast<size_t>(Bone::Hips)];
  const uint32_t parent = skeleton.joints[hips].parent;
  const auto rest = characterFromJoints(skeleton, restPose(skeleton));
  const vec3 down = glm::inverse(glm::mat3(parent < hips ? rest[parent] : mat4(1))) * vec3(0, 0, -over);
  for (city::Track& track : clip.tracks)
    if (track.joint == hips)
      for (vec3& t : track.translations) t += down;
}

double strideOf(const city::Skeleton& skeleton, const city::Clip& clip) {
  const std::optional<Feet> feet = feetOf(skeleton, clip, kFootSamples);
  if (!feet) return 0;
  // The median of how fast the lower foot moves back: its swing and its landing do not count.
  std::vector<float> steps;
  for (size_t k = 0; k < kFootSamples; ++k) {
    const bool left = heightOf(*feet, feet->left[k]) < heightOf(*feet, feet->right[k]);
    const auto& foot = left ? feet->left : feet->right;
    const size_t part = foot[k][0].z - feet->restAnkle < foot[k][1].z - feet->restToe ? 0 : 1;
    steps.push_back(foot[k][part].x - foot[(k + 1) % kFootSamples][part].x);
  }
  std::nth_element(steps.begin(), steps.begin() + kFootSamples / 2, steps.end());
  return std::max(0.0, static_cast<double>(steps[kFootSamples / 2]) * static_cast<double>(kFootSamples));
}

FootContact footContact(const city::Skeleton& skeleton, const city::Clip& clip, std::optional<double> stride) {
  FootContact out;
  const std::optional<Feet> feet = feetOf(skeleton, clip, kFootSamples);
  if (!feet) return out;
  const double gone = stride.value_or(clip.stride);
  out.lowest = -std::numeric_limits<double>::infinity(), out.highest = out.lowest;
  double slid = 0;
  for (size_t k = 0; k < kFootSamples; ++k) {
    const float left = heightOf(*feet, feet->left[k]), right = heightOf(*feet, feet->right[k]);
    out.lowest = std::max(out.lowest, -static_cast<double>(std::min(left, right)));
    out.highest = std::max(out.highest, static_cast<double>(std::min(left, right)));
    // The foot that is lower bears: by whichever of ankle and toe is nearer the ground, how far does it slide?
    const auto& foot = left < right ? feet->left : feet->right;
    const size_t next = (k + 1) % kFootSamples;
    const size_t part = foot[k][0].z - feet->restAnkle < foot[k][1].z - feet->restToe ? 0 : 1;
    const glm::vec2 moved = glm::vec2(foot[next][part] - foot[k][part]) +
                            glm::vec2(static_cast<float>(gone / static_cast<double>(kFootSamples)), 0);
    slid += static_cast<double>(glm::length(moved));
  }
  out.slip = slid / 2;  // two steps in a cycle
  return out;
}

}  // namespace vicus::avatars
