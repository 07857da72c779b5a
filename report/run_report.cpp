#include "report/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "plan/planner.hpp"
#include "plan/techniques.hpp"
#include "report/configurations.hpp"
#include "report/findings.hpp"
#include "report/image_error.hpp"
#include "report/page.hpp"
#include "report/picture_bytes.hpp"
#include "report/rigs.hpp"
#include "report/stability.hpp"
#include "report/write_csv.hpp"
#include "report/write_json.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/tours.hpp"
#include "viewer/whole_file.hpp"

namespace vicus::report {
namespace {

using Clock = std::chrono::steady_clock;
using viewer::ItemBuffer;
using viewer::Picture;

constexpr int kPictureWidth = 480;  // of the pictures on the page

/// A configuration being measured: who plans for it, what draws it, what was seen of it so far.
struct Run {
  Configuration configuration;
  Rig* rig = nullptr;
  plan::Planner planner;
  plan::PlannerState state;  // of the eye along the tour
  std::vector<viewer::FrameRecord> records;

  // Sums for the error figures.
  double lostPixels = 0;
  std::set<uint32_t> lostItems;
  double drawn = 0, visible = 0;
  bool itemsSeen = false;
  std::vector<double> rmse, psnr, ssims, flips;
  std::vector<std::array<int, 2>> shifts;
  std::vector<double> approach;  // mean FLIP, frame by frame
  double geometricPixels = 0;

  Run(Configuration c, Rig* r, plan::Planner p) : configuration(std::move(c)), rig(r), planner(std::move(p)) {}
};

/// What all parts of a report share.
struct Session {
  const city::City& city;
  const city::Knobs& knobs;
  const ReportOptions& options;
  Amounts amounts;
  Rigs rigs;
  Rig* full = nullptr;       // draws references and item buffers
  plan::Planner everything;  // every technique off
  std::span<const plan::Technique> techniques = plan::techniques();
  Clock::time_point begin = Clock::now();
  double workDone = 0, workInAll = 1;
  ReportData data;

  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin).count(); }
  bool stopped() const { return options.stop && options.stop(); }
};

void progress(Session& s, std::string_view stage, double work) {
  s.workDone += work;
  const double fraction = std::clamp(s.workDone / s.workInAll, 1e-3, 1.0);
  if (s.options.progress) s.options.progress(stage, fraction, s.seconds() * (1 - fraction) / fraction);
}

/// As many as wanted, but where the report is in a hurry no more than fit into a share of its seconds at `each` seconds
/// for one, and never fewer than `least`. A cut is noted.
int affordable(Session& s, const std::string& what, int wanted, int least, double share, double each) {
  if (s.amounts.seconds <= 0 || each <= 0) return wanted;
  const int count = std::clamp(static_cast<int>(share * s.amounts.seconds / each), std::min(least, wanted), wanted);
  if (count < wanted) s.data.notes.push_back(fmt::format("{} {} instead of {}, to end in time.", count, what, wanted));
  return count;
}

