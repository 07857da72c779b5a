/// The cull map on the town of boxes of tests/culling/box_city.hpp: sixty street views, and sixty flights over it.
/// For instructions a view: valgrind --tool=callgrind --toggle-collect='*cullHidden*' with --benchmark_filter.
#include "culling/cull_map.hpp"

#include <benchmark/benchmark.h>

#include <map>

#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"
#include "tests/culling/box_city.hpp"

namespace vicus {
namespace {

const test::BoxCity& townOf(uint32_t count) {
  static std::map<uint32_t, test::BoxCity> towns;
  const auto [it, isNew] = towns.try_emplace(count);
  if (isNew) it->second = test::makeBoxCity(count);
  return it->second;
}

/// Frustum, then cull map.
culling::CullMapStats cullHidden(const test::BoxCity& town, const culling::Occluders& occluders, uint32_t columns,
                                 city::FramePlan& plan) {
  const city::InstanceSet& set = town.city.buildings;
  culling::cullInstances(set, culling::boxTestFor(culling::frustumOf(plan.view), set.nodes[0].bounds), plan.buildings);
  return culling::cullOccluded(town.city, occluders, {.columns = columns}, plan);
}

void cullMap(benchmark::State& state) {
  const test::BoxCity& town = townOf(static_cast<uint32_t>(state.range(0)));
  const auto columns = static_cast<uint32_t>(state.range(1));
  const bool flyover = state.range(2) != 0;
  const culling::Occluders occluders = culling::occludersOf(town.city);
  const glm::ivec2 size(3840, 2160);
  const std::vector<city::ViewState> views = flyover ? test::flyoverViews(town, size) : test::streetViews(town, size);
  uint64_t tests = 0, drawn = 0, inFrustum = 0;
  for (auto _ : state)
    for (const city::ViewState& view : views) {
      city::FramePlan plan;
      plan.view = view;
      tests += cullHidden(town, occluders, columns, plan).boxTests;
      drawn += plan.buildings.drawnCount, inFrustum += plan.buildings.inFrustumCount;
    }
  const double passes = static_cast<double>(state.iterations()) * static_cast<double>(views.size());
  state.counters["time_per_view"] =
      benchmark::Counter(passes, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["tests"] = static_cast<double>(tests) / passes;
  state.counters["in_frustum"] = static_cast<double>(inFrustum) / passes;
  state.counters["drawn"] = static_cast<double>(drawn) / passes;
}

/// The truth: an item buffer of 3840 × 2160 for each street view. Takes minutes.
void againstItemBuffer(benchmark::State& state) {
  const test::BoxCity& town = townOf(static_cast<uint32_t>(state.range(0)));
  const culling::Occluders occluders = culling::occludersOf(town.city);
  uint64_t visible = 0, drawn = 0, lost = 0, views = 0;
  for (auto _ : state)
    for (const city::ViewState& view : test::streetViews(town, {3840, 2160})) {
      city::FramePlan plan;
      plan.view = view;
      cullHidden(town, occluders, 8192, plan);
      const std::vector<bool> truth = test::visibleBoxes(town.city, view);
      std::vector<bool> kept(truth.size(), false);
      for (const city::Range& run : plan.buildings.drawn)
        for (uint32_t i = run.first; i < run.end(); ++i) kept[i] = true;
      for (size_t i = 0; i < truth.size(); ++i) visible += truth[i], lost += truth[i] && !kept[i];
      drawn += plan.buildings.drawnCount, ++views;
    }
  state.counters["visible"] = static_cast<double>(visible) / static_cast<double>(views);
  state.counters["drawn_over_visible"] = static_cast<double>(drawn) / static_cast<double>(visible);
  state.counters["wrongly_culled"] = static_cast<double>(lost);
}

BENCHMARK(cullMap)
    ->ArgNames({"boxes", "columns", "flyover"})
    ->ArgsProduct({{10'000, 100'000}, {256, 1024, 8192, 32768}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(againstItemBuffer)->ArgName("boxes")->Arg(10'000)->Arg(100'000)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace vicus
