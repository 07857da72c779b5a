/// A made-up report with one of everything.
#pragma once

#include "pictures.hpp"
#include "report/flip.hpp"
#include "report/report_data.hpp"

namespace vicus::report::testing {

inline RunFigures syntheticRun(const std::string& name, const std::string& path, double ms, double triangles,
                               double drawCalls, double flip) {
  RunFigures run;
  run.name = name;
  run.path = path;
  run.frames = 120;
  run.knobs = {{"frustum_culling", 1}, {"viewer.multisamples", 4}};
  run.features = {{"frustum_culling", {true, "388 of 1024 tiles hold something"}},
                  {"water", {false, "no bodies of water"}}};
  run.frame = {ms, ms * 1.2, ms * 1.4, ms * 1.7};
  run.frameMedian = {ms, ms * 0.96, ms * 1.05};
  run.stages = {{"frustum buildings", {0.3, 0.4, 0.5, 0.6}},
                {"apply", {ms * 0.1, ms * 0.12, ms * 0.13, ms * 0.2}},
                {"draw", {ms * 0.7, ms * 0.9, ms, ms * 1.1}},
                {"finish", {ms * 0.15, ms * 0.2, ms * 0.25, ms * 0.3}}};
  for (const auto& [stage, figures] : run.stages) run.leastStages.push_back({stage, 0.9 * figures.median});
  run.counts = {{"triangles", {triangles, triangles * 1.5}},
                {"draw_calls", {drawCalls, drawCalls * 1.2}},
                {"texture_binds", {drawCalls / 4, drawCalls / 3}},
                {"instances_drawn", {triangles / 300, triangles / 200}}};
  run.memory = {412, 188};
  run.error.falselyCulledPixels = 0;
  run.error.drawnOverVisible = triangles / 40000;
  run.error.rmse = flip * 0.9;
  run.error.psnr = 31.2;
  run.error.ssim = 0.97;
  run.error.flip = flip;
  run.error.popping = 0.0012;
  run.error.geometricPixels = 0;
  return run;
}

inline ReportData syntheticReport() {
  ReportData report;
  report.scene = "norvic";
  report.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  report.size = {640, 360};
  report.quick = true;
  report.complete = true;
  report.seconds = 48;
  report.notes = {"Item buffers of 1920 × 1080 over 4 views instead of 3840 × 2160 over 12."};
  for (const char* path : {"street", "flyover"}) {
    const double scale = std::string(path) == "street" ? 1 : 2.3;
    report.runs.push_back(syntheticRun("all_off", path, 87 * scale, 1.24e6 * scale, 3120, 0.0302));
    report.runs.push_back(syntheticRun("only_frustum_culling", path, 41 * scale, 3.6e5 * scale, 940, 0.0302));
    report.runs.push_back(syntheticRun("only_state_ordering", path, 49 * scale, 1.24e6 * scale, 24, 0.0303));
    report.runs.push_back(syntheticRun("all_on", path, 22.4 * scale, 3.6e5 * scale, 14, 0.0331));
    report.runs.push_back(syntheticRun("all_on_less_frustum_culling", path, 50.5 * scale, 1.24e6 * scale, 24, 0.0332));
    report.runs.push_back(syntheticRun("all_on_less_state_ordering", path, 42 * scale, 3.6e5 * scale, 940, 0.0331));
    report.runs.push_back(syntheticRun("limit", path, 14.8 * scale, 4.0e4 * scale, 9, 0.0302));
  }
  for (const RunFigures& run : report.runs) {
    const double ratio = findRun(report, "all_off", run.path)->frameMedian.value / run.frameMedian.value;
    report.speedups.push_back({run.name, run.path, "all_off", {ratio, ratio * 0.95, ratio * 1.06}});
  }
  Curve curve{"roam", "roam.pixel_error", "pixels", "street", {}};
  for (const double value : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    CurvePoint point;
    point.value = value;
    point.isDefault = value == 2;
    const double ms = 12 + 20 / value;
    point.milliseconds = {ms, ms * 0.97, ms * 1.04};
    point.error.flip = 0.004 * value;
    point.error.rmse = 0.002 * value;
    point.error.geometricPixels = value;
    curve.points.push_back(point);
  }
  report.curves.push_back(curve);
  Curve exact{"cull_map", "cull_map.size", "cells", "street", {}};
  for (const double value : {128.0, 256.0, 512.0, 1024.0}) {
    CurvePoint point;
    point.value = value;
    point.isDefault = value == 512;
    point.milliseconds = {30 - value / 64, 29.5 - value / 64, 30.4 - value / 64};
    point.error.flip = 0;
    exact.points.push_back(point);
  }
  report.curves.push_back(exact);
  for (const char* name : {"city at 0", "city at 1e6 m", "city at 1e7 m", "eye 0.05 m from a wall"})
    report.stability.push_back(city::stabilityRow("coordinates", name, "visible boxes culled", 0, 0));
  report.stability.push_back(city::stabilityRow("frustum", "near-singular matrix", "visible boxes culled", 0, 0));
  report.leftOut = {{"water", "no bodies of water", {}, 1.3, 4.2}, {"buildings", "no height", 12, {}, {}}};

  const auto reference = town(320, 180), picture = town(320, 180, 1);
  const FlipResult result = flip(reference, picture);
  report.pictures.push_back({"all_on", "street", 7, result.mean, reference, picture, paintErrors(result.map)});
  return report;
}

}  // namespace vicus::report::testing
