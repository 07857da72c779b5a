#include "report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vicus::report {
namespace {

std::string where(const RunFigures& run) {
  return fmt::format("{} on {}", run.name, run.path);
}

void lostBuildings(const RunFigures& run, std::vector<std::string>& out) {
  const double pixels = run.error.falselyCulledPixels.value_or(0);
  if (pixels <= 0) return;
  std::string ids;
  for (const uint32_t id : run.error.lostItems) ids += fmt::format("{}{}", ids.empty() ? "" : ", ", id);
  out.push_back(
      fmt::format("{} leaves out what can be seen: {} pixels are lost, of items {}.", where(run), pixels, ids));
}

void movedPictures(const RunFigures& run, std::vector<std::string>& out) {
  const auto [x, y] = run.error.shift;
  if (x != 0 || y != 0)
    out.push_back(fmt::format(
        "The pictures of {} are moved against the reference by {} pixels to the right and {} down.", where(run), x, y));
}

double meanCount(const RunFigures& run, const char* name) {
  const viewer::MeanMax* count = find(run.counts, name);
  return count == nullptr ? 0 : count->mean;
}

/// Whether `a` has no more to do than `b`, within a tenth.
bool drawsNoMore(const RunFigures& a, const RunFigures& b) {
  return std::ranges::all_of(std::vector{"triangles", "draw_calls", "instances_drawn"},
                             [&](const char* name) { return meanCount(a, name) <= 1.1 * meanCount(b, name); });
}

/// A stage whose quickest frame takes much longer than the same stage usually takes in a run that draws at least as
/// much, and matters to the frame. A busy machine makes single frames slow, not all of them.
constexpr double kSlowStage = 3;          // times as long
constexpr double kStageThatCounts = 0.1;  // of the frame

void slowStages(const ReportData& report, const RunFigures& run, std::vector<std::string>& out) {
  for (const auto& [stage, least] : run.leastStages) {
    if (least < kStageThatCounts * run.frame.median) continue;
    const RunFigures* best = nullptr;
    double bestMs = least / kSlowStage;
    for (const RunFigures* other : runsOn(report, run.path)) {
      const viewer::Percentiles* theirs = find(other->stages, stage);
      if (theirs == nullptr || theirs->median >= bestMs || !drawsNoMore(run, *other)) continue;
      best = other;
      bestMs = theirs->median;
    }
    if (best != nullptr)
      out.push_back(fmt::format(
          "The stage \"{}\" is slow in {}: at least {:.2f} ms of a frame of {:.2f} ms, but {:.2f} ms in {}, "
          "which draws no less.",
          stage, where(run), least, run.frame.median, bestMs, best->name));
  }
}

/// all_on that is surely slower than everything but one: that one costs more than it saves.
void costlyTechniques(const ReportData& report, std::vector<std::string>& out) {
  constexpr std::string_view kLess = "all_on_less_";
  constexpr double kWorthTelling = 0.97;
  for (const Speedup& s : report.speedups) {
    if (s.run != "all_on" || !s.over.starts_with(kLess) || !(s.ratio.high < kWorthTelling)) continue;
    out.push_back(
        fmt::format("{} costs more than it saves on {}: everything on takes {:.2f} times as long as without it "
                    "(95 % sure: {:.2f} to {:.2f}).",
                    s.over.substr(kLess.size()), s.path, 1 / s.ratio.value, 1 / s.ratio.high, 1 / s.ratio.low));
  }
}

}  // namespace

std::vector<std::string> findFaults(const ReportData& report) {
  std::vector<std::string> out;
  for (const RunFigures& run : report.runs) lostBuildings(run, out);
  for (const RunFigures& run : report.runs) movedPictures(run, out);
  for (const RunFigures& run : report.runs) slowStages(report, run, out);
  costlyTechniques(report, out);
  for (const city::StabilityRow& row : report.stability)
    if (!row.ok)
      out.push_back(fmt::format("{}, {}: {} is {:g}, over its bound of {:g}.", row.part, row.caseName, row.what,
                                row.figure, row.bound));
  return out;
}

}  // namespace vicus::report