double timeOf(const std::function<void()>& work) {
  const Clock::time_point start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// ---- views and plans -----------------------------------------------------------------------------------------------

city::ViewState viewAt(const Session& s, const city::Tour& tour, double time, glm::ivec2 size) {
  city::ViewState view = city::makeView(viewer::poseAt(tour, time), glm::radians(s.knobs["viewer.fov"]), size);
  view.time = time;
  return view;
}

city::FramePlan planEverything(Session& s, const city::ViewState& view) {
  plan::PlannerState state;
  return s.everything.plan(s.city, view, 0, state);
}

ItemBuffer itemsOf(Session& s, city::ViewState view, glm::ivec2 size) {
  view.viewport = size;
  return s.full->renderer->drawItems(planEverything(s, view));
}

/// The buildings and monuments that a buffer shows, as item ids.
std::set<uint32_t> itemsIn(const ItemBuffer& buffer) {
  std::set<uint32_t> items;
  uint32_t last = 0;
  for (const uint32_t id : buffer.ids) {
    if (id == last || id == city::kItemOther) continue;
    items.insert(last = id);
  }
  items.erase(0);
  return items;
}

/// Takes out of a plan all buildings and monuments that are not among `items`.
void keepOnly(const city::City& city, const std::set<uint32_t>& items, city::FramePlan& plan) {
  city::SetPlan& buildings = plan.buildings;
  buildings.drawn.clear();
  buildings.drawnCount = 0;
  std::vector<uint32_t> monuments;
  const auto buildingCount = static_cast<uint32_t>(city.buildings.size());
  for (const uint32_t item : items) {
    const uint32_t index = item - 1;
    if (index >= buildingCount) {
      if (std::binary_search(plan.monuments.begin(), plan.monuments.end(), index - buildingCount))
        monuments.push_back(index - buildingCount);
      continue;
    }
    if (!buildings.drawn.empty() && buildings.drawn.back().end() == index)
      ++buildings.drawn.back().count;
    else
      buildings.drawn.push_back({index, 1});
    ++buildings.drawnCount;
  }
  plan.monuments = std::move(monuments);
  plan.counts.instancesDrawn = buildings.drawnCount + plan.monuments.size();
  plan.counts.instancesOccluded = plan.counts.instancesInFrustum - plan.counts.instancesDrawn;
}

/// The plan of one run for a view. `visible` are the items that the view shows, for the limit.
city::FramePlan planFor(Session& s, Run& run, const city::ViewState& view, double dt, plan::PlannerState& state,
                        const std::set<uint32_t>& visible) {
  city::FramePlan plan = run.planner.plan(s.city, view, dt, state);
  if (run.configuration.limit) {
    keepOnly(s.city, visible, plan);
    plan.stages.clear();
  }
  if (s.options.interference.plan) s.options.interference.plan(run.configuration.name, plan);
  return plan;
}

double geometricPixels(const Session& s, const Run& run, const city::FramePlan& plan) {
  double pixels = 0;
  for (const plan::Technique& t : s.techniques)
    if (t.geometricErrorPixels && run.configuration.knobs.has(t.switchKnob) && run.configuration.knobs.on(t.switchKnob))
      pixels = std::max(pixels, t.geometricErrorPixels(plan));
  return pixels;
}

/// Runs for configurations; fewer, with the reason in `error`, where one cannot be drawn.
std::vector<Run> makeRuns(Session& s, const std::vector<Configuration>& wanted, std::string& error) {
  std::vector<Run> runs;
  for (const Configuration& c : wanted) {
    Rig* rig = s.rigs.rigFor(c.knobs, error);
    if (rig == nullptr) return {};
    runs.emplace_back(c, rig, plan::Planner(s.city, c.knobs));
  }
  return runs;
}

// ---- run time ------------------------------------------------------------------------------------------------------

void noteItems(const Session& s, Run& run, const city::FramePlan& plan, const ItemBuffer& everything) {
  const viewer::ItemCheck check = viewer::checkItems(s.city, plan, everything, everything);
  run.lostPixels += static_cast<double>(check.lostPixels);
  run.lostItems.insert(check.lostItems.begin(), check.lostItems.end());
  run.itemsSeen = true;
}

/// One frame of every run, one after the other, the first to go changing from frame to frame. Outside their times an
/// item buffer of twice the size tells what is visible: for the limit to draw and for all to be checked against.
void timeFrame(Session& s, std::vector<Run>& runs, const viewer::TourFrame& frame, const city::Tour& tour,
               size_t number) {
  const city::ViewState view = viewAt(s, tour, frame.time, s.amounts.size);
  const ItemBuffer everything = itemsOf(s, view, 2 * s.amounts.size);
  const std::set<uint32_t> visible = itemsIn(everything);
  for (size_t k = 0; k < runs.size(); ++k) {
    Run& run = runs[(k + number) % runs.size()];
    // Nobody has to find out what is visible for the limit: its plan is made beforehand.
    const auto makePlan = [&] { return planFor(s, run, view, frame.dt, run.state, visible); };
    city::FramePlan plan;
    if (run.configuration.limit) plan = makePlan();
    viewer::FrameRecord record = viewer::drawFrame(
        {s.city, run.planner, *run.rig->scene, *run.rig->renderer, *run.rig->context}, Clock::now(),
        [&] { return run.configuration.limit ? std::move(plan) : makePlan(); }, &plan);
    noteItems(s, run, plan, everything);
    run.geometricPixels = std::max(run.geometricPixels, geometricPixels(s, run, plan));
    if (!frame.warmUp) run.records.push_back(std::move(record));
  }
}

void timeRuns(Session& s, std::vector<Run>& runs, const city::Tour& tour, int wanted, double share) {
  // Warm up; what a frame then costs decides how many can be afforded.
  double each = 0;
  for (int k = 0; k < s.amounts.warmUpFrames && !s.stopped(); ++k) {
    const viewer::TourFrame start{0, 0, true};
    each = timeOf([&] { timeFrame(s, runs, start, tour, 0); });
    progress(s, "warming up", static_cast<double>(runs.size()));
  }
  const int frames = affordable(s, "timed frames on " + tour.name, wanted, (wanted + 2) / 3, share, each);
  size_t number = 0;
  for (const viewer::TourFrame& frame : viewer::spreadFrames(tour, static_cast<size_t>(frames))) {
    if (frame.warmUp) continue;
    if (s.stopped()) return;
    timeFrame(s, runs, frame, tour, number++);
    progress(s, "timing " + tour.name, static_cast<double>(runs.size()) * wanted / frames);
  }
}

// ---- errors --------------------------------------------------------------------------------------------------------

/// What is lost and what is drawn for nothing, in large item buffers.
void compareItems(Session& s, std::vector<Run>& runs, const city::Tour& tour, double share) {
  const double duration = viewer::durationOf(tour);
  int views = s.amounts.itemViews;
  for (int k = 0; k < views && !s.stopped(); ++k) {
    const double each = timeOf([&] {
      const double time = tour.keys.front().time + duration * (k + 0.5) / views;
      const city::ViewState view = viewAt(s, tour, time, s.amounts.size);
      const ItemBuffer everything = itemsOf(s, view, s.amounts.itemSize);
      const std::set<uint32_t> visible = itemsIn(everything);
      for (Run& run : runs) {
        plan::PlannerState state;
        const city::FramePlan plan = planFor(s, run, view, 0, state, visible);
        noteItems(s, run, plan, everything);
        run.drawn += static_cast<double>(plan.counts.instancesDrawn);
        run.visible += static_cast<double>(visible.size());
      }
    });
    if (k == 0) views = affordable(s, "item buffers on " + tour.name, views, (views + 2) / 3, share, each);
    progress(s, "item buffers of " + tour.name, 6.0 * s.amounts.itemViews / views);
  }
}

/// A run's picture of a view, spoiled where a test wants it so.
Picture pictureOf(Session& s, Run& run, const city::ViewState& view, plan::PlannerState& state, double dt) {
  std::set<uint32_t> visible;
  if (run.configuration.limit) visible = itemsIn(itemsOf(s, view, 2 * view.viewport));
  run.rig->renderer->draw(planFor(s, run, view, dt, state, visible));
  Picture picture = run.rig->renderer->readPicture();
  if (s.options.interference.picture) s.options.interference.picture(run.configuration.name, picture);
  return picture;
}

struct Compared {
  Picture reference, picture;
  FlipResult flip;
};

Compared comparePicture(Session& s, Run& run, const city::ViewState& view, const Picture& reference,
                        const FlipAppearance& appearance) {
  plan::PlannerState state;
  Compared out{reference, pictureOf(s, run, view, state, 0), {}};
  out.flip = flip(appearance, flipAppearance(out.picture, s.options.flipPixelsPerDegree));
  const PixelError error = pixelError(reference, out.picture);
  run.rmse.push_back(error.rmse);
  run.psnr.push_back(std::min(error.psnr, kEqualPsnr));
  run.ssims.push_back(ssim(reference, out.picture));
  run.flips.push_back(out.flip.mean);
  const Shift shift = findShift(reference, out.picture);
  run.shifts.push_back({shift.x, shift.y});
  return out;
}

Picture referenceOf(Session& s, const city::ViewState& view) {
  return s.full->renderer->drawReference(planEverything(s, view));
}

/// Pictures against the reference, at places spread over the tour. For the page: of everything on, the first place and
/// the one that differs most.
void comparePictures(Session& s, std::vector<Run>& runs, const city::Tour& tour, int wanted, double share,
                     bool forPage) {
  const double duration = viewer::durationOf(tour);
  std::vector<PictureRow> rows;
  int views = wanted;
  for (int k = 0; k < views && !s.stopped(); ++k) {
    const double each = timeOf([&] {
      const double time = tour.keys.front().time + duration * (k + 0.5) / views;
      const city::ViewState view = viewAt(s, tour, time, s.amounts.size);
      const Picture reference = referenceOf(s, view);
      const FlipAppearance appearance = flipAppearance(reference, s.options.flipPixelsPerDegree);
      for (Run& run : runs) {
        const Compared c = comparePicture(s, run, view, reference, appearance);
        if (!forPage || run.configuration.name != "all_on") continue;
        rows.push_back({run.configuration.name, tour.name, k, c.flip.mean, reduced(c.reference, kPictureWidth),
                        reduced(c.picture, kPictureWidth), reduced(paintErrors(c.flip.map), kPictureWidth)});
      }
    });
    if (k == 0) views = affordable(s, "pictures on " + tour.name, views, (views + 3) / 4, share, each);
    progress(s, "comparing pictures of " + tour.name, (16.0 + 2.0 * static_cast<double>(runs.size())) * wanted / views);
  }
  if (rows.empty()) return;
  const auto worst =
      std::max_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.flip < b.flip; });
  s.data.pictures.push_back(rows.front());
  if (worst != rows.begin()) s.data.pictures.push_back(*worst);
}

