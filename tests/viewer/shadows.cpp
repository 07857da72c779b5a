// Shadow maps as drawn: what stands behind the viewer throws its shadow, nothing is remembered that shows, and culling
// changes no pixel.
#include <gmock/gmock.h>

#include <cmath>

#include "city/random.hpp"
#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "small_cities.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/pictures.hpp"
#include "viewer/renderer.hpp"
#include "viewer/tours.hpp"

namespace vicus::viewer {
namespace {

class Shadows : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    context_ = makeOffscreenContext(error);
    if (!context_) GTEST_SKIP() << "no offscreen GL: " << error;
    for (const auto list : {plan::planKnobs(), scenegraph::sceneKnobs(), viewerKnobs()}) knobs_.declare(list);
    knobs_.set("textures.budget_mb", 1);
    knobs_.set("cull_map", 0);
    knobs_.set("shadows.cascades", 4);
  }

  /// A city, its scene and a planner, drawn from nothing.
  struct Shown {
    Shown(GlContext& context, const city::City& from, const city::Knobs& knobs)
        : city(from), planner(city, knobs), scene(city, knobs, diagnostics), renderer(context, scene, 1) {}
    Picture picture(const city::ViewState& view) {
      renderer.draw(planner.plan(city, view, 0, state));
      EXPECT_THAT(renderer.problems(), testing::IsEmpty());
      return renderer.readPicture();
    }
    city::City city;
    city::Diagnostics diagnostics;
    plan::Planner planner;
    scenegraph::Scene scene;
    Renderer renderer;
    plan::PlannerState state;
  };

  static city::ViewState viewOf(const glm::dvec3& eye, double heading, double pitch) {
    return city::makeView({eye, heading, pitch, 0}, 1, {160, 90});
  }
  static double meanOf(const Picture& p) {
    double sum = 0;
    for (const uint8_t v : p.rgb) sum += v;
    return sum / static_cast<double>(p.rgb.size());
  }

  city::Knobs knobs_;
  std::unique_ptr<GlContext> context_;
};

TEST_F(Shadows, AHouseBehindTheViewerThrowsItsShadowBeforeHim) {
  // The sun stands low in the south; the viewer looks north and down at the ground, the house is behind him.
  city::City with = test::cityOf({{0, -12}, {200, 200}}), without = test::cityOf({{60, -12}, {200, 200}});
  for (city::City* city : {&with, &without}) city->environment.sunAzimuth = M_PI, city->environment.sunElevation = 0.3;
  const city::ViewState view = viewOf({0, -3, 1.7}, M_PI / 2, -0.9);
  Shown shaded(*context_, with, knobs_), open(*context_, without, knobs_);
  const Picture dark = shaded.picture(view), light = open.picture(view);
  const city::FramePlan plan = shaded.planner.plan(with, view, 0, shaded.state);
  EXPECT_EQ(plan.buildings.drawnCount, 0u) << "the viewer sees no house";
  EXPECT_LT(meanOf(dark), 0.75 * meanOf(light));
  knobs_.set("shadows.cascades", 0);
  Shown off(*context_, with, knobs_);
  EXPECT_LT(std::abs(meanOf(off.picture(view)) - meanOf(light)), 2) << "without maps there is none";
}

TEST_F(Shadows, CullingEachCascadeChangesNoPixel) {
  const city::City city = test::gridTown();
  city::Knobs off = knobs_;
  off.set("frustum_culling", 0);
  city::Random random(4);
  for (int k = 0; k < 4; ++k) {
    const city::ViewState view = city::makeView(randomView(city, random), 1, {160, 90});
    // Scenes of their own, so that each draws its maps by its own plan.
    Shown culled(*context_, city, knobs_), all(*context_, city, off);
    EXPECT_EQ(compare(culled.picture(view), all.picture(view)).differingPixels, 0u) << k;
  }
}

TEST_F(Shadows, TheMapsRememberNothingThatShows) {
  const city::City city = test::gridTown();
  Shown shown(*context_, city, knobs_);
  const city::ViewState view = viewOf({20, 8, 1.7}, 0.2, -0.1);
  const Picture first = shown.picture(view);
  for (int k = 1; k < 12; ++k) shown.picture(viewOf({20.0 + 7 * k, 8.0 + 5 * k, 1.7 + k}, 0.3 * k, -0.2));
  EXPECT_EQ(compare(first, shown.picture(view)).differingPixels, 0u);
}

TEST_F(Shadows, AStepOfAMillimetreChangesNextToNothing) {
  const city::City city = test::gridTown();
  Shown shown(*context_, city, knobs_);
  const Picture here = shown.picture(viewOf({20, 8, 3}, 0.2, -1.2));
  const Picture step = shown.picture(viewOf({20.001, 8, 3}, 0.2, -1.2));
  size_t changed = 0;
  for (size_t i = 0; i < here.rgb.size(); ++i) changed += std::abs(int{here.rgb[i]} - int{step.rgb[i]}) > 24;
  EXPECT_LT(static_cast<double>(changed), 0.002 * static_cast<double>(here.rgb.size()));
}

TEST_F(Shadows, SunAtItsExtremesDrawsWithoutProblems) {
  for (const double elevation : {M_PI / 2, 0.02, -0.2, static_cast<double>(NAN)}) {
    city::City city = test::gridTown();
    city.environment.sunElevation = elevation;
    Shown shown(*context_, city, knobs_);
    const Picture p = shown.picture(viewOf({20, 8, 1.7}, 0.2, -0.1));
    EXPECT_GT(meanOf(p), 8) << "night is not black: " << elevation;
  }
}

TEST_F(Shadows, WithTheKnobOffNothingOfThemExists) {
  const city::City city = test::gridTown();
  city::Knobs off = knobs_;
  off.set("shadows.cascades", 0);
  city::Diagnostics diagnostics;
  const scenegraph::Scene with(city, knobs_, diagnostics), without(city, off, diagnostics);
  EXPECT_THAT(with.featureNames(), testing::Contains("shadow maps"));
  EXPECT_THAT(with.passNames(), testing::Contains("shadow maps"));
  EXPECT_THAT(without.featureNames(), testing::Not(testing::Contains("shadow maps")));
  EXPECT_THAT(without.passNames(), testing::Not(testing::Contains("shadow maps")));
  EXPECT_THAT(without.describeGraph(), testing::Not(testing::HasSubstr("hadow")));
  EXPECT_GE(with.gpuBytes(), without.gpuBytes() + 4 * 4 * 1024 * 1024);
}

}  // namespace
}  // namespace vicus::viewer
