#include "avatars/pose.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::avatars {

using city::JointTransform;
using glm::mat4;
using glm::quat;
using glm::vec3;

namespace {

bool finite(const vec3& v) {
  return std::isfinite(v.x + v.y + v.z);
}

/// The two keys about a time and how far it lies between them; no keys give nothing.
struct Keys {
  size_t before, after;
  float fraction;
};
std::optional<Keys> keysAt(std::span<const float> times, size_t values, double time, city::Interpolation how) {
  const size_t count = std::min(times.size(), values);
  if (count == 0) return std::nullopt;
  const auto begin = times.begin(), end = times.begin() + static_cast<std::ptrdiff_t>(count);
  const auto later =
      std::upper_bound(begin, end, time, [](double t, float key) { return t < static_cast<double>(key); });
  const auto after = static_cast<size_t>(later - begin);
  if (after == 0) return Keys{0, 0, 0};
  if (after == count || how == city::Interpolation::Stepped) return Keys{after - 1, after - 1, 0};
  const double from = static_cast<double>(times[after - 1]), to = static_cast<double>(times[after]);
  return Keys{after - 1, after, static_cast<float>((time - from) / (to - from))};
}

}  // namespace

city::Pose restPose(const city::Skeleton& skeleton) {
  city::Pose pose;
  pose.reserve(skeleton.joints.size());
  for (const city::Joint& joint : skeleton.joints) pose.push_back(joint.rest);
  return pose;
}

quat unitRotation(const quat& rotation) {
  // Scaled first, so that no square leaves the range of a float.
  const float largest =
      std::max({std::abs(rotation.x), std::abs(rotation.y), std::abs(rotation.z), std::abs(rotation.w)});
  if (!(largest > 0) || !std::isfinite(largest)) return {1, 0, 0, 0};
  const quat scaled = rotation * (1 / largest);
  const float length = glm::length(scaled);
  return std::isfinite(length) ? scaled * (1 / length) : quat(1, 0, 0, 0);
}

quat between(const quat& a, const quat& b, float fraction) {
  const quat from = unitRotation(a);
  quat to = unitRotation(b);
  float cosine = glm::dot(from, to);
  if (cosine < 0) to = -to, cosine = -cosine;
  // So near that the arc is its chord.
  if (cosine > 0.9995F) return unitRotation(from * (1 - fraction) + to * fraction);
  const float angle = std::acos(cosine);
  return unitRotation((from * std::sin((1 - fraction) * angle) + to * std::sin(fraction * angle)) *
                      (1 / std::sin(angle)));
}

double timeInClip(const city::Clip& clip, double time) {
  if (!(clip.duration > 0) || !std::isfinite(clip.duration) || !std::isfinite(time)) return 0;
  if (!clip.loops) return std::clamp(time, 0.0, clip.duration);
  const double wrapped = std::fmod(time, clip.duration);
  return wrapped < 0 ? wrapped + clip.duration : wrapped;
}

void samplePose(const city::Skeleton& skeleton, const city::Clip& clip, double time, city::Pose& out) {
  out.resize(skeleton.joints.size());
  for (size_t j = 0; j < out.size(); ++j) out[j] = skeleton.joints[j].rest;
  const double at = timeInClip(clip, time);
  for (const city::Track& track : clip.tracks) {
    if (track.joint >= out.size()) continue;
    JointTransform& joint = out[track.joint];
    if (const auto k = keysAt(track.rotationTimes, track.rotations.size(), at, track.interpolation))
      joint.rotation = between(track.rotations[k->before], track.rotations[k->after], k->fraction);
    const auto mixed = [&](const std::vector<float>& times, const std::vector<vec3>& values, vec3& into) {
      const auto k = keysAt(times, values.size(), at, track.interpolation);
      if (!k) return;
      const vec3 value = glm::mix(values[k->before], values[k->after], k->fraction);
      if (finite(value)) into = value;
    };
    mixed(track.translationTimes, track.translations, joint.translation);
    mixed(track.scaleTimes, track.scales, joint.scale);
  }
}

city::Pose blendPoses(const city::Pose& a, const city::Pose& b, float fraction) {
  city::Pose out = a;
  for (size_t j = 0; j < std::min(a.size(), b.size()); ++j) {
    out[j].rotation = between(a[j].rotation, b[j].rotation, fraction);
    out[j].translation = glm::mix(a[j].translation, b[j].translation, fraction);
    out[j].scale = glm::mix(a[j].scale, b[j].scale, fraction);
  }
  return out;
}

mat4 matrixOf(const JointTransform& t) {
  mat4 m = glm::mat4_cast(t.rotation);
  for (int k = 0; k < 3; ++k) m[k] *= t.scale[k];
  m[3] = glm::vec4(t.translation, 1);
  return m;
}

std::vector<mat4> characterFromJoints(const city::Skeleton& skeleton, std::span<const JointTransform> pose) {
  std::vector<mat4> out(skeleton.joints.size());
  for (size_t j = 0; j < out.size(); ++j) {
    const uint32_t parent = skeleton.joints[j].parent;
    const mat4 local = matrixOf(j < pose.size() ? pose[j] : skeleton.joints[j].rest);
    out[j] = parent < j ? out[parent] * local : local;
  }
  return out;
}

void addSkinMatrices(const city::Character& character, std::span<const JointTransform> pose,
                     std::vector<std::array<glm::vec4, 3>>& out) {
  const std::vector<mat4> joints = characterFromJoints(character.skeleton, pose);
  for (size_t j = 0; j < joints.size(); ++j) {
    const mat4 rows =
        glm::transpose(j < character.jointFromSkin.size() ? joints[j] * character.jointFromSkin[j] : joints[j]);
    out.push_back({rows[0], rows[1], rows[2]});
  }
}

vec3 skinned(const city::AvatarVertex& vertex, std::span<const std::array<glm::vec4, 3>> matrices) {
  vec3 sum(0);
  const glm::vec4 p(vertex.position, 1);
  for (size_t k = 0; k < 4; ++k) {
    if (vertex.weights[k] == 0 || vertex.joints[k] >= matrices.size()) continue;
    const auto& m = matrices[vertex.joints[k]];
    sum +=
        static_cast<float>(vertex.weights[k]) / 255.0F * vec3(glm::dot(m[0], p), glm::dot(m[1], p), glm::dot(m[2], p));
  }
  return sum;
}

std::optional<uint32_t> findJoint(const city::Skeleton& skeleton, std::string_view name) {
  for (uint32_t j = 0; j < skeleton.joints.size(); ++j)
    if (skeleton.joints[j].name == name) return j;
  return std::nullopt;
}

city::Aabbf boundsInClips(const city::Character& character) {
  constexpr int kPoses = 12;         // through each clip
  constexpr float kBetween = 0.03F;  // metres that a body may reach farther between two of them
  city::Aabbf box;
  city::Pose pose;
  std::vector<std::array<glm::vec4, 3>> matrices;
  for (const city::Clip& clip : character.clips)
    for (int k = 0; k < kPoses; ++k) {
      samplePose(character.skeleton, clip, clip.duration * k / kPoses, pose);
      matrices.clear();
      addSkinMatrices(character, pose, matrices);
      for (const city::AvatarVertex& v : character.levels[0].vertices) box.extend(skinned(v, matrices));
    }
  if (!box.empty()) box.min -= kBetween, box.max += kBetween;
  return box;
}

}  // namespace vicus::avatars