/// How much the difference to the reference jumps along a slow approach: a walk from the tour's middle on, in steps of
/// a fifth of a second.
void measurePopping(Session& s, std::vector<Run>& runs, const city::Tour& tour, double share) {
  constexpr double kStep = 0.2;  // s; 0.28 m at walking pace
  if (tour.jumps) return;
  std::vector<Run*> chosen;
  for (Run& run : runs)
    if (s.amounts.poppingOfAll || run.configuration.name == "all_off" || run.configuration.name == "all_on")
      chosen.push_back(&run);
  std::vector<plan::PlannerState> states(chosen.size());
  const double start = tour.keys.front().time + viewer::durationOf(tour) / 2;
  int frames = s.amounts.approachFrames;
  for (int k = 0; k < frames && !s.stopped(); ++k) {
    const double each = timeOf([&] {
      const city::ViewState view = viewAt(s, tour, start + k * kStep, s.amounts.size);
      const FlipAppearance reference = flipAppearance(referenceOf(s, view), s.options.flipPixelsPerDegree);
      for (size_t i = 0; i < chosen.size(); ++i) {
        const Picture picture = pictureOf(s, *chosen[i], view, states[i], k == 0 ? 0 : kStep);
        chosen[i]->approach.push_back(
            flip(reference, flipAppearance(picture, s.options.flipPixelsPerDegree)).exactMean);
      }
    });
    if (k == 0) frames = affordable(s, "frames of the slow approach on " + tour.name, frames, 3, share, each);
    progress(s, "popping on " + tour.name,
             (16.0 + 2.0 * static_cast<double>(chosen.size())) * s.amounts.approachFrames / frames);
  }
}

