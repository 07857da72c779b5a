#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands.hpp"
#include "app/figures.hpp"
#include "app/open_scene.hpp"
#include "viewer/pictures.hpp"
#include "viewer/window.hpp"

namespace vicus::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Runs the program's library with a folder of its own for files.
class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("vicus-app-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  int vicus(std::vector<std::string> arguments) {
    out_.str(""), err_.str("");
    return run(arguments, {out_, err_, false, "", ""});
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
    return file(name);
  }
  std::string read(const std::string& name) const {
    std::ifstream in(file(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Four houses of 8 to 11 m about a small square.
  std::string hamlet() const {
    std::string features;
    for (int k = 0; k < 4; ++k) {
      const double x = (k % 2) * 30.0, y = (k / 2) * 30.0;
      std::ostringstream f;
      f << R"({"type":"Feature","properties":{"height":)" << 8 + k
        << R"(},"geometry":{"type":"Polygon","coordinates":[[)"
        << "[" << x << "," << y << "],[" << x + 12 << "," << y << "],[" << x + 12 << "," << y + 10 << "],[" << x << ","
        << y + 10 << "],[" << x << "," << y << "]]]}}";
      features += (k ? "," : "") + f.str();
    }
    return write(
        "hamlet.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::28992"}},"features":[)" +
            features + "]}");
  }

  std::filesystem::path folder_;
  std::ostringstream out_, err_;
};

// ---- Usage ----

TEST_F(CommandLine, HelpIsAResult) {
  EXPECT_EQ(vicus({"--help"}), kDone);
  for (const char* command : {"walk", "info", "knobs", "check"}) EXPECT_THAT(out_.str(), HasSubstr(command));
  EXPECT_EQ(vicus({"walk", "--help"}), kDone);
  for (const char* option :
       {"--headless", "--path", "--tour", "--frames", "--fps", "--size", "--out", "--every", "--json", "--set", "--dem",
        "--height-column", "--ground-column", "--crs", "--shift", "--no-cache", "--view"})
    EXPECT_THAT(out_.str(), HasSubstr(option));
  EXPECT_EQ(err_.str(), "");
}

TEST_F(CommandLine, WrongUsageIsTwoAndSaysWhy) {
  const struct {
    std::vector<std::string> arguments;
    std::string message;
  } cases[] = {
      {{}, "subcommand is required"},
      {{"dance"}, "there is no command 'dance'; there are walk info knobs"},
      {{"walk", "--tempo", "3"}, "--tempo"},
      {{"walk", "--frames", "0"}, "--frames"},
      {{"walk", "--frames", "many"}, "--frames"},
      {{"walk", "--every", "-1"}, "--every"},
      {{"walk", "--fps", "0"}, "--fps"},
      {{"walk", "--size", "1280"}, "--size takes WIDTHxHEIGHT, each 1 to 16384, not '1280'"},
      {{"walk", "--size", "0x5"}, "not '0x5'"},
      {{"walk", "--shift", "1,2"}, "--shift takes three numbers x,y,z, not '1,2'"},
      {{"walk", "--view", "1,2,3"}, "--view takes x,y,z,heading,pitch"},
      {{"walk", "--view", "1,2,3,4,5,180"}, "from 0.06 to 179 degrees"},
      {{"walk", "--tour", "street", "--path", "p.json"}, "excludes"},
      {{"walk", "--frames", "3", "--fps", "25"}, "excludes"},
      {{"info", "--set", "frustum_cullin=off"}, "did you mean 'frustum_culling'?"},
      {{"info", "--set", "viewer.fov=500"}, "knob 'viewer.fov' takes 1 to 170, not 500"},
      {{"info", "--set", "viewer.fov"}, "is not name=value"},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(vicus(c.arguments), kWrongUsage) << c.message;
    EXPECT_THAT(err_.str(), HasSubstr(c.message));
    EXPECT_EQ(out_.str(), "");
  }
}

TEST_F(CommandLine, EveryWrongKnobIsTold) {
  EXPECT_EQ(vicus({"info", "--set", "a=1", "--set", "viewer.fov=x"}), kWrongUsage);
  EXPECT_THAT(err_.str(), HasSubstr("unknown knob 'a'"));
  EXPECT_THAT(err_.str(), HasSubstr("'x' is not a number"));
}

TEST_F(CommandLine, WhatIsNotThereIsOneAndNamed) {
  EXPECT_EQ(vicus({"info", file("no-such-town.shp")}), kCouldNot);
  EXPECT_THAT(err_.str(), HasSubstr("no-such-town.shp"));
  EXPECT_EQ(vicus({"walk", hamlet(), "--headless", "--path", write("p.json", "{\"keys\": 5}")}), kCouldNot);
  EXPECT_THAT(err_.str(), HasSubstr("p.json: keys: is not a list"));
}

