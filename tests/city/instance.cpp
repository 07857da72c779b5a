#include "city/instance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "city/random.hpp"

namespace vicus::city {
namespace {

const std::vector<Aabbf> kTypes = {{{-5, -4, 0}, {5, 4, 8}}, {{-1, -1, 0}, {30, 2, 40}}};

std::vector<Instance> randomInstances(uint32_t count, double side, uint32_t seed = 1) {
  Random random(seed);
  std::vector<Instance> list(count);
  for (uint32_t i = 0; i < count; ++i) {
    list[i].position = {random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2), random.uniform(0, 9)};
    list[i].heading = static_cast<float>(random.uniform(0, 6.28));
    list[i].geometry = random.below(2);
    list[i].seed = i;
  }
  return list;
}

TileGrid gridOf(double side) {
  return tileGridFor({{-side / 2, -side / 2, 0}, {side / 2, side / 2, 50}});
}

bool contains(const Aabbf& outer, const Aabbf& inner) {
  return outer.contains(inner.min) && outer.contains(inner.max);
}

TEST(MortonIndex, interleavesColumnAndRow) {
  EXPECT_EQ(mortonIndex(0, 0), 0u);
  EXPECT_EQ(mortonIndex(1, 0), 1u);
  EXPECT_EQ(mortonIndex(0, 1), 2u);
  EXPECT_EQ(mortonIndex(3, 5), 0b100111u);
  EXPECT_EQ(mortonIndex(0xffff, 0xffff), 0xffffffffU);
}

TEST(TileGrid, cellsAndTilesAreInverse) {
  for (const double side : {500.0, 5000.0}) {
    const TileGrid grid = gridOf(side);
    for (uint32_t t = 0; t < grid.tileCount(); ++t) {
      const glm::uvec2 cell = grid.cell(t);
      EXPECT_EQ(mortonIndex(cell.x, cell.y), t);
      EXPECT_EQ(grid.tileAt(grid.centre(t).x, grid.centre(t).y), t);
    }
  }
}

TEST(TileGrid, has16TilesToASideUpTo2048MetresAnd32Beyond) {
  EXPECT_EQ(gridOf(100).size, 16u);
  EXPECT_EQ(gridOf(2048).size, 16u);
  EXPECT_EQ(gridOf(2049).size, 32u);
  EXPECT_EQ(gridOf(100e3).size, 32u);
  EXPECT_EQ(gridOf(1).tileSize, 8) << "tiles are at least 8 m";
  EXPECT_EQ(tileGridFor({}).size, 16u);
}

TEST(TileGrid, coversItsExtentAlsoWhereThatIsFarFromTheOrigin) {
  for (const double place : {0.0, 1e6, 1e7})
    for (const double side : {0.0, 1.0, 2048.0, 100e3}) {
      const Aabb extent{{place, -place, 0}, {place + side, side / 3 - place, 10}};
      const TileGrid grid = tileGridFor(extent);
      const double end = grid.tileSize * grid.size;
      EXPECT_LE(grid.origin.x, extent.min.x);
      EXPECT_LE(grid.origin.y, extent.min.y);
      EXPECT_GE(grid.origin.x + end, extent.max.x);
      EXPECT_GE(grid.origin.y + end, extent.max.y);
    }
}

TEST(TileGrid, positionsOutsideGoToTheNearestTile) {
  const TileGrid grid = gridOf(1000);
  EXPECT_EQ(grid.tileAt(-1e9, -1e9), 0u);
  EXPECT_EQ(grid.tileAt(1e9, 1e9), grid.tileCount() - 1);
  EXPECT_EQ(grid.tileAt(1e300, 0), grid.tileAt(499, 0));
  EXPECT_EQ(grid.tileAt(std::nan(""), std::nan("")), 0u);
}

TEST(InstanceBounds, holdEveryCornerOfTheTurnedGeometry) {
  Random random(2);
  for (const double place : {0.0, 1e4, 1e6})
    for (int k = 0; k < 1000; ++k) {
      Instance instance;
      instance.position = {place + random.uniform(0, 1), -place, random.uniform(-10, 10)};
      instance.heading = static_cast<float>(random.uniform(-10, 10));
      const Aabbf& local = kTypes[1];
      const Aabbf box = instanceBounds(instance, local);
      const double c = std::cos(static_cast<double>(instance.heading)),
                   s = std::sin(static_cast<double>(instance.heading));
      for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? local.max.x : local.min.x, corner & 2 ? local.max.y : local.min.y,
                           corner & 4 ? local.max.z : local.min.z);
        const glm::dvec3 world = instance.position + glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        for (glm::length_t axis = 0; axis < 3; ++axis) {
          ASSERT_LE(static_cast<double>(box.min[axis]), world[axis]);
          ASSERT_GE(static_cast<double>(box.max[axis]), world[axis]);
        }
      }
      // And they are no larger than they must be: the rotated box's own, a float's spacing wider.
      const double spacing = std::max(place, 64.0) * 0x1p-22;
      EXPECT_LE(static_cast<double>(box.size().z), 40 + 1e-3 + 2 * spacing);
    }
}