// ---- figures -------------------------------------------------------------------------------------------------------

std::optional<double> meanOf(const std::vector<double>& values) {
  return values.empty() ? std::nullopt : std::optional(mean(values));
}

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
  f.frameMedian = medianWithInterval(frameTimes(run));
  f.stages = std::move(times.stages);
  f.leastStages = leastStages(run);
  f.counts = viewer::countsOf(run.records);
  f.memory = {static_cast<double>(viewer::peakResidentBytes()) / 1e6,
              static_cast<double>(run.rig->scene->gpuBytes()) / 1e6};
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

/// Keeps what there is so far.
void keep(Session& s) {
  s.data.seconds = s.seconds();
  s.data.findings = findFaults(s.data);
  if (s.options.keep) s.options.keep(s.data);
}

// ---- the whole -----------------------------------------------------------------------------------------------------

/// Shares of a hurried report's seconds, the first tour having all configurations.
struct Shares {
  double timing, items, pictures, popping;
};
constexpr Shares kFirstTour{0.22, 0.08, 0.12, 0.08}, kOtherTour{0.08, 0.05, 0.06, 0.05};
constexpr double kCurveShare = 0.14;

void measureTour(Session& s, const city::Tour& tour, const std::vector<Configuration>& wanted, const Shares& shares,
                 std::string& error) {
  std::vector<Run> runs = makeRuns(s, wanted, error);
  if (runs.empty()) return;
  timeRuns(s, runs, tour, s.amounts.timedFrames, shares.timing);
  compareItems(s, runs, tour, shares.items);
  comparePictures(s, runs, tour, s.amounts.pictureViews, shares.pictures, true);
  measurePopping(s, runs, tour, shares.popping);
  if (runs.front().records.empty()) return;  // stopped before there was anything
  for (const Run& run : runs) s.data.runs.push_back(runFigures(s, run, tour.name));
  addSpeedups(s.data, runs, tour.name);
  keep(s);
}

void measureCurve(Session& s, const plan::Technique& technique, const city::Tour& tour, double share,
                  std::string& error) {
  const auto sweep = sweepOf(technique, s.knobs, s.techniques, s.amounts.curvePoints);
  if (sweep.empty()) return;
  std::vector<Configuration> wanted;
  for (const SweepPoint& p : sweep) wanted.push_back(p.configuration);
  const size_t rigsBefore = s.rigs.count();
  std::vector<Run> runs = makeRuns(s, wanted, error);
  if (runs.empty()) return;
  timeRuns(s, runs, tour, s.amounts.curveFrames, share / 2);
  comparePictures(s, runs, tour, s.amounts.curveViews, share / 2, false);

  Curve curve{std::string(technique.name), std::string(technique.sweptKnob), "", tour.name, {}};
  for (const city::Knob& knob : s.knobs.declared())
    if (knob.name == technique.sweptKnob) curve.unit = knob.unit;
  for (size_t k = 0; k < runs.size() && !runs[k].records.empty(); ++k)
    curve.points.push_back(
        {sweep[k].value, sweep[k].isDefault, medianWithInterval(frameTimes(runs[k])), errorFigures(runs[k])});
  if (!curve.points.empty()) s.data.curves.push_back(std::move(curve));
  runs.clear();
  s.rigs.keepFirst(rigsBefore);
  keep(s);
}

