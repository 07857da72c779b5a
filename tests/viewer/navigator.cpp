#include "viewer/navigator.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "small_cities.hpp"
#include "walking/surroundings.hpp"

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
  n.mode = Mode::Fly;
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

TEST(Navigator, MouseTurnsByTheSameHoweverLongTheFrames) {
  Input input;
  input.mouse = {100, 40};
  for (const double dt : {0.0, 0.016, 2.0}) {
    Navigator n = flyingAt({0, 0, 50});
    step(n, input, dt, {});
    for (int k = 0; k < 100; ++k) step(n, {}, 0.02, {});
    EXPECT_NEAR(n.pose.heading, -100 * kRadiansPerPixel, 1e-12) << "right is clockwise";
    EXPECT_NEAR(n.pose.pitch, -40 * kRadiansPerPixel, 1e-12) << "down is down";
  }
}

TEST(Navigator, TurnsAreEasedUnlessMotionIsReduced) {
  Input input;
  input.mouse = {100, 0};
  Navigator n = flyingAt({0, 0, 50});
  step(n, input, 1 / 60.0, {});
  EXPECT_LT(std::abs(n.pose.heading), 50 * kRadiansPerPixel);
  Navigator calm = flyingAt({0, 0, 50});
  calm.manners.reducedMotion = true;
  step(calm, input, 1 / 60.0, {});
  EXPECT_NEAR(calm.pose.heading, -100 * kRadiansPerPixel, 1e-12);
  EXPECT_EQ(calm.turning, glm::dvec2(0));
  step(calm, forward(), 0.5, {});
  EXPECT_NEAR(glm::length(calm.velocity), kFlySpeed, 1e-9);
  step(calm, {}, 0.001, {});
  EXPECT_EQ(calm.velocity, glm::dvec3(0)) << "no drift";
}

TEST(Navigator, PitchStopsShortOfTheZenithAndHeadingStaysSmall) {
  Navigator n = flyingAt({0, 0, 50});
  Input input;
  input.mouse = {1e7, -1e7};
  step(n, input, 2, {});
  EXPECT_NEAR(n.pose.pitch, glm::radians(89.0), 1e-12);
  EXPECT_LE(std::abs(n.pose.heading), 3.15);
}

TEST(Navigator, WalkingKeepsToTheGround) {
  city::City city = test::gridTown();
  test::setTerrain(city, test::terrain(101, 5, [](double x, double) { return 0.2 * x; }));
  Navigator n;
  n.pose.eye = {-40, 8, walking::groundAt(city, {-40, 8}) + walking::kEyeHeight};
  n.pose.pitch = 1;  // looking up does not lift one off the ground
  Input input = forward();
  input.fast = true;
  for (int k = 0; k < 600; ++k) {
    step(n, input, 1 / 60.0, city);
    const double above = n.pose.eye.z - walking::groundAt(city, glm::dvec2(n.pose.eye));
    EXPECT_NEAR(above, walking::kEyeHeight, walking::kStep);
  }
  EXPECT_NEAR(n.pose.eye.x, -40 + 10 * kRunSpeed, 1);
}

TEST(Navigator, StepsAreEased) {
  city::City city;
  test::setTerrain(city, test::terrain(201, 0.25, [](double x, double) { return x > 0 ? 0.35 : 0.0; }));
  Navigator n;
  n.pose.eye = {-2, 0, walking::kEyeHeight};
  double last = walking::kEyeHeight, fastest = 0;
  for (int k = 0; k < 240; ++k) {
    step(n, forward(), 1 / 60.0, city);
    fastest = std::max(fastest, n.pose.eye.z - last);
    last = n.pose.eye.z;
  }
  EXPECT_NEAR(last, 0.35 + walking::kEyeHeight, 1e-3);
  EXPECT_LT(fastest, 0.07) << "a fifth of the step in a frame at most";
}

TEST(Navigator, OnFootFramesOfAnyLengthEndAtTheSamePlace) {
  const city::City town = test::gridTown();
  std::vector<glm::dvec3> ends;
  for (const int frames : {4, 60, 2000}) {
    Navigator n;
    n.pose.eye = {-20, 8, walking::kEyeHeight};
    for (int k = 0; k < frames; ++k) step(n, forward(), 4.0 / frames, town);
    ends.push_back(n.pose.eye);
  }
  for (const glm::dvec3& end : ends) EXPECT_NEAR(glm::distance(end, ends.front()), 0, 1e-6);
}

TEST(Navigator, AHouseStopsAndTakesTheSpeedAway) {
  const city::City city = test::cityOf({{0, 0}});
  Navigator n;
  n.pose.eye = {-8, 0, walking::kEyeHeight};
  for (int k = 0; k < 600; ++k) step(n, forward(), 1 / 60.0, city);
  EXPECT_NEAR(n.pose.eye.x, -4 - walking::kRadius, 0.01);
  EXPECT_NEAR(glm::length(n.velocity), 0, 0.2);
}

