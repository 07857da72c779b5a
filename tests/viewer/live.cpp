/// The overlay and the frozen view: what F2 and F3 show, drawn offscreen.
#include <gmock/gmock.h>

#include <algorithm>

#include "small_cities.hpp"
#include "viewer/live_view.hpp"
#include "viewer/pictures.hpp"

namespace vicus::viewer {
namespace {

using testing::IsEmpty;

constexpr glm::ivec2 kSize{640, 360};
const double kFov = glm::radians(60.0);

city::Knobs allKnobs() {
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  knobs.declare(scenegraph::sceneKnobs());
  knobs.declare(viewerKnobs());
  return knobs;
}

/// Rows of houses whose walls hide what stands behind them.
city::City townOfWalls() {
  city::City town = test::gridTown(24, 8);
  for (city::BuildingGeometry& type : town.buildingTypes) {
    const std::vector<glm::vec2>& ring = type.footprint[0];
    for (size_t k = 0; k < ring.size(); ++k)
      type.occluders.push_back({ring[k], ring[(k + 1) % ring.size()], 0, type.height});
  }
  return town;
}

class Live : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    context_ = makeOffscreenContext(error);
    if (!context_) GTEST_SKIP() << "nothing to draw with: " << error;
    context_->makeCurrent();
    drawing_.emplace(Drawing{&city_, *context_, allKnobs(), {}, {}, {}});
    drawing_->planner = std::make_unique<plan::Planner>(city_, drawing_->knobs);
    city::Diagnostics diagnostics;
    drawing_->scene = std::make_unique<scenegraph::Scene>(city_, drawing_->knobs, diagnostics);
    drawing_->renderer = std::make_unique<Renderer>(*context_, *drawing_->scene, 4);
    stage_ = drawing_->stage();
    live_.emplace(*drawing_, stage_, "town",
                  [](const plan::Planner& planner, const city::Knobs&) { return planner.features(); });
  }
  void TearDown() override {
    live_.reset();
    drawing_.reset();
  }

  city::ViewState view(glm::dvec3 eye, double heading, double pitch) const {
    return city::makeView({eye, glm::radians(heading), glm::radians(pitch), 0}, kFov, kSize);
  }
  /// Draws `frames` frames of a view, calling `before` each, and returns the last picture.
  Picture draw(const city::ViewState& from, int frames = 1, const std::function<void(int)>& before = {}) {
    LoopHooks hooks;
    int done = 0;
    hooks.nextView = [&]() -> std::optional<NextView> {
      if (done == frames) return std::nullopt;
      if (before) before(done);
      ++done;
      return NextView{from, 0.02, false};
    };
    Picture picture;
    hooks.drawn = [&](size_t, const FrameRecord& record) {
      picture = stage_.renderer->readPicture();
      EXPECT_EQ((record.stages.end() - 2)->name, "overlay");
    };
    live_->install(hooks);
    runFrames(stage_, hooks);
    EXPECT_THAT(stage_.renderer->problems(), IsEmpty());
    EXPECT_EQ(live_->problem(), "");
    return picture;
  }
  static glm::ivec3 pixel(const Picture& p, int x, int y) {
    const uint8_t* at =
        p.rgb.data() + 3 * (static_cast<size_t>(y) * static_cast<size_t>(p.width) + static_cast<size_t>(x));
    return {at[0], at[1], at[2]};
  }
  static double differing(const Picture& a, const Picture& b) { return compare(a, b, 12).share; }

  const city::City city_ = townOfWalls();
  std::unique_ptr<GlContext> context_;
  std::optional<Drawing> drawing_;
  Stage stage_;
  std::optional<LiveView> live_;
  const city::ViewState street_ = view({40, 24, 1.7}, 0, 0);
};

TEST_F(Live, TheOverlayCoversItsPanelAndNothingElse) {
  const Picture plain = draw(street_, 2);
  live_->showOverlay(true);
  const Picture covered = draw(street_, 3);
  size_t inside = 0, outside = 0;
  for (int y = 20; y < kSize.y - 20; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      if (pixel(plain, x, y) == pixel(covered, x, y)) continue;
      (x < 422 ? inside : outside) += 1;
    }
  EXPECT_GT(inside, 100000U);
  EXPECT_EQ(outside, 0U);
  // Drawing over a picture leaves no trace in the next one.
  live_->showOverlay(false);
  EXPECT_EQ(differing(draw(street_, 2), plain), 0);
}

