/// Measures a scene: error against run time.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "city/city.hpp"
#include "city/diagnostics.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "report/flip.hpp"
#include "report/report_data.hpp"

namespace vicus::report {

/// How much is measured. More of anything: surer figures, and more time.
struct Amounts {
  glm::ivec2 size{1280, 720};            ///< of the timed frames and the pictures
  int warmUpFrames = 5;                  ///< for each run
  int timedFrames = 60;                  ///< for each run of a tour
  int pictureViews = 8;                  ///< for each tour: pictures compared with the reference
  glm::ivec2 timedItemSize{2560, 1440};  ///< of the item buffers that every timed frame is checked against
  glm::ivec2 itemSize{3840, 2160};       ///< of those that tell what is visible
  int itemViews = 8;                     ///< for each tour; 0: the timed frames' own tell what is visible
  int approachFrames = 16;               ///< of the slow approach that shows popping
  bool poppingOfAll = true;              ///< of every run; else of all_off and all_on only
  size_t curvePoints = 7;                ///< for each knob
  int curveFrames = 20;                  ///< timed frames for each point
  int curveViews = 4;                    ///< pictures for each point
  int leftOutFrames = 12;                ///< for each part that the scene lacks, with it and without
  bool shortTours = false;               ///< tours after the first: all_off, all_on and limit only, and no popping
  std::vector<std::string> tours{"street", "flyover", "turn", "teleport"};
  std::vector<std::string> only;  ///< names of the configurations; empty: all
  /// Frames and views are cut, to a third or a quarter at most, to end within these; 0: no hurry. Scenes whose frames
  /// take longer get more: as many seconds as `secondsForRound` frames of all configurations of the first tour take, up
  /// to `mostSeconds`.
  double seconds = 0, mostSeconds = 0, secondsForRound = 0;
  bool stability = true;
};

/// What `--quick` measures: under a minute for a town, under three for a city.
Amounts quickAmounts();

/// Ways for tests to spoil what the program does, to see that the report finds it. Each is called with the
/// configuration's name and may be empty.
struct Interference {
  std::function<void(const std::string& run, city::FramePlan& plan)> plan{};        ///< within the frame's time
  std::function<void(const std::string& run, viewer::Picture& picture)> picture{};  ///< before it is compared
};

struct ReportOptions {
  std::string scene{};  ///< as the user named it
  bool quick = false;
  Amounts amounts{};
  double flipPixelsPerDegree = kFlipPixelsPerDegree;
  Interference interference{};
  /// What is being done, how far the whole is (0 to 1), seconds that are left.
  std::function<void(std::string_view stage, double fraction, double secondsLeft)> progress{};
  std::function<bool()> stop{};                   ///< true: end soon and keep what there is
  std::function<void(const ReportData&)> keep{};  ///< after each tour: what there is so far
};

/// Runs everything. Nothing, with the reason in `error`, only where there is no context to draw in; a report that was
/// stopped says so.
std::optional<ReportData> runReport(const city::City& city, const city::Knobs& knobs,
                                    const city::Diagnostics& diagnostics, const ReportOptions& options,
                                    std::string& error);

/// Writes report.html, report.json and report.csv into a folder. An empty text, or what went wrong.
std::string writeReport(const std::filesystem::path& folder, const ReportData& report);

}  // namespace vicus::report
