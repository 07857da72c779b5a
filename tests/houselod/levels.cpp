#include "houselod/levels.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "houselod/slide.hpp"
#include "houselod/stability.hpp"

namespace vicus::houselod {
namespace {

/// A wall of 4 × 3 m with frames of 5 cm, a balcony of 1 m and a door 0.3 m deep, under a roof.
city::BuildingGeometry house() {
  city::BuildingBuilder builder("house");
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}, 0);
  builder.addQuad({3, 0, 2}, {4, 0, 2}, {4, 0, 3}, {3, 0, 3}, 0);
  builder.beginFlat();
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0);
  builder.beginExternalGeometry(0.05f);
  builder.addQuad({1, -0.05f, 1}, {2, -0.05f, 1}, {2, -0.05f, 2}, {1, -0.05f, 2}, 0);
  builder.beginExternalGeometry(1);
  builder.addQuad({1, -1, 1}, {2, -1, 1}, {2, 0, 1}, {1, 0, 1}, 0);
  builder.beginExternalOpening(0.3f);
  builder.addQuad({3, 0.3f, 0}, {4, 0.3f, 0}, {4, 0.3f, 2}, {3, 0.3f, 2}, 0);
  builder.beginPlane(city::PlaneKind::Roof, 0, {0, 0, 1});
  builder.addQuad({0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3}, 0);
  return builder.finish();
}

constexpr double kScalar = 64;
const LevelView kView{inverseScalar(kScalar, kReferencePixels), 0};  // no pixels: detail never holds it back

TEST(Levels, GroupItemsByTheirReach) {
  const TypeLevels levels = levelsOf(house());
  EXPECT_TRUE(levels.flat);
  ASSERT_EQ(levels.reaches.size(), 2u);
  EXPECT_GE(levels.reaches[0], 0.05f);
  EXPECT_LT(levels.reaches[0], 0.06f);
  EXPECT_GE(levels.reaches[1], 1);
  EXPECT_EQ(levels.stepOf, (std::vector<uint8_t>{0, 1}));
  EXPECT_FLOAT_EQ(levels.openings, 0.3f);
}

TEST(Levels, FallWithDistanceAndLeaveTheDeepestItemsLast) {
  const TypeLevels levels = levelsOf(house());
  EXPECT_EQ(levelAt(levels, kView, 4 * kScalar * 0.29), kFullDetail) << "the door is not yet flush";
  EXPECT_EQ(levelAt(levels, kView, 4 * kScalar * 0.31), 2) << "frames are in the wall, the balcony stands out";
  EXPECT_EQ(levelAt(levels, kView, 4 * kScalar * 1.2), 3) << "nothing stands out";
  Level before = kFullDetail;
  for (double distance = 0; distance < 1000; distance += 0.5) {
    const Level level = levelAt(levels, kView, distance);
    EXPECT_GE(level, before);
    before = level;
  }
}

TEST(Levels, WaitUntilAPixelCoversTheFinestThatFlatWallsShow) {
  TypeLevels levels = levelsOf(house());
  levels.detail = 0.5f;
  const LevelView view{kView.inverse, 600};
  EXPECT_EQ(levelAt(levels, view, 299), kFullDetail);
  EXPECT_NE(levelAt(levels, view, 301), kFullDetail);
}

TEST(Levels, FlatWallsTakeOverPixelByPixelOverABandOfDistance) {
  const TypeLevels levels = levelsOf(house());
  const double from = 4 * kScalar * 0.3;  // the door is flush
  EXPECT_EQ(flatShareAt(levels, kView, 0), 0);
  EXPECT_NEAR(flatShareAt(levels, kView, from * (1 + 1e-6)), 0, 1e-4);
  EXPECT_NEAR(flatShareAt(levels, kView, from * (1 + kFadeBand) / 2), 0.5, 1e-6);
  EXPECT_EQ(flatShareAt(levels, kView, from * kFadeBand * 1.001), 1);
  EXPECT_EQ(flatShareAt(levels, kView, std::numeric_limits<double>::infinity()), 1);
  EXPECT_EQ(flatShareAt(levels, kView, std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(flatShareAt(levels, {inverseScalar(0, kReferencePixels), 0}, 1), 1) << "flat from everywhere";
  EXPECT_EQ(flatShareAt(levels, {0, 0}, 1e12), 0) << "never flat";
  EXPECT_EQ(flatShareAt({}, kView, 1e9), 0);
}

TEST(Levels, AHouseWithoutAnythingOnItsWallsHasOne) {
  city::BuildingBuilder builder("barn");
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}, 0);
  const TypeLevels levels = levelsOf(builder.finish());
  EXPECT_FALSE(levels.flat);
  EXPECT_EQ(levelAt(levels, kView, 1e9), kFullDetail);
}

/// Every vertex slides by its own distance from the wall, and none of a wall or roof does.
TEST(Levels, VerticesKnowHowFarTheyStandOut) {
  const city::BuildingGeometry g = house();
  const auto slides = [&](const city::Range& range) {
    std::set<float> out;
    for (uint32_t i = range.first; i < range.end(); ++i)
      out.insert(city::unpackSlide(g.vertices[g.indices[i]].slide).depth);
    return out;
  };
  EXPECT_EQ(slides(g.planes[0].cut), std::set<float>{0});
  EXPECT_EQ(slides(g.planes[0].flat), std::set<float>{0});
  EXPECT_EQ(slides(g.planes[1].cut), std::set<float>{0});
  const std::set<float> balcony = slides(g.externalGeometry[1].indices);
  EXPECT_EQ(balcony, (std::set<float>{0, 1})) << "its foot stays in the wall";
  EXPECT_NEAR(*slides(g.externalOpenings[0].indices).begin(), -0.3, 1e-3);
}

TEST(Levels, StiffCasesHold) {
  const auto rows = houseLodStability();
  EXPECT_GE(rows.size(), 15u);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.caseName << ": " << row.figure << " " << row.what << ", bound " << row.bound;
}

}  // namespace
}  // namespace vicus::houselod
