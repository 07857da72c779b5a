/// Sun, sky and air of a scene as numbers for the shaders.
#pragma once

#include <glm/glm.hpp>

#include "city/city.hpp"

namespace vicus::scenegraph {

/// Linear light; irradiances are divided by π, so that albedo times them is radiance. Exposure is in them: 1 shows
/// nearly white.
struct Light {
  glm::vec3 sunDirection;           ///< unit, towards the sun
  glm::vec3 sun;                    ///< on a surface that faces the sun
  glm::vec3 sky;                    ///< on a surface that faces up
  glm::vec3 bounce;                 ///< on a surface that faces down
  glm::vec3 zenith, horizon, glow;  ///< radiances of the sky; `glow` is added about the sun
  float hazeDensity;                ///< 1 / metres
};

/// Light of a clear day with the sun where `environment` puts it: warmer and weaker when low; dusk and a blue night
/// when it is down. Values that are not finite give those of a default Environment.
Light lightOf(const city::Environment& environment);

}  // namespace vicus::scenegraph
