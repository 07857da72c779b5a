/// ROAM over the hills of tests/terrain/fields.hpp, 4 096 m × 4 096 m at 257² to 4 097² samples: exact errors, the mesh
/// from scratch and from frame to frame.
///
/// The view is 1 280 × 720 at 60°. The wanted error is chosen for each field so that the first mesh has about 20 000
/// triangles. A walker goes 1.4 m/s at 1.7 m above the ground, a flyer 50 m/s at 120 m, both at 60 frames a second,
/// turning slowly. `scratch/frame` is how many times longer a mesh from scratch takes than a frame; both are timed in
/// turn in one run, each with the processor time of its own thread, so that a busy machine troubles neither.
#include <benchmark/benchmark.h>

#include <cmath>
#include <ctime>
#include <map>
#include <numbers>

#include "terrain/error_table.hpp"
#include "terrain/roam.hpp"
#include "tests/terrain/fields.hpp"

namespace vicus::terrain {
namespace {

struct Ground {
  city::HeightField field;
  ErrorTable errors;
};

const Ground& hills(int samples) {
  static std::map<int, Ground> known;
  const auto [at, isNew] = known.try_emplace(samples);
  if (isNew) {
    at->second.field = makeLandscape(samples, Landscape::Hills);
    at->second.errors = buildErrorTable(at->second.field);
  }
  return at->second;
}

struct Traveller {
  glm::dvec2 place{1200, 1500};
  double heading = 0.3;
  double speed = 1.4;  ///< m/s
  double above = 1.7;  ///< metres

  city::ViewState view(const city::HeightField& field) const {
    const double ground = field.heightAt(place.x, place.y).value_or(0);
    return city::makeView({{place, ground + above}, heading, above > 10 ? -0.2 : 0, 0}, std::numbers::pi / 3,
                          {1280, 720});
  }
  /// One sixtieth of a second later.
  void step() {
    heading += 0.05 / 60;
    place += speed / 60 * glm::dvec2(std::cos(heading), std::sin(heading));
    if (glm::any(glm::lessThan(place, glm::dvec2(200))) || glm::any(glm::greaterThan(place, glm::dvec2(3896))))
      heading = std::atan2(2048 - place.y, 2048 - place.x);
  }
};
Traveller walker() {
  return {};
}
Traveller flyer() {
  return {.speed = 50, .above = 120};
}

/// The wanted error at which a first mesh has about 20 000 triangles.
RoamSettings settingsFor(const Ground& ground, const city::ViewState& view) {
  RoamSettings settings;
  settings.budget = 100'000'000;
  double low = 0.01, high = 20;
  for (int i = 0; i < 20; ++i) {
    settings.pixelError = std::sqrt(low * high);
    Roam roam(ground.field, ground.errors);
    (roam.update(view, settings).triangleCount > 20'000 ? low : high) = settings.pixelError;
  }
  return settings;
}

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void exactErrors(benchmark::State& state) {
  const city::HeightField field = makeLandscape(static_cast<int>(state.range(0)), Landscape::Hills);
  size_t bytes = 0;
  for (auto _ : state) {
    const ErrorTable table = buildErrorTable(field, {}, static_cast<unsigned>(state.range(1)));
    bytes = table.bytes();
    benchmark::DoNotOptimize(table);
  }
  state.counters["MB"] = static_cast<double>(bytes) * 1e-6;
}
BENCHMARK(exactErrors)->Args({1025, 1})->Args({1025, 2})->Args({4097, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

void fromScratch(benchmark::State& state) {
  const Ground& ground = hills(static_cast<int>(state.range(0)));
  const city::ViewState view = walker().view(ground.field);
  const RoamSettings settings = settingsFor(ground, view);
  RoamFrame frame;
  for (auto _ : state) {
    Roam roam(ground.field, ground.errors);
    frame = roam.update(view, settings);
  }
  state.counters["triangles"] = frame.triangleCount;
  state.counters["s/split"] = benchmark::Counter(
      frame.operations.splits, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(fromScratch)
    ->RangeMultiplier(2)
    ->Arg(257)
    ->Arg(513)
    ->Arg(1025)
    ->Arg(2049)
    ->Arg(4097)
    ->Unit(benchmark::kMillisecond);

void frames(benchmark::State& state, Traveller traveller) {
  const Ground& ground = hills(static_cast<int>(state.range(0)));
  const RoamSettings settings = settingsFor(ground, traveller.view(ground.field));
  Roam roam(ground.field, ground.errors);
  roam.update(traveller.view(ground.field), settings);
  uint64_t count = 0, operations = 0, triangles = 0, writes = 0, scratches = 0;
  double frameSeconds = 0, scratchSeconds = 0;
  for (auto _ : state) {
    traveller.step();
    const city::ViewState view = traveller.view(ground.field);
    const double begin = threadSeconds();
    const RoamFrame frame = roam.update(view, settings);
    const double seconds = threadSeconds() - begin;
    state.SetIterationTime(seconds);
    frameSeconds += seconds;
    ++count;
    operations += frame.operations.splits + frame.operations.merges;
    triangles += frame.triangleCount;
    writes += frame.changedTriangles.size();
    if (count % 100 != 0) continue;
    const double again = threadSeconds();
    Roam anew(ground.field, ground.errors);
    benchmark::DoNotOptimize(anew.update(view, settings));
    scratchSeconds += threadSeconds() - again;
    ++scratches;
  }
  const auto perFrame = [&](uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(count); };
  state.counters["triangles"] = perFrame(triangles);
  state.counters["operations"] = perFrame(operations);
  state.counters["writes"] = perFrame(writes);
  if (scratches > 0)
    state.counters["scratch/frame"] =
        scratchSeconds / static_cast<double>(scratches) / (frameSeconds / static_cast<double>(count));
}
BENCHMARK_CAPTURE(frames, walker, walker())
    ->Arg(257)
    ->Arg(1025)
    ->Arg(4097)
    ->Iterations(600)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(frames, flyer, flyer())
    ->Arg(257)
    ->Arg(1025)
    ->Arg(4097)
    ->Iterations(600)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vicus::terrain
