#include "viewer/navigator.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "small_cities.hpp"
#include "viewer/surroundings.hpp"

namespace vicus::viewer {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Input forward() {
  Input input;
  input.forward = true;
  return input;
}

Navigator flyingAt(glm::dvec3 eye) {
  Navigator n;
  n.pose.eye = eye;
  n.flying = true;
  return n;
}

TEST(Navigator, OneStepOrAThousandEndAtTheSamePlace) {
  for (const double total : {0.2, 2.0}) {
    Navigator one = flyingAt({0, 0, 50}), many = one;
    step(one, forward(), total, {});
    for (int k = 0; k < 1000; ++k) step(many, forward(), total / 1000, {});
    EXPECT_NEAR(glm::distance(one.pose.eye, many.pose.eye), 0, 1e-9);
    EXPECT_NEAR(glm::distance(one.velocity, many.velocity), 0, 1e-9);
    EXPECT_GT(one.pose.eye.x, 0.3 * kFlySpeed * total);
  }
}

TEST(Navigator, NoTimeNoMovement) {
  Navigator n = flyingAt({1, 2, 3});
  n.velocity = {5, 5, 5};
  for (const double dt : {0.0, -1.0, kNaN, kInf, -kInf}) {
    step(n, forward(), dt, {});
    EXPECT_EQ(n.pose.eye, glm::dvec3(1, 2, 3)) << dt;
  }
}

TEST(Navigator, ADayLongPauseCoversTwoSecondsAtMost) {
  Navigator n = flyingAt({0, 0, 50});
  step(n, forward(), 86400, {});
  EXPECT_LE(n.pose.eye.x, kFlySpeed * kLongestStep);
}

TEST(Navigator, MouseThatIsNotFiniteIsPassedOver) {
  Navigator n = flyingAt({0, 0, 50});
  Input input = forward();
  for (const glm::dvec2 mouse : {glm::dvec2(kNaN, 0), glm::dvec2(0, kInf), glm::dvec2(-kInf, kNaN)}) {
    input.mouse = mouse;
    step(n, input, 0.016, {});
    EXPECT_EQ(n.pose.heading, 0);
    EXPECT_EQ(n.pose.pitch, 0);
  }
}

TEST(Navigator, APoseThatIsNotFiniteIsMended) {
  const city::City town = test::gridTown();
  Navigator n;
  n.pose = {{kNaN, 0, kInf}, kNaN, kInf, kNaN};
  n.velocity = {kNaN, 0, 0};
  step(n, forward(), 0.016, town);
  EXPECT_TRUE(std::isfinite(n.pose.eye.x + n.pose.eye.y + n.pose.eye.z + n.pose.heading + n.pose.pitch + n.pose.roll));
}

TEST(Navigator, MouseTurnsHoweverLongTheFrame) {
  Input input;
  input.mouse = {100, 40};
  for (const double dt : {0.0, 0.016, 2.0}) {
    Navigator n = flyingAt({0, 0, 50});
    step(n, input, dt, {});
    EXPECT_NEAR(n.pose.heading, -100 * kRadiansPerPixel, 1e-12) << "right is clockwise";
    EXPECT_NEAR(n.pose.pitch, -40 * kRadiansPerPixel, 1e-12) << "down is down";
  }
}

TEST(Navigator, PitchStopsShortOfTheZenithAndHeadingStaysSmall) {
  Navigator n = flyingAt({0, 0, 50});
  Input input;
  input.mouse = {1e7, -1e7};
  step(n, input, 0.016, {});
  EXPECT_NEAR(n.pose.pitch, glm::radians(89.0), 1e-12);
  EXPECT_LE(std::abs(n.pose.heading), 3.15);
}

TEST(Navigator, WalkingKeepsToTheGround) {
  city::City city = test::gridTown();
  test::setTerrain(city, test::terrain(101, 5, [](double x, double) { return 0.2 * x; }));
  Navigator n;
  n.pose.eye = {-40, 8, groundAt(city, {-40, 8}) + kEyeHeight};
  n.pose.pitch = 1;  // looking up does not lift one off the ground
  Input input = forward();
  input.fast = true;
  for (int k = 0; k < 600; ++k) {
    step(n, input, 1 / 60.0, city);
    const double above = n.pose.eye.z - groundAt(city, glm::dvec2(n.pose.eye));
    EXPECT_GT(above, 1.4);
    EXPECT_LT(above, 1.9);
  }
  EXPECT_NEAR(n.pose.eye.x, -40 + 10 * kRunSpeed, 1);
}

TEST(Navigator, ACliffIsEasedButNeverWalkedInside) {
  city::City city;
  test::setTerrain(city, test::terrain(41, 1, [](double x, double) { return x > 0 ? 100.0 : 0.0; }));
  Navigator n;
  n.pose.eye = {-2, 0, kEyeHeight};
  for (int k = 0; k < 300; ++k) {
    step(n, forward(), 1 / 60.0, city);
    EXPECT_GE(n.pose.eye.z, groundAt(city, glm::dvec2(n.pose.eye)) + 0.5 * kEyeHeight - 1e-9);
  }
  EXPECT_NEAR(n.pose.eye.z, 100 + kEyeHeight, 1e-3);
}

TEST(Navigator, OppositeKeysStandStill) {
  Navigator n = flyingAt({0, 0, 50});
  Input input;
  input.forward = input.back = input.left = input.right = input.up = input.down = true;
  step(n, input, 1, {});
  EXPECT_NEAR(glm::distance(n.pose.eye, glm::dvec3(0, 0, 50)), 0, 1e-12);
}

TEST(Navigator, DiagonalsAreNoFaster) {
  Navigator straight = flyingAt({0, 0, 50}), diagonal = straight;
  Input input = forward();
  step(straight, input, 2, {});
  input.left = true;
  step(diagonal, input, 2, {});
  EXPECT_NEAR(glm::length(straight.velocity), glm::length(diagonal.velocity), 1e-6);
  EXPECT_GT(diagonal.pose.eye.y, 1) << "left of east is north";
}

TEST(Navigator, FlightIsToggledAndFollowsTheLook) {
  Navigator n;
  n.pose.eye = {0, 0, kEyeHeight};
  n.pose.pitch = 0.5;
  Input input = forward();
  input.toggleFlight = true;
  step(n, input, 1, {});
  EXPECT_TRUE(n.flying);
  EXPECT_GT(n.pose.eye.z, 5);
  step(n, input, 0.016, {});
  EXPECT_FALSE(n.flying);
}

}  // namespace
}  // namespace vicus::viewer
