#include "culling/frustum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "city/random.hpp"
#include "city/view_state.hpp"
#include "culling/exact_visibility.hpp"

namespace vicus::culling {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Looks north from the origin, 90° wide and high: the side planes are at 45°.
city::ViewState northward() {
  return city::makeView({{0, 0, 0}, kPi / 2, 0, 0}, kPi / 2, {100, 100});
}

Containment classifyIn(const city::ViewState& view, const city::Aabbf& box) {
  const BoxTest test = boxTestFor(frustumOf(view), box);
  uint32_t mask = test.allPlanes;
  return classify(test, box, mask);
}

TEST(Frustum, hasFivePlanesWithoutAFarPlaneAndSixWithOne) {
  city::ViewState view = northward();
  EXPECT_EQ(frustumOf(view).count, 5u);
  view.farDistance = 1000;
  EXPECT_EQ(frustumOf(view).count, 6u);
}

TEST(Frustum, planesAreThoseOfTheView) {
  city::ViewState view = northward();
  view.eye = {1e7, -1e7, 300};
  view.farDistance = 1000;
  const Frustum frustum = frustumOf(view);
  ASSERT_EQ(frustum.count, 6u);
  EXPECT_EQ(frustum.origin, view.eye);
  const double s = std::sqrt(0.5);
  const FrustumPlane expected[] = {{{s, s, 0}, 0},  {{-s, s, 0}, 0},    {{0, s, s}, 0},
                                   {{0, s, -s}, 0}, {{0, 1, 0}, -0.05}, {{0, -1, 0}, 1000}};
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_LT(glm::distance(frustum.planes[i].normal, expected[i].normal), 1e-14) << "plane " << i;
    EXPECT_NEAR(frustum.planes[i].distance, expected[i].distance, 1e-9) << "plane " << i;
  }
}

TEST(Frustum, fromClipFromWorldIsTheSameAsFromTheEye) {
  const city::ViewState view = city::makeView({{120, -70, 8}, 0.7, -0.2, 0.1}, 1, {1280, 720});
  const Frustum world = frustumFromClip(city::clipFromWorld(view), {0, 0, 0});
  const Frustum relative = frustumOf(view);
  ASSERT_EQ(world.count, relative.count);
  for (size_t i = 0; i < world.count; ++i) {
    EXPECT_LT(glm::distance(world.planes[i].normal, relative.planes[i].normal), 1e-13);
    EXPECT_NEAR(world.planes[i].distance + glm::dot(world.planes[i].normal, view.eye), relative.planes[i].distance,
                1e-9);
  }
}

TEST(Frustum, rowsWithoutAPlaneAreLeftOut) {
  EXPECT_EQ(frustumFromClip(glm::dmat4(0), {0, 0, 0}).count, 0u);
  // x = w everywhere: the right plane's normal is lost in rounding, the others are left.
  glm::dmat4 rows = glm::transpose(city::clipFromEyeRelative(northward()));
  rows[0] = rows[3];
  EXPECT_EQ(frustumFromClip(glm::transpose(rows), {0, 0, 0}).count, 4u);
  // Near enough to it that what is left is noise.
  rows[0][0] += 1e-17;
  EXPECT_EQ(frustumFromClip(glm::transpose(rows), {0, 0, 0}).count, 4u);
}

TEST(Frustum, oneEntryThatIsNotFiniteLeavesNoPlane) {
  for (glm::length_t i = 0; i < 16; ++i)
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      glm::dmat4 matrix = city::clipFromEyeRelative(northward());
      matrix[i / 4][i % 4] = bad;
      EXPECT_EQ(frustumFromClip(matrix, {0, 0, 0}).count, 0u) << "entry " << i << " is " << bad;
    }
}

TEST(BoxTest, insideOutsideAndCrossing) {
  const city::ViewState view = northward();
  EXPECT_EQ(classifyIn(view, {{-1, 10, -1}, {1, 12, 1}}), Containment::Inside);
  EXPECT_EQ(classifyIn(view, {{-1, -12, -1}, {1, -10, 1}}), Containment::Outside);
  EXPECT_EQ(classifyIn(view, {{7, 10, -1}, {9, 12, 1}}), Containment::Inside);
  EXPECT_EQ(classifyIn(view, {{9, 10, -1}, {13, 12, 1}}), Containment::Crossing);
  EXPECT_EQ(classifyIn(view, {{13, 10, -1}, {15, 12, 1}}), Containment::Outside);
}

TEST(BoxTest, clearsTheBitsOfPlanesThatTheBoxIsInsideOf) {
  const city::Aabbf crossingRight{{9, 10, -1}, {13, 12, 1}};
  const BoxTest test = boxTestFor(frustumOf(northward()), crossingRight);
  uint32_t mask = test.allPlanes;
  EXPECT_EQ(classify(test, crossingRight, mask), Containment::Crossing);
  EXPECT_EQ(mask, 1u << 1);
  // A plane that is not in the mask is not tested again.
  uint32_t without = test.allPlanes & ~(1u << 1);
  EXPECT_EQ(classify(test, crossingRight, without), Containment::Inside);
}

