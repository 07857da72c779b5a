#include "city/aabb.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "city/random.hpp"

namespace vicus::city {
namespace {

TEST(Aabb, aDefaultBoxIsEmptyAndExtendingItGivesThePoint) {
  Aabb box;
  EXPECT_TRUE(box.empty());
  box.extend(Aabb{});
  EXPECT_TRUE(box.empty());
  box.extend(glm::dvec3(1, 2, 3));
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box, (Aabb{{1, 2, 3}, {1, 2, 3}}));
}

TEST(Aabb, aBoxWithNanIsEmpty) {
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    Aabb box{{0, 0, 0}, {1, 1, 1}};
    box.max[axis] = std::nan("");
    EXPECT_TRUE(box.empty());
  }
}

TEST(Aabb, outwardNeverLosesAPointAndIsTheSmallestThatDoesNot) {
  Random random(1);
  for (int k = 0; k < 10000; ++k) {
    const double scale = std::pow(10.0, random.uniform(-10, 12));
    Aabb box;
    box.extend(scale * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    box.extend(scale * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)));
    const Aabbf out = outward(box);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      ASSERT_LE(static_cast<double>(out.min[axis]), box.min[axis]);
      ASSERT_GE(static_cast<double>(out.max[axis]), box.max[axis]);
      ASSERT_GT(static_cast<double>(std::nextafter(out.min[axis], INFINITY)), box.min[axis]);
      ASSERT_LT(static_cast<double>(std::nextafter(out.max[axis], -INFINITY)), box.max[axis]);
    }
  }
}

TEST(Aabb, outwardKeepsFloatsAndEmptyBoxes) {
  EXPECT_EQ(outward({{1, 2, 3}, {4, 5, 6.5}}), (Aabbf{{1, 2, 3}, {4, 5, 6.5F}}));
  EXPECT_TRUE(outward({}).empty());
}

}  // namespace
}  // namespace vicus::city