TEST_F(Live, ASwitchThatIsClickedChangesThePlan) {
  live_->showOverlay(true);
  // Tall enough for all of the panel, and nothing but sky to draw.
  city::ViewState sky = view({40, 24, 1.7}, 0, 89);
  sky.viewport = {640, 900};
  draw(sky, 2);
  ASSERT_TRUE(drawing_->knobs.on("frustum_culling"));
  // The panel's rows from below (a heading that is clicked folds what lies under it): somewhere there is the switch of
  // the first technique.
  for (int y = sky.viewport.y - 20; y > 60 && drawing_->knobs.on("frustum_culling"); y -= 9)
    draw(sky, 4, [&](int frame) { live_->point({{27, y}, frame == 1 || frame == 2, 0}); });
  ASSERT_FALSE(drawing_->knobs.on("frustum_culling"));
  EXPECT_THAT(stage_.planner->steps(), testing::Not(testing::Contains("frustum buildings")));
  EXPECT_EQ(stage_.planner, drawing_->planner.get());
}

TEST_F(Live, KnobsOfDrawingMakeTheSceneAnew) {
  const Picture smooth = draw(street_, 2);
  ASSERT_TRUE(turn(*drawing_, "viewer.multisamples", 1));
  const Picture jagged = draw(street_, 2);
  EXPECT_GT(differing(smooth, jagged), 0);
  EXPECT_LT(differing(smooth, jagged), 0.1) << "only edges";
  const Renderer* before = drawing_->renderer.get();
  ASSERT_TRUE(turn(*drawing_, "state_ordering", 0));
  EXPECT_NE(drawing_->renderer.get(), before);
  stage_ = drawing_->stage();
  EXPECT_LT(differing(draw(street_, 2), jagged), 0.001);
  EXPECT_FALSE(turn(*drawing_, "viewer.multisamples", 99));
  EXPECT_FALSE(turn(*drawing_, "no.such.knob", 1));
}

TEST_F(Live, FatesAreThoseOfThePlan) {
  plan::PlannerState state;
  const city::FramePlan plan = stage_.planner->plan(city_, street_, 0, state);
  const std::vector<Fate> fates = fatesOf(city_, plan);
  ASSERT_EQ(fates.size(), city_.itemCount());
  const auto count = [&](Fate fate) { return static_cast<uint64_t>(std::ranges::count(fates, fate)); };
  EXPECT_EQ(count(Fate::Drawn), plan.counts.instancesDrawn + 1);  // item 0 is nothing
  EXPECT_EQ(count(Fate::Hidden), plan.counts.instancesOccluded);
  EXPECT_EQ(count(Fate::OutsidePicture), plan.counts.instances - plan.counts.instancesInFrustum);
  EXPECT_GT(count(Fate::Hidden), 0U);
  EXPECT_GT(count(Fate::OutsidePicture), 0U);
}

TEST_F(Live, TheFrozenViewColoursByReasonAndThawsWithoutATrace) {
  const city::ViewState above = view({100, -120, 160}, 90, -50);
  const Picture plain = draw(above, 2);
  live_->showFrom(above);
  const Picture frozen = draw(street_);
  // Blue for what lies behind the eye, red for what is hidden before it, no tint over what is drawn: each somewhere.
  size_t bluer = 0, redder = 0, same = 0;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const glm::ivec3 change = pixel(frozen, x, y) - pixel(plain, x, y);
      bluer += change.b - change.r > 40 ? 1U : 0U;
      redder += change.r - change.b > 20 && change.r - change.g > 20 ? 1U : 0U;
      same += change == glm::ivec3(0) ? 1U : 0U;
    }
  EXPECT_GT(bluer, 1000U);
  EXPECT_GT(redder, 1000U);
  EXPECT_GT(same, 10000U);
}

