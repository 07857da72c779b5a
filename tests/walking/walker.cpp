#include "walking/walker.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "city/random.hpp"
#include "tests/viewer/small_cities.hpp"
#include "walking/surroundings.hpp"

namespace vicus::walking {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Adds a box from `min` to `max` as a monument.
void addBox(city::City& city, glm::vec3 min, glm::vec3 max) {
  city::BuildingBuilder builder("box");
  builder.beginPlane(city::PlaneKind::Other, 0, {0, 0, 1}, false);
  builder.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, min, max, 0);
  const city::BuildingGeometry g = builder.finish();
  city::Monument monument;
  monument.mesh = static_cast<uint32_t>(city.meshes.size());
  city.meshes.push_back({"box", {g.vertices, {g.indices.begin(), g.indices.begin() + g.fullDetail.count}}, g.bounds});
  city.monuments.push_back(monument);
}

void finish(city::City& city) {
  city::CityParts parts{city.buildings.instances, city.trees.instances};
  city::finishCity(city, std::move(parts));
}

/// Steps up to a deck of about 2 m and down again, along x from 0; 8 m wide.
city::City stairsCity(float rise, float tread) {
  city::City city;
  city.materials = {test::plaster()};
  const int steps = static_cast<int>(std::round(2 / rise));
  for (int k = 0; k < steps; ++k) {
    const float x = tread * static_cast<float>(k);
    addBox(city, {x, -4, -0.5f}, {2 * tread * static_cast<float>(steps) - x + 4, 4, rise * static_cast<float>(k + 1)});
  }
  finish(city);
  return city;
}

TEST(Walker, OpenGroundIsCrossedExactly) {
  const city::City city;
  Ground ground(city);
  const Standing end = ground.move({{1, 2}, 0}, {30, -40});
  EXPECT_NEAR(glm::distance(end.at, glm::dvec2(31, -38)), 0, 1e-9);
}

TEST(Walker, AWallIsNeverCrossedHoweverLongTheMove) {
  const city::City city = test::cityOf({{0, 0}});  // 8 × 10 m
  for (const double length : {0.001, 0.1, 1.0, 100.0, 5000.0}) {
    Ground ground(city);
    Standing at{{-10, 0}, 0};
    for (int k = 0; k < 50 && at.at.x < -4 - kRadius - 0.01; ++k) at = ground.move(at, {length, 0});
    EXPECT_LE(at.at.x, -4 - kRadius + 1e-9) << length;
    if (length >= 1) {
      EXPECT_NEAR(at.at.x, -4 - kRadius, 0.001) << length;
    }
    EXPECT_TRUE(ground.stands(at));
  }
}

TEST(Walker, SlidesAlongAWall) {
  const city::City city = test::cityOf({{0, 0}});
  Ground ground(city);
  glm::dvec2 blocked(0);
  const Standing end = ground.move({{-5, -3}, 0}, {4, 4}, &blocked);
  EXPECT_NEAR(end.at.x, -4 - kRadius, 0.001);
  EXPECT_NEAR(end.at.y, 1, 0.01);
  EXPECT_NEAR(glm::distance(blocked, glm::dvec2(-1, 0)), 0, 1e-6);
}

TEST(Walker, GapsNarrowerThanTheBodyAreClosedAndWiderOnesOpen) {
  for (const double gap : {0.5, 0.62, 1.0}) {
    const city::City city = test::cityOf({{0, 0}, {8 + gap, 0}});
    Ground ground(city);
    const Standing end = ground.move({{4 + 0.5 * gap, -8}, 0}, {0, 16});
    EXPECT_EQ(end.at.y > 5.5, gap > 2 * kRadius) << gap << ": reached " << end.at.y;
  }
}

TEST(Walker, InACornerNothingShakes) {
  const city::City city = test::cityOf({{0, 0}, {-8, 9}});  // meet in an inner corner at (-4, 5)
  Ground ground(city);
  Standing at = ground.move({{-6, 2}, 0}, {6, 6});
  for (int k = 0; k < 20; ++k) {
    const Standing next = ground.move(at, {0.5, 0.5});
    EXPECT_NEAR(glm::distance(next.at, at.at), 0, 1e-3);
    at = next;
  }
}

TEST(Walker, StairsAreClimbedAndGoneDown) {
  for (const auto& [rise, tread] : {std::pair{0.17f, 0.29f}, {0.2f, 0.25f}, {0.4f, 0.4f}}) {
    const city::City city = stairsCity(rise, tread);
    for (const double piece : {0.01, 0.07, 40.0}) {
      Ground ground(city);
      Standing at{{-2, 0}, 0};
      double highest = 0;
      const int moves = static_cast<int>(std::ceil(40 / piece));
      for (int k = 0; k < moves; ++k) {
        at = ground.move(at, {piece, 0});
        highest = std::max(highest, at.feet);
        ASSERT_TRUE(ground.stands(at)) << at.at.x << " " << at.feet;
      }
      EXPECT_GT(at.at.x, 30) << rise << " " << piece;
      EXPECT_EQ(at.feet, 0);
      if (piece < 1) {
        EXPECT_NEAR(highest, rise * std::round(2 / rise), 1e-5);
      }
    }
  }
}

