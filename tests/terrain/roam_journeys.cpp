/// Walks, flights and jumps over large fields: the wanted error, cracks, and that motion leaves nothing behind. Long:
/// run by ./test --full with --gtest_also_run_disabled_tests.
#include <gtest/gtest.h>

#include <numbers>

#include "city/random.hpp"
#include "terrain/error_table.hpp"
#include "terrain/mesh_check.hpp"
#include "terrain/roam.hpp"
#include "tests/terrain/fields.hpp"

namespace vicus::terrain {
namespace {

using city::HeightField;
using city::ViewState;

ViewState viewOver(const HeightField& field, glm::dvec2 place, double above, double heading, double pitch) {
  const double ground = field.heightAt(place.x, place.y).value_or(0);
  return city::makeView({{place, ground + above}, heading, pitch, 0}, std::numbers::pi / 3, {1280, 720});
}

void expectSoundJourney(const HeightField& field, const std::vector<ViewState>& views, int measureEvery) {
  const ErrorTable table = buildErrorTable(field);
  RoamSettings settings;
  settings.budget = std::numeric_limits<uint32_t>::max();
  Roam roam(field, table);
  MeshBuffers mesh;
  for (size_t i = 0; i < views.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const RoamFrame frame = roam.update(views[i], settings);
    mesh.apply(frame);
    EXPECT_EQ(frame.pixelError, settings.pixelError);
    if (i % static_cast<size_t>(measureEvery) != 0) continue;
    const MeshFaults faults = findFaults(field, mesh.held);
    EXPECT_EQ(faults.cracks + faults.flipped, 0U);
    const MeasuredError error = measureError(field, mesh.held, &views[i]);
    EXPECT_LE(error.largestPixels, settings.pixelError * (1 + 1e-4));
    EXPECT_EQ(error.uncovered, 0U);
    Roam anew(field, table);
    EXPECT_EQ(frame.triangleCount, anew.update(views[i], settings).triangleCount);
    if (testing::Test::HasFailure()) return;
  }
}

/// `seconds` of a walk at 1.4 m/s and of a flight at 50 m/s, 30 frames a second, then jumps.
std::vector<ViewState> journey(const HeightField& field, int seconds) {
  std::vector<ViewState> views;
  for (const double speed : {1.4, 50.0}) {
    glm::dvec2 place(1200, 1500);
    for (int i = 0; i < 30 * seconds; ++i) {
      const double heading = 0.3 + 0.05 * i / 30;
      place += speed / 30 * glm::dvec2(std::cos(heading), std::sin(heading));
      views.push_back(viewOver(field, place, speed > 10 ? 120 : 1.7, heading, speed > 10 ? -0.2 : 0));
    }
  }
  city::Random random(3);
  for (int i = 0; i < 2 * seconds; ++i)
    views.push_back(viewOver(field, {random.uniform(0, 4096), random.uniform(0, 4096)}, random.uniform(2, 400),
                             random.uniform(0, 6.28), random.uniform(-0.8, 0.2)));
  return views;
}

TEST(RoamJourney, OverASmallFieldIsSound) {
  const HeightField field = makeLandscape(257, Landscape::Cliffs);
  expectSoundJourney(field, journey(field, 2), 7);
}

TEST(DISABLED_RoamJourneyInFull, OverLargeFieldsIsSound) {
  for (const Landscape kind : {Landscape::Hills, Landscape::Cliffs}) {
    const HeightField field = makeLandscape(4097, kind);
    expectSoundJourney(field, journey(field, 10), 30);
  }
}

}  // namespace
}  // namespace vicus::terrain
