#include "report/write_csv.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vicus::report {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "";
}
std::string number(const std::optional<double>& value) {
  return value ? number(*value) : "";
}

const std::vector<std::string> kCounts{"triangles", "draw_calls", "texture_binds", "instances_drawn",
                                       "instances_in_frustum"};

using Line = std::vector<std::string>;

void appendErrors(Line& line, const ErrorFigures& e) {
  for (const auto& figure :
       {e.falselyCulledPixels, e.drawnOverVisible, e.rmse, e.psnr, e.ssim, e.flip, e.popping, e.geometricPixels})
    line.push_back(number(figure));
}

std::string joined(const Line& line) {
  std::string out;
  for (const std::string& field : line) out += (out.empty() ? "" : ",") + field;
  return out + "\r\n";
}

}  // namespace

std::string reportCsv(const ReportData& report) {
  Line names{"kind",
             "name",
             "path",
             "knob",
             "value",
             "default",
             "frames",
             "frame_ms_median",
             "frame_ms_low",
             "frame_ms_high",
             "frame_ms_p95",
             "frame_ms_p99",
             "speedup_over_all_off",
             "speedup_low",
             "speedup_high"};
  names.insert(names.end(), kCounts.begin(), kCounts.end());
  for (const char* name :
       {"falsely_culled_pixels", "drawn_over_visible", "rmse", "psnr", "ssim", "flip", "popping", "geometric_px"})
    names.emplace_back(name);
  std::string out = joined(names);

  for (const RunFigures& run : report.runs) {
    Line line{"run",
              quoted(run.name),
              quoted(run.path),
              "",
              "",
              "",
              std::to_string(run.frames),
              number(run.frameMedian.value),
              number(run.frameMedian.low),
              number(run.frameMedian.high),
              number(run.frame.p95),
              number(run.frame.p99)};
    Line speedup{"", "", ""};
    for (const Speedup& s : report.speedups)
      if (s.run == run.name && s.path == run.path && s.over == "all_off")
        speedup = {number(s.ratio.value), number(s.ratio.low), number(s.ratio.high)};
    line.insert(line.end(), speedup.begin(), speedup.end());
    for (const std::string& name : kCounts) {
      const viewer::MeanMax* count = find(run.counts, name);
      line.push_back(count == nullptr ? "" : number(count->mean));
    }
    appendErrors(line, run.error);
    out += joined(line);
  }
  for (const Curve& curve : report.curves)
    for (const CurvePoint& point : curve.points) {
      Line line{"curve",
                quoted(curve.technique),
                quoted(curve.path),
                quoted(curve.knob),
                number(point.value),
                point.isDefault ? "1" : "0",
                "",
                number(point.milliseconds.value),
                number(point.milliseconds.low),
                number(point.milliseconds.high)};
      line.resize(names.size() - 8);
      appendErrors(line, point.error);
      out += joined(line);
    }
  return out;
}

}  // namespace vicus::report