TEST_F(Live, FrozenItStaysWhileTheVisitorFlies) {
  draw(street_, 2);
  const city::ViewState above = view({100, -120, 160}, 90, -50);
  const Picture plain = draw(above, 2);
  live_->freeze(true);
  draw(street_);  // frozen here
  const Picture first = draw(above, 2);
  EXPECT_GT(differing(first, plain), 0.05);
  EXPECT_EQ(differing(draw(above, 2), first), 0) << "the plan does not follow the eye";
  live_->freeze(false);
  EXPECT_EQ(differing(draw(above, 2), plain), 0);
}

TEST(LinesOf, TilesByWhetherTheyAreDrawnAndTheFrustum) {
  const city::City town = test::gridTown(24, 8);
  city::FramePlan plan;
  plan.view = city::makeView({{10, 24, 1.7}, 0, 0, 0}, kFov, kSize);
  size_t tiles = 0;
  for (const city::Tile& tile : town.tiles) tiles += tile.bounds.empty() ? 0U : 1U;
  const auto green = [](const SceneLine& line) { return line.colour.g > line.colour.r + 50; };
  EXPECT_EQ(std::ranges::count_if(linesOf(town, plan), green), 0);
  for (uint32_t t = 0; t < town.tiles.size(); ++t) plan.tiles.push_back(t);
  const std::vector<SceneLine> lines = linesOf(town, plan);
  EXPECT_EQ(static_cast<size_t>(std::ranges::count_if(lines, green)), 4 * tiles);
  EXPECT_GE(lines.size(), 4 * tiles + 8) << "and the frustum's edges";
}

TEST(LinesOf, TheCullMapLiesOverTheWallsThatMadeIt) {
  const city::City town = townOfWalls();
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  const city::ViewState view = city::makeView({{40, 24, 1.7}, 0, 0, 0}, kFov, kSize);
  const culling::CullMapView horizon = plan::Planner(town, knobs).cullMap(town, view);
  ASSERT_FALSE(horizon.occluders.empty());
  const std::vector<SceneLine> lines = linesOf(horizon, view.eye);
  EXPECT_EQ(lines.size(), horizon.occluders.size() + static_cast<size_t>(std::ranges::count_if(
                                                         horizon.slopes, [](float s) { return std::isfinite(s); })));
  size_t checked = 0;
  for (size_t k = horizon.occluders.size(); k < lines.size(); ++k) {
    const glm::dvec3 a = lines[k].a - view.eye, b = lines[k].b - view.eye;
    EXPECT_NEAR(std::max(std::abs(a.x), std::abs(a.y)), 10, 1e-9);
    // No chosen wall over the column's whole width stands higher than the horizon there, where it is lowest.
    for (const culling::CullMapView::Line& wall : horizon.occluders) {
      const glm::dvec3 p = wall.a - view.eye, q = wall.b - view.eye;
      double least = std::numeric_limits<double>::infinity();
      for (const glm::dvec3& edge : {a, b}) {
        const double atP = edge.x * p.y - edge.y * p.x, atQ = edge.x * q.y - edge.y * q.x;
        const glm::dvec3 at = glm::mix(p, q, atP / (atP - atQ));
        const bool within = atP * atQ < 0 && glm::distance(at, p) > 0.1 && glm::distance(at, q) > 0.1 &&
                            glm::dot(glm::dvec2(at), glm::dvec2(edge)) > 0;
        least = within ? std::min(least, at.z * 10 / std::max(std::abs(at.x), std::abs(at.y))) : -1e9;
        if (!within) break;
      }
      if (least < -1e6) continue;
      ++checked;
      EXPECT_GE(a.z, least - 0.005);
    }
  }
  EXPECT_GT(checked, 100U);

  knobs.set("cull_map.kind", 1);
  const culling::CullMapView grid = plan::Planner(town, knobs).cullMap(town, view);
  EXPECT_GT(linesOf(grid, view.eye).size(), grid.occluders.size() + 100);
  knobs.set("cull_map", 0);
  EXPECT_TRUE(linesOf(plan::Planner(town, knobs).cullMap(town, view), view.eye).empty());
}

}  // namespace
}  // namespace vicus::viewer
