#include "scenegraph/arena.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "small_city.hpp"

namespace vicus::scenegraph {
namespace {

using tests::gabledHouse;
using tests::smallTree;

/// Corner positions of a run of indices, triangle by triangle, sorted.
std::vector<std::array<float, 9>> triangles(const Arena& arena, const ArenaGeometry& g, const city::Range& run) {
  const ArenaChunk& chunk = arena.chunks[g.chunk];
  std::vector<std::array<float, 9>> out;
  for (uint32_t i = run.first; i < run.end(); i += 3) {
    std::array<float, 9> t{};
    for (uint32_t k = 0; k < 3; ++k) {
      const glm::vec3 p = chunk.vertices[static_cast<size_t>(g.baseVertex) + chunk.indices[i + k]].position;
      t[3 * k] = p.x, t[3 * k + 1] = p.y, t[3 * k + 2] = p.z;
    }
    out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

city::City twoHouses() {
  city::City city;
  city.buildingTypes = {gabledHouse("a", 7, 5, 2.6f, 5), gabledHouse("b", 9, 6, 5, 8)};
  return city;
}

TEST(Arena, OfNothingIsEmpty) {
  const Arena arena = buildingArena({}, {});
  EXPECT_TRUE(arena.chunks.empty());
  EXPECT_FALSE(arena.has(ArenaPart::Opaque));
}

TEST(Arena, HoldsFullDetailOfEachTypeAndNothingElse) {
  const city::City city = twoHouses();
  const Arena arena = buildingArena(city, {});
  ASSERT_EQ(arena.geometries.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const city::BuildingGeometry& from = city.buildingTypes[i];
    const ArenaGeometry& g = arena.geometries[i];
    EXPECT_EQ(g.parts[0].count, from.fullDetail.count);
    EXPECT_EQ(g.parts[1].count, 0u);
    Arena whole;
    const PlaneRun run{from.fullDetail, 0};
    addGeometry(whole, from.vertices, from.indices, {&run, 1}, {});
    EXPECT_EQ(triangles(arena, g, g.parts[0]), triangles(whole, whole.geometries[0], whole.geometries[0].parts[0]));
  }
}

TEST(Arena, PlanesFollowEachOtherAndFillTheirGeometry) {
  const Arena arena = buildingArena(twoHouses(), {});
  for (const ArenaGeometry& g : arena.geometries) {
    uint32_t next = g.parts[0].first;
    for (uint32_t p = g.planes.first; p < g.planes.end(); ++p) {
      EXPECT_EQ(arena.planes[p].parts[0].first, next);
      next = arena.planes[p].parts[0].end();
    }
    EXPECT_EQ(next, g.parts[0].end());
  }
}

TEST(Arena, TrianglesWithHolesGoToTheirOwnPart) {
  city::City city;
  city.treeTypes = {smallTree()};
  std::vector<uint8_t> cutOut(tests::kLeaves + 1, 0);
  cutOut[tests::kLeaves] = 1;
  const Arena arena = treeArena(city, cutOut);
  EXPECT_EQ(arena.geometries[0].parts[0].count, 3u * 8);
  EXPECT_EQ(arena.geometries[0].parts[1].count, 3u * 4);
  EXPECT_TRUE(arena.has(ArenaPart::CutOut));
}

TEST(Arena, AGeometryNeverCrossesChunks) {
  const city::BuildingGeometry house = gabledHouse("house", 7, 5, 2.6f, 5);
  const PlaneRun run{house.fullDetail, 0};
  const uint64_t room = 3 * house.vertices.size() * sizeof(city::Vertex);
  Arena arena;
  for (int i = 0; i < 10; ++i) addGeometry(arena, house.vertices, house.indices, {&run, 1}, {}, room);
  EXPECT_EQ(arena.chunks.size(), 4u);
  for (const ArenaChunk& chunk : arena.chunks) EXPECT_LE(chunk.vertices.size() * sizeof(city::Vertex), room);
  for (const ArenaGeometry& g : arena.geometries)
    EXPECT_EQ(triangles(arena, g, g.parts[0]), triangles(arena, arena.geometries[0], arena.geometries[0].parts[0]));
}

TEST(Arena, AGeometryLargerThanAChunkGetsItsOwn) {
  const city::BuildingGeometry house = gabledHouse("house", 7, 5, 2.6f, 5);
  const PlaneRun run{house.fullDetail, 0};
  Arena arena;
  for (int i = 0; i < 2; ++i) addGeometry(arena, house.vertices, house.indices, {&run, 1}, {}, 1);
  EXPECT_EQ(arena.chunks.size(), 2u);
}

TEST(Arena, ATypeWithoutTrianglesDrawsNothing) {
  city::City city;
  city.buildingTypes.resize(1);
  const Arena arena = buildingArena(city, {});
  EXPECT_EQ(arena.geometries[0].parts[0].count, 0u);
}

}  // namespace
}  // namespace vicus::scenegraph
