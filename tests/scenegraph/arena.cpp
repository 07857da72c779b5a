#include "scenegraph/arena.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "small_city.hpp"

namespace vicus::scenegraph {
namespace {

using tests::gabledHouse;
using tests::smallTree;

/// Corner positions of a run of indices, triangle by triangle, sorted.
std::vector<std::array<float, 9>> triangles(std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                                            int32_t baseVertex, const city::Range& run) {
  std::vector<std::array<float, 9>> out;
  for (uint32_t i = run.first; i < run.end(); i += 3) {
    std::array<float, 9> t{};
    for (uint32_t k = 0; k < 3; ++k) {
      const glm::vec3 p = vertices[static_cast<size_t>(baseVertex) + indices[i + k]].position;
      t[3 * k] = p.x, t[3 * k + 1] = p.y, t[3 * k + 2] = p.z;
    }
    out.push_back(t);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// What a level of a geometry draws, all runs together.
std::vector<std::array<float, 9>> drawnAt(const Arena& arena, const ArenaGeometry& g, houselod::Level level,
                                          ArenaPart part = ArenaPart::Opaque) {
  const ArenaChunk& chunk = arena.chunks[g.chunk];
  std::vector<std::array<float, 9>> out;
  for (uint32_t r = g.runs.first; r < g.runs.end(); ++r) {
    const auto more =
        triangles(chunk.vertices, chunk.indices, g.baseVertex, indicesAt(arena, arena.runs[r], part, level));
    out.insert(out.end(), more.begin(), more.end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// What it ought to draw, put together from the building itself.
std::vector<std::array<float, 9>> expectedAt(const city::BuildingGeometry& g, houselod::Level level) {
  const houselod::TypeLevels levels = houselod::levelsOf(g);
  std::vector<std::array<float, 9>> out;
  const auto add = [&](const city::Range& range) {
    const auto more = triangles(g.vertices, g.indices, 0, range);
    out.insert(out.end(), more.begin(), more.end());
  };
  if (level == houselod::kFullDetail) {
    add(g.fullDetail);
  } else {
    for (const city::Plane& plane : g.planes) add(plane.flat);
    for (size_t i = 0; i < g.externalGeometry.size(); ++i)
      if (levels.stepOf[i] + 1 >= level) add(g.externalGeometry[i].indices);
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
  const Arena arena = buildingArena({}, {}, Ordering::ByState, nullptr);
  EXPECT_TRUE(arena.chunks.empty());
  EXPECT_FALSE(arena.has(ArenaPart::Opaque));
}

/// A wall with an opening, a sill and a balcony, and one with nothing.
city::BuildingGeometry decoratedHouse() {
  city::BuildingBuilder builder("decorated");
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}, 0);
  builder.addQuad({3, 0, 2}, {4, 0, 2}, {4, 0, 3}, {3, 0, 3}, 0);
  builder.beginFlat();
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0);
  builder.beginExternalGeometry(1);
  builder.addQuad({1, -1, 1}, {2, -1, 1}, {2, 0, 1}, {1, 0, 1}, 0);
  builder.beginExternalGeometry(0.05f);
  builder.addQuad({1, -0.05f, 1}, {2, -0.05f, 1}, {2, -0.05f, 2}, {1, -0.05f, 2}, 0);
  builder.beginExternalOpening(0.3f);
  builder.addQuad({3, 0.3f, 0}, {4, 0.3f, 0}, {4, 0.3f, 2}, {3, 0.3f, 2}, 0);
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, 1, 0});
  builder.addQuad({4, 4, 0}, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}, 0);
  return builder.finish();
}

TEST(Arena, DrawsEachLevelOfEachTypeAndNothingElse) {
  city::City city = twoHouses();
  city.buildingTypes.push_back(decoratedHouse());
  const houselod::HouseTypes houses = houselod::lookAtTypes(city.buildingTypes, {});
  for (const Ordering ordering : {Ordering::ByState, Ordering::Scene}) {
    const Arena arena = buildingArena(city, {}, ordering, &houses);
    ASSERT_EQ(arena.geometries.size(), 3u);
    for (size_t i = 0; i < 3; ++i) {
      const city::BuildingGeometry& from = city.buildingTypes[i];
      const ArenaGeometry& g = arena.geometries[i];
      EXPECT_EQ(g.runs.count, ordering == Ordering::ByState ? 1 : from.planes.size());
      EXPECT_EQ(drawnAt(arena, g, houselod::kFullDetail), expectedAt(from, houselod::kFullDetail));
      EXPECT_TRUE(drawnAt(arena, g, houselod::kFullDetail, ArenaPart::CutOut).empty());
      if (!houselod::levelsOf(from).flat) continue;
      for (uint32_t level = 1; level <= g.steps + 1; ++level)
        EXPECT_EQ(drawnAt(arena, g, static_cast<houselod::Level>(level)),
                  expectedAt(from, static_cast<houselod::Level>(level)))
            << from.name << ", level " << level;
    }
  }
  EXPECT_EQ(buildingArena(city, {}, Ordering::ByState, &houses).geometries[2].steps, 2u);
}

TEST(Arena, WithoutHouseLodHasFullDetailAlone) {
  city::City city = twoHouses();
  city.buildingTypes.push_back(decoratedHouse());
  const Arena arena = buildingArena(city, {}, Ordering::ByState, nullptr);
  EXPECT_FALSE(arena.hasFlat());
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(drawnAt(arena, arena.geometries[i], houselod::kFullDetail),
              expectedAt(city.buildingTypes[i], houselod::kFullDetail));
  const houselod::HouseTypes houses = houselod::lookAtTypes(city.buildingTypes, {});
  EXPECT_TRUE(buildingArena(city, {}, Ordering::ByState, &houses).hasFlat());
}

/// A gable with an opening but no surface without it: flat, the opening still closes the hole.
TEST(Arena, LeavesNoHoleOpenWhereAWallHasNoFlatSurface) {
  city::BuildingBuilder builder("gable");
  builder.beginPlane(city::PlaneKind::Gable, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}, 0);
  builder.beginExternalOpening(0.3f);
  builder.addQuad({3, 0.3f, 0}, {4, 0.3f, 0}, {4, 0.3f, 3}, {3, 0.3f, 3}, 0);
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, 1, 0});
  builder.addQuad({4, 4, 0}, {0, 4, 0}, {0, 4, 3}, {4, 4, 3}, 0);
  builder.beginExternalGeometry(0.05f);
  builder.addQuad({2, 4.05f, 1}, {1, 4.05f, 1}, {1, 4.05f, 2}, {2, 4.05f, 2}, 0);
  city::City city;
  city.buildingTypes = {builder.finish()};
  const houselod::HouseTypes houses = houselod::lookAtTypes(city.buildingTypes, {});
  const Arena arena = buildingArena(city, {}, Ordering::ByState, &houses);
  const ArenaGeometry& g = arena.geometries[0];
  EXPECT_EQ(drawnAt(arena, g, houselod::kFullDetail).size(), 8u);
  EXPECT_EQ(drawnAt(arena, g, 1).size(), 8u);
  EXPECT_EQ(drawnAt(arena, g, 2).size(), 6u) << "the sill alone is left out";
}