TEST_F(CommandLine, WithoutADisplayTheWayOutIsNamed) {
  if (!viewer::displayProblem().empty()) {
    EXPECT_EQ(vicus({"walk", hamlet()}), kCouldNot);
    EXPECT_THAT(err_.str(), HasSubstr("no display: use --headless"));
  }
}

TEST_F(CommandLine, AnUnknownTourIsWrongUsage) {
  EXPECT_EQ(vicus({"walk", hamlet(), "--headless", "--tour", "waltz"}), kWrongUsage);
  EXPECT_THAT(err_.str(), HasSubstr("there is no tour 'waltz'; this scene has street, flyover, turn, teleport"));
}

// ---- Options ----

TEST(Options, Sizes) {
  EXPECT_EQ(parseSize("1280x720"), glm::ivec2(1280, 720));
  EXPECT_EQ(parseSize("1×16384"), glm::ivec2(1, 16384));
  for (const char* bad : {"", "x", "12", "12x", "x12", "-3x4", "3x16385", "3x4x5", "3 x 4", "3.5x4"})
    EXPECT_FALSE(parseSize(bad)) << bad;
}

TEST(Options, Numbers) {
  EXPECT_THAT(*parseNumbers("1,-2.5,1e3", 3, 3), testing::ElementsAre(1, -2.5, 1000));
  for (const char* bad : {"", "1,2", "1,2,3,4", "1,,3", "1,2,x", "1,2,nan", "1,2,inf", "1,2,3,"})
    EXPECT_FALSE(parseNumbers(bad, 3, 3)) << bad;
}

TEST(Options, Views) {
  std::string error;
  const auto view = parseView("-10,20,3,90,-45,30", error);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->eye, glm::dvec3(-10, 20, 3));
  EXPECT_NEAR(view->heading, 1.570796, 1e-6);
  EXPECT_NEAR(view->pitch, -0.785398, 1e-6);
  EXPECT_NEAR(*view->fov, 0.523599, 1e-6);
  EXPECT_FALSE(parseView("0,0,0,0,0", error)->fov);
}

// ---- knobs ----

TEST_F(CommandLine, KnobsAsATableAndAsJson) {
  EXPECT_EQ(vicus({"knobs"}), kDone);
  for (const char* name : {"frustum_culling", "state_ordering", "viewer.multisamples", "viewer.fov", "viewer.vsync"})
    EXPECT_THAT(out_.str(), HasSubstr(name));
  EXPECT_EQ(vicus({"knobs", "--json"}), kDone);
  const json knobs = json::parse(out_.str());
  ASSERT_TRUE(knobs.is_array());
  for (const json& knob : knobs) {
    for (const char* key : {"name", "unit", "meaning", "too_small", "too_large"})
      EXPECT_FALSE(knob.at(key).get<std::string>().empty()) << knob;
    EXPECT_LE(knob.at("min"), knob.at("default"));
    EXPECT_LE(knob.at("default"), knob.at("max"));
  }
}

TEST(Knobs, TechniquesAreSwitchedOffAndNothingElse) {
  const city::Knobs on = allKnobs(), off = withoutTechniques(on);
  EXPECT_FALSE(off.on("frustum_culling"));
  EXPECT_FALSE(off.on("state_ordering"));
  for (const city::Knob& k : on.declared())
    if (k.name.find('.') != std::string_view::npos) {
      EXPECT_EQ(on[k.name], off[k.name]) << k.name;
    }
}

// ---- info ----

TEST_F(CommandLine, InfoTellsWhatTheSceneHolds) {
  EXPECT_EQ(vicus({"info", hamlet()}), kDone) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("4 of 4 types"));
  EXPECT_THAT(out_.str(), HasSubstr("frustum_culling"));
  EXPECT_THAT(out_.str(), HasSubstr("off, no trees"));
}

TEST_F(CommandLine, InfoAsJsonKeepsItsContract) {
  EXPECT_EQ(vicus({"info", "--json", hamlet()}), kDone) << err_.str();
  const json info = json::parse(out_.str());
  EXPECT_EQ(info.at("buildings"), 4);
  EXPECT_EQ(info.at("building_types"), 4);
  EXPECT_GE(info.at("building_polygons"), 4 * 10);
  EXPECT_THAT(info.at("scene").get<std::string>(), HasSubstr("hamlet.geojson"));
  EXPECT_EQ(info.at("extent_m").size(), 3u);
  EXPECT_TRUE(info.at("left_out").is_array());
  EXPECT_GT(info.at("bytes").at("parameters"), 0);
  EXPECT_GT(info.at("bytes").at("geometry"), 0);
  for (const char* name : {"frustum_culling", "state_ordering", "terrain", "trees"}) {
    EXPECT_TRUE(info.at("features").at(name).at("on").is_boolean());
    EXPECT_FALSE(info.at("features").at(name).at("why").get<std::string>().empty());
  }
  EXPECT_TRUE(info.contains("crs"));
  EXPECT_TRUE(info.contains("terrain"));
}

