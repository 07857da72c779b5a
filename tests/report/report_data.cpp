#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/findings.hpp"
#include "report/page.hpp"
#include "report/plot.hpp"
#include "report/write_csv.hpp"
#include "report/write_json.hpp"
#include "synthetic.hpp"

namespace vicus::report {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::syntheticReport;

TEST(ReportJson, RoundTrip) {
  const std::string text = reportJson(syntheticReport());
  std::string error;
  const auto again = parseReport(text, error);
  ASSERT_TRUE(again) << error;
  EXPECT_EQ(reportJson(*again), text);
}

TEST(ReportJson, HasTheShapeThatIsPromised) {
  const auto json = nlohmann::json::parse(reportJson(syntheticReport()));
  const auto& run = json["runs"][0];
  EXPECT_EQ(run["name"], "all_off");
  for (const char* key : {"path", "scene", "renderer", "size", "frames", "knobs", "features", "run_time_ms", "counts",
                          "memory_mb", "error"})
    EXPECT_TRUE(run.contains(key)) << key;
  for (const char* key :
       {"falsely_culled_pixels", "drawn_over_visible", "rmse", "psnr", "flip", "popping", "geometric_px"})
    EXPECT_TRUE(run["error"].contains(key)) << key;
  EXPECT_TRUE(run["run_time_ms"]["frame"].contains("p99"));
  EXPECT_TRUE(run["run_time_ms"]["stages"]["draw"].contains("median"));
  EXPECT_TRUE(run["counts"]["triangles"].contains("mean"));
  for (const char* key : {"speedups", "curves", "stability", "left_out"}) EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_TRUE(json["curves"][0]["points"][0].contains("ms"));
  EXPECT_TRUE(json["stability"][0].contains("case"));
}

TEST(ReportJson, WhatIsNotANumberIsNull) {
  ReportData report;
  RunFigures& run = report.runs.emplace_back();
  run.error.flip = std::numeric_limits<double>::infinity();
  run.frameMedian.value = NAN;
  run.name = "broken \xff name";
  const auto json = nlohmann::json::parse(reportJson(report));
  EXPECT_TRUE(json["runs"][0]["error"]["flip"].is_null());
  EXPECT_TRUE(json["runs"][0]["error"]["rmse"].is_null());
}

TEST(ReportJson, OtherTextIsAnError) {
  std::string error;
  EXPECT_FALSE(parseReport("{", error));
  EXPECT_FALSE(error.empty());
  EXPECT_FALSE(parseReport("[1]", error));
  EXPECT_FALSE(parseReport(R"({"runs": "none"})", error));
  EXPECT_TRUE(parseReport("{}", error));
}

TEST(ReportCsv, EveryLineHasTheSameFields) {
  ReportData report = syntheticReport();
  report.runs[0].path = "a, \"quoted\" path";
  const std::string csv = reportCsv(report);
  EXPECT_THAT(csv, HasSubstr("\"a, \"\"quoted\"\" path\""));
  size_t fields = 0;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    bool inQuotes = false;
    size_t commas = 0;
    for (const char c : line) {
      if (c == '"') inQuotes = !inQuotes;
      if (c == ',' && !inQuotes) ++commas;
    }
    if (fields == 0) fields = commas;
    EXPECT_EQ(commas, fields) << line;
  }
}

TEST(FindFaults, NoneInAGoodReport) {
  EXPECT_THAT(findFaults(syntheticReport()), IsEmpty());
}

TEST(FindFaults, NamesWhatIsLost) {
  ReportData report = syntheticReport();
  report.runs[3].error.falselyCulledPixels = 214;
  report.runs[3].error.lostItems = {77, 1203};
  EXPECT_THAT(findFaults(report),
              Contains("all_on on street leaves out what can be seen: 214 pixels are lost, of items "
                       "77, 1203."));
}

TEST(FindFaults, NamesASlowStage) {
  ReportData report = syntheticReport();
  for (auto& [name, least] : report.runs[3].leastStages)
    if (name == "frustum buildings") least = 9;
  EXPECT_THAT(findFaults(report),
              Contains(HasSubstr("The stage \"frustum buildings\" is slow in all_on on street: at least 9.00 ms")));
}