TEST(InstanceBounds, ofEmptyGeometryAreThePosition) {
  Instance instance;
  instance.position = {1, 2, 3};
  EXPECT_EQ(instanceBounds(instance, {}), (Aabbf{{1, 2, 3}, {1, 2, 3}}));
}

TEST(InstanceSet, isAPermutationOfItsInputInMortonOrder) {
  const std::vector<Instance> input = randomInstances(5000, 1000);
  const TileGrid grid = gridOf(1000);
  const InstanceSet set = buildInstanceSet(input, kTypes, grid);
  ASSERT_EQ(set.size(), input.size());
  std::vector<bool> seen(input.size(), false);
  uint32_t tile = 0;
  for (size_t i = 0; i < set.size(); ++i) {
    const Instance& instance = set.instances[i];
    EXPECT_FALSE(seen[instance.seed]);
    seen[instance.seed] = true;
    EXPECT_EQ(instance.position, input[instance.seed].position);
    EXPECT_EQ(set.bounds[i], instanceBounds(instance, kTypes[instance.geometry]));
    EXPECT_GE(grid.tileAt(instance.position.x, instance.position.y), tile) << "tiles are in ascending order";
    tile = grid.tileAt(instance.position.x, instance.position.y);
  }
}

TEST(InstanceSet, dependsOnNothingButItsInput) {
  const std::vector<Instance> input = randomInstances(2000, 1000);
  const InstanceSet a = buildInstanceSet(input, kTypes, gridOf(1000)),
                    b = buildInstanceSet(input, kTypes, gridOf(1000));
  for (size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a.instances[i].seed, b.instances[i].seed);
}

TEST(InstanceSet, instancesAtOnePlaceKeepTheirOrder) {
  std::vector<Instance> input(100);
  for (uint32_t i = 0; i < 100; ++i) input[i].seed = i;
  const InstanceSet set = buildInstanceSet(input, kTypes, gridOf(1000));
  for (uint32_t i = 0; i < 100; ++i) EXPECT_EQ(set.instances[i].seed, i);
  EXPECT_EQ(set.nodes.size(), 1u) << "they cannot be told apart, so they are one leaf";
}

