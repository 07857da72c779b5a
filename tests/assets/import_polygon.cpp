#include "assets/import/polygon.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "city/random.hpp"

namespace vicus::assets {
namespace {

Ring rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

double triangleArea(const Triangulation& cut) {
  double sum = 0;
  for (size_t t = 0; t + 2 < cut.triangles.size(); t += 3) {
    const double a = signedArea(
        Ring{cut.points[cut.triangles[t]], cut.points[cut.triangles[t + 1]], cut.points[cut.triangles[t + 2]]});
    EXPECT_GT(a, 0) << "a triangle is clockwise";
    sum += a;
  }
  return sum;
}

TEST(CleanPolygon, WindsOuterCounterClockwiseAndHolesClockwise) {
  Polygon raw{{rectangle(0, 0, 10, 10), rectangle(2, 2, 4, 4)}};
  std::reverse(raw.rings[0].begin(), raw.rings[0].end());
  const CleanedPolygons out = cleanPolygon(raw);
  ASSERT_EQ(out.polygons.size(), 1u);
  EXPECT_FALSE(out.repaired);
  EXPECT_DOUBLE_EQ(signedArea(out.polygons[0].rings[0]), 100);
  EXPECT_DOUBLE_EQ(signedArea(out.polygons[0].rings[1]), -4);
  EXPECT_DOUBLE_EQ(area(out.polygons[0]), 96);
}

TEST(CleanPolygon, DropsRepeatedPointsClosingPointAndSpikes) {
  const CleanedPolygons out =
      cleanPolygon({{{{0, 0}, {0, 0}, {10, 0}, {15, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 10}, {0, 0}}}});
  ASSERT_EQ(out.polygons.size(), 1u);
  EXPECT_FALSE(out.repaired);
  EXPECT_EQ(out.polygons[0].rings[0].size(), 4u);
  EXPECT_DOUBLE_EQ(area(out.polygons[0]), 100);
}

TEST(CleanPolygon, SpikeAtTheSeam) {
  const CleanedPolygons out = cleanPolygon({{{{-5, 0}, {0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}}});
  ASSERT_EQ(out.polygons.size(), 1u);
  EXPECT_DOUBLE_EQ(area(out.polygons[0]), 100);
}

TEST(CleanPolygon, BowTieBecomesTwoTriangles) {
  const CleanedPolygons out = cleanPolygon({{{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}});
  EXPECT_TRUE(out.repaired);
  ASSERT_EQ(out.polygons.size(), 2u);
  EXPECT_NEAR(area(out.polygons[0]), 25, 1e-9);
  EXPECT_NEAR(area(out.polygons[1]), 25, 1e-9);
}

TEST(CleanPolygon, SaysWhyNothingIsLeft) {
  EXPECT_EQ(cleanPolygon({{{{0, 0}, {1, 0}}}}).problem, "fewer than three different points");
  EXPECT_EQ(cleanPolygon({{{{0, 0}, {5, 0}, {10, 0}}}}).problem, "its outline encloses no area");
  EXPECT_EQ(cleanPolygon({{rectangle(0, 0, 0.1, 0.1)}}).problem, "its area is under 0.1 m²");
  EXPECT_EQ(cleanPolygon({{{{0, 0}, {NAN, 0}, {10, 10}}}}).problem, "a coordinate is not a number");
}

TEST(CleanPolygon, HoleThatTouchesTheOutlineIsValid) {
  const CleanedPolygons out = cleanPolygon({{rectangle(0, 0, 10, 10), {{0, 5}, {3, 4}, {3, 6}}}});
  EXPECT_FALSE(out.repaired);
  ASSERT_EQ(out.polygons.size(), 1u);
  EXPECT_NEAR(triangleArea(triangulate(out.polygons[0])), 97, 1e-9);
}

TEST(CleanPolygon, HoleOutsideTheOutlineIsRepaired) {
  const CleanedPolygons out = cleanPolygon({{rectangle(0, 0, 10, 10), rectangle(20, 20, 24, 24)}});
  EXPECT_TRUE(out.repaired);
  EXPECT_FALSE(out.polygons.empty());
}

/// Whatever comes in, what comes out is valid, and its triangles cover it exactly.
TEST(CleanPolygon, RandomOutlinesBecomeValidAndTriangulate) {
  city::Random random(7);
  int repaired = 0;
  for (int round = 0; round < 400; ++round) {
    Ring ring;
    const uint32_t corners = 3 + random.below(12);
    for (uint32_t i = 0; i < corners; ++i) ring.emplace_back(random.uniform(0, 30), random.uniform(0, 30));
    const CleanedPolygons out = cleanPolygon({{ring}});
    repaired += out.repaired;
    for (const Polygon& p : out.polygons) {
      EXPECT_GT(signedArea(p.rings[0]), 0);
      const double triangles = triangleArea(triangulate(p));
      EXPECT_NEAR(triangles, area(p), 1e-6 * area(p) + 1e-6) << "round " << round;
    }
  }
  EXPECT_GT(repaired, 100) << "the test should meet crossing outlines";
}

TEST(IsConvex, TellsStarsAndReflexCornersApart) {
  EXPECT_TRUE(isConvex(rectangle(0, 0, 1, 1)));
  EXPECT_TRUE(isConvex(Ring{{0, 0}, {1, 0}, {2, 0}, {1, 1}}));  // a point in line
  EXPECT_FALSE(isConvex(Ring{{0, 0}, {4, 0}, {1, 1}, {0, 4}}));
  Ring pentagram;
  for (int i = 0; i < 5; ++i) pentagram.emplace_back(std::cos(i * 4 * M_PI / 5), std::sin(i * 4 * M_PI / 5));
  EXPECT_FALSE(isConvex(pentagram)) << "turns left everywhere, but twice around";
  EXPECT_FALSE(isConvex(Ring{{0, 0}, {0, 1}, {1, 1}, {1, 0}})) << "clockwise";
}

TEST(CornersOf, MergesPointsInLineButNotAcrossAGroup) {
  const Ring ring{{0, 0}, {5, 0.01}, {10, 0}, {10, 10}, {0, 10}};
  const std::vector<uint8_t> same(5, 0), parted{1, 0, 0, 0, 0};
  EXPECT_EQ(cornersOf(ring, same, 0.03).size(), 4u);
  EXPECT_EQ(cornersOf(ring, parted, 0.03).size(), 5u);
}

TEST(CornersOf, KeepsARoundTowerRound) {
  Ring ring;
  for (int i = 0; i < 360; ++i) ring.emplace_back(10 * std::cos(i * M_PI / 180), 10 * std::sin(i * M_PI / 180));
  const std::vector<uint8_t> group(ring.size(), 0);
  Ring kept;
  for (const uint32_t i : cornersOf(ring, group, 0.03)) kept.push_back(ring[i]);
  EXPECT_LT(kept.size(), 60u);
  // No kept chord lies further than the tolerance from the circle.
  for (size_t i = 0; i < kept.size(); ++i)
    EXPECT_GE(glm::length((kept[i] + kept[(i + 1) % kept.size()]) / 2.0), 10 - 0.0301);
}

TEST(Triangulate, LShapeWithHole) {
  const Polygon p{{{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}}, {{2, 2}, {2, 5}, {5, 5}, {5, 2}}}};
  EXPECT_NEAR(triangleArea(triangulate(p)), area(p), 1e-9);
  EXPECT_DOUBLE_EQ(area(p), 20 * 8 + 8 * 12 - 9);
}

TEST(Centroid, DoesNotCareHowFarAway) {
  const Polygon near{{{{0, 0}, {6, 0}, {0, 6}}}};
  const Polygon far{{{{1e7, 1e7}, {1e7 + 6, 1e7}, {1e7, 1e7 + 6}}}};
  EXPECT_NEAR(centroid(near).x, 2, 1e-12);
  EXPECT_NEAR(centroid(far).x - 1e7, 2, 1e-8);
}

}  // namespace
}  // namespace vicus::assets
