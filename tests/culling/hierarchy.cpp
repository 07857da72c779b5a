#include "culling/hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <vector>

#include "city/city.hpp"
#include "city/random.hpp"
#include "culling/exact_visibility.hpp"

namespace vicus::culling {
namespace {

constexpr double kPi = std::numbers::pi;

city::InstanceSet randomTown(uint32_t count, double side) {
  city::Random random(1);
  std::vector<city::Aabbf> types;
  for (int i = 0; i < 10; ++i) types.push_back({{-5, -4 - i, 0}, {5, 4 + i, 8 + i}});
  std::vector<city::Instance> houses(count);
  for (city::Instance& house : houses) {
    house.position = {random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2), random.uniform(0, 9)};
    house.heading = static_cast<float>(random.uniform(0, 2 * kPi));
    house.geometry = random.below(10);
  }
  return city::buildInstanceSet(std::move(houses), types,
                                city::tileGridFor({{-side / 2, -side / 2, 0}, {side / 2, side / 2, 30}}));
}

city::ViewState randomView(city::Random& random, double side) {
  const double height = random.uniform() < 0.5 ? 1.7 : random.uniform(0, 500);
  const double pitch = random.uniform() < 0.5 ? random.uniform(-0.2, 0.2) : random.uniform(-kPi / 2, kPi / 2);
  return city::makeView({{random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2), height},
                         random.uniform(0, 2 * kPi),
                         pitch,
                         random.uniform(-0.3, 0.3)},
                        random.uniform(0.05, 2.5), {1280, 720});
}

/// Checks that the runs are what SetPlan promises and hands out which instances are drawn.
std::vector<bool> flagsOf(const city::SetPlan& plan, size_t size) {
  std::vector<int> seen(size, 0);
  std::vector<bool> drawn(size, false);
  uint64_t count = 0;
  for (size_t k = 0; k < plan.drawn.size(); ++k) {
    EXPECT_GT(plan.drawn[k].count, 0u);
    if (k > 0) {
      EXPECT_GT(plan.drawn[k].first, plan.drawn[k - 1].end()) << "runs touch, overlap or are out of order";
    }
    for (uint32_t i = plan.drawn[k].first; i < plan.drawn[k].end(); ++i) ++seen[i], drawn[i] = true, ++count;
  }
  for (size_t k = 0; k < plan.dropped.size(); ++k) {
    EXPECT_EQ(plan.dropped[k].reason, city::DropReason::Frustum);
    if (k > 0) {
      EXPECT_GT(plan.dropped[k].range.first, plan.dropped[k - 1].range.end());
    }
    for (uint32_t i = plan.dropped[k].range.first; i < plan.dropped[k].range.end(); ++i) ++seen[i];
  }
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  EXPECT_EQ(plan.drawnCount, count);
  EXPECT_EQ(plan.inFrustumCount, count);
  return drawn;
}