TEST(Navigator, TakeMeBackGoesWhereThereWasRoom) {
  const city::City town = test::gridTown();
  Navigator n;
  n.manners.reducedMotion = true;
  n.pose.eye = {-20, 8, walking::kEyeHeight};
  for (int k = 0; k < 600; ++k) step(n, forward(), 1 / 60.0, town);
  const glm::dvec3 here = n.pose.eye;
  Input back;
  back.takeBack = true;
  double passed = 0;
  for (int k = 0; k < 6; ++k) {
    step(n, back, 1 / 60.0, town);
    ASSERT_TRUE(n.standing);
    EXPECT_TRUE(n.ground->stands(*n.standing));
    EXPECT_GT(glm::distance(here, n.pose.eye), passed);
    passed = glm::distance(here, n.pose.eye) - 0.1;
  }
  Navigator lost = flyingAt({20, 20, 400});
  lost.manners.reducedMotion = true;
  step(lost, back, 1 / 60.0, town);
  EXPECT_EQ(lost.mode, Mode::Walk);
  EXPECT_TRUE(lost.standing && lost.ground->stands(*lost.standing)) << "from the air, before ever having walked";
}

TEST(Navigator, ALaneDrawsToItsMiddleOnlyWhenAsked) {
  const city::City city = test::cityOf({{0, 0}, {0, 14}, {8, 0}, {8, 14}, {16, 0}, {16, 14}});  // 4 m wide at y = 7
  for (const double pull : {0.0, 1.0}) {
    Navigator n;
    n.manners.lanePull = pull;
    n.pose.eye = {-4, 5.6, walking::kEyeHeight};
    for (int k = 0; k < 900; ++k) step(n, forward(), 1 / 60.0, city);
    EXPECT_NEAR(n.pose.eye.y, pull > 0 ? 7 : 5.6, 0.15) << pull;
  }
}