TEST_F(CommandLine, InfoShowsASwitchedOffTechnique) {
  EXPECT_EQ(vicus({"info", "--json", "--set", "state_ordering=off", "--set", "frustum_culling=0", hamlet()}), kDone);
  const json features = json::parse(out_.str()).at("features");
  EXPECT_FALSE(features.at("state_ordering").at("on"));
  EXPECT_FALSE(features.at("frustum_culling").at("on"));
}

TEST_F(CommandLine, GraphIsReadable) {
  EXPECT_EQ(vicus({"info", "--graph", hamlet()}), kDone) << err_.str();
  EXPECT_THAT(out_.str(), testing::StartsWith("root"));
  EXPECT_THAT(out_.str(), HasSubstr("buildings"));
}

// ---- walk ----

TEST_F(CommandLine, WalkDrawsPicturesAndFigures) {
  const int code = vicus({"walk", hamlet(), "--headless", "--frames", "5", "--every", "2", "--size", "96x54", "--out",
                          file("pictures"), "--json", file("figures.json"), "--set", "viewer.multisamples=1"});
  if (code == kCouldNot && err_.str().find("EGL") != std::string::npos) GTEST_SKIP() << err_.str();
  ASSERT_EQ(code, kDone) << err_.str();
  for (const char* name : {"frame_00000.png", "frame_00002.png", "frame_00004.png"}) {
    std::string error;
    const auto picture = viewer::readPicture(folder_ / "pictures" / name, error);
    ASSERT_TRUE(picture) << error;
    EXPECT_EQ(picture->width, 96);
    EXPECT_EQ(picture->height, 54);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "pictures" / "frame_00001.png"));
  EXPECT_THAT(err_.str(), HasSubstr("3 pictures in " + file("pictures")));

  const json figures = json::parse(read("figures.json"));
  EXPECT_EQ(figures.at("frames"), 5);
  EXPECT_EQ(figures.at("size"), json({96, 54}));
  EXPECT_EQ(figures.at("knobs").at("viewer.multisamples"), 1);
  EXPECT_FALSE(figures.at("renderer").get<std::string>().empty());
  EXPECT_TRUE(figures.at("features").at("frustum_culling").at("on"));
  for (const char* p : {"median", "p95", "p99", "max"}) EXPECT_GT(figures.at("run_time_ms").at("frame").at(p), 0);
  for (const char* stage : {"input", "apply buildings", "update", "cull", "draw", "finish", "swap"})
    EXPECT_TRUE(figures.at("run_time_ms").at("stages").at(stage).contains("median")) << stage;
  for (const char* count :
       {"tiles", "tiles_drawn", "instances", "instances_in_frustum", "instances_occluded", "instances_drawn",
        "triangles", "draw_calls", "texture_binds", "terrain_triangles", "blockmaps", "avatars"}) {
    EXPECT_TRUE(figures.at("counts").at(count).contains("mean")) << count;
    EXPECT_TRUE(figures.at("counts").at(count).contains("max")) << count;
  }
  EXPECT_EQ(figures.at("counts").at("instances").at("max"), 4);
  EXPECT_GT(figures.at("memory_mb").at("peak_resident"), 1);
  EXPECT_GT(figures.at("memory_mb").at("gpu"), 0);
}

TEST_F(CommandLine, SingleViewsAreDrawn) {
  const int code = vicus({"walk", hamlet(), "--headless", "--size", "64x36", "--out", file("o"), "--view",
                          "-20,-20,30,45,-40", "--view", "-20,-20,30,45,-40,20"});
  if (code == kCouldNot && err_.str().find("EGL") != std::string::npos) GTEST_SKIP() << err_.str();
  ASSERT_EQ(code, kDone) << err_.str();
  std::string error;
  const auto wide = viewer::readPicture(folder_ / "o" / "frame_00000.png", error);
  const auto narrow = viewer::readPicture(folder_ / "o" / "frame_00001.png", error);
  ASSERT_TRUE(wide && narrow) << error;
  EXPECT_GT(viewer::compare(*wide, *narrow).share, 0.1);
}

