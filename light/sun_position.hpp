/// Where the sun stands in the sky of a place at a time.
///
/// Based on: Meeus 1998, "Astronomical Algorithms", chapters 12 (sidereal time), 13 (horizontal coordinates), 16
/// (refraction, Sæmundsson's formula) and 25 (the sun's position to 0.01°).
#pragma once

#include <optional>
#include <span>

#include "city/city.hpp"
#include "city/knob.hpp"

namespace vicus::light {

struct SunPosition {
  double azimuth = 0;    ///< radians clockwise from north, 0 … 2π
  double elevation = 0;  ///< radians above the horizon, lifted by the air (refraction)
};

/// Days since 2000-01-01 00:00 of a date of the Gregorian calendar, also before its time: negative before 2000. Months
/// 1 to 12, days 1 to 31; a day beyond its month's end counts on into the next.
double daysOf(int year, int month, int day);

/// The sun over a place. `days` are days since 2000-01-01 00:00 UTC, `latitude` (positive north) and `longitude`
/// (positive east) radians. Within 0.02° from year 1000 to 3000, 0.2° from -1000 to 4000: clock and ephemeris time are
/// taken as one. At the poles the azimuth counts from the meridian of the longitude. Nothing for numbers that are not
/// finite, for latitudes beyond a pole, and for days more than a million years off.
std::optional<SunPosition> sunAt(double days, double latitude, double longitude);

/// Days in UTC of days in local mean solar time at a longitude (radians, positive east).
double utcOfSolarTime(double solarDays, double longitude);

/// light.hour and light.day: the time of day without a scene description.
std::span<const city::Knob> lightKnobs();

/// Where on Earth, radians: latitude positive north, longitude positive east.
struct Place {
  double latitude = 0, longitude = 0;
};
/// Where Norvic lies, and any city that does not say where: Norwich.
constexpr Place kNorwich = {0.91857, 0.02269};

/// Sets the sun of an environment by the knobs' day and hour at a place; changes nothing where light.hour is negative
/// or the place is none.
void applyTime(city::Environment& environment, const Place& place, const city::Knobs& knobs);

}  // namespace vicus::light
