#include "report/stage_trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace vicus::report {
namespace {

TEST(ChromeTrace, StagesFollowEachOtherInMicroseconds) {
  const std::vector<TracedFrame> frames{{0, {{"plan", 1.5}, {"draw", 2}}}, {5, {{"plan", 1}}}};
  const auto trace = nlohmann::json::parse(chromeTrace(frames));
  std::vector<nlohmann::json> bars;
  for (const auto& event : trace["traceEvents"])
    if (event["ph"] == "X") bars.push_back(event);
  ASSERT_EQ(bars.size(), 5U);
  EXPECT_EQ(bars[0]["name"], "frame 0");
  EXPECT_EQ(bars[0]["dur"], 3500);
  EXPECT_EQ(bars[1]["name"], "plan");
  EXPECT_EQ(bars[1]["ts"], 0);
  EXPECT_EQ(bars[2]["ts"], 1500);
  EXPECT_EQ(bars[2]["dur"], 2000);
  EXPECT_EQ(bars[3]["ts"], 5000);
}

TEST(ChromeTrace, BadTimesBecomeZero) {
  const std::vector<TracedFrame> frames{{NAN, {{"a \"quoted\" \xff name", -1}, {"b", INFINITY}}}};
  const auto trace = nlohmann::json::parse(chromeTrace(frames));
  EXPECT_EQ(trace["traceEvents"].back()["dur"], 0);
}

TEST(TracedFrames, FollowEachOtherWithoutAGap) {
  std::vector<viewer::FrameRecord> records(2);
  records[0].stages = {{"input", 1}, {"traverse", 4}};
  records[1].stages = {{"input", 2}};
  const auto frames = tracedFrames(records);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[1].start, 5);
  EXPECT_EQ(frames[0].stages[1].name, "traverse");
}

TEST(ChromeTrace, NoFrames) {
  EXPECT_TRUE(nlohmann::json::accept(chromeTrace({})));
}

}  // namespace
}  // namespace vicus::report
