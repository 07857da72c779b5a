#include "city/view_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "city/random.hpp"

namespace vicus::city {
namespace {

constexpr double kPi = std::numbers::pi;

void expectOrthonormal(const ViewState& view) {
  EXPECT_NEAR(glm::length(view.right), 1, 1e-15);
  EXPECT_NEAR(glm::length(view.up), 1, 1e-15);
  EXPECT_NEAR(glm::length(view.forward), 1, 1e-15);
  EXPECT_NEAR(glm::dot(view.right, view.up), 0, 1e-15);
  EXPECT_NEAR(glm::dot(view.up, view.forward), 0, 1e-15);
  EXPECT_LT(glm::distance(glm::cross(view.right, view.forward), view.up), 1e-15) << "right-handed";
}

TEST(MakeView, theFrameIsOrthonormalForEveryPose) {
  Random random(1);
  for (int k = 0; k < 1000; ++k)
    expectOrthonormal(
        makeView({{0, 0, 0}, random.uniform(-10, 10), random.uniform(-4, 4), random.uniform(-4, 4)}, 1, {640, 480}));
  for (const double pitch : {kPi / 2, -kPi / 2})
    for (const double roll : {0.0, kPi / 2, kPi}) expectOrthonormal(makeView({{0, 0, 0}, 0.3, pitch, roll}, 1, {1, 1}));
}

TEST(MakeView, headingTurnsFromEastToNorthAndPitchLooksUp) {
  const ViewState east = makeView({}, 1, {640, 480});
  EXPECT_LT(glm::distance(east.forward, glm::dvec3(1, 0, 0)), 1e-15);
  EXPECT_LT(glm::distance(east.right, glm::dvec3(0, -1, 0)), 1e-15);
  const ViewState north = makeView({{0, 0, 0}, kPi / 2, 0, 0}, 1, {640, 480});
  EXPECT_LT(glm::distance(north.forward, glm::dvec3(0, 1, 0)), 1e-15);
  const ViewState up = makeView({{0, 0, 0}, kPi / 2, kPi / 2, 0}, 1, {640, 480});
  EXPECT_LT(glm::distance(up.forward, glm::dvec3(0, 0, 1)), 1e-15);
  EXPECT_LT(glm::distance(up.right, north.right), 1e-15) << "straight up keeps the heading";
}

TEST(MakeView, rollLeansTheHeadToTheRight) {
  const ViewState rolled = makeView({{0, 0, 0}, kPi / 2, 0, kPi / 2}, 1, {640, 480});
  EXPECT_LT(glm::distance(rolled.up, glm::dvec3(1, 0, 0)), 1e-15);
}

TEST(MakeView, whatIsNotANumberKeepsTheFallback) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ViewState before = makeView({{1, 2, 3}, 0.5, 0.1, 0.2}, 1.1, {640, 480});
  const ViewState oneAxis = makeView({{5, kNan, 7}, 0.5, 0.1, 0.2}, 1.1, {640, 480}, before);
  EXPECT_EQ(oneAxis.eye, glm::dvec3(5, 2, 7));
  for (const ViewPose& pose :
       {ViewPose{{1, 2, 3}, kNan, 0, 0}, ViewPose{{1, 2, 3}, 0, INFINITY, 0}, ViewPose{{1, 2, 3}, 0, 0, -INFINITY}}) {
    const ViewState view = makeView(pose, kNan, {640, 480}, before);
    EXPECT_EQ(view.forward, before.forward);
    EXPECT_EQ(view.up, before.up);
    EXPECT_EQ(view.verticalFov, before.verticalFov);
  }
}

TEST(MakeView, fieldOfViewAndViewportAreClamped) {
  EXPECT_EQ(makeView({}, 0, {640, 480}).verticalFov, kSmallestFov);
  EXPECT_EQ(makeView({}, -1, {640, 480}).verticalFov, kSmallestFov);
  EXPECT_EQ(makeView({}, 10, {640, 480}).verticalFov, kLargestFov);
  EXPECT_EQ(makeView({}, 1, {0, -5}).viewport, glm::ivec2(1, 1));
  EXPECT_EQ(makeView({}, 1, {100'000, 16384}).viewport, glm::ivec2(16384, 16384));
}

/// Normalised device coordinates of a position relative to the city's origin.
glm::dvec3 project(const ViewState& view, glm::dvec3 p) {
  const glm::dvec4 clip = clipFromWorld(view) * glm::dvec4(p, 1);
  return glm::dvec3(clip) / clip.w;
}

TEST(ClipFromWorld, depthIsOneAtTheNearPlaneAndFallsToZero) {
  ViewState view = makeView({{10, 20, 30}, 0.4, 0.2, 0.1}, 1, {1280, 720});
  EXPECT_NEAR(project(view, view.eye + view.nearDistance * view.forward).z, 1, 1e-12);
  EXPECT_NEAR(project(view, view.eye + 100'000.0 * view.forward).z, 0, 1e-6);
  EXPECT_GT(project(view, view.eye + 1e9 * view.forward).z, 0);
  view.farDistance = 1000;
  EXPECT_NEAR(project(view, view.eye + view.nearDistance * view.forward).z, 1, 1e-12);
  EXPECT_NEAR(project(view, view.eye + 1000.0 * view.forward).z, 0, 1e-12);
}

TEST(ClipFromWorld, theFieldOfViewReachesFromEdgeToEdge) {
  for (const double degrees : {0.1, 1.0, 60.0, 120.0, 179.0})
    for (const glm::ivec2 viewport : {glm::ivec2(1, 1), {1280, 720}, {16384, 1}, {1, 16384}}) {
      const double fov = degrees * kPi / 180;
      const ViewState view = makeView({{0, 0, 0}, 0.7, -0.3, 0.2}, fov, viewport);
      const double halfHeight = std::tan(view.verticalFov / 2), halfWidth = halfHeight * view.aspect();
      const glm::dvec3 corner = 10.0 * (view.forward + halfWidth * view.right + halfHeight * view.up);
      const glm::dvec3 ndc = project(view, corner);
      // The narrowest picture is 10⁻⁷ wide for each metre of distance, which leaves 9 of a double's 16 digits.
      EXPECT_NEAR(ndc.x, 1, 1e-8) << degrees << "°, " << viewport.x << " × " << viewport.y;
      EXPECT_NEAR(ndc.y, 1, 1e-9) << degrees << "°, " << viewport.x << " × " << viewport.y;
    }
}

TEST(ClipFromWorld, relativeToTheEyeNothingIsLostFarAway) {
  const ViewPose here{{0, 0, 1.7}, 0.4, 0.1, 0};
  ViewPose there = here;
  there.eye += glm::dvec3(1e7, 1e7, 0);
  EXPECT_EQ(clipFromEyeRelative(makeView(here, 1, {1280, 720})), clipFromEyeRelative(makeView(there, 1, {1280, 720})));
}

TEST(ClipFromWorld, isTheEyeRelativeMatrixAfterMovingToTheEye) {
  const ViewState view = makeView({{120, -70, 8}, 0.7, -0.2, 0.1}, 1, {1280, 720});
  const glm::dvec4 p(100, 33, 7, 1);
  const glm::dvec4 a = clipFromWorld(view) * p;
  const glm::dvec4 b = clipFromEyeRelative(view) * glm::dvec4(glm::dvec3(p) - view.eye, 1);
  EXPECT_LT(glm::distance(a, b), 1e-11);
}

TEST(PixelsPerUnitSlope, isThePublishedFigure) {
  EXPECT_NEAR(pixelsPerUnitSlope(makeView({}, kPi / 3, {1280, 720})), 623.5, 0.05);
}

}  // namespace
}  // namespace vicus::city
