/// What throws shadows into a view, as plain data: cascades of squares about the eye as the sun sees them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "city/frame_plan.hpp"

namespace vicus::city {

/// A parallel projection along the sun's light.
struct ShadowView {
  /// Rows: right, up, and towards the sun; orthonormal.
  glm::dmat3 lightFromWorld{1};
  glm::dvec3 centre{0};   ///< metres from the city's origin
  double halfExtent = 1;  ///< metres from the centre to each edge, along right and up
  double halfDepth = 1;   ///< metres from the centre to both ends of the depth, along the light
  double reach = 0;       ///< metres: all that lies nearer to the eye is within the square

  /// Depth 1 at the end towards the sun, 0 at the other: reversed, like every view's.
  glm::dmat4 clipFromRelative() const {
    glm::dmat4 m(1);
    for (int column = 0; column < 3; ++column) {
      m[column][0] = lightFromWorld[column][0] / halfExtent;
      m[column][1] = lightFromWorld[column][1] / halfExtent;
      m[column][2] = lightFromWorld[column][2] / (2 * halfDepth);
    }
    m[3][2] = 0.5;
    return m;
  }
};

/// One cascade: what stands between it and the sun.
struct ShadowPlan {
  ShadowView view;
  SetPlan buildings;
  SetPlan trees;
  std::vector<uint32_t> monuments;  ///< ascending
  bool ground = false;              ///< the height field throws shadows into it
};

}  // namespace vicus::city
