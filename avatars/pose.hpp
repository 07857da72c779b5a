/// Poses from clips, and matrices from poses.
///
/// Based on: Willmott et al. 2001, §5.2 (key-frame interpolation); Shoemake 1985, "Animating Rotation with Quaternion
/// Curves" (slerp).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "city/avatars.hpp"

namespace vicus::avatars {

/// All joints at rest.
city::Pose restPose(const city::Skeleton& skeleton);

/// A rotation of unit length; the identity for one of no length or that is not finite.
glm::quat unitRotation(const glm::quat& rotation);

/// The rotation a fraction (0 to 1) of the shorter arc from `a` to `b`; neither need be of unit length. A rotation and
/// its negative are the same one: nothing moves between them.
glm::quat between(const glm::quat& a, const glm::quat& b, float fraction);

/// Where in a clip of that duration a time lies, seconds: wrapped where it loops, else held at its ends; 0 for a clip
/// of no duration and a time that is not finite.
double timeInClip(const city::Clip& clip, double time);

/// The pose at a time in seconds. Joints without a track stand at rest; keys beyond the shorter of a track's times and
/// values, and tracks of joints that the skeleton lacks, are as if they were not there. Values that are not finite give
/// the rest. `out` is overwritten; its storage is reused.
void samplePose(const city::Skeleton& skeleton, const city::Clip& clip, double time, city::Pose& out);

/// Each joint a fraction (0: a, 1: b) of the way from one pose to another of the same skeleton.
city::Pose blendPoses(const city::Pose& a, const city::Pose& b, float fraction);

glm::mat4 matrixOf(const city::JointTransform& transform);

/// For each joint the matrix from its frame to the character's. A pose of fewer joints than the skeleton leaves the
/// others at rest.
std::vector<glm::mat4> characterFromJoints(const city::Skeleton& skeleton, std::span<const city::JointTransform> pose);

/// Appends the matrices from the mesh at rest to the posed one, by row, one for each joint.
void addSkinMatrices(const city::Character& character, std::span<const city::JointTransform> pose,
                     std::vector<std::array<glm::vec4, 3>>& out);

/// A point of the mesh in a pose: the weighted mean of where its joints' matrices (from `addSkinMatrices`) put it.
glm::vec3 skinned(const city::AvatarVertex& vertex, std::span<const std::array<glm::vec4, 3>> matrices);

/// Index of the joint with that name.
std::optional<uint32_t> findJoint(const city::Skeleton& skeleton, std::string_view name);

/// Bounds of the full mesh in poses throughout the character's clips.
city::Aabbf boundsInClips(const city::Character& character);

}  // namespace vicus::avatars
