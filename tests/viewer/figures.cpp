#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "city/random.hpp"
#include "small_cities.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/measure.hpp"
#include "viewer/path_file.hpp"
#include "viewer/pictures.hpp"
#include "viewer/whole_file.hpp"

namespace vicus::viewer {
namespace {

using testing::HasSubstr;

// ---- Percentiles ----

TEST(Percentile, ByHand) {
  std::vector<double> samples{4, 1, 3, 2};
  EXPECT_EQ(percentile(samples, 0), 1);
  EXPECT_EQ(percentile(samples, 1), 4);
  EXPECT_NEAR(percentile(samples, 0.95), 3.85, 1e-12);
  EXPECT_EQ(percentile(samples, 7), 4);
  EXPECT_TRUE(std::isnan(percentile({}, 0.5)));
}

TEST(Percentiles, NoneOneAndTwo) {
  EXPECT_EQ(percentiles({}).max, 0);
  const std::vector<double> one{7};
  EXPECT_EQ(percentiles(one).median, 7);
  EXPECT_EQ(percentiles(one).p99, 7);
  const std::vector<double> two{10, 20};
  EXPECT_EQ(percentiles(two).median, 15);
  EXPECT_NEAR(percentiles(two).p95, 19.5, 1e-12);
  EXPECT_EQ(percentiles(two).max, 20);
}

TEST(Percentiles, OneToAHundredAndOne) {
  std::vector<double> values;
  for (int k = 101; k >= 1; --k) values.push_back(k);
  const Percentiles p = percentiles(values);
  EXPECT_EQ(p.median, 51);
  EXPECT_EQ(p.p95, 96);
  EXPECT_EQ(p.p99, 100);
  EXPECT_EQ(p.max, 101);
}

TEST(Percentiles, LeaveOutWhatIsNotFinite) {
  const std::vector<double> values{std::nan(""), 3, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(percentiles(values).max, 3);
}

TEST(MeanMax, OfCounts) {
  EXPECT_EQ(meanMax({}).mean, 0);
  const std::vector<double> values{2, 4, 9};
  EXPECT_EQ(meanMax(values).mean, 5);
  EXPECT_EQ(meanMax(values).max, 9);
}

TEST(PeakResident, IsSomething) {
  EXPECT_GT(peakResidentBytes(), 1000000u);
}

TEST(TimesOf, StagesInTheOrderOfTheirAppearance) {
  std::vector<FrameRecord> records(2);
  records[0].milliseconds = 10, records[1].milliseconds = 30;
  records[0].stages = {{"input", 1}, {"swap", 2}};
  records[1].stages = {{"input", 3}, {"frustum", 5}, {"swap", 2}};
  const RunTimes times = timesOf(records);
  EXPECT_EQ(times.frame.median, 20);
  ASSERT_EQ(times.stages.size(), 3u);
  EXPECT_EQ(times.stages[0].first, "input");
  EXPECT_EQ(times.stages[0].second.max, 3);
  EXPECT_EQ(times.stages[2].second.median, 5) << "of the frames that had the stage";
}

// ---- Pictures ----

class PictureFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("vicus-pictures-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  size_t files() const {
    size_t count = 0;
    if (std::filesystem::exists(folder_))
      for ([[maybe_unused]] const auto& f : std::filesystem::directory_iterator(folder_)) ++count;
    return count;
  }
  std::filesystem::path folder_;
};

Picture noise(int width, int height) {
  Picture p{width, height, std::vector<uint8_t>(static_cast<size_t>(3 * width * height))};
  city::Random random(5);
  for (uint8_t& v : p.rgb) v = static_cast<uint8_t>(random.below(256));
  return p;
}

TEST_F(PictureFiles, RoundTripIsExactAndLeavesNothingBeside) {
  const Picture picture = noise(37, 21);
  const auto file = folder_ / "deep" / "a picture.png";
  ASSERT_EQ(writePng(file, picture), "");
  ASSERT_EQ(writePng(file, picture), "") << "writing over is no failure";
  std::string error;
  const auto back = readPicture(file, error);
  ASSERT_TRUE(back) << error;
  EXPECT_EQ(back->width, 37);
  EXPECT_EQ(back->rgb, picture.rgb);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deep" / "a picture.png.part"));
}

TEST_F(PictureFiles, APlaceThatCannotBeWrittenIsNamed) {
  std::filesystem::create_directories(folder_ / "there.png");  // a folder stands in the way
  const std::string problem = writePng(folder_ / "there.png", noise(4, 4));
  EXPECT_THAT(problem, HasSubstr("there.png: cannot be written"));
  EXPECT_EQ(files(), 1u) << "the half-made file is taken away";
  std::ofstream(folder_ / "file") << "x";
  EXPECT_THAT(writePng(folder_ / "file" / "a.png", noise(4, 4)), HasSubstr("the folder cannot be made"));
}

TEST_F(PictureFiles, WholeFilesReplaceWhatWasThere) {
  ASSERT_EQ(writeWhole(folder_ / "deep" / "a.txt", "one, longer"), "");
  ASSERT_EQ(writeWhole(folder_ / "deep" / "a.txt", "two"), "");
  std::string text;
  std::getline(std::ifstream(folder_ / "deep" / "a.txt"), text);
  EXPECT_EQ(text, "two");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deep" / "a.txt.part"));
  EXPECT_THAT(writeWhole(folder_ / "deep" / "a.txt" / "b.txt", "x"), HasSubstr("b.txt"));
}

TEST_F(PictureFiles, PixelsMustBeThere) {
  std::string error;
  EXPECT_TRUE(pngBytes({}, error).empty());
  EXPECT_THAT(error, HasSubstr("has 0 bytes"));
  EXPECT_THAT(writePng(folder_ / "a.png", {4, 4, std::vector<uint8_t>(5)}), HasSubstr("has 5 bytes"));
  EXPECT_THAT(writePng(folder_ / "a.png", {0, 0, {}}), HasSubstr("not written"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(PictureFiles, WhatIsNoPictureIsSaid) {
  std::string error;
  EXPECT_FALSE(readPicture(folder_ / "nothing.png", error));
  EXPECT_THAT(error, HasSubstr("nothing.png: cannot be read"));
}

TEST(Compare, CountsPixelsNotChannels) {
  Picture a{2, 2, std::vector<uint8_t>(12, 100)}, b = a;
  EXPECT_EQ(compare(a, b).differingPixels, 0u);
  b.rgb[0] = 103, b.rgb[1] = 90, b.rgb[11] = 101;
  const PictureDifference d = compare(a, b);
  EXPECT_EQ(d.largest, 10);
  EXPECT_EQ(d.differingPixels, 2u);
  EXPECT_EQ(d.share, 0.5);
  EXPECT_EQ(compare(a, b, 1).differingPixels, 1u);
  EXPECT_EQ(compare(a, Picture{4, 1, std::vector<uint8_t>(12)}).share, 1);
}

// ---- Item buffers ----

TEST(ItemCheck, KnowsWhatThePlanLists) {
  city::City city = test::gridTown(5, 2);
  city.monuments.resize(3);
  city::FramePlan plan;
  plan.buildings.drawn = {{1, 2}, {5, 1}};
  plan.monuments = {2};
  const bool drawn[] = {false, true, true, false, false, true, false, false, false, false};
  for (uint32_t i = 0; i < 10; ++i) EXPECT_EQ(plansItem(city, plan, city.itemOfBuilding(i)), drawn[i]) << i;
  EXPECT_FALSE(plansItem(city, plan, city.itemOfMonument(0)));
  EXPECT_TRUE(plansItem(city, plan, city.itemOfMonument(2)));
  for (const uint32_t item : {0u, city.itemCount(), city::kItemOther}) EXPECT_FALSE(plansItem(city, plan, item));
}

TEST(ItemCheck, CountsLostPixelsAndDifferences) {
  const city::City city = test::gridTown(5, 2);
  city::FramePlan plan;
  plan.buildings.drawn = {{0, 4}};
  const ItemBuffer full{4, 2, {0, 1, 1, 7, 7, 9, city::kItemOther, 2}};
  // Where 7 was lost, what stood behind shows; a planned one may differ without being lost.
  const ItemBuffer planned{4, 2, {0, 1, 1, 0, 2, 2, 0, 3}};
  const ItemCheck check = checkItems(city, plan, full, planned);
  EXPECT_EQ(check.lostPixels, 3u);
  EXPECT_THAT(check.lostItems, testing::ElementsAre(7u, 9u));
  EXPECT_EQ(check.shownPixels, 6u);
  EXPECT_EQ(check.differingPixels, 5u);
}

TEST(ItemCheck, NothingIsLostWhenAllIsPlanned) {
  const city::City city = test::gridTown(5, 2);
  city::FramePlan plan;
  plan.buildings.drawn = {{0, 10}};
  const ItemBuffer full{2, 1, {1, 10}};
  EXPECT_EQ(checkItems(city, plan, full, full).lostPixels, 0u);
  EXPECT_EQ(checkItems(city, plan, full, full).differingPixels, 0u);
}

// ---- Path files ----

std::string pathProblem(std::string_view text) {
  city::Diagnostics diagnostics;
  EXPECT_FALSE(parsePath(text, "my.json", diagnostics));
  EXPECT_EQ(diagnostics.messages.size(), 1u);
  return diagnostics.messages.empty() ? "" : describe(diagnostics.messages[0]);
}

TEST(PathFile, ReadsKeysInDegrees) {
  city::Diagnostics diagnostics;
  const auto path = parsePath(R"({"name": "to the market", "keys": [
      {"time": 0, "position": [1, 2, 3], "heading": 90, "pitch": -45},
      {"time": 2.5, "position": [4, 5, 6]}]})",
                              "my.json", diagnostics);
  ASSERT_TRUE(path);
  EXPECT_TRUE(diagnostics.messages.empty());
  EXPECT_EQ(path->name, "to the market");
  EXPECT_FALSE(path->jumps);
  ASSERT_EQ(path->keys.size(), 2u);
  EXPECT_NEAR(path->keys[0].heading, 1.5707963, 1e-6);
  EXPECT_NEAR(path->keys[0].pitch, -0.7853981, 1e-6);
  EXPECT_EQ(path->keys[1].position, glm::dvec3(4, 5, 6));
  EXPECT_EQ(path->keys[1].time, 2.5);
}

TEST(PathFile, TheFileNamesAPathWithoutName) {
  city::Diagnostics diagnostics;
  const auto path =
      parsePath(R"({"jumps": true, "keys": [{"time": 0, "position": [1, 2, 3]}]})", "/a/b/tour one.json", diagnostics);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->name, "tour one");
  EXPECT_TRUE(path->jumps);
}

TEST(PathFile, MessagesNameFileAndPlace) {
  EXPECT_EQ(pathProblem("{\n  \"keys\": [,]\n}"), "my.json: line 2, column 12: is not JSON from here on");
  EXPECT_THAT(pathProblem(""), HasSubstr("my.json: line 1, column 1: is not JSON"));
  EXPECT_THAT(pathProblem("[]"), HasSubstr("is not an object with \"keys\""));
  EXPECT_THAT(pathProblem(R"({"keys": []})"), HasSubstr("my.json: keys: is not a list of at least one key"));
  EXPECT_THAT(pathProblem(R"({"keys": [3]})"), HasSubstr("keys[0]: is not an object"));
  EXPECT_THAT(pathProblem(R"({"keys": [{"position": [1,2,3]}]})"), HasSubstr("keys[0]: has no \"time\""));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": 0}]})"), HasSubstr("keys[0]: has no \"position\""));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": 0, "position": [1, 2]}]})"),
              HasSubstr("keys[0].position: is not three numbers [x, y, z]: [1,2]"));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": "now", "position": [1, 2, 3]}]})"),
              HasSubstr("keys[0].time: is not a number: \"now\""));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": 0, "position": [1, 2, 3], "pitch": 91}]})"),
              HasSubstr("keys[0].pitch: is 91; it goes from -90"));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": 1, "position": [1,2,3]}, {"time": 1, "position": [1,2,3]}]})"),
              HasSubstr("keys[1].time: is 1, not after the key before (1)"));
  EXPECT_THAT(pathProblem(R"({"keys": [{"time": 1e999, "position": [1,2,3]}]})"), HasSubstr("my.json"));
  EXPECT_THAT(pathProblem("{\"keys\": [{\"time\": 0, \"position\": [1,2,3]}], \"name\": \"\xff\"}"),
              HasSubstr("my.json: line 1"));
}

TEST(PathFile, UnknownFieldsAreToldAndPassedOver) {
  city::Diagnostics diagnostics;
  EXPECT_TRUE(parsePath(R"({"keys": [{"time": 0, "position": [1,2,3], "headding": 5}]})", "my.json", diagnostics));
  ASSERT_EQ(diagnostics.messages.size(), 1u);
  EXPECT_EQ(describe(diagnostics.messages[0]), "my.json: keys[0]: \"headding\" means nothing here and is passed over");
  EXPECT_FALSE(diagnostics.hasErrors());
}

TEST(PathFile, AMissingFileIsNamed) {
  city::Diagnostics diagnostics;
  EXPECT_FALSE(readPath("/nowhere/path.json", diagnostics));
  EXPECT_EQ(describe(diagnostics.messages.at(0)), "/nowhere/path.json: cannot be opened");
}

}  // namespace
}  // namespace vicus::viewer