TEST(BoxTest, boxesWithoutVolumeAreTestedLikeOthers) {
  const city::ViewState view = northward();
  EXPECT_EQ(classifyIn(view, {{0, 10, 0}, {0, 10, 0}}), Containment::Inside);
  EXPECT_EQ(classifyIn(view, {{20, 10, 0}, {20, 10, 0}}), Containment::Outside);
  EXPECT_EQ(classifyIn(view, {{-20, 10, 0}, {20, 10, 0}}), Containment::Crossing);
  EXPECT_EQ(classifyIn(view, {{-20, 10, -20}, {20, 10, 20}}), Containment::Crossing);
}

TEST(BoxTest, boxesAroundTheEye) {
  const city::ViewState view = northward();
  EXPECT_EQ(classifyIn(view, {{-1, -1, -1}, {1, 1, 1}}), Containment::Crossing);
  EXPECT_EQ(classifyIn(view, {{-1e9F, -1e9F, -1e9F}, {1e9F, 1e9F, 1e9F}}), Containment::Crossing);
  EXPECT_EQ(classifyIn(view, {{-0.01F, -0.01F, -0.01F}, {0.01F, 0.01F, 0.01F}}), Containment::Outside)
      << "nearer than the near plane";
}

TEST(BoxTest, emptyBoxesAreOutsideAndNanIsNever) {
  const city::ViewState view = northward();
  EXPECT_EQ(classifyIn(view, {}), Containment::Outside);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    city::Aabbf low{{-1, -12, -1}, {1, -10, 1}}, high = low;
    low.min[axis] = kNan;
    high.max[axis] = kNan;
    EXPECT_EQ(classifyIn(view, low), Containment::Crossing);
    EXPECT_EQ(classifyIn(view, high), Containment::Crossing);
  }
}

TEST(BoxTest, anInfiniteBoxIsNeverOutside) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  EXPECT_NE(classifyIn(northward(), {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}),
            Containment::Outside);
}

TEST(BoxTest, slackIsTwoMillimetresAtTwoKilometres) {
  const BoxTest test = boxTestFor(frustumOf(northward()), {{-2048, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(test.slack, 0.002, 0.0001);
}

TEST(BoxTest, aBoxWithinAnotherIsNeverLessOutside) {
  city::Random random(3);
  const city::Aabbf reach{{-1000, -1000, -1000}, {1000, 1000, 1000}};
  for (int k = 0; k < 200; ++k) {
    const city::ViewState view =
        city::makeView({{random.uniform(-900, 900), random.uniform(-900, 900), random.uniform(-900, 900)},
                        random.uniform(0, 7),
                        random.uniform(-2, 2),
                        random.uniform(0, 7)},
                       random.uniform(0.01, 3), {1280, 720});
    const BoxTest test = boxTestFor(frustumOf(view), reach);
    for (int i = 0; i < 100; ++i) {
      city::Aabbf outer, inner;
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        float v[4];
        for (float& x : v) x = static_cast<float>(random.uniform(-1000, 1000));
        std::sort(std::begin(v), std::end(v));
        outer.min[axis] = v[0], inner.min[axis] = v[1], inner.max[axis] = v[2], outer.max[axis] = v[3];
      }
      uint32_t outerMask = test.allPlanes, innerMask = test.allPlanes;
      const Containment outerIs = classify(test, outer, outerMask), innerIs = classify(test, inner, innerMask);
      if (outerIs != Containment::Crossing) {
        ASSERT_EQ(innerIs, outerIs);
      } else if (innerIs != Containment::Outside) {
        ASSERT_EQ(innerMask & ~outerMask, 0u) << "the inner box crosses a plane that the outer one is inside of";
      }
    }
  }
}

TEST(ExactVisibility, agreesWithCasesWorkedOutByHand) {
  const city::ViewState view = northward();
  const auto visible = [&](const city::Aabbf& box) {
    return isSurfaceInClipSpace(city::clipFromEyeRelative(view), view.eye, box);
  };
  EXPECT_TRUE(visible({{-1, 10, -1}, {1, 12, 1}}));
  EXPECT_FALSE(visible({{-1, -12, -1}, {1, -10, 1}}));
  EXPECT_TRUE(visible({{9.999F, 10, 0}, {12, 10, 0}}));
  EXPECT_FALSE(visible({{10.001F, 10, 0}, {12, 10, 0}}));
  EXPECT_TRUE(visible({{0, 10, 0}, {0, 10, 0}}));
  EXPECT_FALSE(visible({}));
  // It crosses two planes behind their common edge, so that no plane has all of it outside, yet nothing is seen.
  EXPECT_FALSE(visible({{-3, -1, 2.5F}, {3, 2, 3.5F}}));
}

}  // namespace
}  // namespace vicus::culling
