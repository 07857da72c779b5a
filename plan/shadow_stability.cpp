#include "plan/shadow_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "light/sun_position.hpp"
#include "plan/planner.hpp"

namespace vicus::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

city::City oneHouse(const glm::dvec3& at) {
  city::City city;
  city::BuildingGeometry house;
  house.bounds = {{-6, -5, 0}, {6, 5, 9}};
  city.buildingTypes = {house};
  city::CityParts parts;
  parts.buildings.emplace_back().position = at;
  city::finishCity(city, std::move(parts));
  return city;
}

/// Places about the eye that a cascade promises to hold and does not, and those whose depth is none; or that many where
/// a plan is not finite.
double placesLost(const city::City& city, const city::Knobs& knobs, const glm::dvec3& eye) {
  const Planner planner(city, knobs);
  PlannerState state;
  const city::FramePlan plan = planner.plan(city, city::makeView({eye, 0, 0, 0}, 1, {64, 64}), 0, state);
  double lost = 0;
  for (const auto& cascade : plan.shadows) {
    if (!cascade) continue;
    const glm::dmat4 clip = cascade->view.clipFromRelative();
    for (int direction = 0; direction < 26; ++direction) {
      const int k = direction < 13 ? direction : direction + 1;  // without the eye itself
      const glm::dvec3 away(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const glm::dvec3 p = eye + glm::normalize(away) * cascade->view.reach;
      const glm::dvec4 at = clip * glm::dvec4(p - cascade->view.centre, 1);
      if (!(std::abs(at.x) <= 1 && std::abs(at.y) <= 1 && std::isfinite(at.z))) ++lost;
    }
  }
  return lost;
}

}  // namespace

std::vector<city::StabilityRow> shadowStability() {
  std::vector<city::StabilityRow> rows;
  const auto add = [&](const char* name, const char* what, double figure, double bound) {
    rows.push_back(city::stabilityRow("light", name, what, figure, bound));
  };
  // The sun.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  double pole = 0;
  for (int hour = 0; hour < 24; ++hour)
    for (const double latitude : {90 * kDegree, -90 * kDegree}) {
      const auto sun = light::sunAt(light::daysOf(2024, 6, 21) + hour / 24.0, latitude, 0);
      const double declination = latitude > 0 ? 23.44 : -23.44;
      pole = sun ? std::max(pole, std::abs(sun->elevation / kDegree - declination)) : INFINITY;
    }
  add("both poles at the solstice, through a day", "degrees from the declination", pole, 0.06);
  double answered = 0;
  for (const double bad : {nan, static_cast<double>(INFINITY), 1e300})
    answered += (light::sunAt(bad, 0, 0) ? 1 : 0) + (light::sunAt(0, bad, 0) ? 1 : 0);
  answered += light::sunAt(0, 0, nan) ? 1 : 0;
  add("dates and places that are none", "suns found", answered, 0);

  // The maps.
  city::Knobs knobs;
  knobs.declare(planKnobs());
  knobs.set("shadows.cascades", 4);
  city::City city = oneHouse({0, 0, 0});
  const auto with = [&](double azimuth, double elevation) {
    city.environment.sunAzimuth = azimuth * kDegree, city.environment.sunElevation = elevation * kDegree;
    return placesLost(city, knobs, {3, -9, 1.7});
  };
  const auto cascades = [&](double azimuth, double elevation) {
    with(azimuth, elevation);
    return static_cast<double>(cascadeCount(city, knobs));
  };
  const char* const kLost = "places in reach outside their map";
  add("sun in the zenith", kLost, with(123, 90), 0);
  add("sun 1 degree over the horizon", kLost, with(250, 1), 0);
  add("sun below the horizon", "cascades", cascades(0, -3), 0);
  add("sun at angles that are not numbers", "cascades", cascades(nan, 30), 0);
  with(200, 40);
  city::Knobs least = knobs, largest = knobs;
  least.set("shadows.distance", 20), least.set("shadows.size", 64);
  largest.set("shadows.distance", 20000), largest.set("shadows.size", 8192);
  add("least distance and size", kLost, placesLost(city, least, {3, -9, 1.7}), 0);
  add("largest distance and size", kLost, placesLost(city, largest, {3, -9, 1.7}), 0);
  add("eye 50 km away", kLost, placesLost(city, largest, {50000, 0, 1.7}), 0);
  city = oneHouse({1e7, -4e6, 0});
  with(200, 40);
  add("city 1e7 m from the origin", kLost, placesLost(city, knobs, {1e7 + 3, -4e6 - 9, 1.7}), 0);
  return rows;
}

}  // namespace vicus::plan
