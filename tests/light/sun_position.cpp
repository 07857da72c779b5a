// The sun's place against published figures and against what everybody knows of it.
#include "light/sun_position.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace vicus::light {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

SunPosition sun(double days, double latitude, double longitude) {
  return sunAt(days, latitude * kDegree, longitude * kDegree).value();
}

TEST(SunPosition, DaysCountFromTheYear2000) {
  EXPECT_EQ(daysOf(2000, 1, 1), 0);
  EXPECT_EQ(daysOf(1999, 12, 31), -1);
  EXPECT_EQ(daysOf(2000, 3, 1), 60) << "2000 was a leap year";
  EXPECT_EQ(daysOf(1900, 3, 1) - daysOf(1900, 2, 28), 1) << "1900 was none";
  EXPECT_EQ(daysOf(1858, 11, 17), 51544 * -1.0) << "the modified Julian date's first day";
  EXPECT_EQ(daysOf(-4713, 11, 24), -2451545) << "the Julian date's";
}

TEST(SunPosition, MeeusExample25a) {
  // 1992-10-13 00:00: declination -7.78507°. At the pole that is the true elevation; no refraction is left down there.
  const SunPosition s = sun(daysOf(1992, 10, 13), 90, 0);
  EXPECT_NEAR(s.elevation / kDegree, -7.78507, 0.001);
}

TEST(SunPosition, TheSolarPositionAlgorithmsExample) {
  // Reda and Andreas 2004 (NREL/TP-560-34302), appendix A.5: 2003-10-17 12:30:30 at UTC-7, 105.1786° W 39.742476° N:
  // zenith 50.11162°, azimuth 194.34024° (there with a parallax of 0.002° and the air of 1 830 m).
  const double days = daysOf(2003, 10, 17) + (19 + 30.0 / 60 + 30.0 / 3600) / 24;
  const SunPosition s = sun(days, 39.742476, -105.1786);
  EXPECT_NEAR(s.elevation / kDegree, 90 - 50.11162, 0.02);
  EXPECT_NEAR(s.azimuth / kDegree, 194.34024, 0.02);
}

TEST(SunPosition, TheYearsTurningPoints) {
  // Equinox and solstice of 2024 to the minute (US Naval Observatory). At the pole the elevation is the declination and
  // what refraction lifts it by: 0.48° at the horizon.
  EXPECT_NEAR(sun(daysOf(2024, 3, 20) + (3 + 6 / 60.0) / 24, -90, 0).elevation / kDegree, 0.48, 0.06);
  EXPECT_NEAR(sun(daysOf(2024, 6, 20) + (20 + 51 / 60.0) / 24, 90, 0).elevation / kDegree, 23.4385, 0.06);
  const double june = daysOf(2024, 6, 20);
  double highest = 0;
  for (int minute = 0; minute < 1440; ++minute)
    highest = std::max(highest, sun(june + minute / 1440.0, 47.6, 8).elevation);
  EXPECT_NEAR(highest / kDegree, 90 - 47.6 + 23.437, 0.03);
}

TEST(SunPosition, NoonIsSouthInEuropeAndNorthInChile) {
  const double noon = utcOfSolarTime(daysOf(2001, 4, 15) + 0.5, 2.3 * kDegree);  // the equation of time is 0 then
  EXPECT_NEAR(sun(noon, 48.9, 2.3).azimuth / kDegree, 180, 0.2);
  const double chile = utcOfSolarTime(daysOf(2001, 4, 15) + 0.5, -70 * kDegree);
  EXPECT_NEAR(std::remainder(sun(chile, -33, -70).azimuth / kDegree, 360), 0, 0.3);
}

TEST(SunPosition, MidnightSunAndPolarNight) {
  for (int hour = 0; hour < 24; ++hour) {
    EXPECT_GT(sun(daysOf(2010, 6, 21) + hour / 24.0, 80, 15).elevation, 0);
    EXPECT_LT(sun(daysOf(2010, 12, 21) + hour / 24.0, 80, 15).elevation, 0);
  }
}

TEST(SunPosition, ItMovesSmoothly) {
  // No jump of more than its fifteen degrees an hour and what a path near the zenith adds, in elevation.
  double last = sun(0, 12, 5).elevation;
  for (int minute = 1; minute < 3 * 1440; ++minute) {
    const double now = sun(minute / 1440.0, 12, 5).elevation;
    EXPECT_LT(std::abs(now - last), 0.3 * kDegree) << minute;
    last = now;
  }
}

TEST(SunPosition, BadNumbersGiveNoSun) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(sunAt(nan, 0, 0));
  EXPECT_FALSE(sunAt(infinite, 0, 0));
  EXPECT_FALSE(sunAt(0, nan, 0));
  EXPECT_FALSE(sunAt(0, 2, 0)) << "beyond the pole";
  EXPECT_FALSE(sunAt(0, 0, infinite));
  EXPECT_FALSE(sunAt(1e15, 0, 0));
  EXPECT_TRUE(sunAt(3e8, std::numbers::pi / 2, 100)) << "far, but a number";
}

city::Knobs knobs() {
  city::Knobs k;
  k.declare(lightKnobs());
  return k;
}

TEST(LightKnobs, AnHourMovesTheSunAndNoneLeavesIt) {
  const Place place{52 * kDegree, 1 * kDegree};
  city::Environment environment;
  const city::Environment before = environment;
  city::Knobs k = knobs();
  applyTime(environment, place, k);
  EXPECT_EQ(environment.sunElevation, before.sunElevation);
  k.set("light.hour", 18);
  applyTime(environment, place, k);
  EXPECT_GT(environment.sunAzimuth, 260 * kDegree) << "evening: in the west";
  EXPECT_LT(environment.sunElevation, 15 * kDegree);
  k.set("light.hour", 12);
  k.set("light.day", 356);
  applyTime(environment, place, k);
  EXPECT_NEAR(environment.sunElevation / kDegree, 90 - 52 - 23.44, 0.2) << "midwinter's noon";
}

TEST(LightKnobs, APlaceThatIsNoneIsLeftAlone) {
  city::Environment environment;
  city::Knobs k = knobs();
  k.set("light.hour", 6);
  const double before = environment.sunElevation;
  applyTime(environment, {NAN, 0}, k);
  EXPECT_EQ(environment.sunElevation, before);
}

}  // namespace
}  // namespace vicus::light