/// Flat walls show their pictures; full detail knows nothing of them.
TEST(Arena, PutsPicturesOnFlatWallsAlone) {
  city::City city;
  city.buildingTypes = {gabledHouse("a", 7, 5, 2.6f, 5), decoratedHouse()};
  houselod::HouseTypes houses = houselod::lookAtTypes(city.buildingTypes, {});
  houses.pictures = houselod::planPictures(city.buildingTypes, 1, 128);
  constexpr city::MaterialId kFirstPage = 100;
  const Arena arena = buildingArena(city, {}, Ordering::ByState, &houses, kFirstPage);
  const ArenaGeometry& g = arena.geometries[1];
  const ArenaChunk& chunk = arena.chunks[g.chunk];
  const auto pictured = [&](houselod::Level level) {
    size_t count = 0;
    const city::Range range = indicesAt(arena, arena.runs[g.runs.first], ArenaPart::Opaque, level);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const city::Vertex& v = chunk.vertices[static_cast<size_t>(g.baseVertex) + chunk.indices[i]];
      if (v.material < kFirstPage) continue;
      ++count;
      EXPECT_TRUE(glm::all(glm::greaterThan(v.uv, glm::vec2(0))) && glm::all(glm::lessThan(v.uv, glm::vec2(1))));
      EXPECT_EQ(v.item, city.buildingTypes[1].planes[0].baseTexture) << "its seed's tint is the wall's own";
    }
    return count;
  };
  EXPECT_EQ(pictured(houselod::kFullDetail), 0u);
  EXPECT_EQ(pictured(static_cast<houselod::Level>(g.steps + 1)), 6u) << "one of its two walls has things on it";
}

TEST(Arena, TrianglesWithHolesGoToTheirOwnPart) {
  city::City city;
  city.treeTypes = {smallTree()};
  std::vector<uint8_t> cutOut(tests::kLeaves + 1, 0);
  cutOut[tests::kLeaves] = 1;
  const Arena arena = treeArena(city, cutOut);
  EXPECT_EQ(drawnAt(arena, arena.geometries[0], 0, ArenaPart::Opaque).size(), 8u);
  EXPECT_EQ(drawnAt(arena, arena.geometries[0], 0, ArenaPart::CutOut).size(), 4u);
  EXPECT_TRUE(arena.has(ArenaPart::CutOut));
}

TEST(Arena, AGeometryNeverCrossesChunks) {
  const city::BuildingGeometry house = gabledHouse("house", 7, 5, 2.6f, 5);
  const city::MaterialId material = 0;
  const uint64_t room = 3 * house.vertices.size() * sizeof(city::Vertex);
  Arena arena;
  for (int i = 0; i < 10; ++i)
    addGeometry(arena, house.vertices, house.indices, {{house.fullDetail, 0, 0}}, {&material, 1}, 0, {}, room);
  EXPECT_EQ(arena.chunks.size(), 4u);
  for (const ArenaChunk& chunk : arena.chunks) EXPECT_LE(chunk.vertices.size() * sizeof(city::Vertex), room);
  for (const ArenaGeometry& g : arena.geometries)
    EXPECT_EQ(drawnAt(arena, g, 0), drawnAt(arena, arena.geometries[0], 0));
}

TEST(Arena, AGeometryLargerThanAChunkGetsItsOwn) {
  const city::BuildingGeometry house = gabledHouse("house", 7, 5, 2.6f, 5);
  const city::MaterialId material = 0;
  Arena arena;
  for (int i = 0; i < 2; ++i)
    addGeometry(arena, house.vertices, house.indices, {{house.fullDetail, 0, 0}}, {&material, 1}, 0, {}, 1);
  EXPECT_EQ(arena.chunks.size(), 2u);
}

TEST(Arena, ATypeWithoutTrianglesDrawsNothing) {
  city::City city;
  city.buildingTypes.resize(1);
  const houselod::HouseTypes houses = houselod::lookAtTypes(city.buildingTypes, {});
  const Arena arena = buildingArena(city, {}, Ordering::ByState, &houses);
  EXPECT_TRUE(drawnAt(arena, arena.geometries[0], 0).empty());
}

}  // namespace
}  // namespace vicus::scenegraph
