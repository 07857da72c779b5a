#include <algorithm>

#include "report/image_error.hpp"
#include "report/session.hpp"

namespace vicus::report {
namespace {

std::optional<double> meanOf(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(mean(values));
}

Named<FeatureFigures> featureFigures(const Session& s, const Run& run) {
  Named<FeatureFigures> out;
  for (const plan::FeatureReport& f : run.planner.features()) out.push_back({f.name, {f.on, f.why}});
  for (const plan::Technique& t : s.techniques) {
    if (t.switchKnob.empty() || find(out, std::string(t.name)) != nullptr) continue;
    const bool on = run.configuration.knobs.has(t.switchKnob) && run.configuration.knobs.on(t.switchKnob);
    out.push_back({std::string(t.name), {on, on ? "always pays" : "knob"}});
  }
  return out;
}

Named<double> leastStages(const Run& run) {
  Named<double> out;
  for (const viewer::FrameRecord& record : run.records)
    for (const viewer::StageSample& stage : record.stages) {
      const auto known =
          std::ranges::find(out, stage.name, [](const auto& entry) { return std::string_view(entry.first); });
      if (known == out.end())
        out.emplace_back(stage.name, stage.milliseconds);
      else
        known->second = std::min(known->second, stage.milliseconds);
    }
  return out;
}

}  // namespace

ErrorFigures errorFigures(const Run& run) {
  ErrorFigures e;
  if (run.itemsSeen) e.falselyCulledPixels = run.lostPixels;
  for (const uint32_t item : run.lostItems)
    if (e.lostItems.size() < kLostItemsListed) e.lostItems.push_back(item);
  if (run.visible > 0) e.drawnOverVisible = run.drawn / run.visible;
  e.rmse = meanOf(run.rmse), e.psnr = meanOf(run.psnr), e.ssim = meanOf(run.ssims), e.flip = meanOf(run.flips);
  if (run.approach.size() >= 2) e.popping = popping(run.approach).jump;
  e.geometricPixels = run.geometricPixels;
  // Moved only where every picture is moved alike.
  if (!run.shifts.empty() && std::ranges::all_of(run.shifts, [&](const auto& shift) { return shift == run.shifts[0]; }))
    e.shift = run.shifts[0];
  return e;
}

std::vector<double> frameTimes(const Run& run) {
  std::vector<double> out;
  for (const viewer::FrameRecord& r : run.records) out.push_back(r.milliseconds);
  return out;
}

RunFigures runFigures(const Session& s, const Run& run, const std::string& path) {
  RunFigures f;
  f.name = run.configuration.name;
  f.path = path;
  f.frames = static_cast<int>(run.records.size());
  for (const city::Knob& knob : run.configuration.knobs.declared())
    f.knobs.push_back({std::string(knob.name), run.configuration.knobs[knob.name]});
  f.features = featureFigures(s, run);
  viewer::RunTimes times = viewer::timesOf(run.records);
  f.frame = times.frame;
  f.gpu = times.gpu;
  f.frameMedian = medianWithInterval(frameTimes(run));
  f.stages = std::move(times.stages);
  f.leastStages = leastStages(run);
  f.counts = viewer::countsOf(run.records);
  f.memory = {static_cast<double>(viewer::peakResidentBytes()) / 1e6,
              static_cast<double>(run.rig->scene->gpuBytes() + run.rig->renderer->gpuBytes()) / 1e6};
  f.error = errorFigures(run);
  return f;
}

/// Every run over all_off, and all_on over everything but one: what that one brings.
void addSpeedups(ReportData& data, const std::vector<Run>& runs, const std::string& path) {
  const auto add = [&](const Run& run, const Run& over) {
    data.speedups.push_back(
        {run.configuration.name, path, over.configuration.name, ratioOfMedians(frameTimes(over), frameTimes(run))});
  };
  for (const Run& over : runs)
    for (const Run& run : runs) {
      const bool less = over.configuration.name.starts_with("all_on_less_");
      if (over.configuration.name == "all_off" || (less && run.configuration.name == "all_on")) add(run, over);
    }
}

}  // namespace vicus::report
