/// The walls of one building after another about the eye.
#pragma once

#include <vector>

#include "city/view_state.hpp"
#include "culling/occluders.hpp"

namespace vicus::culling {

/// Walls lose this much of their height, so that rounding on the way to the screen never uncovers what they hide.
constexpr double kLessHigh = 0.01;
constexpr double kFacing = 0.005;  ///< metres: an eye nearer to a wall's plane sees it edge on

struct PlacedWall {
  glm::dvec2 a, b;  ///< relative to the eye
  bool faces = false, done = false;
};

double distanceToSegment2(glm::dvec2 a, glm::dvec2 b);

/// Holds the walls of the building placed last; storage is reused.
class PlacedWalls {
 public:
  PlacedWalls(const city::City& city, const Occluders& occluders, const city::ViewState& view);

  /// Places a building's walls about the eye; how many of them stand, face it and are far enough not to be cut open by
  /// the near plane.
  int place(uint32_t building);
  /// The same question for a wall of a monument, relative to the eye.
  bool faces(const MeshWall& wall) const;

  std::vector<PlacedWall> walls;
  glm::dvec3 eye;

 private:
  const city::City* city_;
  const Occluders* occluders_;
  double clear_;  ///< metres about the eye within which the near plane may cut a surface open
};

}  // namespace vicus::culling
