#include "city/city.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::city {
namespace {

Aabb toDouble(const Aabbf& box) {
  return {glm::dvec3(box.min), glm::dvec3(box.max)};
}

/// Adds to every tile the ground that lies on it. Samples on a shared edge belong to both sides.
void extendByTerrain(std::vector<Tile>& tiles, const TileGrid& grid, const HeightField& field) {
  for (uint32_t t = 0; t < grid.tileCount(); ++t) {
    const glm::dvec2 min = grid.origin + grid.tileSize * glm::dvec2(grid.cell(t));
    const glm::dvec2 from = (min - field.origin) / field.spacing;
    const glm::dvec2 to = (min + grid.tileSize - field.origin) / field.spacing;
    const int c0 = std::clamp(static_cast<int>(std::floor(from.x)), 0, field.size.x - 1);
    const int c1 = std::clamp(static_cast<int>(std::ceil(to.x)), 0, field.size.x - 1);
    const int r0 = std::clamp(static_cast<int>(std::floor(from.y)), 0, field.size.y - 1);
    const int r1 = std::clamp(static_cast<int>(std::ceil(to.y)), 0, field.size.y - 1);
    Aabb box;
    for (int row = r0; row <= r1; ++row)
      for (int column = c0; column <= c1; ++column) {
        const float h = field.at(column, row);
        if (std::isfinite(h)) box.extend(glm::dvec3(field.origin + field.spacing * glm::dvec2(column, row), h));
      }
    if (!box.empty()) tiles[t].bounds.extend(outward(box));
  }
}

}  // namespace

size_t finishCity(City& city, CityParts parts) {
  // Monuments' world bounds first: the extent needs them.
  for (Monument& m : city.monuments) {
    Instance asInstance;
    asInstance.position = m.position, asInstance.heading = m.heading;
    m.bounds = instanceBounds(asInstance, city.meshes[m.mesh].bounds);
  }

  std::vector<Aabbf> typeBounds, treeBounds;
  for (const BuildingGeometry& g : city.buildingTypes) typeBounds.push_back(g.bounds);
  for (const MeshGeometry& g : city.treeTypes) treeBounds.push_back(g.bounds);

  // The extent is that of everything that stands in the city or is its ground.
  city.extent = {};
  const auto extendBy = [&](const std::vector<Instance>& list, const std::vector<Aabbf>& bounds) {
    for (const Instance& i : list)
      if (i.geometry < bounds.size() && std::isfinite(i.position.x + i.position.y + i.position.z))
        city.extent.extend(toDouble(instanceBounds(i, bounds[i.geometry])));
  };
  extendBy(parts.buildings, typeBounds);
  extendBy(parts.trees, treeBounds);
  for (const Monument& m : city.monuments) city.extent.extend(toDouble(m.bounds));
  if (city.terrain) city.extent.extend(city.terrain->bounds());
  for (const WaterBody& w : city.water)
    for (const glm::dvec2& p : w.points) city.extent.extend(glm::dvec3(p, w.level));

  city.grid = tileGridFor(city.extent);
  size_t droppedBuildings = 0, droppedTrees = 0;
  city.buildings = buildInstanceSet(std::move(parts.buildings), typeBounds, city.grid, 16, &droppedBuildings);
  city.trees = buildInstanceSet(std::move(parts.trees), treeBounds, city.grid, 16, &droppedTrees);

  city.tiles.assign(city.grid.tileCount(), {});
  const std::vector<Range> buildingRuns = tileRuns(city.buildings, city.grid);
  const std::vector<Range> treeRuns = tileRuns(city.trees, city.grid);
  for (uint32_t t = 0; t < city.grid.tileCount(); ++t) {
    Tile& tile = city.tiles[t];
    tile.instances = buildingRuns[t], tile.trees = treeRuns[t];
    for (uint32_t i = tile.instances.first; i < tile.instances.end(); ++i) tile.bounds.extend(city.buildings.bounds[i]);
    for (uint32_t i = tile.trees.first; i < tile.trees.end(); ++i) tile.bounds.extend(city.trees.bounds[i]);
  }
  if (city.terrain && !city.terrain->empty()) extendByTerrain(city.tiles, city.grid, *city.terrain);
  return droppedBuildings + droppedTrees;
}

uint64_t fullDetailTriangles(const City& city) {
  uint64_t count = 0;
  for (const Instance& i : city.buildings.instances) count += city.buildingTypes[i.geometry].fullDetailTriangles();
  for (const Monument& m : city.monuments) count += city.meshes[m.mesh].mesh.triangleCount();
  return count;
}

CityBytes memoryOf(const City& city) {
  const auto bytes = [](const auto& v) { return static_cast<uint64_t>(v.size() * sizeof(v[0])); };
  CityBytes out;
  for (const BuildingGeometry& g : city.buildingTypes) {
    out.geometry += sizeof(g) + bytes(g.vertices) + bytes(g.indices) + bytes(g.levels) + bytes(g.planes) +
                    bytes(g.externalGeometry) + bytes(g.externalOpenings) + bytes(g.occluders);
    for (const auto& ring : g.footprint) out.geometry += bytes(ring);
  }
  for (const auto* list : {&city.treeTypes, &city.meshes})
    for (const MeshGeometry& g : *list) out.geometry += sizeof(g) + bytes(g.mesh.vertices) + bytes(g.mesh.indices);
  for (const InstanceSet* set : {&city.buildings, &city.trees})
    out.instances += bytes(set->instances) + bytes(set->bounds) + bytes(set->nodes);
  if (city.terrain) out.terrain = bytes(city.terrain->heights);
  for (const Character& c : city.people.characters) {
    out.people += sizeof(c) + bytes(c.skeleton.joints) + bytes(c.jointFromSkin) + bytes(c.dresses);
    for (const AvatarMesh& m : c.levels) out.people += bytes(m.vertices) + bytes(m.indices);
    for (const Clip& clip : c.clips)
      for (const Track& t : clip.tracks)
        out.people += sizeof(t) + bytes(t.rotationTimes) + bytes(t.rotations) + bytes(t.translationTimes) +
                      bytes(t.translations) + bytes(t.scaleTimes) + bytes(t.scales);
  }
  for (const WalkRoute& r : city.people.routes) out.people += sizeof(r) + bytes(r.points);
  out.people += bytes(city.people.places) + bytes(city.people.placed);
  return out;
}

}  // namespace vicus::city
