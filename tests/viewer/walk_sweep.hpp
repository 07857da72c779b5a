/// Random walks with an independent check of every place that they reach.
#pragma once

#include "city/city.hpp"

namespace vicus::test {

struct SweepResult {
  size_t steps = 0, insideWalls = 0, insideMonuments = 0, offGround = 0, notFinite = 0, notBack = 0;
  double walked = 0;         ///< metres
  double worstWall = 0;      ///< metres deepest inside a wall's reach
  glm::dvec3 lastInside{0};  ///< feet of the last step inside a monument
  size_t onMonuments = 0;    ///< steps that stood on a bridge, a stair or another monument
};

/// `steps` steps with random keys, turns and frame times from 1 ms to 2 s; every 500 steps it starts anew somewhere in
/// the streets, every 97 it asks to be taken back. Checked without the walker's own grid: the distance to all
/// footprints near, to all monuments' triangles near, the height of ground and decks.
SweepResult sweepOnFoot(const city::City& city, size_t steps, uint32_t seed);

}  // namespace vicus::test