TEST_F(CommandLine, ATourFilmedTwiceIsTheSame) {
  const std::string path = write("way.json", R"({"keys": [
      {"time": 0, "position": [6, -20, 1.65], "heading": 90}, {"time": 0.5, "position": [8, -19, 1.65], "heading": 100},
      {"time": 1, "position": [9, -17, 1.65], "heading": 80}]})");
  const auto film = [&](const std::string& out) {
    return vicus({"film", hamlet(), "--path", path, "--fps", "8", "--size", "64x36", "-o", file(out)});
  };
  const int code = film("a.mp4");
  if (code == kCouldNot && err_.str().find("EGL") != std::string::npos) GTEST_SKIP() << err_.str();
  ASSERT_EQ(code, kDone) << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("film in " + file("a.mp4")));
  ASSERT_EQ(film("b.mp4"), kDone) << err_.str();
  EXPECT_GT(read("a.mp4").size(), 1000u);
  EXPECT_EQ(read("a.mp4"), read("b.mp4"));
  for (const char* folder : {"c", "d"}) ASSERT_EQ(film(folder), kDone) << err_.str();
  for (int k = 0; k < 9; ++k) {
    const std::string name = "/frame_0000" + std::to_string(k) + ".png";
    EXPECT_GT(read("c" + name).size(), 100u) << name;
    EXPECT_EQ(read("c" + name), read("d" + name)) << name;
  }
  EXPECT_EQ(vicus({"film", hamlet(), "--tour", "street"}), kWrongUsage) << "no file is named";
}

TEST_F(CommandLine, AFolderThatCannotBeMadeIsTold) {
  write("taken", "a file, not a folder");
  const int code = vicus({"walk", hamlet(), "--headless", "--frames", "3", "--size", "16x9", "--out", file("taken")});
  EXPECT_EQ(code, kCouldNot);
  if (err_.str().find("EGL") != std::string::npos) GTEST_SKIP() << err_.str();
  EXPECT_THAT(err_.str(), HasSubstr("the folder cannot be made"));
}

TEST_F(CommandLine, CheckFindsNothingLost) {
  const int code = vicus({"check", hamlet(), "--views", "6", "--size", "64x36"});
  if (code == kCouldNot && err_.str().find("EGL") != std::string::npos) GTEST_SKIP() << err_.str();
  EXPECT_EQ(code, kDone) << err_.str();
  EXPECT_THAT(out_.str(), HasSubstr("views: 6 at 64x36"));
  EXPECT_THAT(out_.str(), HasSubstr("pixels lost: 0 of"));
  EXPECT_THAT(out_.str(), HasSubstr("views that differ: 0"));
}

// ---- Messages ----

TEST(Console, TenOfAKindThenACount) {
  std::ostringstream out, err;
  {
    Console console({out, err, false, "", ""});
    city::Diagnostics d;
    for (int k = 0; k < 25; ++k)
      d.warn("town.shp", "feature " + std::to_string(k), "ring of " + std::to_string(k) + ".5 m is open");
    d.error("town.shp", "feature 3", "has no height");
    d.leftOut.push_back({"buildings", 2, "no height"});
    d.leftOut.push_back({"trees", 0, "none"});
    console.report(d);
  }
  const std::string text = err.str();
  EXPECT_THAT(text, HasSubstr("warning: town.shp: feature 9: ring of 9.5 m is open\n"));
  EXPECT_THAT(text, Not(HasSubstr("feature 10:")));
  EXPECT_THAT(text, HasSubstr("warning: town.shp: and 15 more of this kind\n"));
  EXPECT_THAT(text, HasSubstr("error: town.shp: feature 3: has no height\n"));
  EXPECT_THAT(text, HasSubstr("left out: 2 buildings: no height"));
  EXPECT_THAT(text, Not(HasSubstr("trees")));
  EXPECT_EQ(out.str(), "");
}

TEST(Console, ProgressIsOneLineAStageElsewhereAndRewrittenInATerminal) {
  std::ostringstream out, plain, terminal;
  for (std::ostringstream* err : {&plain, &terminal}) {
    Console console({out, *err, err == &terminal, "", ""});
    for (const double f : {0.0, 0.5, 0.501, 1.0}) console.progress("reading", f);
    console.progress("sorting", std::nan(""));
    console.say("done");
  }
  EXPECT_EQ(plain.str(), "reading\nsorting\ndone\n");
  EXPECT_THAT(terminal.str(), HasSubstr("\r\x1b[Kreading 50 %"));
  EXPECT_THAT(terminal.str(), testing::EndsWith("\r\x1b[Kdone\n")) << "the line is wiped before a message";
}

}  // namespace
}  // namespace vicus::app
