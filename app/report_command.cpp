#include <cmath>
#include <filesystem>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/open_scene.hpp"
#include "report/run_report.hpp"

namespace vicus::app {
namespace {

/// "2 min 05 s".
std::string spokenSeconds(double seconds) {
  const auto whole = static_cast<long>(std::lround(std::max(seconds, 0.0)));
  char text[32];
  if (whole < 60)
    std::snprintf(text, sizeof text, "%ld s", whole);
  else
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  return text;
}

}  // namespace

int report(const ReportCommandOptions& options, const Surroundings& surroundings) {
  Console console(surroundings);
  int code = kDone;
  std::optional<OpenScene> scene = openScene(options.scene, surroundings, console, code);
  if (!scene) return code;

  std::string problem;
  report::ReportOptions settings;
  settings.scene = scene->name;
  settings.quick = options.quick;
  if (options.quick) settings.amounts = report::quickAmounts();
  settings.stop = [&] { return interrupted() || !problem.empty(); };
  settings.progress = [&](std::string_view stage, double fraction, double secondsLeft) {
    std::string text(stage);
    if (surroundings.terminal && fraction > 0.02) text += ", about " + spokenSeconds(secondsLeft) + " left,";
    console.progress(text, fraction);
  };
  settings.keep = [&](const report::ReportData& data) { problem = report::writeReport(options.out, data); };

  std::string error;
  const std::optional<report::ReportData> data =
      report::runReport(*scene->city, scene->knobs, scene->diagnostics, settings, error);
  console.progressDone();
  finishCache(*scene, console);
  if (!data) error = error.empty() ? "the report could not be made" : error;
  for (const std::string& text : {error, problem})
    if (!text.empty()) console.error(text), code = kCouldNot;
  if (!data) return code;
  for (const std::string& finding : data->findings) console.warn(finding);
  if (!data->complete) console.warn("interrupted; the report holds what was measured until then");
  if (code == kDone)
    console.say("report in " + spokenSeconds(data->seconds) + ": " +
                (std::filesystem::absolute(options.out) / "report.html").lexically_normal().string());
  return code;
}

}  // namespace vicus::app
