/// Based on: the Trace Event Format ("complete events", ph = X).
#include "report/stage_trace.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace vicus::report {
namespace {

double microseconds(double milliseconds) {
  return std::isfinite(milliseconds) && milliseconds > 0 ? milliseconds * 1000 : 0;
}

nlohmann::ordered_json bar(const std::string& name, const char* category, double start, double duration) {
  return {{"name", name}, {"cat", category}, {"ph", "X"}, {"ts", start}, {"dur", duration}, {"pid", 1}, {"tid", 1}};
}

}  // namespace

std::vector<TracedFrame> tracedFrames(std::span<const viewer::FrameRecord> records) {
  std::vector<TracedFrame> frames;
  double start = 0;
  for (const viewer::FrameRecord& record : records) {
    TracedFrame& frame = frames.emplace_back();
    frame.start = start;
    for (const viewer::StageSample& stage : record.stages) {
      frame.stages.push_back({std::string(stage.name), stage.milliseconds});
      start += stage.milliseconds;
    }
  }
  return frames;
}

std::string chromeTrace(std::span<const TracedFrame> frames) {
  auto events = nlohmann::ordered_json::array();
  events.push_back({{"name", "process_name"}, {"ph", "M"}, {"pid", 1}, {"args", {{"name", "vicus"}}}});
  events.push_back({{"name", "thread_name"}, {"ph", "M"}, {"pid", 1}, {"tid", 1}, {"args", {{"name", "render loop"}}}});
  for (size_t i = 0; i < frames.size(); ++i) {
    const double start = microseconds(frames[i].start);
    double total = 0;
    for (const TracedStage& stage : frames[i].stages) total += microseconds(stage.milliseconds);
    events.push_back(bar("frame " + std::to_string(i), "frame", start, total));
    double at = start;
    for (const TracedStage& stage : frames[i].stages) {
      const double duration = microseconds(stage.milliseconds);
      events.push_back(bar(stage.name, "stage", at, duration));
      at += duration;
    }
  }
  const nlohmann::ordered_json trace{{"traceEvents", std::move(events)}, {"displayTimeUnit", "ms"}};
  return trace.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace vicus::report
