#include "scenegraph/arena.hpp"

#include <algorithm>
#include <cassert>

namespace vicus::scenegraph {
namespace {

/// A building plane at full detail is one run of indices: its cut surface, then its items (BuildingGeometry's layout).
PlaneRun runOf(const city::BuildingGeometry& g, const city::Plane& plane) {
  uint32_t first = UINT32_MAX, end = 0;
  const auto include = [&](const city::Range& range) {
    if (range.count == 0) return;
    first = std::min(first, range.first);
    end = std::max(end, range.end());
  };
  include(plane.cut);
  for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i)
    include(g.externalGeometry[i].indices);
  for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
    include(g.externalOpenings[i].indices);
  if (end == 0) return {{0, 0}, plane.baseTexture};
  return {{first, end - first}, plane.baseTexture};
}

}  // namespace

bool Arena::has(ArenaPart part) const {
  return std::any_of(geometries.begin(), geometries.end(),
                     [&](const ArenaGeometry& g) { return g.parts[static_cast<size_t>(part)].count > 0; });
}

void addGeometry(Arena& arena, std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                 std::span<const PlaneRun> planes, std::span<const uint8_t> cutOut, uint64_t chunkBytes) {
  const auto full = [&](const ArenaChunk& chunk) {
    return (chunk.vertices.size() + vertices.size()) * sizeof(city::Vertex) > chunkBytes ||
           (chunk.indices.size() + indices.size()) * sizeof(uint32_t) > chunkBytes;
  };
  if (arena.chunks.empty() || (full(arena.chunks.back()) && !arena.chunks.back().vertices.empty()))
    arena.chunks.emplace_back();
  ArenaChunk& chunk = arena.chunks.back();

  ArenaGeometry geometry;
  geometry.chunk = static_cast<uint32_t>(arena.chunks.size() - 1);
  geometry.baseVertex = static_cast<int32_t>(chunk.vertices.size());
  geometry.planes = {static_cast<uint32_t>(arena.planes.size()), static_cast<uint32_t>(planes.size())};
  chunk.vertices.insert(chunk.vertices.end(), vertices.begin(), vertices.end());
  for (const PlaneRun& plane : planes) arena.planes.push_back({{}, plane.material});

  for (size_t part = 0; part < kArenaParts; ++part) {
    geometry.parts[part].first = static_cast<uint32_t>(chunk.indices.size());
    for (uint32_t p = 0; p < planes.size(); ++p) {
      city::Range& run = arena.planes[geometry.planes.first + p].parts[part];
      run.first = static_cast<uint32_t>(chunk.indices.size());
      for (uint32_t i = planes[p].indices.first; i + 2 < planes[p].indices.end(); i += 3) {
        assert(std::max({indices[i], indices[i + 1], indices[i + 2]}) < vertices.size());
        const city::MaterialId material = vertices[indices[i]].material;
        const bool holes = material < cutOut.size() && cutOut[material] != 0;
        if (holes == (part == static_cast<size_t>(ArenaPart::CutOut)))
          chunk.indices.insert(chunk.indices.end(), &indices[i], &indices[i] + 3);
      }
      run.count = static_cast<uint32_t>(chunk.indices.size()) - run.first;
    }
    geometry.parts[part].count = static_cast<uint32_t>(chunk.indices.size()) - geometry.parts[part].first;
  }
  arena.geometries.push_back(geometry);
}

Arena buildingArena(const city::City& city, std::span<const uint8_t> cutOut) {
  Arena arena;
  arena.geometries.reserve(city.buildingTypes.size());
  std::vector<PlaneRun> runs;
  for (const city::BuildingGeometry& g : city.buildingTypes) {
    runs.clear();
    for (const city::Plane& plane : g.planes) runs.push_back(runOf(g, plane));
    addGeometry(arena, g.vertices, g.indices, runs, cutOut);
  }
  return arena;
}

Arena treeArena(const city::City& city, std::span<const uint8_t> cutOut) {
  Arena arena;
  for (const city::MeshGeometry& g : city.treeTypes) {
    const PlaneRun whole{{0, static_cast<uint32_t>(g.mesh.indices.size())},
                         g.mesh.vertices.empty() ? city::MaterialId{0} : g.mesh.vertices[0].material};
    addGeometry(arena, g.mesh.vertices, g.mesh.indices, {&whole, 1}, cutOut);
  }
  return arena;
}

}  // namespace vicus::scenegraph
