#include <gtest/gtest.h>

#include "assets/import/ground_cover.hpp"

namespace vicus::assets {
namespace {

using city::Ground;

/// Square houses of 10 m whose centres lie `pitch` metres apart, `count` to a side, on flat ground of 400 m × 400 m.
city::City houses(int count, double pitch) {
  city::City city;
  city::HeightField flat;
  flat.origin = {-200, -200}, flat.spacing = {100, 100}, flat.size = {5, 5};
  flat.heights.assign(25, 0.0f);
  city.terrain = flat;
  city::BuildingGeometry house;
  house.bounds = {{-5, -5, 0}, {5, 5, 8}};
  house.footprint = {{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}};
  city.buildingTypes = {house};
  city::CityParts parts;
  for (int y = 0; y < count; ++y)
    for (int x = 0; x < count; ++x) {
      city::Instance i;
      i.position = {pitch * (x - (count - 1) / 2.0), pitch * (y - (count - 1) / 2.0), 0};
      parts.buildings.push_back(i);
    }
  city::finishCity(city, std::move(parts));
  return city;
}

Ground at(const city::GroundCover& cover, double x, double y) {
  const auto column = static_cast<size_t>((x - cover.origin.x) / cover.spacing),
             row = static_cast<size_t>((y - cover.origin.y) / cover.spacing);
  return cover.kinds[row * static_cast<size_t>(cover.size.x) + column];
}

TEST(GroundCover, StreetsRunBetweenTheHousesOfADenseTown) {
  const auto cover = guessGroundCover(houses(15, 16));  // 10 m houses, 6 m lanes
  ASSERT_TRUE(cover);
  EXPECT_EQ(at(*cover, 8.5, 8.5), Ground::Street) << "the middle of a crossing";
  EXPECT_EQ(at(*cover, 5.5, 0.5), Ground::Paving) << "beside a wall";
  EXPECT_EQ(at(*cover, 190.5, 190.5), Ground::Grass) << "60 m out of town";
}

TEST(GroundCover, ALoneHouseHasAGardenNotAStreet) {
  const auto cover = guessGroundCover(houses(1, 1));
  ASSERT_TRUE(cover);
  EXPECT_EQ(at(*cover, 12.5, 0.5), Ground::Garden);
  EXPECT_EQ(at(*cover, 5.5, 0.5), Ground::Earth);
  EXPECT_EQ(at(*cover, 60.5, 0.5), Ground::Grass);
  for (const Ground kind : cover->kinds) EXPECT_NE(kind, Ground::Street);
}

TEST(GroundCover, HeadingTurnsTheFootprint) {
  city::City city = houses(1, 1);
  city.buildings.instances[0].heading = 0.785398f;  // its corners now lie on the axes, 7.07 m out
  const auto cover = guessGroundCover(city);
  ASSERT_TRUE(cover);
  EXPECT_EQ(at(*cover, 7.5, 0.5), Ground::Earth) << "half a metre from a corner";
  EXPECT_EQ(at(*cover, 5.5, 5.5), Ground::Garden) << "2.8 m from a wall";
}

TEST(GroundCover, NothingToGuessFromGivesNothing) {
  city::City noTerrain = houses(3, 20);
  noTerrain.terrain.reset();
  EXPECT_FALSE(guessGroundCover(noTerrain));
  EXPECT_FALSE(guessGroundCover(houses(0, 1)));
  city::City noFootprints = houses(3, 20);
  noFootprints.buildingTypes[0].footprint.clear();
  EXPECT_FALSE(guessGroundCover(noFootprints));
}

}  // namespace
}  // namespace vicus::assets