TEST(Walker, AStepTooHighStops) {
  const city::City city = stairsCity(0.5f, 1);
  Ground ground(city);
  const Standing end = ground.move({{-2, 0}, 0}, {10, 0});
  EXPECT_NEAR(end.at.x, -kLegRadius, 0.21);
  EXPECT_EQ(end.feet, 0);
}

TEST(Walker, NobodyStepsOffAHighDeck) {
  city::City city;
  city.materials = {test::plaster()};
  addBox(city, {-5, -5, -1}, {5, 5, 3});
  finish(city);
  Ground ground(city);
  Standing at{{0, 0}, 3};
  ASSERT_TRUE(ground.stands(at));
  city::Random random(7);
  for (int k = 0; k < 2000; ++k) {
    const double angle = random.uniform(0, 6.3);
    at = ground.move(at, random.uniform(0.001, 8) * glm::dvec2(std::cos(angle), std::sin(angle)));
    ASSERT_EQ(at.feet, 3);
    ASSERT_LE(std::max(std::abs(at.at.x), std::abs(at.at.y)), 5);
  }
}

TEST(Walker, LowCeilingsStopAndGatesLetThrough) {
  for (const float soffit : {1.6f, 2.2f}) {
    city::City city;
    city.materials = {test::plaster()};
    addBox(city, {0, -5, soffit}, {2, 5, 4});
    addBox(city, {0, -5, -1}, {2, -1, 4});
    addBox(city, {0, 1, -1}, {2, 5, 4});
    finish(city);
    Ground ground(city);
    const Standing end = ground.move({{-3, 0.9}, 0}, {8, 0});
    EXPECT_EQ(end.at.x > 2, soffit > 2) << soffit << ": reached " << end.at.x;
  }
}

TEST(Walker, WaterIsWadedToTheKneesOnly) {
  city::City city;
  test::setTerrain(city, test::terrain(81, 1, [](double x, double) { return x > 0 ? -0.1 * x : 0.0; }));
  city::WaterBody river;
  river.points = {{-40, -40}, {40, -40}, {40, 40}, {-40, 40}};
  river.indices = {0, 1, 2, 0, 2, 3};
  river.level = -0.5;
  city.water = {river};
  Ground ground(city);
  const Standing end = ground.move({{-5, 0}, 0}, {30, 0});
  EXPECT_NEAR(end.at.x, 9, 0.21) << "where the water is 0.4 m deep";
  EXPECT_NEAR(end.feet, -0.9, 0.03);
}

TEST(Walker, CliffsStopWhateverTheFrameTime) {
  city::City city;
  test::setTerrain(city, test::terrain(41, 1, [](double x, double) { return x > 0 ? 100.0 : 0.0; }));
  for (const double piece : {0.001, 0.02, 5.0}) {
    Ground ground(city);
    Standing at{{-2, 0}, 0};
    for (double gone = 0; gone < 5; gone += piece) at = ground.move(at, {piece, 0});
    EXPECT_LT(at.feet, 1) << piece;
    EXPECT_NEAR(at.at.x, 0, 0.25) << piece;
  }
}

TEST(Walker, APlaceIsFoundOutsideHousesAndClosedMonuments) {
  city::City city = test::gridTown();
  const glm::dvec3 corner(200, 200, 0);
  addBox(city, glm::vec3(corner), glm::vec3(corner) + glm::vec3(20, 12, 9));
  finish(city);
  Ground ground(city);
  for (const glm::dvec2 p : {glm::dvec2(0, 0), {40, 16}, {210, 206}}) {
    const auto place = ground.place(p, 0);
    ASSERT_TRUE(place) << p.x;
    EXPECT_TRUE(ground.stands(*place));
    EXPECT_LT(glm::distance(place->at, p), 14);
    EXPECT_GE(clearance(city, place->at, 1), kRadius - 0.001);
    EXPECT_FALSE(place->at.x > 200 && place->at.x < 220 && place->at.y > 200 && place->at.y < 212);
  }
}

TEST(Walker, WhatIsNotFiniteMovesNobody) {
  const city::City city = test::gridTown();
  Ground ground(city);
  const Standing from{{-20, 3}, 0};
  for (const glm::dvec2 by : {glm::dvec2(kNaN, 0), glm::dvec2(0, -INFINITY), glm::dvec2(0)})
    EXPECT_EQ(ground.move(from, by).at, from.at);
  EXPECT_FALSE(ground.place({kNaN, 0}, 0));
  EXPECT_FALSE(ground.footing({0, kNaN}, 0));
  EXPECT_FALSE(ground.stands({{0, 0}, kNaN}));
}

TEST(Walker, TheLanesWidthIsMeasured) {
  const city::City city = test::cityOf({{0, 0}, {12, 0}});  // 4 m apart
  Ground ground(city);
  EXPECT_NEAR(ground.freeWay({{5, 0}, 0}, {-1, 0}, 8), 1, 0.06);
  EXPECT_NEAR(ground.freeWay({{5, 0}, 0}, {1, 0}, 8), 3, 0.06);
  EXPECT_EQ(ground.freeWay({{5, 0}, 0}, {0, 1}, 8), 8);
}

}  // namespace
}  // namespace vicus::walking
