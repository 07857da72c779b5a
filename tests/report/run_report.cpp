/// The instrument is tested before it is trusted: faults are planted, and the report must find and name each.
#include "report/run_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

#include "plan/planner.hpp"
#include "plan/techniques.hpp"
#include "report/budget.hpp"
#include "report/configurations.hpp"
#include "report/stability.hpp"
#include "report/write_json.hpp"
#include "scenegraph/scene.hpp"
#include "tests/report/all_knobs.hpp"
#include "tests/viewer/small_cities.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::report {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// As little as shows everything once.
Amounts fewest() {
  Amounts a;
  a.size = {128, 72};
  a.warmUpFrames = 1;
  a.timedFrames = 4;
  a.pictureViews = 2;
  a.timedItemSize = {256, 144};
  a.itemSize = {320, 180};
  a.itemViews = 2;
  a.leftOutFrames = 2;
  a.approachFrames = 2;
  a.poppingOfAll = false;
  a.curvePoints = 2;
  a.curveFrames = 2;
  a.curveViews = 1;
  a.shortTours = true;
  a.tours = {"street", "flyover"};
  a.stability = false;
  return a;
}

std::vector<std::string> configurationNames() {
  std::vector<std::string> names;
  for (const Configuration& c : configurations(allKnobs(), plan::techniques())) names.push_back(c.name);
  return names;
}

class RunReport : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    if (!viewer::makeOffscreenContext(error)) GTEST_SKIP() << "nothing to draw with: " << error;
  }

  ReportData run(ReportOptions options) {
    options.scene = "town";
    std::string error;
    const auto data = runReport(town_, allKnobs(), {}, options, error);
    EXPECT_TRUE(data) << error;
    return data.value_or(ReportData{});
  }

  /// A tour with only the configurations that a fault needs, to be quick.
  static ReportOptions few(const char* tour, std::vector<std::string> configurations) {
    ReportOptions options{.amounts = fewest()};
    options.amounts.tours = {tour};
    options.amounts.only = std::move(configurations);
    options.amounts.curvePoints = 0;
    return options;
  }

  const city::City town_ = test::gridTown(40, 25);
};

TEST_F(RunReport, HasEveryConfigurationAndFigure) {
  ReportOptions options{.amounts = fewest()};
  int kept = 0;
  options.keep = [&](const ReportData&) { ++kept; };
  double last = 0;
  options.progress = [&](std::string_view, double fraction, double secondsLeft) {
    EXPECT_GE(fraction, last);
    EXPECT_GE(secondsLeft, 0);
    last = fraction;
  };
  const ReportData data = run(options);
  EXPECT_TRUE(data.complete);
  EXPECT_GE(kept, 3);  // after each tour and at the end
  EXPECT_NEAR(last, 1, 0.05);

  std::multiset<std::string> street, flyover;
  for (const RunFigures& r : data.runs) (r.path == "street" ? street : flyover).insert(r.name);
  EXPECT_THAT(street, ::testing::UnorderedElementsAreArray(configurationNames()));
  EXPECT_THAT(flyover, UnorderedElementsAre("all_off", "all_on", "limit"));
  for (const RunFigures& r : data.runs) {
    EXPECT_EQ(r.frames, 4) << r.name;
    EXPECT_GT(r.frame.median, 0) << r.name;
    EXPECT_EQ(r.error.falselyCulledPixels, 0) << r.name << " on " << r.path;
    EXPECT_GE(r.error.drawnOverVisible.value_or(0), 1) << r.name;
    EXPECT_GT(r.error.flip.value_or(0), 0) << r.name;
    EXPECT_LT(r.error.flip.value_or(1), 0.2) << r.name;
    EXPECT_EQ(r.error.geometricPixels, 0) << r.name;
    EXPECT_EQ(r.error.shift, (std::array<int, 2>{0, 0})) << r.name;
  }
  // Perfect visibility draws what is visible and nothing else; culling lies between that and everything.
  const auto overdraw = [&](const char* name) { return *findRun(data, name, "street")->error.drawnOverVisible; };
  EXPECT_EQ(overdraw("limit"), 1);
  EXPECT_GE(overdraw("all_on"), 1);
  EXPECT_LT(overdraw("all_on"), overdraw("all_off"));
  EXPECT_EQ(overdraw("all_off"), overdraw("only_state_ordering"));
  // Pictures do not depend on what is left out behind the eye.
  EXPECT_EQ(findRun(data, "all_off", "street")->error.flip,
            findRun(data, "only_frustum_culling", "street")->error.flip);

  const auto curve = std::ranges::find(data.curves, "viewer.multisamples", &Curve::knob);
  ASSERT_NE(curve, data.curves.end());
  ASSERT_EQ(curve->points.size(), 2U);
  EXPECT_GT(curve->points[0].error.flip, curve->points[1].error.flip);  // 1 sample against 8
  // The town has houses and nothing else: what the rest would cost is measured.
  for (const char* part : {"terrain", "water", "trees", "monuments"}) {
    const auto left = std::ranges::find(data.leftOut, part, &LeftOutFigures::what);
    ASSERT_NE(left, data.leftOut.end()) << part;
    EXPECT_TRUE(left->savedMilliseconds) << part;
    EXPECT_GT(left->savedMb.value_or(0), 0) << part;
  }
  EXPECT_FALSE(data.pictures.empty());
  EXPECT_FALSE(data.speedups.empty());
  std::string error;
  EXPECT_TRUE(parseReport(reportJson(data), error)) << error;
}