std::vector<LeftOutFigures> leftOutOf(const plan::Planner& planner, const city::Diagnostics& diagnostics) {
  std::vector<LeftOutFigures> out;
  for (const plan::FeatureReport& f : planner.features())
    if (!f.on) out.push_back({f.name, f.why, {}, {}, {}});
  for (const city::LeftOut& l : diagnostics.leftOut)
    out.push_back({l.what, l.why, static_cast<double>(l.count), {}, {}});
  return out;
}

/// Work in frames, roughly, to tell the time that is left.
double workOf(const Amounts& a, size_t runs) {
  const auto n = static_cast<double>(runs);
  return n * (a.warmUpFrames + a.timedFrames) + 6.0 * a.itemViews + (16 + 2 * n) * (a.pictureViews + a.approachFrames);
}

}  // namespace

Amounts quickAmounts(const city::City& city) {
  Amounts a;
  a.size = {640, 360};
  a.warmUpFrames = 3;
  a.timedFrames = 12;
  a.pictureViews = 4;
  a.itemSize = {1920, 1080};
  a.itemViews = 4;
  a.approachFrames = 6;
  a.poppingOfAll = false;
  a.curvePoints = 3;
  a.curveFrames = 8;
  a.curveViews = 2;
  a.shortTours = true;
  a.tours = {"street", "flyover"};
  constexpr size_t kTown = 4000;  // buildings
  a.seconds = city.buildings.size() <= kTown ? 45 : 140;
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
  s.data.notes.push_back(fmt::format(
      "What is visible was seen in item buffers of {} × {} pixels over {} views of each tour, and what is lost also in "
      "buffers of {} × {} at every timed frame.",
      s.amounts.itemSize.x, s.amounts.itemSize.y, s.amounts.itemViews, 2 * s.amounts.size.x, 2 * s.amounts.size.y));

  const std::vector<city::Tour> tours = viewer::makeTours(city);
  std::vector<Configuration> few;
  for (const Configuration& c : all)
    if (c.name == "all_off" || c.name == "all_on" || c.name == "limit") few.push_back(c);
  size_t curves = 0;
  for (const plan::Technique& t : techniques)
    curves += sweepOf(t, knobs, techniques, s.amounts.curvePoints).empty() ? 0 : 1;
  const size_t others = s.amounts.tours.size() - 1;
  s.workInAll = workOf(s.amounts, all.size()) +
                static_cast<double>(others) * workOf(s.amounts, s.amounts.shortTours ? few.size() : all.size());
  const auto points = static_cast<double>(s.amounts.curvePoints);
  s.workInAll += static_cast<double>(curves) *
                 (points * (s.amounts.warmUpFrames + s.amounts.curveFrames) + (16 + 2 * points) * s.amounts.curveViews);

  // The cases that take no drawing come first, so that an interrupted report has them too.
  if (s.amounts.stability) {
    progress(s, "stiff and extreme cases", 0);
    s.data.stability = allStability(options.quick);
  }
  for (size_t k = 0; k < s.amounts.tours.size() && !s.stopped() && error.empty(); ++k)
    if (const city::Tour* tour = viewer::findTour(tours, s.amounts.tours[k]); tour != nullptr && !tour->keys.empty())
      measureTour(s, *tour, k > 0 && s.amounts.shortTours ? few : all, k == 0 ? kFirstTour : kOtherTour, error);
  const city::Tour* first = viewer::findTour(tours, s.amounts.tours.front());
  for (const plan::Technique& t : techniques)
    if (first != nullptr && !first->keys.empty() && !s.stopped() && error.empty())
      measureCurve(s, t, *first, kCurveShare / static_cast<double>(std::max<size_t>(curves, 1)), error);
  if (!error.empty()) return std::nullopt;

  s.data.complete = !s.stopped();
  if (s.data.complete) progress(s, "done", std::max(s.workInAll - s.workDone, 0.0));
  for (const std::string& problem : s.full->renderer->problems()) s.data.notes.push_back("Drawing: " + problem);
  keep(s);
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
