#include "city/vertex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "city/random.hpp"

namespace vicus::city {
namespace {

glm::vec3 randomDirection(Random& random) {
  const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Angle between unit vectors in degrees, precise for small ones.
double degreesBetween(glm::vec3 a, glm::vec3 b) {
  return 2 * std::asin(std::min(1.0, glm::length(glm::dvec3(a) - glm::dvec3(b)) / 2)) * 180 / std::numbers::pi;
}

TEST(PackNormal, largestErrorIsAsPromised) {
  Random random(1);
  double largest = 0, longest = 0;
  for (int k = 0; k < 200'000; ++k) {
    const glm::vec3 normal = randomDirection(random);
    const glm::vec3 back = unpackNormal(packNormal(normal));
    largest = std::max(largest, degreesBetween(normal, back));
    longest = std::max(longest, std::abs(static_cast<double>(glm::length(back)) - 1));
  }
  EXPECT_LT(largest, 0.0046);
  EXPECT_LT(longest, 1e-6);
}

TEST(PackNormal, axesAreExact) {
  for (const glm::vec3 axis : {glm::vec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    const glm::vec3 back = unpackNormal(packNormal(axis));
    EXPECT_LT(degreesBetween(axis, back), 1e-5) << back.x << " " << back.y << " " << back.z;
  }
}

TEST(PackNormal, packingWhatWasUnpackedChangesNothingMore) {
  Random random(2);
  for (int k = 0; k < 20'000; ++k) {
    const uint32_t once = packNormal(randomDirection(random));
    EXPECT_LT(degreesBetween(unpackNormal(once), unpackNormal(packNormal(unpackNormal(once)))), 0.0046);
  }
}

TEST(PackNormal, zeroAndNanGiveUp) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec3 bad : {glm::vec3(0), {kNan, 0, 0}, {0, kNan, 0}, {0, 0, kNan}})
    EXPECT_EQ(unpackNormal(packNormal(bad)), glm::vec3(0, 0, 1));
}

TEST(UnpackNormal, isAlwaysOfUnitLength) {
  Random random(3);
  for (int k = 0; k < 100'000; ++k) ASSERT_NEAR(glm::length(unpackNormal(random.bits())), 1, 1e-5);
}

TEST(PackSlide, roundTripOfAxisAndDepth) {
  Random random(4);
  double largestAngle = 0, largestShare = 0;
  for (int k = 0; k < 100'000; ++k) {
    const glm::vec3 axis = randomDirection(random);
    const auto depth = static_cast<float>(random.uniform(-5, 5));
    const Slide back = unpackSlide(packSlide(axis, depth));
    largestAngle = std::max(largestAngle, degreesBetween(axis, back.axis));
    largestShare = std::max(largestShare, std::abs(static_cast<double>(back.depth - depth)) /
                                              std::max(std::abs(static_cast<double>(depth)), 1e-3));
  }
  // 8 bits for each octahedral coordinate: the grid's cells are 1/127 wide.
  EXPECT_LT(largestAngle, 1.3);
  // Half floats have 11 significant bits.
  EXPECT_LE(largestShare, 0x1p-11);
}

TEST(PackSlide, wallsAlongTheAxesAndDepthZeroAreExact) {
  for (const glm::vec3 axis : {glm::vec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
    const Slide back = unpackSlide(packSlide(axis, 0));
    EXPECT_LT(degreesBetween(axis, back.axis), 1e-5);
    EXPECT_EQ(back.depth, 0);
  }
  EXPECT_EQ(unpackSlide(packSlide({1, 0, 0}, -0.25F)).depth, -0.25F);
}

TEST(Range, endsAfterItsLast) {
  EXPECT_EQ((Range{3, 4}.end()), 7u);
  EXPECT_EQ(Range{}.end(), 0u);
}

}  // namespace
}  // namespace vicus::city
