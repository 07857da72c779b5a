/// What the parts of a report share while it is being measured.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/planner.hpp"
#include "plan/techniques.hpp"
#include "report/budget.hpp"
#include "report/configurations.hpp"
#include "report/report_data.hpp"
#include "report/rigs.hpp"
#include "report/run_report.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::report {

/// A configuration being measured: who plans for it, what draws it, what was seen of it so far.
struct Run {
  Configuration configuration;
  Rig* rig = nullptr;
  plan::Planner planner;
  plan::PlannerState state;  ///< of the eye along the tour
  std::vector<viewer::FrameRecord> records;

  // What adds up to the error figures.
  double lostPixels = 0;
  std::set<uint32_t> lostItems;
  double drawn = 0, visible = 0;  ///< instances, over all views
  bool itemsSeen = false;
  std::vector<double> rmse, psnr, ssims, flips;  ///< one for each picture
  std::vector<std::array<int, 2>> shifts;
  std::vector<double> approach;  ///< mean FLIP, frame by frame
  double geometricPixels = 0;

  Run(Configuration c, Rig* r, plan::Planner p) : configuration(std::move(c)), rig(r), planner(std::move(p)) {}
};

/// A place on a tour, with what is true there whoever draws it: found once, for all runs and curves.
struct Place {
  city::ViewState view;
  double dt = 0;  ///< seconds since the place before
  std::vector<std::pair<uint32_t, uint32_t>>
      items;                                 ///< buildings, monuments and people in sight, ascending, with their pixels
  std::optional<viewer::Picture> reference;  ///< where pictures are compared
};

struct Session {
  const city::City& city;
  const city::Knobs& knobs;
  const ReportOptions& options;
  Amounts amounts;
  Budget budget;
  Rigs rigs;
  Rig* full = nullptr;       ///< draws references and item buffers
  plan::Planner everything;  ///< every technique off
  std::span<const plan::Technique> techniques = plan::techniques();
  double workDone = 0, workInAll = 1;
  ReportData data;

  bool stopped() const { return options.stop && options.stop(); }
  /// Tells how far the report is; `work` in frames, roughly.
  void progress(std::string_view stage, double work);
  /// What a hurry cuts is noted.
  void noteCut(const std::string& what, int count, int wanted);
  /// Hands on what there is so far.
  void keep();
};

// ---- session.cpp: views, plans, truths

city::ViewState viewAt(const Session& s, const city::Tour& tour, double time, glm::ivec2 size);
/// The view with every technique off.
city::FramePlan planEverything(Session& s, const city::ViewState& view);
/// The buildings and monuments that a buffer of `size` shows, with their pixels.
std::vector<std::pair<uint32_t, uint32_t>> itemsInSight(Session& s, city::ViewState view, glm::ivec2 size);
viewer::Picture referenceOf(Session& s, const city::ViewState& view);
/// The plan of one run for a place.
city::FramePlan planFor(Session& s, Run& run, const Place& place, plan::PlannerState& state);
/// Runs for configurations; fewer, with the reason in `error`, where one cannot be drawn.
std::vector<Run> makeRuns(Session& s, const std::vector<Configuration>& wanted, std::string& error);

// ---- measure_tour.cpp: one after the other, for all runs in turn

/// Times all runs along a tour, checks every plan against what is in sight, and compares pictures at some of the
/// places, which it returns. In a hurry it ends by the share `until`.
std::vector<Place> timeTour(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until);
/// The same at places that are known already, for a curve.
void timePlaces(Session& s, std::vector<Run>& runs, std::vector<Place>& places, double until);
/// What is lost and what is drawn for nothing, in large item buffers.
void compareItems(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until);
/// How much the difference to the reference jumps along a slow approach from the tour's middle on.
void measurePopping(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until);

// ---- run_figures.cpp: from what was seen to figures

ErrorFigures errorFigures(const Run& run);
std::vector<double> frameTimes(const Run& run);
RunFigures runFigures(const Session& s, const Run& run, const std::string& path);
/// Every run over all_off, and all_on over everything but one: what that one brings.
void addSpeedups(ReportData& data, const std::vector<Run>& runs, const std::string& path);

}  // namespace vicus::report
