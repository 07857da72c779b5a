/// Frustum culling of a million boxes, and how long it takes to build their hierarchy.
///
/// The town: square blocks 80 m apart with streets of 12 m between them; twelve plots of 17 × 17 m along each block's
/// edge, 12 of 22 m deep; houses 8 to 22 m high, 8 % of the plots empty, 1.5 % with a tower of 30 to 60 m. A million
/// houses make 24 × 24 km. Sixty street views stand near the middle of the town 1.7 m above the ground and look along
/// the street, swinging by 40° to both sides; sixty flyover views circle at 120 m and look down by 25°. Field of view
/// 60°, 16:9, no far plane.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "city/city.hpp"
#include "city/random.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"
#include "plan/planner.hpp"

namespace vicus {
namespace {

constexpr double kBlock = 80;

struct Town {
  std::vector<city::Instance> houses;
  std::vector<city::Aabbf> types;
  double side = 0;  ///< metres
};

Town makeTown(uint32_t count) {
  Town town;
  const auto blocks = static_cast<uint32_t>(std::ceil(std::sqrt(count / (12 * 0.92))));
  town.side = blocks * kBlock;
  std::map<std::array<int, 3>, uint32_t> known;
  for (uint32_t block = 0; block < blocks * blocks; ++block)
    for (uint32_t plot = 0; plot < 16 && town.houses.size() < count; ++plot) {
      const uint32_t column = plot % 4, row = plot / 4;
      const bool inner = column % 3 != 0 && row % 3 != 0;
      city::Random random(city::hash32(block, plot));
      if (inner || random.uniform() < 0.08) continue;
      int height = static_cast<int>(random.uniform(8, 22));
      if (random.uniform() < 0.015) height = static_cast<int>(random.uniform(30, 60));

      // The back of a house reaches 5 m into the yard, away from the street in front of it.
      glm::dvec2 min(6 + 17 * column, 6 + 17 * row), max = min + 17.0;
      if (column == 0) max.x += 5;
      if (column == 3) min.x -= 5;
      if (column % 3 != 0) (row == 0 ? max.y += 5 : min.y -= 5);
      const glm::dvec2 size = max - min, corner(block % blocks * kBlock, block / blocks * kBlock);
      const auto [type, isNew] = known.try_emplace({static_cast<int>(size.x), static_cast<int>(size.y), height},
                                                   static_cast<uint32_t>(town.types.size()));
      if (isNew) {
        const glm::vec3 half(size / 2.0, 0);
        town.types.push_back({-half, half + glm::vec3(0, 0, height)});
      }
      city::Instance house;
      house.position = glm::dvec3(corner + (min + max) / 2.0, 0);
      house.geometry = type->second;
      town.houses.push_back(house);
    }
  return town;
}

city::ViewState viewAt(glm::dvec3 eye, double heading, double pitch) {
  return city::makeView({eye, heading, pitch, 0}, std::numbers::pi / 3, {1280, 720});
}

constexpr int kViews = 60;

std::vector<city::ViewState> streetViews(const Town& town) {
  std::vector<city::ViewState> views;
  const double middle = std::floor(town.side / kBlock / 2) * kBlock;
  for (int k = 0; k < kViews; ++k) {
    const double t = static_cast<double>(k) / kViews, swing = 0.7 * std::sin(25 * t);
    const bool north = k < kViews / 2;
    const double along = middle - 3 * kBlock + (north ? t : t - 0.5) * 12 * kBlock;
    views.push_back(north ? viewAt({middle, along, 1.7}, std::numbers::pi / 2 + swing, 0)
                          : viewAt({along, middle + kBlock, 1.7}, swing, 0));
  }
  return views;
}

std::vector<city::ViewState> flyoverViews(const Town& town) {
  std::vector<city::ViewState> views;
  for (int k = 0; k < kViews; ++k) {
    const double t = 2 * std::numbers::pi * k / kViews;
    const glm::dvec2 eye = town.side * (0.5 + 0.3 * glm::dvec2(std::cos(t), std::sin(t)));
    views.push_back(viewAt({eye, 120}, t + 1.9, -0.436));
  }
  return views;
}

city::TileGrid gridOf(const Town& town) {
  return city::tileGridFor({{0, 0, 0}, {town.side, town.side, 60}});
}

const Town& townOf(uint32_t count) {
  static std::map<uint32_t, Town> towns;
  const auto [it, isNew] = towns.try_emplace(count);
  if (isNew) it->second = makeTown(count);
  return it->second;
}

const city::InstanceSet& setOf(uint32_t count) {
  static std::map<uint32_t, city::InstanceSet> sets;
  const auto [it, isNew] = sets.try_emplace(count);
  const Town& town = townOf(count);
  if (isNew) it->second = city::buildInstanceSet(town.houses, town.types, gridOf(town));
  return it->second;
}

enum Path { Street, Flyover };

std::vector<city::ViewState> viewsOf(const Town& town, int64_t path) {
  return path == Street ? streetViews(town) : flyoverViews(town);
}

/// For each view and box: time and boxes tested. For each view: share of the boxes drawn, and in how many runs.
void report(benchmark::State& state, uint64_t tests, uint64_t drawn, uint64_t runs) {
  const auto passes = static_cast<double>(state.iterations()) * kViews;
  const auto boxes = static_cast<double>(state.range(0));
  state.counters["time_per_box"] =
      benchmark::Counter(passes * boxes, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["tests_per_box"] = static_cast<double>(tests) / passes / boxes;
  state.counters["drawn_share"] = static_cast<double>(drawn) / passes / boxes;
  state.counters["runs"] = static_cast<double>(runs) / passes;
}

void cullThroughHierarchy(benchmark::State& state) {
  const auto count = static_cast<uint32_t>(state.range(0));
  const city::InstanceSet& set = setOf(count);
  const std::vector<city::ViewState> views = viewsOf(townOf(count), state.range(1));
  city::SetPlan plan;
  uint64_t tests = 0, drawn = 0, runs = 0;
  for (auto _ : state)
    for (const city::ViewState& view : views) {
      tests += culling::cullInstances(set, culling::boxTestFor(culling::frustumOf(view), set.nodes[0].bounds), plan);
      drawn += plan.drawnCount, runs += plan.drawn.size();
      benchmark::DoNotOptimize(plan.drawn.data());
    }
  report(state, tests, drawn, runs);
}

void testEveryBox(benchmark::State& state) {
  const auto count = static_cast<uint32_t>(state.range(0));
  const city::InstanceSet& set = setOf(count);
  const std::vector<city::ViewState> views = viewsOf(townOf(count), state.range(1));
  uint64_t drawn = 0;
  for (auto _ : state)
    for (const city::ViewState& view : views) {
      const culling::BoxTest test = culling::boxTestFor(culling::frustumOf(view), set.nodes[0].bounds);
      for (const city::Aabbf& box : set.bounds) {
        uint32_t mask = test.allPlanes;
        drawn += culling::classify(test, box, mask) != culling::Containment::Outside;
      }
    }
  report(state, static_cast<uint64_t>(state.iterations()) * kViews * set.size(), drawn, 0);
}

void buildHierarchy(benchmark::State& state) {
  const auto count = static_cast<uint32_t>(state.range(0));
  const Town& town = townOf(count);
  const city::TileGrid grid = gridOf(town);
  double bytes = 0;
  for (auto _ : state) {
    const city::InstanceSet set = city::buildInstanceSet(town.houses, town.types, grid);
    bytes = static_cast<double>(set.instances.size() * sizeof(city::Instance) +
                                set.bounds.size() * sizeof(city::Aabbf) + set.nodes.size() * sizeof(city::BoundsNode));
    benchmark::DoNotOptimize(set.nodes.data());
  }
  state.counters["bytes_per_instance"] = bytes / count;
}

BENCHMARK(cullThroughHierarchy)
    ->ArgNames({"boxes", "flyover"})
    ->ArgsProduct({{10'000, 100'000, 1'000'000}, {Street, Flyover}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(testEveryBox)
    ->ArgNames({"boxes", "flyover"})
    ->ArgsProduct({{1'000'000}, {Street, Flyover}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(buildHierarchy)->ArgName("boxes")->Arg(1'000'000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace vicus
