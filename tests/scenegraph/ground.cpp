#include <gmock/gmock.h>

#include <cmath>

#include "scenegraph/ground_map.hpp"
#include "scenegraph/ground_mesh.hpp"
#include "scenegraph/ground_shade.hpp"
#include "scenegraph/light.hpp"
#include "scenegraph/terrain_mesh.hpp"
#include "scenegraph/tile_table.hpp"
#include "small_city.hpp"

namespace vicus::scenegraph {
namespace {

/// A field over a grid whose tiles do not divide it evenly.
city::HeightField bumpyField(int columns, int rows) {
  city::HeightField field;
  field.size = {columns, rows};
  field.origin = {-37, 11};
  field.spacing = {3, 4};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      field.heights.push_back(static_cast<float>(5 * std::sin(c * 0.7) + 3 * std::cos(r)));
  field.updateRange();
  return field;
}

city::City cityOn(city::HeightField field) {
  city::City city;
  city.terrain = std::move(field);
  city::finishCity(city, {});
  return city;
}

TerrainMesh meshOf(const city::City& city) {
  return terrainMesh(*city.terrain, city.grid, tileBases(city));
}

uint64_t triangleCount(const TerrainMesh& mesh) {
  uint64_t count = 0;
  for (const TerrainPatch& p : mesh.patches) count += p.indices.count / 3;
  return count;
}

TEST(TerrainMesh, DrawsEachTriangleOfTheSurfaceOnce) {
  for (const glm::ivec2 size : {glm::ivec2(2, 2), glm::ivec2(2, 9), glm::ivec2(33, 33), glm::ivec2(50, 71)}) {
    const city::City city = cityOn(bumpyField(size.x, size.y));
    const TerrainMesh mesh = meshOf(city);
    EXPECT_EQ(triangleCount(mesh), city.terrain->triangleCount()) << size.x << " x " << size.y;
    const std::vector<glm::dvec3> bases = tileBases(city);
    double area = 0;
    for (const TerrainPatch& patch : mesh.patches)
      for (uint32_t i = patch.indices.first; i < patch.indices.end(); i += 3) {
        glm::dvec3 p[3], middle(0);
        for (uint32_t k = 0; k < 3; ++k) {
          p[k] = bases[patch.tile] + glm::dvec3(mesh.vertices[patch.baseVertex + mesh.indices[i + k]].position);
          middle += p[k] / 3.0;
        }
        area += glm::cross(p[1] - p[0], p[2] - p[0]).z / 2;
        // What is drawn is the surface that things stand on.
        EXPECT_NEAR(middle.z, city.terrain->heightAt(middle.x, middle.y).value(), 1e-4);
      }
    const glm::dvec2 extent = city.terrain->extent();
    EXPECT_NEAR(area, extent.x * extent.y, 1e-3) << "all triangles face up and cover the field once";
  }
}

TEST(TerrainMesh, APatchLiesWithinItsTilesBounds) {
  const city::City city = cityOn(bumpyField(50, 71));
  const TerrainMesh mesh = meshOf(city);
  const std::vector<glm::dvec3> bases = tileBases(city);
  for (const TerrainPatch& patch : mesh.patches) {
    city::Aabbf bounds = city.tiles[patch.tile].bounds;
    bounds.min -= 1e-3f, bounds.max += 1e-3f;
    for (uint32_t i = patch.indices.first; i < patch.indices.end(); ++i)
      EXPECT_TRUE(bounds.contains(
          glm::vec3(bases[patch.tile] + glm::dvec3(mesh.vertices[patch.baseVertex + mesh.indices[i]].position))));
  }
}

TEST(TerrainMesh, LeavesHolesWhereThereIsNoData) {
  city::HeightField field = bumpyField(20, 20);
  field.at(7, 8) = NAN;
  field.at(0, 0) = NAN;
  const city::City city = cityOn(field);
  const TerrainMesh mesh = meshOf(city);
  EXPECT_EQ(triangleCount(mesh), city.terrain->triangleCount());
  EXPECT_LT(triangleCount(mesh), 2u * 19 * 19);
  for (const TerrainVertex& v : mesh.vertices) EXPECT_TRUE(std::isfinite(v.position.z));
}

TEST(TerrainMesh, WithoutAnyDataHasNoPatches) {
  city::HeightField field = bumpyField(5, 5);
  std::fill(field.heights.begin(), field.heights.end(), NAN);
  city::TileGrid grid;
  EXPECT_TRUE(terrainMesh(field, grid, std::vector<glm::dvec3>(grid.tileCount())).patches.empty());
  EXPECT_TRUE(terrainMesh({}, grid, std::vector<glm::dvec3>(grid.tileCount())).patches.empty());
}

TEST(TerrainMesh, PatchesOfOneShapeShareTheirIndices) {
  const TerrainMesh mesh = meshOf(cityOn(bumpyField(129, 129)));
  EXPECT_LT(mesh.indices.size(), 3 * 2u * 128 * 128 / 8);
}

TEST(SampleNormal, IsThatOfASlope) {
  city::HeightField field;
  field.size = {4, 4}, field.spacing = {2, 2};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) field.heights.push_back(static_cast<float>(2 * c));
  for (int c = 0; c < 4; ++c) {
    const glm::vec3 n = sampleNormal(field, c, 1);
    EXPECT_NEAR(n.x, -std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(n.z, std::sqrt(0.5f), 1e-6f);
  }
  field.at(1, 1) = NAN;
  EXPECT_NEAR(sampleNormal(field, 2, 1).x, -std::sqrt(0.5f), 1e-6f) << "one neighbour is enough";
  EXPECT_EQ(sampleNormal(field, 1, 1), glm::vec3(0, 0, 1));
}

TEST(TileTable, SubtractsTheEyeInDouble) {
  const glm::dvec3 far(1e7, 5e6, 0);
  TileTable table({far + glm::dvec3(12.25, 0, 3)});
  table.moveTo(far + glm::dvec3(0, 0, 1.625));
  EXPECT_EQ(glm::vec3(table.fromEye()[0]), glm::vec3(12.25f, 0, 1.375f));
}

TEST(GroundMesh, BeginsAtTheTerrainsEdgeAndEndsAtTheHorizon) {
  const city::City city = cityOn(bumpyField(30, 20));
  const GroundMesh mesh = groundMesh(city);
  EXPECT_FALSE(mesh.followsEye);
  // Each border sample is a vertex.
  size_t found = 0;
  float farthest = 0;
  for (const GroundVertex& v : mesh.vertices) {
    const glm::dvec3 p = mesh.centre + glm::dvec3(v.position);
    const glm::dvec2 cell = (glm::dvec2(p) - city.terrain->origin) / city.terrain->spacing;
    if (v.beyond == 0 && std::abs(p.z - city.terrain->heightAt(p.x, p.y).value()) < 1e-4 &&
        glm::length(cell - glm::round(cell)) < 1e-4)
      ++found;
    farthest = std::max(farthest, glm::length(v.position));
  }
  EXPECT_GE(found, 2u * (29 + 19));
  EXPECT_GT(static_cast<double>(farthest), kGroundReach);
}

TEST(GroundMesh, FacesUp) {
  for (const city::City& city : {cityOn(bumpyField(30, 20)), city::City()}) {
    const GroundMesh mesh = groundMesh(city);
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
      const glm::dvec3 a(mesh.vertices[mesh.indices[i]].position), b(mesh.vertices[mesh.indices[i + 1]].position),
          c(mesh.vertices[mesh.indices[i + 2]].position);
      EXPECT_GE(glm::cross(b - a, c - a).z, -1e-2);
    }
  }
}

TEST(GroundMesh, WithoutTerrainIsAPlaneUnderTheLowestHouse) {
  tests::SmallCityOptions options;
  options.terrain = false;
  options.shift = {100, 200, 7};
  const GroundMesh mesh = groundMesh(tests::smallCity(options));
  EXPECT_TRUE(mesh.followsEye);
  EXPECT_NEAR(mesh.centre.z, 6.7, 1e-9);
}

TEST(GroundMesh, UnderHolesInTheBorderIsAPlane) {
  city::HeightField field = bumpyField(9, 9);
  field.at(3, 0) = NAN;
  const city::City city = cityOn(field);
  const GroundMesh mesh = groundMesh(city);
  EXPECT_TRUE(mesh.followsEye);
  EXPECT_LT(mesh.centre.z, static_cast<double>(city.terrain->minHeight));
}

TEST(GroundMap, SizeIsAPowerOfTwoWithinItsBounds) {
  EXPECT_EQ(groundMapSize({2048, 1000}, 8192), 4096);
  EXPECT_EQ(groundMapSize({2048, 1000}, 2048), 2048);
  EXPECT_EQ(groundMapSize({1, 1}, 2048), 64);
  EXPECT_EQ(groundMapSize({1e9, 1}, 1024), 1024);
}

TEST(GroundMap, TakesTheColourOfWhatCoversTheGround) {
  city::HeightField field = bumpyField(21, 21);
  std::fill(field.heights.begin(), field.heights.end(), 4.0f);
  city::GroundCover cover;
  cover.origin = field.origin, cover.spacing = 10, cover.size = {6, 8};
  cover.kinds.assign(48, city::Ground::Paving);
  const auto mean = [&](city::Ground kind) {
    std::fill(cover.kinds.begin(), cover.kinds.end(), kind);
    const GroundMap map = paintGroundMap(field, &cover, 64, {}, lightOf({}));
    glm::dvec4 sum(0);
    for (size_t i = 0; i < map.rgba.size(); ++i) sum[static_cast<int>(i % 4)] += map.rgba[i] / (255.0 * 64 * 64);
    return sum;
  };
  const glm::dvec4 grass = mean(city::Ground::Grass), paving = mean(city::Ground::Paving);
  EXPECT_GT(grass.g, grass.r);
  EXPECT_GT(paving.r, grass.r);
  EXPECT_NEAR(grass.a, 0, 0.01);
  EXPECT_NEAR(paving.a, 1, 0.01);
}

TEST(GroundMap, IsTheSameEachTime) {
  const city::HeightField field = bumpyField(21, 21);
  EXPECT_EQ(paintGroundMap(field, nullptr, 128, {}, lightOf({})).rgba,
            paintGroundMap(field, nullptr, 128, {}, lightOf({})).rgba);
}

/// A city of one house of 10 m × 10 m × 10 m in the middle of level ground of 64 m × 64 m.
city::City oneBlock() {
  city::City city;
  city::HeightField field;
  field.size = {17, 17}, field.spacing = {4, 4}, field.origin = {-32, -32};
  field.heights.assign(17 * 17, 2.0f);
  field.updateRange();
  city.terrain = field;
  city::BuildingBuilder b("block");
  b.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-5, -5, 0}, {5, 5, 10}, 0);
  city.buildingTypes.push_back(b.finish());
  city::CityParts parts;
  parts.buildings.resize(1);
  parts.buildings[0].position.z = 2;
  city::finishCity(city, std::move(parts));
  return city;
}

