#include "report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "report/leaving_out.hpp"
#include "report/page.hpp"
#include "report/session.hpp"
#include "report/stability.hpp"
#include "report/write_csv.hpp"
#include "report/write_json.hpp"
#include "viewer/tours.hpp"
#include "viewer/whole_file.hpp"

namespace vicus::report {
namespace {

/// Shares of a hurried report's seconds by which its parts end. Tuned on norvic: what costs most comes first, and what
/// comes later can still shrink.
constexpr double kFirstTourEnds = 0.58, kFirstPoppingEnds = 0.68, kOtherToursEnd = 0.85, kCurvesEnd = 0.9;

/// Measures one tour; returns its places.
std::vector<Place> measureTour(Session& s, const city::Tour& tour, const std::vector<Configuration>& wanted,
                               double timedUntil, double until, bool popping, std::string& error) {
  std::vector<Run> runs = makeRuns(s, wanted, error);
  if (runs.empty()) return {};
  std::vector<Place> places = timeTour(s, runs, tour, timedUntil);
  compareItems(s, runs, tour, until);
  if (popping) measurePopping(s, runs, tour, until);
  if (runs.front().records.empty()) return {};  // stopped before there was anything
  for (const Run& run : runs) s.data.runs.push_back(runFigures(s, run, tour.name));
  addSpeedups(s.data, runs, tour.name);
  s.keep();
  return places;
}

void measureCurve(Session& s, const plan::Technique& technique, const city::Tour& tour, std::vector<Place>& places,
                  double until, std::string& error) {
  const auto sweep = sweepOf(technique, s.knobs, s.techniques, s.amounts.curvePoints);
  if (sweep.empty() || places.empty()) return;
  std::vector<Configuration> wanted;
  for (const SweepPoint& p : sweep) wanted.push_back(p.configuration);
  const size_t rigsBefore = s.rigs.count();
  std::vector<Run> runs = makeRuns(s, wanted, error);
  if (runs.empty()) return;
  timePlaces(s, runs, places, until);
  s.progress("curve of " + std::string(technique.name),
             static_cast<double>(runs.size()) * (3 + s.amounts.curveFrames + 2 * s.amounts.curveViews));

  Curve curve{std::string(technique.name), std::string(technique.sweptKnob), "", tour.name, {}};
  for (const city::Knob& knob : s.knobs.declared())
    if (knob.name == technique.sweptKnob) curve.unit = knob.unit;
  for (size_t k = 0; k < runs.size() && !runs[k].records.empty(); ++k)
    curve.points.push_back(
        {sweep[k].value, sweep[k].isDefault, medianWithInterval(frameTimes(runs[k])), errorFigures(runs[k])});
  if (!curve.points.empty()) s.data.curves.push_back(std::move(curve));
  runs.clear();
  s.rigs.keepFirst(rigsBefore);
  s.keep();
}

// ---- what is left out ----------------------------------------------------------------------------------------------

std::vector<LeftOutFigures> leftOutOf(const plan::Planner& planner, const city::Diagnostics& diagnostics) {
  std::vector<LeftOutFigures> out;
  for (const plan::FeatureReport& f : planner.features())
    if (!f.on) out.push_back({f.name, f.why, {}, {}, {}});
  for (const city::LeftOut& l : diagnostics.leftOut)
    out.push_back({l.what, l.why, static_cast<double>(l.count), {}, {}});
  return out;
}

double megabytes(const city::City& city, const Rig& rig) {
  const city::CityBytes bytes = city::memoryOf(city);
  return static_cast<double>(bytes.geometry + bytes.instances + bytes.terrain + rig.scene->gpuBytes()) / 1e6;
}

/// Forces one part on and draws the same places with and without it, in turn.
void measureLeftOut(Session& s, const std::vector<Place>& places, LeftOutFigures& figures) {
  const std::optional<city::City> forced = withPart(s.city, figures.what);
  if (!forced) return;
  // Both made anew: what a rig has drawn before leaves buffers behind.
  Rigs plainRigs(s.city), forcedRigs(*forced);
  std::string error;
  const Rig* plain = plainRigs.rigFor(s.knobs, error);
  const Rig* with = forcedRigs.rigFor(s.knobs, error);
  if (plain == nullptr || with == nullptr) return;
  const plan::Planner without(s.city, s.knobs), forcedOn(*forced, s.knobs);
  plan::PlannerState stateWithout, stateWith;
  std::vector<double> saved;
  const auto frame = [&](const city::City& city, const plan::Planner& planner, const Rig& rig, const Place& place,
                         plan::PlannerState& state) {
    return viewer::drawFrame({&city, &planner, rig.scene.get(), rig.renderer.get(), rig.context.get()},
                             std::chrono::steady_clock::now(),
                             [&] { return planner.plan(city, place.view, place.dt, state); })
        .milliseconds;
  };
  const int frames = std::min(s.amounts.leftOutFrames, static_cast<int>(places.size()));
  for (int k = -2; k < frames && !s.stopped(); ++k) {
    const Place& place = places[static_cast<size_t>(std::max(k, 0)) * places.size() / static_cast<size_t>(frames)];
    const double cheap = frame(s.city, without, *plain, place, stateWithout);
    const double dear = frame(*forced, forcedOn, *with, place, stateWith);
    if (k >= 0) saved.push_back(dear - cheap);
  }
  if (saved.empty()) return;
  figures.savedMilliseconds = median(saved);
  figures.savedMb = megabytes(*forced, *with) - megabytes(s.city, *plain);
}

/// Work in frames, roughly, to tell the time that is left.
double workOf(const Amounts& a, size_t runs) {
  const auto n = static_cast<double>(runs);
  return n * a.warmUpFrames + (n + 6) * a.timedFrames + 6.0 * a.itemViews + (16 + 2 * n) * a.approachFrames;
}

}  // namespace

Amounts quickAmounts() {
  Amounts a;
  a.size = {640, 360};
  a.warmUpFrames = 2;
  a.timedFrames = 12;
  a.pictureViews = 4;
  a.timedItemSize = {1280, 720};
  a.itemViews = 0;
  a.approachFrames = 6;
  a.poppingOfAll = false;
  a.curvePoints = 3;
  a.curveFrames = 8;
  a.curveViews = 2;
  a.leftOutFrames = 6;
  a.shortTours = true;
  a.tours = {"street", "flyover"};
  a.seconds = 44;
  a.mostSeconds = 140;
  a.secondsForRound = 24;
  return a;
}

std::optional<ReportData> runReport(const city::City& city, const city::Knobs& knobs,
                                    const city::Diagnostics& diagnostics, const ReportOptions& options,
                                    std::string& error) {
  const auto techniques = plan::techniques();
  std::vector<Configuration> all = configurations(knobs, techniques);
  const city::Knobs everythingOff = all.front().knobs;
  if (const auto& only = options.amounts.only; !only.empty())
    std::erase_if(all, [&](const Configuration& c) { return std::ranges::find(only, c.name) == only.end(); });
  Session s{.city = city,
            .knobs = knobs,
            .options = options,
            .amounts = options.amounts,
            .budget = Budget(options.amounts.seconds),
            .rigs = Rigs(city),
            .everything = plan::Planner(city, everythingOff),
            .data = {}};
  s.full = s.rigs.rigFor(knobs, error);
  if (s.full == nullptr) return std::nullopt;
  s.data.scene = options.scene;
  s.data.renderer = s.full->context->rendererName();
  s.data.size = {s.amounts.size.x, s.amounts.size.y};
  s.data.quick = options.quick;
  s.data.leftOut = leftOutOf(plan::Planner(city, knobs), diagnostics);
  const glm::ivec2 timed = s.amounts.timedItemSize, large = s.amounts.itemSize;
  if (s.amounts.itemViews == 0)
    s.data.notes.push_back(fmt::format(
        "What is visible was seen in an item buffer of {} × {} pixels at every timed frame.", timed.x, timed.y));
  else
    s.data.notes.push_back(fmt::format(
        "What is visible was seen in item buffers of {} × {} pixels over {} views of each tour, and what is lost also "
        "in buffers of {} × {} at every timed frame.",
        large.x, large.y, s.amounts.itemViews, timed.x, timed.y));

  const std::vector<city::Tour> tours = viewer::makeTours(city);
  std::vector<Configuration> few;
  for (const Configuration& c : all)
    if (c.name == "all_off" || c.name == "all_on" || c.name == "limit") few.push_back(c);
  size_t curves = 0;
  for (const plan::Technique& t : techniques)
    curves += sweepOf(t, knobs, techniques, s.amounts.curvePoints).empty() ? 0 : 1;
  const size_t others = s.amounts.tours.size() - 1;
  s.workInAll =
      workOf(s.amounts, all.size()) +
      static_cast<double>(others) * workOf(s.amounts, s.amounts.shortTours ? few.size() : all.size()) +
      static_cast<double>(curves * s.amounts.curvePoints) * (3 + s.amounts.curveFrames + 2 * s.amounts.curveViews);

  // The cases that take no drawing come first, so that an interrupted report has them too.
  if (s.amounts.stability) {
    s.progress("stiff and extreme cases", 0);
    s.data.stability = allStability();
  }
  std::vector<Place> places;  // of the first tour
  const city::Tour* first = nullptr;
  for (size_t k = 0; k < s.amounts.tours.size() && !s.stopped() && error.empty(); ++k) {
    const city::Tour* tour = viewer::findTour(tours, s.amounts.tours[k]);
    if (tour == nullptr || tour->keys.empty()) continue;
    if (k == 0) {
      first = tour;
      places = measureTour(s, *tour, all, kFirstTourEnds, kFirstPoppingEnds, true, error);
    } else {
      const double until = kFirstPoppingEnds + (kOtherToursEnd - kFirstPoppingEnds) * static_cast<double>(k) /
                                                   static_cast<double>(s.amounts.tours.size() - 1);
      measureTour(s, *tour, s.amounts.shortTours ? few : all, until, until, !s.amounts.shortTours, error);
    }
  }
  double curve = 0;
  for (const plan::Technique& t : techniques) {
    if (first == nullptr || s.stopped() || !error.empty()) break;
    if (sweepOf(t, knobs, techniques, s.amounts.curvePoints).empty()) continue;
    const double until = kOtherToursEnd + (kCurvesEnd - kOtherToursEnd) * ++curve / static_cast<double>(curves);
    measureCurve(s, t, *first, places, until, error);
  }
  for (LeftOutFigures& figures : s.data.leftOut)
    if (!places.empty() && !s.stopped() && s.budget.left(1) > 0) measureLeftOut(s, places, figures);
  if (!error.empty()) return std::nullopt;

  s.data.complete = !s.stopped();
  if (s.data.complete) s.progress("done", std::max(s.workInAll - s.workDone, 0.0));
  for (const std::string& problem : s.full->renderer->problems()) s.data.notes.push_back("Drawing: " + problem);
  s.keep();
  return s.data;
}

std::string writeReport(const std::filesystem::path& folder, const ReportData& report) {
  for (const auto& [name, text] :
       {std::pair{"report.json", reportJson(report)}, std::pair{"report.csv", reportCsv(report)},
        std::pair{"report.html", reportPage(report)}})
    if (std::string problem = viewer::writeWhole(folder / name, text); !problem.empty()) return problem;
  return {};
}

}  // namespace vicus::report
