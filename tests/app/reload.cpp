// A town whose rules change while it is drawn.
#include "app/reload.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "viewer/pictures.hpp"
#include "viewer/renderer.hpp"

namespace vicus::app {
namespace {

using testing::HasSubstr;

class Reloading : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("vicus-reload-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    write("houses.geojson",
          R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}},)"
          R"("features":[{"type":"Feature","properties":{"height":8},"geometry":{"type":"Polygon","coordinates":)"
          R"([[[0,0],[12,0],[12,10],[0,10],[0,0]]]}}]})");
    rules("brick");
    options_.inputs = {
        write("town.toml", "[[sources]]\nfile = \"houses.geojson\"\n[[styles]]\nrules = \"own.rules\"\n")};
    options_.noCache = true;
    int code = 0;
    std::optional<OpenScene> scene = openScene(options_, surroundings_, console_, code);
    ASSERT_TRUE(scene) << err_.str();
    scene_ = std::move(*scene);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  void rules(const std::string& texture) const {
    write("own.rules", "plain " + texture +
                           "\nHouse => Extrude(house.height, Comp(side: Wall))\nWall => SampleTexture(" + texture +
                           ", Rep, (0, 0, 0, 0))\n");
  }
  /// Asks until the worker has an answer; nothing where there is none within a minute.
  static std::optional<Rebuilt> answerOf(Reload& reload, const city::Knobs& knobs) {
    for (int k = 0; k < 6000; ++k) {
      if (auto rebuilt = reload.poll(knobs)) return rebuilt;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return std::nullopt;
  }

  std::filesystem::path folder_;
  std::ostringstream out_, err_;
  Surroundings surroundings_{out_, err_, false, "", ""};
  Console console_{surroundings_};
  SceneOptions options_;
  OpenScene scene_;
};

TEST_F(Reloading, AMistakeIsToldWithItsPlaceAndTheTownStays) {
  Reload reload(scene_, options_, "");
  EXPECT_FALSE(reload.poll(scene_.knobs)) << "nothing has changed";
  write("own.rules", "House => Extrud(house.height, Wall)\n");
  const std::optional<Rebuilt> rebuilt = answerOf(reload, scene_.knobs);
  ASSERT_TRUE(rebuilt);
  EXPECT_FALSE(rebuilt->city);
  ASSERT_FALSE(rebuilt->diagnostics.messages.empty());
  const std::string told = city::describe(rebuilt->diagnostics.messages[0]);
  EXPECT_THAT(told, HasSubstr("own.rules:1:10"));
  EXPECT_THAT(told, HasSubstr("did you mean Extrude?\n  House => Extrud(house.height, Wall)\n           ^"));
}

TEST_F(Reloading, ADescriptionWithOtherParametersCountsToo) {
  write("own.rules",
        "param storey = 2 m (1 .. 4)\nHouse => Extrude(house.height, Comp(side: Wall))\n"
        "Wall => RepeatY(storey, AttachScope(block, 0.1, 10, 20, oak))\n");
  Reload reload(scene_, options_, "");
  write("town.toml",
        "[[sources]]\nfile = \"houses.geojson\"\n[[styles]]\nrules = \"own.rules\"\nparameters = { storey = 4 }\n");
  const std::optional<Rebuilt> rebuilt = answerOf(reload, scene_.knobs);
  ASSERT_TRUE(rebuilt && rebuilt->city);
  EXPECT_EQ(rebuilt->city->buildingTypes.at(0).externalGeometry.size(), 8u);
}

TEST_F(Reloading, TheNextFrameShowsWhatChanged) {
  std::string error;
  const std::unique_ptr<viewer::GlContext> context = viewer::makeOffscreenContext(error);
  if (!context) GTEST_SKIP() << "nothing to draw with: " << error;
  context->makeCurrent();
  city::Diagnostics diagnostics;
  viewer::Drawing drawing{scene_.city.get(), *context, scene_.knobs, {}, {}, {}};
  drawing.planner = std::make_unique<plan::Planner>(*scene_.city, scene_.knobs);
  drawing.scene = std::make_unique<scenegraph::Scene>(*scene_.city, scene_.knobs, diagnostics);
  drawing.renderer = std::make_unique<viewer::Renderer>(*context, *drawing.scene, 1);
  viewer::Stage stage = drawing.stage();
  Reload reload(scene_, options_, "");
  const city::ViewState view = city::makeView({{0, -25, 4}, glm::radians(90.0), 0, 0}, glm::radians(50.0), {64, 48});
  std::vector<viewer::Picture> pictures;
  bool changed = false;
  viewer::LoopHooks hooks;
  hooks.pause = [&] {
    if (pictures.size() != 1 || changed) return;
    rules("limewash");
    std::optional<Rebuilt> rebuilt = answerOf(reload, drawing.knobs);
    ASSERT_TRUE(rebuilt && rebuilt->city);
    // A knob that was turned meanwhile counts.
    drawing.knobs.set("cull_map", 0);
    show(std::move(*rebuilt), scene_, drawing);
    stage = drawing.stage();
    changed = true;
  };
  hooks.nextView = [&]() -> std::optional<viewer::NextView> {
    if (pictures.size() == 3) return std::nullopt;
    return viewer::NextView{view, 0.02, false};
  };
  hooks.drawn = [&](size_t, const viewer::FrameRecord&) { pictures.push_back(drawing.renderer->readPicture()); };
  viewer::runFrames(stage, hooks);
  EXPECT_THAT(drawing.renderer->problems(), testing::IsEmpty());
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_GT(viewer::compare(pictures[0], pictures[1], 12).share, 0.1);
  EXPECT_LT(viewer::compare(pictures[1], pictures[2], 12).share, 0.01);
}

}  // namespace
}  // namespace vicus::app
