// The loop, pictures and item buffers through a real GL context without a display.
#include <gmock/gmock.h>

#include "city/random.hpp"
#include "small_cities.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/pictures.hpp"
#include "viewer/tours.hpp"

namespace vicus::viewer {
namespace {

constexpr double kFov = 1;
constexpr glm::ivec2 kSize(160, 90);

/// A small town with terrain, ready to draw.
class DrawnTown : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    context_ = makeOffscreenContext(error);
    if (!context_) GTEST_SKIP() << "no offscreen GL: " << error;
    city_ = test::gridTown();
    test::setTerrain(city_, test::terrain(41, 10, [](double x, double y) { return -0.02 * x - 0.01 * y - 2; }));
    for (const auto knobs : {plan::planKnobs(), scenegraph::sceneKnobs(), viewerKnobs()}) knobs_.declare(knobs);
    knobs_.set("textures.budget_mb", 1);
    city::Diagnostics diagnostics;
    scene_ = std::make_unique<scenegraph::Scene>(city_, knobs_, diagnostics);
    renderer_ = std::make_unique<Renderer>(*context_, *scene_, 1);
    knobs_.set("roam", 0);  // what hides what is compared on one ground
    culling_ = std::make_unique<plan::Planner>(city_, knobs_);
    city::Knobs off = knobs_;
    off.set("frustum_culling", 0);
    everything_ = std::make_unique<plan::Planner>(city_, off);
  }
  void TearDown() override {
    if (renderer_) {
      EXPECT_THAT(renderer_->problems(), testing::IsEmpty());
    }
    renderer_.reset();
    scene_.reset();
  }

  city::ViewState overview() const { return city::makeView({{-40, -60, 60}, 0.8, -0.5, 0}, kFov, kSize); }
  city::FramePlan plan(const city::ViewState& view) { return culling_->plan(city_, view, 0, state_); }
  city::FramePlan planAll(const city::ViewState& view) { return everything_->plan(city_, view, 0, allState_); }

  city::City city_;
  city::Knobs knobs_;
  std::unique_ptr<GlContext> context_;
  std::unique_ptr<scenegraph::Scene> scene_;
  std::unique_ptr<Renderer> renderer_;
  std::unique_ptr<plan::Planner> culling_, everything_;
  plan::PlannerState state_, allState_;
};

TEST_F(DrawnTown, CullingLosesNoPixel) {
  city::Random random(11);
  uint64_t shown = 0, culled = 0;
  for (int k = 0; k < 12; ++k) {
    const city::ViewState view = city::makeView(randomView(city_, random), kFov, kSize);
    const city::FramePlan planned = plan(view), all = planAll(view);
    const ItemCheck check = checkItems(city_, planned, renderer_->drawItems(all), renderer_->drawItems(planned));
    EXPECT_EQ(check.lostPixels, 0u) << "view " << k;
    EXPECT_EQ(check.differingPixels, 0u) << "view " << k;
    shown += check.shownPixels;
    culled += all.counts.instancesDrawn - planned.counts.instancesDrawn;

    renderer_->draw(all);
    const Picture full = renderer_->readPicture();
    renderer_->draw(planned);
    EXPECT_EQ(compare(full, renderer_->readPicture()).differingPixels, 0u) << "view " << k;
  }
  EXPECT_GT(shown, 1000u) << "the views show buildings";
  EXPECT_GT(culled, 100u) << "and something was culled";
}

TEST_F(DrawnTown, ACullerThatDropsABuildingIsFound) {
  const city::ViewState view = overview();
  const city::FramePlan all = planAll(view);
  const ItemBuffer full = renderer_->drawItems(all);
  // The item that takes the most pixels, left out.
  std::vector<uint64_t> pixels(city_.itemCount(), 0);
  for (const uint32_t id : full.ids)
    if (id != 0 && id != city::kItemOther) ++pixels.at(id);
  const auto dropped = static_cast<uint32_t>(std::max_element(pixels.begin(), pixels.end()) - pixels.begin());
  ASSERT_GT(pixels[dropped], 20u);
  city::FramePlan faulty = all;
  const uint32_t index = dropped - 1, count = static_cast<uint32_t>(city_.buildings.size());
  faulty.buildings.drawn = {{0, index}, {index + 1, count - index - 1}};
  std::erase_if(faulty.buildings.drawn, [](const city::Range& run) { return run.count == 0; });
  faulty.buildings.drawnCount = count - 1;

  const ItemCheck check = checkItems(city_, faulty, full, renderer_->drawItems(faulty));
  EXPECT_EQ(check.lostPixels, pixels[dropped]);
  EXPECT_THAT(check.lostItems, testing::ElementsAre(dropped));
  EXPECT_EQ(check.differingPixels, pixels[dropped]);
}

TEST_F(DrawnTown, EveryFrameDrawsLikeTheFirst) {
  const city::FramePlan planned = plan(overview());
  const ItemBuffer firstItems = renderer_->drawItems(planned);
  renderer_->draw(planned);
  const Picture first = renderer_->readPicture();
  for (int k = 0; k < 3; ++k) {
    renderer_->draw(planned);
    EXPECT_EQ(compare(first, renderer_->readPicture()).differingPixels, 0u) << "frame " << k + 2;
    EXPECT_EQ(renderer_->drawItems(planned).ids, firstItems.ids) << "frame " << k + 2;
  }
  EXPECT_GT(std::count_if(firstItems.ids.begin(), firstItems.ids.end(),
                          [](uint32_t id) { return id != 0 && id != city::kItemOther; }),
            100);
}

TEST_F(DrawnTown, TheLoopKeepsTheRecordsOfCountedFrames) {
  const city::Tour tour = makeTours(city_)[0];
  const std::vector<TourFrame> frames = spreadFrames(tour, 3);
  size_t next = 0;
  std::vector<size_t> drawn;
  LoopHooks hooks;
  hooks.nextView = [&]() -> std::optional<NextView> {
    if (next == frames.size()) return std::nullopt;
    const TourFrame& f = frames[next++];
    return NextView{city::makeView(poseAt(tour, f.time), kFov, kSize), f.dt, f.warmUp};
  };
  hooks.drawn = [&](size_t frame, const FrameRecord&) { drawn.push_back(frame); };
  const Stage stage{&city_, culling_.get(), scene_.get(), renderer_.get(), context_.get()};
  const std::vector<FrameRecord> records = runFrames(stage, hooks);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_THAT(drawn, testing::ElementsAre(0u, 1u, 2u));
  for (const FrameRecord& r : records) {
    std::vector<std::string> names;
    double sum = 0;
    for (const StageSample& s : r.stages) {
      names.emplace_back(s.name);
      if (s.name != "swap") sum += s.milliseconds;
    }
    EXPECT_EQ(names.front(), "input");
    EXPECT_EQ(names.back(), "swap");
    for (const char* name : {"apply buildings", "update", "cull", "draw", "finish"})
      EXPECT_THAT(names, testing::Contains(name));
    EXPECT_LE(sum, r.milliseconds + 1e-6) << "stages do not overlap";
    EXPECT_EQ(r.counts.instances, city_.buildings.size());
    EXPECT_GT(r.draw.triangles, 0u);
  }
  // A kiosk keeps nothing.
  next = 0;
  hooks.keepRecords = false;
  EXPECT_TRUE(runFrames(stage, hooks).empty());
  EXPECT_EQ(drawn.size(), 6u);
}

}  // namespace
}  // namespace vicus::viewer
