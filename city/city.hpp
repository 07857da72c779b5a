/// The city: everything that a scene holds, as plain values.
///
/// Based on: Willmott et al. 2001, §2 (building and mesh geometry lists, tiles with instances).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "city/avatars.hpp"
#include "city/building_geometry.hpp"
#include "city/height_field.hpp"
#include "city/instance.hpp"
#include "city/material.hpp"

namespace vicus::city {

/// A mesh that stands once or is too free in form for planes: castle, cathedral, bridge, tree.
struct MeshGeometry {
  std::string name;
  TriangleMesh mesh;
  Aabbf bounds;
};

/// A unique mesh in its place.
struct Monument {
  std::string name;
  uint32_t mesh = 0;            ///< index into City::meshes
  glm::dvec3 position{0};       ///< metres from the city's origin
  float heading = 0;            ///< radians counter-clockwise
  uint32_t attributes = kNone;  ///< row of City::attributes
  Aabbf bounds;                 ///< world bounds, set by `finishCity`
};

/// Level surfaces of water: triangles on the plan with one height each body.
struct WaterBody {
  std::string name;
  double level = 0;                ///< metres above the city's origin
  std::vector<glm::dvec2> points;  ///< metres from the city's origin
  std::vector<uint32_t> indices;   ///< three for each triangle, counter-clockwise from above
};

enum class StreetKind : uint8_t { Lane, Street, HighStreet, Road, Bridge };

/// Streets as a graph: where one can walk.
struct StreetGraph {
  struct Node {
    glm::dvec3 position{0};  ///< metres from the city's origin, on the ground
  };
  struct Edge {
    uint32_t a = 0, b = 0;  ///< nodes
    float width = 4;        ///< metres
    StreetKind kind = StreetKind::Street;
    std::string name;
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;
};

/// A way through the city that a tour follows, played at the speed that its keys' times give.
struct Tour {
  struct Key {
    double time = 0;         ///< seconds, increasing
    glm::dvec3 position{0};  ///< of the eye, metres from the city's origin
    double heading = 0;      ///< radians counter-clockwise from east, where the eye looks
    double pitch = 0;        ///< radians, up positive
  };
  std::string name;
  std::vector<Key> keys;
  bool jumps = false;  ///< true: the eye stays at a key until the next one's time (teleport)
};

/// What is known of a building: its attributes as the sources give them, column name and text.
using Attributes = std::vector<std::pair<std::string, std::string>>;

/// Light and air.
struct Environment {
  double sunAzimuth = 3.9;     ///< radians clockwise from north, where the sun stands (3.9: afternoon, south-west)
  double sunElevation = 0.75;  ///< radians above the horizon
  double hazeDistance = 6000;  ///< metres at which a surface has lost 63 % of its contrast
};

struct City {
  std::string name;
  glm::dvec3 origin{0};  ///< in `crs`; every other position is relative to it
  std::string crs;       ///< "EPSG:2154" or WKT; empty: local metres
  Aabb extent;           ///< of all content, metres from the origin

  std::vector<Material> materials;
  std::vector<BuildingGeometry> buildingTypes;
  InstanceSet buildings;
  std::vector<MeshGeometry> treeTypes;
  InstanceSet trees;
  std::vector<MeshGeometry> meshes;
  std::vector<Monument> monuments;

  TileGrid grid;
  std::vector<Tile> tiles;  ///< grid.size², in Morton order

  std::optional<HeightField> terrain;
  std::optional<GroundCover> groundCover;
  std::vector<WaterBody> water;
  std::optional<StreetGraph> streets;
  std::vector<Tour> tours;
  People people;
  std::vector<Attributes> attributes;
  Environment environment;

  /// Item ids, as item buffers hold them: 0 nothing, then buildings, then monuments, then (beyond `itemCount`, which
  /// counts what stands) people; trees, terrain and water have none and write kItemOther (they hide, and are never
  /// counted).
  uint32_t itemOfBuilding(uint32_t index) const { return 1 + index; }
  uint32_t itemOfMonument(uint32_t index) const { return 1 + static_cast<uint32_t>(buildings.size()) + index; }
  uint32_t itemOfPerson(uint32_t index) const { return itemCount() + index; }
  uint32_t itemCount() const { return 1 + static_cast<uint32_t>(buildings.size() + monuments.size()); }
};
constexpr uint32_t kItemOther = 0xffffffffU;

/// What importers and generators hand over, before it is sorted into tiles.
struct CityParts {
  std::vector<Instance> buildings;
  std::vector<Instance> trees;
};

/// Completes a city whose lists (materials, types, meshes, monuments, terrain, …) are filled in: extent, tile grid,
/// sorted instances with bounds and hierarchy, tiles with bounds, monuments' bounds. Returns how many instances it
/// dropped (bad geometry index or position).
size_t finishCity(City& city, CityParts parts);

/// Full-detail triangles of all building instances and monuments.
uint64_t fullDetailTriangles(const City& city);

/// Bytes that the city's vectors hold, by what they are for.
struct CityBytes {
  uint64_t geometry = 0;   ///< vertices, indices, planes, meshes
  uint64_t instances = 0;  ///< instances, bounds, hierarchy: the parameters
  uint64_t terrain = 0;
  uint64_t people = 0;  ///< bodies, motions and ways
};
CityBytes memoryOf(const City& city);

}  // namespace vicus::city
