/// Frustum culling of whole sets through their hierarchies of bounds.
///
/// Based on: Clark 1976, "Hierarchical Geometric Models for Visible Surface Algorithms" (what lies wholly inside is
/// tested no further); Assarsson and Möller 2000 (plane masks); Willmott et al. 2001, §3.1.3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/frame_plan.hpp"
#include "city/instance.hpp"
#include "culling/frustum.hpp"

namespace vicus::culling {

/// Sorts a set's instances into drawn runs and runs dropped for the frustum, both ascending and merged where they
/// touch, together covering the set once. A node outside or inside is one run without further tests; the instances of a
/// leaf that crosses the frustum are tested one by one. `out` is overwritten; its storage is reused. Returns the number
/// of boxes tested, nodes and instances.
///
/// The set is one that `buildInstanceSet` made, so its boxes are neither empty nor NaN; `test` must have been made with
/// a reach that contains the root's bounds.
uint64_t cullInstances(const city::InstanceSet& set, const BoxTest& test, city::SetPlan& out);

/// The bounds of 4ᵏ tiles in Morton order, and above them those of each four, up to one box of all: level by level, the
/// root first, so that the children of node i are 4i + 1 to 4i + 4. Tiles without anything on them have empty bounds.
struct TileTree {
  std::vector<city::Aabbf> bounds;
  uint32_t firstLeaf = 0;  ///< where the tiles' own bounds begin
};

/// `tiles.size()` must be a power of four (as that of a TileGrid is) or zero.
TileTree buildTileTree(std::span<const city::Tile> tiles);

/// Appends the tiles whose bounds may be seen, ascending; those with empty bounds never are. Returns the number of
/// boxes tested.
uint64_t cullTiles(const TileTree& tree, const BoxTest& test, std::vector<uint32_t>& drawn);

}  // namespace vicus::culling
