/// The country about a city: ground from the terrain's edge to the horizon, or under a city without terrain. No GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::scenegraph {

struct GroundVertex {
  glm::vec3 position;  ///< metres from GroundMesh::centre
  glm::vec2 uv;        ///< in the ground map: 0 to 1 over the height field
  float beyond;        ///< 0 at the terrain's edge to 1 in open country
};

struct GroundMesh {
  std::vector<GroundVertex> vertices;
  std::vector<uint32_t> indices;
  glm::dvec3 centre{0};     ///< metres from the city's origin
  bool followsEye = false;  ///< its centre moves with the eye on the plan: a plane, fine near the eye
};

/// How far the ground goes on, metres: haze has hidden everything long before.
constexpr double kGroundReach = 120000;

/// Where the height field has a whole border: rings that start at the border and level out to its mean height. Else a
/// plane: just under the lowest ground where there is some, so that holes show ground; under the lowest building where
/// there is no terrain.
GroundMesh groundMesh(const city::City& city);

}  // namespace vicus::scenegraph
