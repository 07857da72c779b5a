// Gamepad, recorded tours and what the window says.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "viewer/film.hpp"
#include "viewer/gamepad.hpp"
#include "viewer/panel.hpp"
#include "viewer/path_file.hpp"
#include "viewer/pictures.hpp"
#include "viewer/recorder.hpp"
#include "viewer/tours.hpp"

namespace vicus::viewer {
namespace {

using testing::HasSubstr;

TEST(Gamepad, SticksMoveAndLookAndRestInTheMiddle) {
  Gamepad pad;
  pad.axes = {0.1f, -0.1f, 0.05f, 0, -1, -1};
  Input rest;
  addGamepad(pad, {}, rest);
  EXPECT_EQ(rest.stick, glm::dvec2(0));
  EXPECT_EQ(rest.turnStick, glm::dvec2(0));
  pad.axes = {0, -1, 1, 0, -1, -1};
  Input input;
  addGamepad(pad, {}, input);
  EXPECT_NEAR(input.stick.y, 1, 1e-9) << "up on the stick is forward";
  EXPECT_NEAR(input.turnStick.x, 1, 1e-9);
  pad.axes[0] = std::nanf("");
  addGamepad(pad, {}, input);
  EXPECT_TRUE(std::isfinite(input.stick.x + input.stick.y));
}

TEST(Gamepad, ButtonsCountOnceForEachPress) {
  Gamepad before, now;
  now.buttons[1] = 1;  // B
  now.buttons[3] = 1;  // Y
  Input first, held;
  addGamepad(now, before, first);
  EXPECT_TRUE(first.takeBack);
  EXPECT_EQ(first.mode, Mode::Map);
  addGamepad(now, now, held);
  EXPECT_FALSE(held.takeBack);
  EXPECT_FALSE(held.mode);
}

TEST(Recorder, ARecordedWayIsReadBackAndPlayedWhereItWas) {
  Recorder recorder;
  recorder.note(0, {});
  EXPECT_FALSE(recorder.end()) << "nothing was begun";
  recorder.begin("my way");
  std::vector<std::pair<double, city::ViewPose>> way;
  for (int k = 0; k <= 200; ++k) {
    const double t = 0.03 * k;
    way.push_back({t, {{3 * std::sin(t), 1.4 * t, 1.65}, 3.0 + 0.4 * t, 0.1 * std::sin(2 * t), 0}});  // over ±π
    recorder.note(100 + t, way.back().second);
  }
  const auto tour = recorder.end();
  ASSERT_TRUE(tour);
  EXPECT_FALSE(recorder.recording());
  EXPECT_LT(tour->keys.size(), 30u);
  city::Diagnostics diagnostics;
  const auto read = parsePath(pathText(*tour), "way.json", diagnostics);
  ASSERT_TRUE(read);
  EXPECT_TRUE(diagnostics.messages.empty());
  EXPECT_EQ(read->name, "my way");
  EXPECT_NEAR(durationOf(*read), 6, 1e-9);
  for (const auto& [t, pose] : way) {
    const city::ViewPose played = poseAt(*read, t);
    EXPECT_LT(glm::distance(played.eye, pose.eye), 0.03) << t;
    EXPECT_LT(std::abs(std::remainder(played.heading - pose.heading, 6.283185307179586)), 0.01) << t;
    EXPECT_LT(std::abs(played.pitch - pose.pitch), 0.01) << t;
  }
}

/// How many pixels differ from the first one's colour.
size_t inked(const Picture& picture) {
  size_t count = 0;
  for (size_t p = 3; p < picture.rgb.size(); p += 3)
    count += picture.rgb[p] != picture.rgb[0] || picture.rgb[p + 1] != picture.rgb[1];
  return count;
}

TEST(Panel, HasLettersAndFitsTheWindow) {
  const Picture help = drawPanel(helpLines(), 1, {1920, 1080});
  EXPECT_GT(inked(help), 3000u) << "is the package fonts-dejavu-core there?";
  EXPECT_LT(help.height, 700);
  for (const glm::ivec2 largest : {glm::ivec2(600, 330), {300, 200}, {20, 20}, {1, 1}, {0, 0}}) {
    const Picture small = drawPanel(helpLines(), 1, largest);
    EXPECT_LE(small.width, std::max(largest.x, 1));
    EXPECT_LE(small.height, std::max(largest.y, 1));
    EXPECT_EQ(small.rgb.size(), 3u * static_cast<size_t>(small.width) * static_cast<size_t>(small.height));
  }
  EXPECT_GT(drawPanel(helpLines(), 2, {4000, 4000}).height, 3 * help.height / 2) << "larger letters on fine screens";
}

TEST(Panel, LoadingGrowsAndErrorsAreWritten) {
  size_t last = 0;
  for (const double fraction : {0.0, 0.5, 1.0, 7.0, std::nan("")}) {
    const Picture p = drawLoading({640, 360}, 1, "norvic", "raising the land", fraction);
    EXPECT_EQ(p.width, 640);
    if (!(fraction <= 1)) continue;
    EXPECT_GE(inked(p), last) << fraction;
    last = inked(p);
  }
  const std::vector<std::string> none, one{"town.shp: cannot be opened"};
  EXPECT_GT(inked(drawError({640, 360}, 1, "town.shp", one)), inked(drawError({640, 360}, 1, "town.shp", none)) + 200);
}

TEST(Pictures, NotesGoIntoTheFile) {
  const auto path = std::filesystem::temp_directory_path() / "vicus_notes.png";
  const Picture picture{4, 2, std::vector<uint8_t>(24, 90)};
  const std::vector<std::pair<std::string, std::string>> notes{
      {"Title", "norvic"}, {"Description", "from the bridge"}, {"CRS", "local metres"}};
  ASSERT_EQ(writePng(path, picture, notes), "");
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [name, text] : notes) EXPECT_THAT(bytes, HasSubstr(name + std::string(1, '\0') + text));
  std::filesystem::remove(path);
}

TEST(Film, TheSamePicturesGiveTheSameBytes) {
  const auto folder = std::filesystem::temp_directory_path() / "vicus_film";
  std::string bytes[2];
  for (std::string& file : bytes) {
    std::filesystem::remove_all(folder);
    const auto path = folder / "film.mp4";
    std::string error;
    const auto film = Film::open(path, {65, 48}, 25, error);
    ASSERT_TRUE(film) << error;
    for (int k = 0; k < 30; ++k) {
      Picture picture{65, 48, std::vector<uint8_t>(3 * 65 * 48)};
      for (size_t p = 0; p < picture.rgb.size(); ++p)
        picture.rgb[p] = static_cast<uint8_t>(p / 7 + 5 * static_cast<size_t>(k));
      ASSERT_EQ(film->add(picture), "");
    }
    EXPECT_FALSE(std::filesystem::exists(path)) << "not before it is whole";
    EXPECT_THAT(film->add({10, 10, std::vector<uint8_t>(300)}), HasSubstr("10 × 10 in a film of 64 × 48"));
    ASSERT_EQ(film->finish(), "");
    std::ifstream in(path, std::ios::binary);
    file.assign(std::istreambuf_iterator<char>(in), {});
  }
  EXPECT_GT(bytes[0].size(), 1000u);
  EXPECT_EQ(bytes[0], bytes[1]);
  std::filesystem::remove_all(folder);
}

TEST(Film, WhatCannotBeIsSaid) {
  std::string error;
  EXPECT_FALSE(Film::open("/proc/no/film.mp4", {64, 48}, 25, error));
  EXPECT_THAT(error, HasSubstr("cannot be made"));
  EXPECT_FALSE(Film::open("film.mp4", {1, 1}, 25, error));
  EXPECT_THAT(error, HasSubstr("2 × 2"));
  EXPECT_FALSE(Film::open("film.mp4", {64, 48}, 0, error));
  EXPECT_TRUE(isFilmName("a/b.mp4"));
  EXPECT_FALSE(isFilmName("a/b"));
}

}  // namespace
}  // namespace vicus::viewer
