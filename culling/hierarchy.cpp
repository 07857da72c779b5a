#include "culling/hierarchy.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "culling/box_distance.hpp"

namespace vicus::culling {
namespace {

using city::BoundsNode;
using city::Range;

/// Collects runs that arrive in ascending order.
class RunCollector {
 public:
  explicit RunCollector(city::SetPlan& out) : out_(out) {
    out_.drawn.clear();
    out_.dropped.clear();
  }

  void draw(Range run) {
    if (!out_.drawn.empty() && out_.drawn.back().end() == run.first)
      out_.drawn.back().count += run.count;
    else
      out_.drawn.push_back(run);
    drawnCount_ += run.count;
  }

  void drop(Range run) {
    if (!out_.dropped.empty() && out_.dropped.back().range.end() == run.first)
      out_.dropped.back().range.count += run.count;
    else
      out_.dropped.push_back({run, city::DropReason::Frustum});
  }

  void finish() { out_.drawnCount = out_.inFrustumCount = drawnCount_; }

 private:
  city::SetPlan& out_;
  uint64_t drawnCount_ = 0;
};

/// Instances that are tested in one go: one bit each.
constexpr uint32_t kChunk = 64;

class InstanceCuller {
 public:
  InstanceCuller(const city::InstanceSet& set, const BoxTest& test, city::SetPlan& out)
      : set_(set), test_(test), runs_(out) {}

  uint64_t run() {
    if (!set_.nodes.empty()) visit(set_.nodes[0], test_.allPlanes);
    runs_.finish();
    return tests_;
  }

 private:
  void visit(const BoundsNode& node, uint32_t mask) {
    ++tests_;
    switch (classifyOrdered(test_, node.bounds, mask)) {
      case Containment::Outside:
        runs_.drop(node.instances);
        return;
      case Containment::Inside:
        runs_.draw(node.instances);
        return;
      case Containment::Crossing:
        break;
    }
    if (node.childCount == 0) return testEach(node.instances, mask);
    for (uint32_t child = node.firstChild; child < node.firstChild + node.childCount; ++child)
      visit(set_.nodes[child], mask);
  }

  /// Tests the instances of a leaf and hands them on in runs. Without branches on the outcome of a test: at the
  /// frustum's edge it is a coin's toss, and a wrongly predicted branch costs more than the test.
  void testEach(Range run, uint32_t mask) {
    tests_ += run.count;
    for (uint32_t first = run.first; first < run.end(); first += kChunk) {
      const uint32_t count = std::min(kChunk, run.end() - first);
      const uint64_t outside = outsideBits(first, count, mask);
      for (uint32_t i = 0; i < count;) {
        const bool dropped = (outside >> i & 1) != 0;
        const uint64_t differing = (dropped ? ~outside : outside) >> i;
        const uint32_t length = std::min(static_cast<uint32_t>(std::countr_zero(differing)), count - i);
        emit({first + i, length}, dropped);
        i += length;
      }
    }
  }

  /// Bit i is set where instance first + i is outside one of the planes in `mask`. `count` is at most kChunk.
  uint64_t outsideBits(uint32_t first, uint32_t count, uint32_t mask) const {
    uint64_t outside = 0;
    for (uint32_t rest = mask; rest != 0; rest &= rest - 1) {
      const BoxTest::Plane plane = test_.planes[static_cast<size_t>(std::countr_zero(rest))];
      for (uint32_t i = 0; i < count; ++i) {
        const bool beyond = cornerDistance(test_, plane, set_.bounds[first + i], plane.farthest) < 0;
        outside |= static_cast<uint64_t>(beyond) << i;
      }
    }
    return outside;
  }

  void emit(Range run, bool outside) { outside ? runs_.drop(run) : runs_.draw(run); }

  const city::InstanceSet& set_;
  const BoxTest& test_;
  RunCollector runs_;
  uint64_t tests_ = 0;
};

struct TileCuller {
  const TileTree& tree;
  const BoxTest& test;
  std::vector<uint32_t>& drawn;
  uint64_t tests = 0;

  void visit(uint32_t node, uint32_t mask) {
    const city::Aabbf& box = tree.bounds[node];
    if (box.empty()) return;
    if (mask != 0) {
      ++tests;
      if (classify(test, box, mask) == Containment::Outside) return;
    }
    if (node >= tree.firstLeaf) return drawn.push_back(node - tree.firstLeaf);
    for (uint32_t quadrant = 0; quadrant < 4; ++quadrant) visit(4 * node + 1 + quadrant, mask);
  }
};

}  // namespace

uint64_t cullInstances(const city::InstanceSet& set, const BoxTest& test, city::SetPlan& out) {
  return InstanceCuller(set, test, out).run();
}

TileTree buildTileTree(std::span<const city::Tile> tiles) {
  TileTree tree;
  if (tiles.empty()) return tree;
  assert(std::has_single_bit(tiles.size()) && std::countr_zero(tiles.size()) % 2 == 0 && "tiles are not a power of 4");
  const size_t firstLeaf = (tiles.size() - 1) / 3;
  tree.firstLeaf = static_cast<uint32_t>(firstLeaf);
  tree.bounds.resize(firstLeaf);
  for (const city::Tile& tile : tiles) tree.bounds.push_back(tile.bounds);
  for (size_t node = firstLeaf; node-- > 0;)
    for (size_t quadrant = 0; quadrant < 4; ++quadrant) tree.bounds[node].extend(tree.bounds[4 * node + 1 + quadrant]);
  return tree;
}

uint64_t cullTiles(const TileTree& tree, const BoxTest& test, std::vector<uint32_t>& drawn) {
  TileCuller culler{tree, test, drawn};
  if (!tree.bounds.empty()) culler.visit(0, test.allPlanes);
  return culler.tests;
}

}  // namespace vicus::culling
