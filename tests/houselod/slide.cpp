#include "houselod/slide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vicus::houselod {
namespace {

TEST(Slide, IsThePublishedLineBetweenNearAndFar) {
  const double inverse = inverseScalar(50, kReferencePixels);
  // Depth 0.2: near 10 m, far 40 m.
  EXPECT_DOUBLE_EQ(slidTo(0.2, 10, inverse), 0.2);
  EXPECT_NEAR(slidTo(0.2, 25, inverse), 0.1, 1e-12);
  EXPECT_NEAR(slidTo(0.2, 40, inverse), 0, 1e-12);
  EXPECT_EQ(slidTo(0.2, 41, inverse), 0);
  EXPECT_NEAR(pushedIn(0.2, 25, inverse), 0.5, 1e-12);
  EXPECT_EQ(pushedIn(0.2, 3, inverse), 0);
  EXPECT_EQ(pushedIn(0.2, 100, inverse), 1);
  EXPECT_NEAR(flatFrom(0.2, inverse), 40, 1e-9);
}

TEST(Slide, OpeningsBecomeFlush) {
  const double inverse = inverseScalar(50, kReferencePixels);
  EXPECT_NEAR(slidTo(-0.2, 25, inverse), -0.1, 1e-12);
  EXPECT_EQ(slidTo(-0.2, 100, inverse), 0);
}

/// Points of one item keep their order: what is behind stays behind.
TEST(Slide, KeepsTheOrderOfPoints) {
  const double inverse = inverseScalar(64, kReferencePixels);
  for (double distance = 0; distance < 400; distance += 3)
    for (double depth = 0; depth < 1; depth += 0.01)
      EXPECT_LE(slidTo(depth, distance, inverse), slidTo(depth + 0.01, distance, inverse));
}

TEST(Slide, FinerPicturesKeepDetailFromFartherAway) {
  const double coarse = inverseScalar(64, kReferencePixels), fine = inverseScalar(64, 3 * kReferencePixels);
  EXPECT_NEAR(flatFrom(0.1, fine), 3 * flatFrom(0.1, coarse), 1e-9);
  EXPECT_NEAR(largestErrorPixels(coarse, kReferencePixels), largestErrorPixels(fine, 3 * kReferencePixels), 1e-9);
}

/// Nothing appears farther from its place than the bound says.
TEST(Slide, KeepsToItsErrorInPixels) {
  const double inverse = inverseScalar(64, kReferencePixels);
  double worst = 0;
  for (double depth = 0.01; depth < 2; depth *= 1.1)
    for (double distance = 0.1; distance < 2000; distance *= 1.05) {
      const double gone = depth - slidTo(depth, distance, inverse);
      worst = std::max(worst, gone / distance * kReferencePixels);
    }
  EXPECT_LE(worst, largestErrorPixels(inverse, kReferencePixels) + 1e-9);
  EXPECT_GE(worst, 0.9 * largestErrorPixels(inverse, kReferencePixels));
}

}  // namespace
}  // namespace vicus::houselod