/// Every promise of BoundsNode and InstanceSet::nodes.
void expectHierarchy(const InstanceSet& set, uint32_t leafSize) {
  ASSERT_FALSE(set.nodes.empty());
  EXPECT_EQ(set.nodes[0].instances, (Range{0, static_cast<uint32_t>(set.size())}));
  size_t children = 0;
  for (const BoundsNode& node : set.nodes) {
    for (uint32_t i = node.instances.first; i < node.instances.end(); ++i)
      ASSERT_TRUE(contains(node.bounds, set.bounds[i]));
    if (node.childCount == 0) {
      EXPECT_LE(node.instances.count, leafSize);
      continue;
    }
    ASSERT_GE(node.childCount, 2u);
    ASSERT_LE(node.childCount, 4u);
    uint32_t from = node.instances.first;
    for (uint32_t c = node.firstChild; c < node.firstChild + node.childCount; ++c) {
      EXPECT_TRUE(contains(node.bounds, set.nodes[c].bounds));
      EXPECT_EQ(set.nodes[c].instances.first, from);
      EXPECT_GT(set.nodes[c].instances.count, 0u);
      from = set.nodes[c].instances.end();
    }
    EXPECT_EQ(from, node.instances.end());
    children += node.childCount;
  }
  EXPECT_EQ(children + 1, set.nodes.size()) << "every node but the root is one node's child";
}

TEST(InstanceSet, nodesContainTheirChildrenAndInstances) {
  for (const double side : {10.0, 1000.0, 100e3})
    for (const uint32_t leafSize : {1u, 16u, 100u})
      expectHierarchy(buildInstanceSet(randomInstances(3000, side), kTypes, gridOf(side), leafSize), leafSize);
}

TEST(InstanceSet, leavesOutWhatHasNoPlaceOrShape) {
  std::vector<Instance> input = randomInstances(10, 100);
  input[1].position.x = std::nan("");
  input[3].position.z = INFINITY;
  input[5].heading = std::nanf("");
  input[7].geometry = 2;
  size_t dropped = 0;
  const InstanceSet set = buildInstanceSet(input, kTypes, gridOf(100), 16, &dropped);
  EXPECT_EQ(dropped, 4u);
  EXPECT_EQ(set.size(), 6u);
  for (const Instance& i : set.instances) EXPECT_TRUE(i.seed != 1 && i.seed != 3 && i.seed != 5 && i.seed != 7);
}

TEST(InstanceSet, ofNothingIsEmpty) {
  const InstanceSet set = buildInstanceSet({}, kTypes, gridOf(100));
  EXPECT_TRUE(set.empty());
  EXPECT_TRUE(set.nodes.empty());
  for (const Range& run : tileRuns(set, gridOf(100))) EXPECT_EQ(run.count, 0u);
}

TEST(InstanceSet, ofOneHasOneNode) {
  const InstanceSet set = buildInstanceSet(randomInstances(1, 100), kTypes, gridOf(100));
  expectHierarchy(set, 16);
  EXPECT_EQ(set.nodes.size(), 1u);
}

TEST(TileRuns, everyInstanceIsInItsOwnTilesRunAndNoOther) {
  for (const double side : {800.0, 5000.0, 100e3}) {
    const TileGrid grid = gridOf(side);
    const InstanceSet set = buildInstanceSet(randomInstances(5000, side * 1.1), kTypes, grid);  // some stand outside
    const std::vector<Range> runs = tileRuns(set, grid);
    ASSERT_EQ(runs.size(), grid.tileCount());
    std::vector<int> seen(set.size(), 0);
    for (uint32_t t = 0; t < runs.size(); ++t)
      for (uint32_t i = runs[t].first; i < runs[t].end(); ++i) {
        ++seen[i];
        EXPECT_EQ(grid.tileAt(set.instances[i].position.x, set.instances[i].position.y), t);
      }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  }
}

TEST(InstanceSet, aMillionInstancesFitIn200Megabytes) {
  constexpr uint32_t kMillion = 1'000'000;
  const TileGrid grid = gridOf(24e3);
  const InstanceSet set = buildInstanceSet(randomInstances(kMillion, 24e3), kTypes, grid);
  ASSERT_EQ(set.size(), kMillion);
  const size_t bytes = set.instances.capacity() * sizeof(Instance) + set.bounds.capacity() * sizeof(Aabbf) +
                       set.nodes.capacity() * sizeof(BoundsNode);
  EXPECT_LE(bytes, 200'000'000u);
  RecordProperty("bytes", static_cast<int>(bytes));
}

}  // namespace
}  // namespace vicus::city
