#include "light/sun_position.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vicus::light {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMostDays = 365.25e6;

constexpr city::Knob kKnobs[] = {
    {"light.hour", -1, -1, 24, "hours",
     "Time of day, local mean solar time; below 0 the sun stands where the scene puts it.", "0: midnight",
     "24: midnight again"},
    {"light.day", 237, 1, 366, "day of the year", "The day of the year 2000 that light.hour is on.",
     "1: the first of January", "366: the last of December"},
};

/// The air lifts what is seen at this true elevation (radians) by so much. Below -1°, where nobody sees it, it fades
/// out so that the sun's path stays smooth.
double refraction(double elevation) {
  const double degrees = elevation / kDegree;
  const double shown = std::max(degrees, -1.0);
  const double minutes = 1.02 / std::tan((shown + 10.3 / (shown + 5.11)) * kDegree);
  const double fade = std::clamp((degrees + 6) / 5, 0.0, 1.0);
  return std::max(minutes, 0.0) / 60 * kDegree * fade;
}

}  // namespace

double daysOf(int year, int month, int day) {
  // Days before March of year 0, counted in years that begin in March (Hinnant, "chrono-compatible low-level date
  // algorithms").
  const int shifted = month <= 2 ? year - 1 : year;
  const int era = (shifted >= 0 ? shifted : shifted - 399) / 400;
  const int yearOfEra = shifted - era * 400;
  const int dayOfYear = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
  const int dayOfEra = yearOfEra * 365 + yearOfEra / 4 - yearOfEra / 100 + dayOfYear;
  constexpr int kEraDays = 146097, kTo2000 = 730425;
  return static_cast<double>(era) * kEraDays + dayOfEra - kTo2000;
}

std::optional<SunPosition> sunAt(double days, double latitude, double longitude) {
  constexpr double kBeyondPole = 1e-9;
  if (!(std::abs(days) <= kMostDays) || !(std::abs(latitude) <= kTurn / 4 + kBeyondPole) || !std::isfinite(longitude))
    return std::nullopt;
  // Julian centuries since J2000.0, noon of 2000-01-01.
  const double sinceNoon = days - 0.5, t = sinceNoon / 36525;
  const double meanLongitude = std::remainder(280.46646 + t * (36000.76983 + t * 0.0003032), 360.0);
  const double anomaly = std::remainder(357.52911 + t * (35999.05029 - t * 0.0001537), 360.0) * kDegree;
  const double centre = (1.914602 - t * (0.004817 + t * 0.000014)) * std::sin(anomaly) +
                        (0.019993 - 0.000101 * t) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = std::remainder(125.04 - 1934.136 * t, 360.0) * kDegree;
  const double apparent = (meanLongitude + centre - 0.00569 - 0.00478 * std::sin(node)) * kDegree;
  const double obliquity =
      (23.4392911 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7)) + 0.00256 * std::cos(node)) * kDegree;
  const double rightAscension = std::atan2(std::cos(obliquity) * std::sin(apparent), std::cos(apparent));
  const double declination = std::asin(std::clamp(std::sin(obliquity) * std::sin(apparent), -1.0, 1.0));

  const double sidereal = std::remainder(280.46061837 + 360.98564736629 * sinceNoon + t * t * 0.000387933, 360.0);
  const double hourAngle = sidereal * kDegree + longitude - rightAscension;
  const double sinLatitude = std::sin(latitude), cosLatitude = std::cos(latitude);
  // The direction in the axes east, north, up.
  const double east = -std::cos(declination) * std::sin(hourAngle);
  const double north = cosLatitude * std::sin(declination) - sinLatitude * std::cos(declination) * std::cos(hourAngle);
  const double up = sinLatitude * std::sin(declination) + cosLatitude * std::cos(declination) * std::cos(hourAngle);
  SunPosition sun;
  sun.azimuth = std::atan2(east, north);
  if (sun.azimuth < 0) sun.azimuth += kTurn;
  sun.elevation = std::atan2(up, std::hypot(east, north));
  sun.elevation += refraction(sun.elevation);
  return sun;
}

double utcOfSolarTime(double solarDays, double longitude) {
  return solarDays - longitude / kTurn;
}

std::span<const city::Knob> lightKnobs() {
  return kKnobs;
}

void applyTime(city::Environment& environment, const Place& place, const city::Knobs& knobs) {
  const double hour = knobs["light.hour"];
  if (hour < 0) return;
  const double solarDays = std::floor(knobs["light.day"]) - 1 + hour / 24;
  const auto sun = sunAt(utcOfSolarTime(solarDays, place.longitude), place.latitude, place.longitude);
  if (!sun) return;
  environment.sunAzimuth = sun->azimuth;
  environment.sunElevation = sun->elevation;
}

}  // namespace vicus::light