TEST(CullInstances, nothingThatIsVisibleIsCulledIn1000ViewsOf100000Boxes) {
  constexpr double kSide = 6000;
  const city::InstanceSet town = randomTown(100'000, kSide);
  city::Random random(2);
  city::SetPlan plan;
  uint64_t wronglyCulled = 0, drawn = 0, tests = 0;
  for (int k = 0; k < 1000; ++k) {
    const city::ViewState view = randomView(random, kSide);
    const glm::dmat4 rows = glm::transpose(city::clipFromEyeRelative(view));
    tests += cullInstances(town, boxTestFor(frustumOf(view), town.nodes[0].bounds), plan);
    drawn += plan.drawnCount;
    // What was culled must lie beyond one of the inequalities of clip space with all its corners. Each is linear, so
    // its largest value over the box is at the corner that its signs choose.
    const glm::dvec4 inequalities[] = {rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                                       rows[3] - rows[2]};
    for (const city::DroppedRange& run : plan.dropped)
      for (uint32_t i = run.range.first; i < run.range.end(); ++i) {
        const glm::dvec3 lo = glm::dvec3(town.bounds[i].min) - view.eye, hi = glm::dvec3(town.bounds[i].max) - view.eye;
        bool beyond = false;
        for (const glm::dvec4& a : inequalities) {
          const double largest = std::max(a.x * lo.x, a.x * hi.x) + std::max(a.y * lo.y, a.y * hi.y) +
                                 std::max(a.z * lo.z, a.z * hi.z) + a.w;
          if (largest < 0) {
            beyond = true;
            break;
          }
        }
        wronglyCulled += !beyond;
      }
  }
  EXPECT_EQ(wronglyCulled, 0u);
  EXPECT_GT(drawn, 0u);
  EXPECT_LT(static_cast<double>(drawn), 0.5 * 1000 * 100'000) << "it culls";
  EXPECT_LT(static_cast<double>(tests), 0.035 * 1000 * 100'000) << "box tests for each box";
}

TEST(CullInstances, isExactlyWhatTestingEveryBoxGives) {
  const city::InstanceSet town = randomTown(5000, 1000);
  city::Random random(3);
  city::SetPlan plan;
  for (int k = 0; k < 100; ++k) {
    const BoxTest test = boxTestFor(frustumOf(randomView(random, 1000)), town.nodes[0].bounds);
    cullInstances(town, test, plan);
    const std::vector<bool> drawn = flagsOf(plan, town.size());
    for (size_t i = 0; i < town.size(); ++i) {
      uint32_t mask = test.allPlanes;
      ASSERT_EQ(drawn[i], classify(test, town.bounds[i], mask) != Containment::Outside) << "instance " << i;
    }
  }
}

TEST(CullInstances, drawsHardlyMoreThanIsVisible) {
  const city::InstanceSet town = randomTown(3000, 2000);
  city::Random random(4);
  city::SetPlan plan;
  uint64_t drawn = 0, visible = 0;
  for (int k = 0; k < 50; ++k) {
    const city::ViewState view = city::makeView(
        {{random.uniform(-1000, 1000), random.uniform(-1000, 1000), 1.7}, random.uniform(0, 7), 0, 0}, 1, {1280, 720});
    cullInstances(town, boxTestFor(frustumOf(view), town.nodes[0].bounds), plan);
    drawn += plan.drawnCount;
    for (const city::Aabbf& box : town.bounds)
      visible += isSurfaceInClipSpace(city::clipFromEyeRelative(view), view.eye, box);
  }
  EXPECT_GE(drawn, visible);
  EXPECT_LE(static_cast<double>(drawn), 1.01 * static_cast<double>(visible));
}

TEST(CullInstances, aSetWithoutInstancesGivesNothing) {
  city::SetPlan plan;
  plan.drawn = {{1, 2}};
  plan.drawnCount = 2;
  EXPECT_EQ(cullInstances({}, boxTestFor(frustumOf({}), {}), plan), 0u);
  EXPECT_TRUE(plan.drawn.empty());
  EXPECT_TRUE(plan.dropped.empty());
  EXPECT_EQ(plan.drawnCount, 0u);
}

TEST(CullInstances, aFrustumWithoutPlanesDrawsAllInOneRun) {
  const city::InstanceSet town = randomTown(1000, 1000);
  city::SetPlan plan;
  EXPECT_EQ(cullInstances(town, boxTestFor(frustumFromClip(glm::dmat4(0), {0, 0, 0}), town.nodes[0].bounds), plan), 1u);
  EXPECT_EQ(plan.drawn, (std::vector<city::Range>{{0, 1000}}));
  EXPECT_TRUE(plan.dropped.empty());
}

TEST(CullInstances, thousandsAtOnePlaceAreOneLeaf) {
  std::vector<city::Instance> houses(1000);
  const city::Aabbf type{{-1, -1, 0}, {1, 1, 1}};
  const city::InstanceSet pile = city::buildInstanceSet(houses, {&type, 1}, city::TileGrid{});
  EXPECT_EQ(pile.nodes.size(), 1u);
  // The eye looks along the boxes' common edge, so that they cross the frustum and each is tested.
  const city::ViewState view = city::makeView({{-1, -10, 0.5}, kPi / 2, 0, 0}, 0.01, {100, 100});
  city::SetPlan plan;
  EXPECT_EQ(cullInstances(pile, boxTestFor(frustumOf(view), pile.nodes[0].bounds), plan), 1001u);
  EXPECT_EQ(plan.drawn, (std::vector<city::Range>{{0, 1000}}));
}

std::vector<city::Tile> randomTiles(uint32_t side, double share, city::Random& random) {
  std::vector<city::Tile> tiles(side * side);
  for (uint32_t row = 0; row < side; ++row)
    for (uint32_t column = 0; column < side; ++column)
      if (random.uniform() < share)
        tiles[city::mortonIndex(column, row)].bounds = {glm::vec3(column * 100, row * 100, 0),
                                                        glm::vec3(column * 100 + 110, row * 100 + 110, 20)};
  return tiles;
}

TEST(CullTiles, isExactlyWhatTestingEveryTileGives) {
  city::Random random(5);
  for (const uint32_t side : {1u, 2u, 16u, 32u})
    for (const double share : {0.0, 0.1, 0.9, 1.0}) {
      const std::vector<city::Tile> tiles = randomTiles(side, share, random);
      const TileTree tree = buildTileTree(tiles);
      city::Aabbf reach;
      for (const city::Tile& tile : tiles) reach.extend(tile.bounds);
      for (int k = 0; k < 20; ++k) {
        const city::ViewState view =
            city::makeView({{random.uniform(0, side * 100.0), random.uniform(0, side * 100.0), random.uniform(1, 200)},
                            random.uniform(0, 7),
                            random.uniform(-1.5, 0.5),
                            0},
                           1, {1280, 720});
        const BoxTest test = boxTestFor(frustumOf(view), reach);
        std::vector<uint32_t> drawn, expected;
        const uint64_t tests = cullTiles(tree, test, drawn);
        for (uint32_t t = 0; t < tiles.size(); ++t) {
          uint32_t mask = test.allPlanes;
          if (classify(test, tiles[t].bounds, mask) != Containment::Outside) expected.push_back(t);
        }
        ASSERT_EQ(drawn, expected) << side << " tiles to a side, share " << share;
        EXPECT_LE(tests, tree.bounds.size());
      }
    }
}

TEST(CullTiles, noTilesGiveNothing) {
  std::vector<uint32_t> drawn;
  EXPECT_EQ(cullTiles(buildTileTree({}), boxTestFor(frustumOf({}), {}), drawn), 0u);
  EXPECT_TRUE(drawn.empty());
}

}  // namespace
}  // namespace vicus::culling
