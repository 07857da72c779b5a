#include "scenegraph/light.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace vicus::scenegraph {
namespace {

TEST(Light, TheSunStandsWhereTheEnvironmentSays) {
  city::Environment environment;
  environment.sunAzimuth = std::numbers::pi / 2, environment.sunElevation = 0;
  EXPECT_LT(glm::length(lightOf(environment).sunDirection - glm::vec3(1, 0, 0)), 1e-6f) << "clockwise from north";
  environment.sunElevation = std::numbers::pi / 2;
  EXPECT_LT(glm::length(lightOf(environment).sunDirection - glm::vec3(0, 0, 1)), 1e-6f);
}

TEST(Light, ALowSunIsWeakerAndRedder) {
  city::Environment high, low;
  high.sunElevation = 1, low.sunElevation = 0.1;
  const glm::vec3 day = lightOf(high).sun, evening = lightOf(low).sun;
  EXPECT_LT(evening.g, day.g);
  EXPECT_LT(evening.b / evening.r, day.b / day.r);
  low.sunElevation = -0.3;
  EXPECT_EQ(lightOf(low).sun, glm::vec3(0)) << "night";
}

TEST(Light, BadNumbersGiveAUsualDay) {
  city::Environment bad;
  bad.sunAzimuth = NAN, bad.sunElevation = INFINITY, bad.hazeDistance = NAN;
  const Light light = lightOf(bad), usual = lightOf({});
  EXPECT_EQ(light.sunDirection, usual.sunDirection);
  EXPECT_EQ(light.hazeDensity, usual.hazeDensity);
  bad.hazeDistance = 0;
  EXPECT_TRUE(std::isfinite(lightOf(bad).hazeDensity));
}

}  // namespace
}  // namespace vicus::scenegraph
