#include "city/city.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "city/random.hpp"

namespace vicus::city {
namespace {

City townAround(glm::dvec3 centre, double side) {
  City town;
  BuildingGeometry house;
  house.bounds = {{-6, -5, 0}, {6, 5, 9}};
  house.fullDetail = {0, 36};
  town.buildingTypes = {house, house};
  MeshGeometry tree, church;
  tree.bounds = {{-3, -3, 0}, {3, 3, 12}};
  church.bounds = {{-10, -30, 0}, {10, 30, 50}};
  church.mesh.indices.resize(300);
  town.treeTypes = {tree};
  town.meshes = {church};
  town.monuments.resize(2);
  town.monuments[1].position = centre;
  town.monuments[0].position = centre + glm::dvec3(side / 2, 0, 0);
  town.monuments[0].heading = static_cast<float>(std::numbers::pi / 2);
  return town;
}

CityParts partsAround(glm::dvec3 centre, double side, uint32_t count = 1000) {
  Random random(1);
  CityParts parts;
  const auto place = [&] {
    return centre + glm::dvec3(random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2), 0);
  };
  for (uint32_t i = 0; i < count; ++i) {
    parts.buildings.emplace_back().position = place();
    parts.buildings.back().seed = i;
    parts.buildings.back().geometry = i % 2;
    parts.trees.emplace_back().position = place();
  }
  return parts;
}

bool contains(const Aabbf& outer, const Aabbf& inner) {
  return outer.contains(inner.min) && outer.contains(inner.max);
}

TEST(FinishCity, everythingIsInTheExtentAndInItsTile) {
  for (const double place : {0.0, 1e6, 1e7})
    for (const double side : {500.0, 100e3}) {
      const glm::dvec3 centre(place, -place / 2, 0);
      City town = townAround(centre, side);
      ASSERT_EQ(finishCity(town, partsAround(centre, side)), 0u);
      ASSERT_EQ(town.tiles.size(), town.grid.tileCount());
      size_t buildings = 0, trees = 0;
      for (uint32_t t = 0; t < town.tiles.size(); ++t) {
        const Tile& tile = town.tiles[t];
        buildings += tile.instances.count, trees += tile.trees.count;
        for (uint32_t i = tile.instances.first; i < tile.instances.end(); ++i) {
          ASSERT_TRUE(contains(tile.bounds, town.buildings.bounds[i]));
          const glm::dvec3& p = town.buildings.instances[i].position;
          ASSERT_EQ(town.grid.tileAt(p.x, p.y), t);
          ASSERT_TRUE(town.extent.contains(p));
        }
        for (uint32_t i = tile.trees.first; i < tile.trees.end(); ++i)
          ASSERT_TRUE(contains(tile.bounds, town.trees.bounds[i]));
      }
      EXPECT_EQ(buildings, 1000u);
      EXPECT_EQ(trees, 1000u);
    }
}

TEST(FinishCity, monumentsGetTheirTurnedBounds) {
  City town = townAround({0, 0, 0}, 500);
  finishCity(town, {});
  EXPECT_NEAR(town.monuments[0].bounds.size().x, 60, 0.01) << "turned by a quarter";
  EXPECT_NEAR(town.monuments[0].bounds.size().y, 20, 0.01);
  EXPECT_NEAR(town.monuments[1].bounds.size().x, 20, 0.01);
}

TEST(FinishCity, countsWhatItLeavesOut) {
  City town = townAround({0, 0, 0}, 500);
  CityParts parts = partsAround({0, 0, 0}, 500);
  parts.buildings[3].geometry = 99;
  parts.trees[5].position.y = std::nan("");
  EXPECT_EQ(finishCity(town, std::move(parts)), 2u);
  EXPECT_EQ(town.buildings.size(), 999u);
  EXPECT_EQ(town.trees.size(), 999u);
}

TEST(FinishCity, anEmptyCityIsFinishedToo) {
  City nothing;
  EXPECT_EQ(finishCity(nothing, {}), 0u);
  EXPECT_TRUE(nothing.extent.empty());
  for (const Tile& tile : nothing.tiles) EXPECT_TRUE(tile.bounds.empty());
}

TEST(FinishCity, tilesHoldTheirGroundAndLeaveHolesOut) {
  City town;
  HeightField field;
  field.size = {129, 129}, field.spacing = {8, 8}, field.origin = {-512, -512};
  Random random(2);
  for (int i = 0; i < 129 * 129; ++i) field.heights.push_back(static_cast<float>(random.uniform(0, 30)));
  // The south-west quarter has no data.
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) field.at(column, row) = std::numeric_limits<float>::quiet_NaN();
  field.updateRange();
  town.terrain = field;
  finishCity(town, {});
  for (int k = 0; k < 2000; ++k) {
    const glm::dvec2 p(random.uniform(-512, 512), random.uniform(-512, 512));
    const auto height = field.heightAt(p.x, p.y);
    if (!height) continue;
    const Aabbf& bounds = town.tiles[town.grid.tileAt(p.x, p.y)].bounds;
    const glm::dvec3 ground(p, *height);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      ASSERT_LE(static_cast<double>(bounds.min[axis]), ground[axis]);
      ASSERT_GE(static_cast<double>(bounds.max[axis]), ground[axis]);
    }
  }
  EXPECT_TRUE(town.tiles[0].bounds.empty()) << "no ground, nothing on it";
}

TEST(City, itemIdsAreOneToOne) {
  City town = townAround({0, 0, 0}, 500);
  finishCity(town, partsAround({0, 0, 0}, 500, 10));
  EXPECT_EQ(town.itemOfBuilding(0), 1u);
  EXPECT_EQ(town.itemOfBuilding(9), 10u);
  EXPECT_EQ(town.itemOfMonument(0), 11u);
  EXPECT_EQ(town.itemCount(), 13u);
}

TEST(City, trianglesAndBytesAddUp) {
  City town = townAround({0, 0, 0}, 500);
  finishCity(town, partsAround({0, 0, 0}, 500));
  EXPECT_EQ(fullDetailTriangles(town), 1000u * 12 + 2 * 100);
  const CityBytes bytes = memoryOf(town);
  EXPECT_GE(bytes.instances, 2000 * (sizeof(Instance) + sizeof(Aabbf)));
  EXPECT_EQ(bytes.terrain, 0u);
}

}  // namespace
}  // namespace vicus::city
