#include "scenegraph/light.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::scenegraph {

Light lightOf(const city::Environment& environment) {
  const city::Environment usual;
  const auto orUsual = [](double value, double otherwise) { return std::isfinite(value) ? value : otherwise; };
  const double azimuth = orUsual(environment.sunAzimuth, usual.sunAzimuth);
  const double elevation = orUsual(environment.sunElevation, usual.sunElevation);
  const double haze = orUsual(environment.hazeDistance, usual.hazeDistance);

  Light light;
  light.sunDirection =
      glm::vec3(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation), std::sin(elevation));
  // The lower the sun, the more air its light crosses and the redder it comes through (optical depths of a clear day
  // for red, green and blue, over an air mass of 1 / sin of the elevation, bent so that it stays finite).
  const float height = static_cast<float>(std::sin(elevation));
  const float airMass = 1.0f / (std::max(height, 0.0f) + 0.06f);
  const glm::vec3 through = glm::exp(-glm::vec3(0.075f, 0.115f, 0.20f) * airMass);
  const float day = std::clamp(height * 6.0f + 0.25f, 0.02f, 1.0f);
  light.sun = height > -0.02f ? 1.42f * through : glm::vec3(0);
  light.sky = day * glm::vec3(0.235f, 0.290f, 0.390f);
  light.bounce = 0.16f * glm::vec3(0.95f, 0.9f, 0.75f) * (std::max(height, 0.0f) * light.sun + light.sky);
  light.zenith = day * glm::vec3(0.060f, 0.150f, 0.390f);
  light.horizon = day * glm::vec3(0.42f, 0.53f, 0.66f);
  light.glow = 0.22f * light.sun;
  light.hazeDensity = static_cast<float>(1.0 / std::max(haze, 1.0));
  return light;
}

}  // namespace vicus::scenegraph