TEST_F(RunReport, FindsACullerThatDropsOneInAThousand) {
  ReportOptions options = few("flyover", {"all_off", "all_on"});
  options.interference.plan = [](const std::string& run, city::FramePlan& plan) {
    if (run != "all_on") return;
    // Cuts one of the town's 1 000 houses out of the runs that are drawn.
    constexpr uint32_t kHouse = 500;
    std::vector<city::Range> drawn;
    for (const city::Range& r : plan.buildings.drawn) {
      if (kHouse < r.first || kHouse >= r.end()) {
        drawn.push_back(r);
        continue;
      }
      if (kHouse > r.first) drawn.push_back({r.first, kHouse - r.first});
      if (kHouse + 1 < r.end()) drawn.push_back({kHouse + 1, r.end() - kHouse - 1});
    }
    plan.buildings.drawn = std::move(drawn);
  };
  const ReportData data = run(options);
  EXPECT_THAT(data.findings, Contains(::testing::AllOf(HasSubstr("all_on on flyover leaves out what can be seen"),
                                                       HasSubstr("of items 501."))));
  EXPECT_THAT(data.findings, Not(Contains(HasSubstr("all_off"))));
}

TEST_F(RunReport, FindsASlowStage) {
  ReportOptions options = few("street", {"all_on", "visibility"});
  options.interference.plan = [](const std::string& run, city::FramePlan& plan) {
    if (run != "all_on") return;
    constexpr int kMilliseconds = 100;  // stands out of a frame on a busy machine, too
    std::this_thread::sleep_for(std::chrono::milliseconds(kMilliseconds));
    for (city::StageTime& stage : plan.stages)
      if (stage.name == "frustum buildings") stage.milliseconds += kMilliseconds;
  };
  EXPECT_THAT(run(options).findings,
              Contains(HasSubstr("The stage \"frustum buildings\" is slow in all_on on street")));
}

TEST_F(RunReport, FindsAPictureThatIsMovedByOnePixel) {
  ReportOptions options = few("flyover", {"all_off", "limit"});
  options.amounts.size = {320, 180};
  options.interference.picture = [](const std::string& run, viewer::Picture& picture) {
    if (run != "limit") return;
    for (int y = 0; y < picture.height; ++y) {
      uint8_t* row = picture.rgb.data() + 3 * static_cast<size_t>(y) * static_cast<size_t>(picture.width);
      std::copy_backward(row, row + 3 * (picture.width - 1), row + 3 * picture.width);
    }
  };
  EXPECT_THAT(
      run(options).findings,
      Contains("The pictures of limit on flyover are moved against the reference by 1 pixels to the right and 0 "
               "down."));
}

TEST_F(RunReport, KeepsWhatItHasWhenStopped) {
  ReportOptions options = few("street", {"all_on"});
  options.amounts.tours.emplace_back("flyover");
  bool firstTourDone = false;
  ReportData kept;
  options.keep = [&](const ReportData& data) { firstTourDone = true, kept = data; };
  options.stop = [&] { return firstTourDone; };
  const ReportData data = run(options);
  EXPECT_FALSE(data.complete);
  EXPECT_EQ(data.runs.size(), 1U);
  EXPECT_EQ(kept.runs.size(), data.runs.size());
}

TEST_F(RunReport, CutsFramesBeforeConfigurationsWhenInAHurry) {
  ReportOptions options = few("street", {"all_off", "all_on", "limit"});
  options.amounts.seconds = 1e-3;
  options.amounts.tours = {"street"};
  const ReportData data = run(options);
  EXPECT_EQ(data.runs.size(), 3U);
  EXPECT_EQ(data.runs[0].frames, 2);
  EXPECT_THAT(data.notes, Contains("2 timed frames on street instead of 4, to end in time."));
}

TEST(QuickAmounts, TimeThatIsLeftOverIsTheNextPartsOwn) {
  Budget budget(100);
  EXPECT_EQ(budget.affordable(12, 4, 0.5, 2), 12);
  EXPECT_NEAR(budget.affordable(1000, 4, 0.5, 1), 50, 1);
  EXPECT_NEAR(budget.affordable(1000, 4, 1, 1), 100, 1);
  EXPECT_EQ(budget.affordable(12, 4, 0.5, 1e9), 4);
  EXPECT_EQ(budget.affordable(3, 4, 0.5, 1e9), 3) << "never more than was wanted";
  budget.setSeconds(10);
  EXPECT_EQ(budget.affordable(12, 4, 0.5, 1), 4);
  Budget none(0);
  EXPECT_EQ(none.affordable(12, 4, 0.5, 1e9), 12);
  none.setSeconds(10);
  EXPECT_FALSE(none.hurried());
}

TEST_F(RunReport, AnEmptyCityIsReportedToo) {
  city::City city;
  city::finishCity(city, {});
  ReportOptions options = few("street", {"all_off", "all_on", "limit"});
  std::string error;
  const auto data = runReport(city, allKnobs(), {}, options, error);
  ASSERT_TRUE(data) << error;
  EXPECT_THAT(data->findings, IsEmpty());
}

TEST(AllStability, EveryRowIsWithinItsBound) {
  const auto rows = allStability();
  EXPECT_GT(rows.size(), 20U);
  for (const city::StabilityRow& row : rows)
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " is " << row.figure << ", bound "
                        << row.bound;
}

}  // namespace
}  // namespace vicus::report
