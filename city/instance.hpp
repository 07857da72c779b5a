/// What stands in the city, and the hierarchy of bounds over it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "city/aabb.hpp"
#include "city/vertex.hpp"

namespace vicus::city {

constexpr uint32_t kNone = 0xffffffffU;

/// One building (or tree) with all its parts.
struct Instance {
  glm::dvec3 position{0};       ///< metres from the city's origin, of the geometry's origin
  float heading = 0;            ///< radians counter-clockwise from above; 0 leaves the geometry's x axis pointing east
  uint32_t geometry = 0;        ///< index into the set's geometry list (City::buildingTypes or City::treeTypes)
  uint32_t seed = 0;            ///< chooses tints and variants
  uint32_t attributes = kNone;  ///< row of City::attributes
};

/// A node of the quadtree over instances. Children are consecutive; a node's instances are one run, its children's runs
/// in order.
struct BoundsNode {
  Aabbf bounds;             ///< of all its instances, metres from the city's origin
  Range instances;          ///< in InstanceSet::instances
  uint32_t firstChild = 0;  ///< in InstanceSet::nodes
  uint32_t childCount = 0;  ///< 0 for a leaf
};

/// Instances in the order of a Morton curve over the tile grid and on into each tile, so that every tile and every
/// quadrant is one run of instances. Build it with `buildInstanceSet`.
struct InstanceSet {
  std::vector<Instance> instances;
  std::vector<Aabbf> bounds;      ///< one for each instance; contains all its vertices
  std::vector<BoundsNode> nodes;  ///< node 0 is the root; empty where there are no instances

  size_t size() const { return instances.size(); }
  bool empty() const { return instances.empty(); }
};

/// The square grid of tiles that covers the city's extent. Size² tiles, 16 or 32 to a side.
struct TileGrid {
  glm::dvec2 origin{0};  ///< south-west corner, metres from the city's origin
  double tileSize = 1;   ///< metres, > 0
  uint32_t size = 16;    ///< tiles to a side: 16 or 32

  /// Index of the tile at (x, y), in Morton order; positions outside go to the nearest tile, NaN to tile 0.
  uint32_t tileAt(double x, double y) const;
  /// Column and row of a tile.
  glm::uvec2 cell(uint32_t tile) const;
  uint32_t tileCount() const { return size * size; }
  /// Centre of a tile on the plan.
  glm::dvec2 centre(uint32_t tile) const;
};

/// Grid for an extent: 16 tiles to a side while tiles stay at or under 128 m (cities to 2 048 m, the published
/// walkthrough's size), 32 for larger ones. Tiles are square and at least 8 m.
TileGrid tileGridFor(const Aabb& extent);

/// A tile of ground with what stands on it.
struct Tile {
  Aabbf bounds;     ///< of its instances, trees and ground
  Range instances;  ///< in City::buildings
  Range trees;      ///< in City::trees
};

/// Interleaves the bits of column and row: the index of a cell along the Morton curve.
uint32_t mortonIndex(uint32_t column, uint32_t row);

/// World bounds of an instance whose geometry has the local bounds `local`: the rotated box's own bounds, rounded
/// outward.
Aabbf instanceBounds(const Instance& instance, const Aabbf& local);

/// Sorts instances into Morton order, computes their bounds from `geometryBounds` (one for each geometry) and builds
/// the quadtree down to at most `leafSize` instances. Instances with a geometry out of range or a position that is not
/// finite are dropped; their count is `dropped` where given. Deterministic; ties keep the order of the input.
InstanceSet buildInstanceSet(std::vector<Instance> instances, std::span<const Aabbf> geometryBounds,
                             const TileGrid& grid, uint32_t leafSize = 16, size_t* dropped = nullptr);

/// For each tile of the grid, the run of the set's instances that stand on it.
std::vector<Range> tileRuns(const InstanceSet& set, const TileGrid& grid);

}  // namespace vicus::city
