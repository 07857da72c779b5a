/// What hides: the walls and roofs of buildings behind which nothing shows, chosen once for a city.
///
/// Based on: Wonka and Schmalstieg 1999, §3 (facades as occluders); Willmott et al. 2001, §3.2.2 (occluder lines).
/// Departs from both: roofs and gables hide too, as far as the wall that carries them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"
#include "culling/building_slabs.hpp"

namespace vicus::culling {

/// A wall that hides: upright, opaque from `bottom` to `top`, drawn on the right of a → b. In the building's frame.
struct OccluderWall {
  glm::dvec2 a{0}, b{0};
  float bottom = 0, top = 0;
  double reach = 0;                 ///< metres that storeys above stand out before it; an eye nearer may be inside them
  uint32_t previous = city::kNone;  ///< wall of the same building whose b is this a (the very same point)
  uint32_t next = city::kNone;      ///< wall whose a is this b
};

/// An upright quadrilateral of a monument, drawn on the right of a → b; its top may slope.
struct MeshWall {
  glm::dvec2 a{0}, b{0};
  double bottom = 0, topA = 0, topB = 0;
};

/// A gable or a roof slope above a wall: with the wall it hides up to its own upper edge, between the wall's ends.
///
///            n ____ m          The slope is drawn, and seen from above, where the eye is above its plane; then its
///           /      | .         lower edge is seen at or below the wall's top, and no sight passes between the two.
///     eave /_______|__.
///          |  wall  |
struct OccluderCap {
  uint32_t wall = 0;   ///< in the type's walls
  city::Range points;  ///< in `Occluders::capPoints`: from the lower edge's end at b along the upper edge to that at a
  /// Half-spaces in the building's frame that must hold the eye: dot(xyz, eye) + w > 0.
  std::array<glm::dvec4, 2> above{};
};

/// The walls of all building types, and which of them hide in which building: worked out once for a city.
struct Occluders {
  std::vector<OccluderWall> walls;
  std::vector<city::Range> ofType;  ///< in `walls`, one for each building type
  std::vector<OccluderCap> caps;
  std::vector<city::Range> capsOfType;  ///< in `caps`, ordered by wall
  std::vector<glm::dvec3> capPoints;    ///< in the building's frame
  std::vector<BuildingSlab> slabs;
  std::vector<city::Range> slabsOfType;  ///< in `slabs`
  std::vector<float> recess;             ///< for each type: metres that the opaque surface may lie behind a wall's face
  std::vector<uint32_t> firstOfBuilding;  ///< in `stands`; one more than there are buildings
  std::vector<uint8_t> stands;            ///< 1: this wall of this building stands in the ground over its whole length
  std::vector<MeshWall> monumentWalls;    ///< those that stand in the ground, metres from the city's origin
  std::vector<city::Range> ofMonument;    ///< in `monumentWalls`
  uint64_t standing = 0;                  ///< ones in `stands`
  bool terrain = false;                   ///< what a line of sight meets beneath a wall is the height field
  double lowest = 0;                      ///< without terrain: nothing in the city reaches lower
  double highest = 0;                     ///< no building, tree or monument reaches higher
};

/// From a building's frame to the city's plan.
struct Placement {
  explicit Placement(const city::Instance& instance)
      : position(instance.position),
        cosine(std::cos(static_cast<double>(instance.heading))),
        sine(std::sin(static_cast<double>(instance.heading))) {}
  glm::dvec2 operator()(glm::dvec2 p) const {
    return {position.x + (cosine * p.x - sine * p.y), position.y + (sine * p.x + cosine * p.y)};
  }
  glm::dvec3 position;
  double cosine, sine;
};

/// Chooses the walls: a type's occluder lines whose foot is at or below its ground, as high as the lines above them go
/// on without a gap. Points of lines that lie within `kSamePoint` become one. A building's wall stands where the
/// terrain is nowhere below its foot, so that no line of sight passes beneath it; in a city without terrain, where
/// nothing reaches below its foot.
Occluders occludersOf(const city::City& city);
constexpr double kSamePoint = 1e-3;  ///< metres; corners of a closed building that differ by rounding

}  // namespace vicus::culling
