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

/// A stage that takes much longer than the same stage of a run that draws at least as much, and matters to the frame.
/// Tuned so that noise of a loaded machine (twice the median of 12 frames) stays below.
constexpr double kSlowStage = 3;          // times as long
constexpr double kStageThatCounts = 0.1;  // of the frame

void slowStages(const ReportData& report, const RunFigures& run, std::vector<std::string>& out) {
  for (const auto& [stage, ms] : run.stages) {
    if (ms.median < kStageThatCounts * run.frame.median) continue;
    const RunFigures* best = nullptr;
    double bestMs = ms.median / kSlowStage;
    for (const RunFigures* other : runsOn(report, run.path)) {
      const viewer::Percentiles* theirs = find(other->stages, stage);
      if (theirs == nullptr || theirs->median >= bestMs || !drawsNoMore(run, *other)) continue;
      best = other;
      bestMs = theirs->median;
    }
    if (best != nullptr)
      out.push_back(
          fmt::format("The stage \"{}\" is slow in {}: {:.2f} ms of a frame of {:.2f} ms, but {:.2f} ms in {}, "
                      "which draws no less.",
                      stage, where(run), ms.median, run.frame.median, bestMs, best->name));
  }
}

/// all_on_less_X that is surely faster than all_on: X costs more than it saves.
void costlyTechniques(const ReportData& report, const RunFigures& run, std::vector<std::string>& out) {
  const std::string prefix = "all_on_less_";
  if (!run.name.starts_with(prefix)) return;
  const RunFigures* all = findRun(report, "all_on", run.path);
  if (all == nullptr || agree(all->frameMedian, run.frameMedian) || all->frameMedian.value <= run.frameMedian.value)
    return;
  out.push_back(fmt::format("{} costs more than it saves on {}: all_on takes {:.2f} ms, without it {:.2f} ms.",
                            run.name.substr(prefix.size()), run.path, all->frameMedian.value, run.frameMedian.value));
}

}  // namespace

std::vector<std::string> findFaults(const ReportData& report) {
  std::vector<std::string> out;
  for (const RunFigures& run : report.runs) lostBuildings(run, out);
  for (const RunFigures& run : report.runs) movedPictures(run, out);
  for (const RunFigures& run : report.runs) slowStages(report, run, out);
  for (const RunFigures& run : report.runs) costlyTechniques(report, run, out);
  for (const city::StabilityRow& row : report.stability)
    if (!row.ok)
      out.push_back(fmt::format("{}, {}: {} is {:g}, over its bound of {:g}.", row.part, row.caseName, row.what,
                                row.figure, row.bound));
  return out;
}

}  // namespace vicus::report
