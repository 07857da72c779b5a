/// Light that buildings, monuments and trees keep from the ground: painted once into the ground map. No GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::scenegraph {

/// Square pictures over the height field, row 0 in the south. 255: all of it reaches the ground.
struct GroundShade {
  int size = 0;  ///< 0: nothing is shaded
  std::vector<uint8_t> sun;
  std::vector<uint8_t> sky;
};

/// Coarsest pixel, metres, at which shade is worth painting: half the width of a lane.
constexpr double kCoarsestShade = 2.5;

/// Shadows of all buildings' plain surfaces, of monuments' triangles and of trees' crowns as ellipsoids, thrown by the
/// sun onto level ground at the height of what throws them; and the sky that they hide from the ground about them.
/// Size 0 where there is no terrain, the sun stands below 3°, or a pixel would be larger than kCoarsestShade.
/// `towardSun` is unit.
GroundShade shadeGround(const city::City& city, const glm::vec3& towardSun, int size);

}  // namespace vicus::scenegraph