TEST(Navigator, TheHeadBobsOnlyWhenAsked) {
  const city::City city;
  for (const bool bob : {false, true}) {
    Navigator n;
    n.manners.headBob = bob;
    n.pose.eye = {0, 0, walking::kEyeHeight};
    double low = 10, high = 0;
    for (int k = 0; k < 300; ++k) {
      step(n, forward(), 1 / 60.0, city);
      low = std::min(low, n.pose.eye.z), high = std::max(high, n.pose.eye.z);
    }
    EXPECT_NEAR(high - low, bob ? 0.06 : 0, 0.005);
  }
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

Input press(Mode mode) {
  Input input;
  input.mode = mode;
  return input;
}

void settle(Navigator& n, const city::City& city, const Sights& sights = {}) {
  for (int k = 0; k < 60; ++k) step(n, {}, 1 / 30.0, city, sights);
}

TEST(Navigator, FlightIsToggledAndFollowsTheLook) {
  const city::City city;
  Navigator n;
  n.pose.eye = {0, 0, walking::kEyeHeight};
  n.pose.pitch = 0.5;
  step(n, press(Mode::Fly), 1, city);
  EXPECT_EQ(n.mode, Mode::Fly);
  settle(n, city);
  for (int k = 0; k < 60; ++k) step(n, forward(), 1 / 60.0, city);
  EXPECT_GT(n.pose.eye.z, 8);
  step(n, press(Mode::Fly), 0.016, city);
  EXPECT_EQ(n.mode, Mode::Walk) << "the same key again";
  settle(n, city);
  EXPECT_NEAR(n.pose.eye.z, walking::kEyeHeight, 1e-9);
}

TEST(Navigator, FlightStaysOverTheGround) {
  city::City city;
  test::setTerrain(city, test::terrain(41, 5, [](double x, double) { return x; }));
  Navigator n = flyingAt({0, 0, 10});
  n.pose.pitch = -1.4;
  for (int k = 0; k < 300; ++k) {
    step(n, forward(), 1 / 30.0, city);
    EXPECT_GE(n.pose.eye.z, walking::groundAt(city, glm::dvec2(n.pose.eye)) + 0.49);
  }
}

TEST(Navigator, OrbitKeepsItsDistanceAndLooksAtItsMiddle) {
  const city::City town = test::gridTown();
  Navigator n;
  n.pose.eye = {-40, 40, 30};
  n.pose.pitch = -0.5;
  n.mode = Mode::Fly;
  step(n, press(Mode::Orbit), 0.016, town);
  settle(n, town);
  ASSERT_EQ(n.mode, Mode::Orbit);
  Input input;
  input.mouse = {40, 5};
  const double distance = n.distance;
  for (int k = 0; k < 50; ++k) {
    step(n, input, 0.02, town);
    EXPECT_NEAR(glm::distance(n.pose.eye, n.pivot), distance, 1e-6);
    const glm::dvec3 ahead = city::makeView(n.pose, 1, {16, 9}).forward;
    EXPECT_NEAR(glm::distance(glm::normalize(n.pivot - n.pose.eye), ahead), 0, 1e-6);
  }
  step(n, forward(), 1, town);
  EXPECT_LT(n.distance, 0.5 * distance);
}

TEST(Navigator, TheMapLooksDownAndATapGoesThere) {
  const city::City town = test::gridTown();
  Navigator n;
  n.pose.eye = {-20, 8, walking::kEyeHeight};
  step(n, press(Mode::Map), 0.016, town);
  settle(n, town);
  ASSERT_EQ(n.mode, Mode::Map);
  EXPECT_TRUE(n.wantsPointer());
  EXPECT_NEAR(n.pose.eye.z, 300, 1);
  EXPECT_NEAR(city::makeView(n.pose, 1, {16, 9}).forward.z, -1, 1e-9);
  EXPECT_NEAR(city::makeView(n.pose, 1, {16, 9}).up.y, 1, 1e-6) << "north is up";
  Input tap;
  tap.tap = true, tap.viewport = {800, 600}, tap.pointer = {400, 150};  // a quarter of the height above the middle
  const double north = 300 * std::tan(0.5 * n.manners.verticalFov) * 0.5;
  step(n, tap, 0.016, town);
  settle(n, town);
  ASSERT_EQ(n.mode, Mode::Walk);
  ASSERT_TRUE(n.standing && n.ground->stands(*n.standing));
  EXPECT_NEAR(glm::distance(n.standing->at, glm::dvec2(-20, 8 + north)), 0, 6);
}

TEST(Navigator, ATapOnTheStreetIsWalkedTo) {
  const city::City town = test::gridTown();
  Navigator n;
  n.pose.eye = {-20, 8, walking::kEyeHeight};
  n.pose.pitch = -0.2;
  Input tap;
  tap.tap = true, tap.viewport = {800, 600}, tap.pointer = {400, 300};
  step(n, tap, 0.016, town);
  ASSERT_TRUE(n.goal);
  const glm::dvec2 goal = *n.goal;
  EXPECT_NEAR(goal.x, -20 + walking::kEyeHeight / std::tan(0.2), 0.1);
  for (int k = 0; k < 900; ++k) step(n, {}, 1 / 60.0, town);
  EXPECT_NEAR(glm::distance(glm::dvec2(n.pose.eye), goal), 0, 0.4);
  EXPECT_FALSE(n.goal);
}

TEST(Navigator, ATourIsPlayedAndLeftByAStep) {
  const city::City town = test::gridTown();
  Sights sights;
  for (int k = 0; k < 5; ++k) sights.tour.keys.push_back({2.0 * k, {-40.0 + 2 * k, 8, 1.65}, 0, 0});
  Navigator n;
  n.manners.reducedMotion = true;
  n.pose.eye = {-20, 8, walking::kEyeHeight};
  step(n, press(Mode::Tour), 0, town, sights);
  ASSERT_EQ(n.mode, Mode::Tour);
  for (int k = 0; k < 30; ++k) step(n, {}, 0.1, town, sights);
  EXPECT_NEAR(n.pose.eye.x, -37, 1e-6);
  step(n, forward(), 0.016, town, sights);
  EXPECT_EQ(n.mode, Mode::Walk);
  EXPECT_NEAR(n.pose.eye.x, -37, 0.1);
  step(n, press(Mode::Tour), 0, town, {});
  EXPECT_EQ(n.mode, Mode::Walk) << "there is no tour";
}

TEST(Navigator, ViewsAreGoneToOnFootOrInTheAir) {
  const city::City town = test::gridTown();
  Sights sights;
  sights.views = {{{-20, 8, 1.65}, 1, 0, 0}, {{0, 0, 120}, 2, -1, 0}};
  Navigator n;
  n.pose.eye = {-60, 8, walking::kEyeHeight};
  Input input;
  for (const auto& [view, mode] : {std::pair{1, Mode::Walk}, {2, Mode::Fly}, {1, Mode::Walk}}) {
    input.view = view;
    step(n, input, 0.016, town, sights);
    settle(n, town, sights);
    EXPECT_EQ(n.mode, mode);
    EXPECT_NEAR(glm::distance(n.pose.eye, sights.views[static_cast<size_t>(view - 1)].eye), 0, 0.1);
  }
  input.view = 7;
  step(n, input, 0.016, town, sights);
  EXPECT_NEAR(n.pose.eye.x, -20, 0.1) << "a key without a view does nothing";
}

TEST(Navigator, WhatAPixelShowsOfTheGround) {
  const city::City city;
  const city::ViewState view = city::makeView({{0, 0, 10}, 0, -0.5, 0}, 1, {800, 600});
  const auto middle = groundUnder(city, view, {400, 300});
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x, 10 / std::tan(0.5), 1e-4);
  EXPECT_NEAR(middle->z, 0, 1e-6);
  EXPECT_LT(groundUnder(city, view, {600, 300})->y, 0) << "right of east is south";
  EXPECT_FALSE(groundUnder(city, view, {400, 0})) << "the sky";
  EXPECT_FALSE(groundUnder(city, view, {900, 300}));
}

}  // namespace
}  // namespace vicus::viewer