TEST(GroundShade, ThrowsAShadowAsLongAsTheHouseIsHigh) {
  const city::City city = oneBlock();
  // From the west at 45°: the shadow lies from x = −5 to 15.
  const GroundShade shade = shadeGround(city, glm::normalize(glm::vec3(-1, 0, 1)), 64);
  ASSERT_EQ(shade.size, 64);
  const auto sunAt = [&](int x, int y) {
    return int{shade.sun[static_cast<size_t>(y + 32) * 64 + static_cast<size_t>(x + 32)]};
  };
  EXPECT_EQ(sunAt(10, 0), 0);
  EXPECT_EQ(sunAt(14, 4), 0);
  EXPECT_EQ(sunAt(16, 0), 255);
  EXPECT_EQ(sunAt(-7, 0), 255);
  EXPECT_EQ(sunAt(10, 6), 255);
}

TEST(GroundShade, HidesTheSkyAtTheFootOfWallsOnly) {
  const GroundShade shade = shadeGround(oneBlock(), {0, 0, 1}, 64);
  const auto skyAt = [&](int x) { return int{shade.sky[static_cast<size_t>(32) * 64 + static_cast<size_t>(x + 32)]}; };
  EXPECT_LT(skyAt(5), 170);
  EXPECT_GT(skyAt(5), 90);
  EXPECT_EQ(skyAt(9), 255);
}

TEST(GroundShade, IsLeftOutWhereItWouldNotShow) {
  const city::City city = oneBlock();
  EXPECT_EQ(shadeGround(city, {1, 0, 0}, 64).size, 0) << "the sun on the horizon";
  EXPECT_EQ(shadeGround(city, {0, 0, 1}, 16).size, 0) << "pixels of 4 m";
  EXPECT_EQ(shadeGround(city::City(), {0, 0, 1}, 64).size, 0) << "no terrain";
}

TEST(GroundMap, IsDarkerInTheShade) {
  const city::City city = oneBlock();
  const Light light = lightOf(city.environment);
  const auto sum = [](const GroundMap& map) {
    uint64_t total = 0;
    for (const uint8_t v : map.rgba) total += v;
    return total;
  };
  EXPECT_LT(sum(paintGroundMap(*city.terrain, nullptr, 64, shadeGround(city, light.sunDirection, 64), light)),
            sum(paintGroundMap(*city.terrain, nullptr, 64, {}, light)));
}

}  // namespace
}  // namespace vicus::scenegraph
