/// People: their skeletons, clips, bodies, and where they walk and stand.
///
/// Based on: Willmott et al. 2001, §5.2 (key-frame interpolated, motion-captured avatars that play single motions from
/// a library).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "city/aabb.hpp"
#include "city/instance.hpp"

namespace vicus::city {

/// Where a joint stands in its parent's frame: applied to a point in the order scale, rotation, translation.
struct JointTransform {
  glm::quat rotation{1, 0, 0, 0};  ///< unit
  glm::vec3 translation{0};        ///< metres
  glm::vec3 scale{1};

  bool operator==(const JointTransform&) const = default;
};

/// One transform for each joint of a skeleton.
using Pose = std::vector<JointTransform>;

struct Joint {
  std::string name;
  uint32_t parent = kNone;  ///< before the joint in its skeleton; kNone: stands in the character's frame
  JointTransform rest;
};

/// Joints, parents before children. Frame of the character: metres, z up, facing +x, the origin on the ground between
/// the feet.
struct Skeleton {
  std::vector<Joint> joints;
};

enum class Interpolation : uint8_t { Linear, Stepped };

/// The keys of one joint. Times in seconds, never decreasing, each list as long as its values; an empty list leaves
/// that part of the joint at rest. Where several keys have one time, the last holds from there on.
struct Track {
  uint32_t joint = 0;
  Interpolation interpolation = Interpolation::Linear;
  std::vector<float> rotationTimes, translationTimes, scaleTimes;
  std::vector<glm::quat> rotations;
  std::vector<glm::vec3> translations, scales;
};

/// A motion. Before its first key and after its last a track holds these.
struct Clip {
  std::string name;
  double duration = 0;  ///< seconds, ≥ 0; 0: a single pose
  bool loops = true;    ///< begins again after `duration`
  double stride = 0;    ///< metres that the body moves ahead in one run; 0: on the spot
  std::vector<Track> tracks;
};

/// A vertex of a body, 28 bytes, as the graphics card gets it.
struct AvatarVertex {
  glm::vec3 position{0};  ///< metres in the character's frame at rest
  uint32_t normal = 0;    ///< `packNormal`
  std::array<uint8_t, 4> joints{};
  std::array<uint8_t, 4> weights{255, 0, 0, 0};     ///< their sum is 255
  std::array<uint8_t, 4> colour{255, 255, 255, 0};  ///< square root of linear colour, and the part of the dress that
                                                    ///< multiplies it

  bool operator==(const AvatarVertex&) const = default;
};
static_assert(sizeof(AvatarVertex) == 28);

struct AvatarMesh {
  std::vector<AvatarVertex> vertices;
  std::vector<uint32_t> indices;
};

constexpr size_t kAvatarMeshLevels = 3;
/// Parts that a dress colours: skin, hair, upper garment, lower garment, linen, shoes, hat, what is carried.
constexpr size_t kDressParts = 8;
/// Linear colours, one for each part.
using Dress = std::array<glm::vec3, kDressParts>;

/// What a person can be doing; each character has a clip for each.
enum class Role : uint8_t { Walk, Idle, Talk, Carry };
constexpr size_t kRoles = 4;

/// A body that can be drawn in any pose, with its motions and the dresses that it may wear.
struct Character {
  std::string name;
  Skeleton skeleton;
  std::vector<glm::mat4> jointFromSkin;              ///< for each joint: from the mesh at rest to the joint's frame
  std::array<AvatarMesh, kAvatarMeshLevels> levels;  ///< the first is full detail
  std::array<Clip, kRoles> clips;                    ///< by Role
  std::vector<Dress> dresses;                        ///< at least one
  Aabbf bounds;                                      ///< of the mesh in all poses of all clips
  bool carries = false;                              ///< has something in its arms: walks in Role::Carry
};

/// A closed way through the streets at equal steps: out on one side of the street and back on the other.
struct WalkRoute {
  struct Point {
    glm::dvec3 position{0};  ///< metres from the city's origin, on the ground, in the middle of the street
    float free = 1;          ///< metres to the right in which nobody meets a wall
    bool deck = false;       ///< a bridge: its height holds, not the ground's
  };
  std::vector<Point> points;  ///< the last joins the first
  double step = 2;            ///< metres between points along the way
  double length() const { return step * static_cast<double>(points.size()); }
};

/// A place for one of a group to stand.
struct StandingPlace {
  glm::dvec3 position{0};
  float heading = 0;   ///< radians counter-clockwise from east: towards the others
  uint32_t group = 0;  ///< who stands together
};

/// One of the people.
struct Person {
  uint32_t character = 0;
  Role role = Role::Idle;
  uint32_t route = kNone;  ///< kNone: stands
  double start = 0;        ///< metres along the route at time 0; of who stands, seconds into the clip
  float speed = 1;         ///< metres a second along the route; of who stands, of the clip's pace
  float side = 0.5F;       ///< of the route's free width to the right, 0 to 1
  float scale = 1;         ///< of the body
  uint32_t dress = 0;      ///< index into Character::dresses
  glm::dvec3 position{0};  ///< of who stands
  float heading = 0;
};

/// The people of a city. Empty lists: there are none, and nothing of the program that shows them is made.
struct People {
  std::vector<Character> characters;
  std::vector<WalkRoute> routes;
  std::vector<StandingPlace> places;
  std::vector<Person> placed;  ///< people of whom all is told; they come first
  uint32_t count = 0;          ///< of all that are shown, where nobody asks for another number
  uint32_t seed = 1;

  bool empty() const {
    return characters.empty() || (placed.empty() && (count == 0 || (routes.empty() && places.empty())));
  }
};

}  // namespace vicus::city
