/// The ground's mesh over real terrain and over the generated city: the stated error, measured sample by sample against
/// the full field by code that knows nothing of how the mesh was made.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "assets/load_city.hpp"
#include "city/random.hpp"
#include "plan/planner.hpp"
#include "terrain/mesh_check.hpp"

namespace vicus::app {
namespace {

using city::ViewState;

constexpr double kRounding = 1e-4;  // pixels are worked out in float

/// A file of the real data sets, or empty where they are not here.
std::string realData(const std::string& name) {
  const char* folder = std::getenv("VICUS_DATA");
  const std::filesystem::path file = std::filesystem::path(folder ? folder : "../shared/data") / name;
  return std::filesystem::exists(file) ? file.string() : "";
}

ViewState viewOver(const city::HeightField& field, glm::dvec2 place, double above, double heading, double pitch) {
  const double ground = field.heightAt(place.x, place.y).value_or(0);
  return city::makeView({{place, ground + above}, heading, pitch, 0}, std::numbers::pi / 3, {1280, 720});
}

/// A walk, a flight and jumps, `count` frames of each.
std::vector<ViewState> journeys(const city::HeightField& field, int count) {
  city::Random random(5);
  std::vector<ViewState> views;
  const glm::dvec2 middle = field.origin + 0.5 * field.extent();
  for (int i = 0; i < count; ++i) views.push_back(viewOver(field, middle + glm::dvec2(0.5 * i, 0.2 * i), 1.7, 0.4, 0));
  for (int i = 0; i < count; ++i)
    views.push_back(viewOver(field, middle + glm::dvec2(50.0 * i, -20.0 * i), 120, -0.4 + 0.02 * i, -0.2));
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 place = field.origin + field.extent() * glm::dvec2(random.uniform(0, 1), random.uniform(0, 1));
    views.push_back(viewOver(field, place, random.uniform(2, 500), random.uniform(0, 6.28), random.uniform(-0.6, 0.2)));
  }
  return views;
}

void expectBound(const std::string& input, int count) {
  assets::LoadOptions options;
  const assets::LoadResult loaded = assets::loadCity(std::vector<std::string>{input}, options);
  ASSERT_TRUE(loaded.city && loaded.city->terrain) << input;
  const city::City& city = *loaded.city;
  const city::HeightField& field = *city.terrain;
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  const plan::Planner planner(city, knobs);
  plan::PlannerState state;
  terrain::MeshBuffers buffers;
  double worst = 0;
  int number = 0;
  for (const ViewState& view : journeys(field, count)) {
    SCOPED_TRACE(input + ", frame " + std::to_string(number++));
    const city::FramePlan plan = planner.plan(city, view, 1.0 / 60, state);
    ASSERT_TRUE(plan.roam);
    buffers.apply(*plan.roam);
    const terrain::MeshFaults faults = terrain::findFaults(field, buffers.held);
    EXPECT_EQ(faults.cracks + faults.flipped, 0U);
    const terrain::MeasuredError error = terrain::measureError(field, buffers.held, &view);
    EXPECT_EQ(error.uncovered, 0U);
    EXPECT_LE(error.largestPixels, plan.roam->pixelError * (1 + kRounding));
    if (plan.roam->stoppedBy == city::StoppedBy::Error) {
      EXPECT_EQ(plan.roam->pixelError, knobs["roam.pixel_error"]);
    }
    worst = std::max(worst, error.largestPixels);
  }
  EXPECT_GT(worst, 0.1) << "the mesh is coarser than the field";
  testing::Test::RecordProperty("largest pixel error of " + std::filesystem::path(input).stem().string(),
                                std::to_string(worst));
}

constexpr const char* kTerrains[] = {"dem/mt_rainier_90m.tif", "dem/SainteHelens.dem", "dem/malta_dtm_40.tif",
                                     "monaco/N43E007.hgt.zip"};

TEST(RoamBound, HoldsOverNorvic) {
  expectBound("norvic", 4);
}

TEST(RoamBound, HoldsOverRealTerrain) {
  if (realData("dem").empty()) GTEST_SKIP() << "the real data sets are not here";
  for (const char* name : kTerrains) expectBound(realData(name), 3);
}

// The long sweep of ./test --full is run with --gtest_also_run_disabled_tests.
TEST(DISABLED_RoamBoundInFull, HoldsThroughLongJourneys) {
  expectBound("norvic", 60);
  if (realData("dem").empty()) GTEST_SKIP() << "the real data sets are not here";
  for (const char* name : kTerrains) expectBound(realData(name), 60);
}

}  // namespace
}  // namespace vicus::app