TEST(FindFaults, NamesAMovedPicture) {
  ReportData report = syntheticReport();
  report.runs[3].error.shift = {1, 0};
  EXPECT_THAT(findFaults(report),
              Contains("The pictures of all_on on street are moved against the reference by 1 pixels "
                       "to the right and 0 down."));
}

TEST(FindFaults, NamesATechniqueThatDoesNotPay) {
  ReportData report = syntheticReport();
  report.speedups.push_back({"all_on", "street", "all_on_less_frustum_culling", {2, 1.9, 2.1}});
  report.speedups.push_back({"all_on", "street", "all_on_less_state_ordering", {0.5, 0.4, 0.6}});
  EXPECT_THAT(findFaults(report),
              ::testing::ElementsAre(HasSubstr("state_ordering costs more than it saves on street: everything on "
                                               "takes 2.00 times as long")));
}

TEST(FindFaults, NamesARowOutOfBound) {
  ReportData report = syntheticReport();
  report.stability.push_back(city::stabilityRow("frustum", "eye at 50 km", "visible boxes culled", 3, 0));
  EXPECT_THAT(findFaults(report), Contains(HasSubstr("frustum, eye at 50 km: visible boxes culled is 3")));
}

/// Says only the text that is missing or too much, not the whole page.
bool has(const std::string& page, std::string_view text) {
  return page.find(text) != std::string::npos;
}

TEST(ReportPage, StandsAlone) {
  const std::string page = reportPage(syntheticReport());
  for (const char* text : {"data:image/png;base64,", "Only frustum culling", "Perfect visibility", "roam.pixel_error",
                           "4 of 4 within bounds", "no bodies of water", "</html>"})
    EXPECT_TRUE(has(page, text)) << text;
  for (const char* text : {"http://", "https://", ">nan", "\"nan", " nan ", "inf "})
    EXPECT_FALSE(has(page, text)) << text;
}

TEST(ReportPage, EscapesNames) {
  ReportData report = syntheticReport();
  report.scene = "<script>alert(1)</script>";
  EXPECT_FALSE(has(reportPage(report), "<script>alert"));
}

TEST(ReportPage, ShowsFaultsAtTheTop) {
  ReportData report = syntheticReport();
  report.findings = {"all_on on street leaves out what can be seen"};
  const std::string page = reportPage(report);
  EXPECT_LT(page.find("Faults found"), page.find("All configurations"));
  EXPECT_TRUE(has(page, report.findings[0]));
}

TEST(ReportPage, AnEmptyReportIsAPageToo) {
  const std::string page = reportPage({});
  EXPECT_TRUE(has(page, "Not finished"));
  EXPECT_TRUE(has(page, "</html>"));
}

TEST(ErrorTimePlot, PointsThatCannotBeDrawnAreLeftOut) {
  EXPECT_EQ(errorTimePlot({}, {}), "");
  EXPECT_EQ(errorTimePlot({{"a", true, {{{NAN, 0, 0}, 1, "", "", false}, {{0, 0, 0}, 1, "", "", false}}}}, {}), "");
  // One point alone, and only errors of 0.
  EXPECT_TRUE(has(errorTimePlot({{"a", true, {{{5, 5, 5}, 0, "one", "", true}}}}, {}), "one"));
}

TEST(ShortNumber, KeepsThreeDigits) {
  EXPECT_EQ(shortNumber(0), "0");
  EXPECT_EQ(shortNumber(0.03124), "0.0312");
  EXPECT_EQ(shortNumber(4.2749), "4.27");
  EXPECT_EQ(shortNumber(99.96), "100");
  EXPECT_EQ(shortNumber(9.999), "10.0");
  EXPECT_EQ(shortNumber(1240000), "1.24 M");
  EXPECT_EQ(shortNumber(10381), "10.4 k");
  EXPECT_EQ(shortNumber(3e-7), "3.0e-07");
  EXPECT_EQ(shortNumber(-2.5), "-2.50");
  EXPECT_EQ(shortNumber(NAN), "–");
}

}  // namespace
}  // namespace vicus::report
