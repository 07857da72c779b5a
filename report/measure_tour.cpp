#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>

#include "report/flip.hpp"
#include "report/image_error.hpp"
#include "report/picture_bytes.hpp"
#include "report/session.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/tours.hpp"

namespace vicus::report {
namespace {

using Clock = std::chrono::steady_clock;
using viewer::Picture;

constexpr int kPictureWidth = 480;  // of the pictures on the page

double timeOf(const std::function<void()>& work) {
  const Clock::time_point start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// ---- what a plan and a picture lack --------------------------------------------------------------------------------

void noteItems(const Session& s, Run& run, const city::FramePlan& plan, const Place& place) {
  for (const auto& [item, pixels] : place.items) {
    if (viewer::plansItem(s.city, plan, item)) continue;
    run.lostPixels += pixels;
    run.lostItems.insert(item);
  }
  run.itemsSeen = true;
}

void noteDrawn(const Session& s, Run& run, const city::FramePlan& plan, const Place& place) {
  run.drawn += static_cast<double>(plan.counts.instancesDrawn);
  run.visible += static_cast<double>(
      std::ranges::count_if(place.items, [&](const auto& item) { return item.first < s.city.itemCount(); }));
}

double geometricPixels(const Session& s, const Run& run, const city::FramePlan& plan) {
  double pixels = 0;
  for (const plan::Technique& t : s.techniques)
    if (t.geometricErrorPixels && run.configuration.knobs.has(t.switchKnob) && run.configuration.knobs.on(t.switchKnob))
      pixels = std::max(pixels, t.geometricErrorPixels(plan));
  return pixels;
}

/// The pictures of one place against its reference. Many runs draw the very same picture: it is compared once.
class Comparison {
 public:
  Comparison(const Picture& reference, double pixelsPerDegree)
      : reference_(reference), appearance_(flipAppearance(reference, pixelsPerDegree)) {}

  struct Figures {
    Picture picture;
    PixelError error;
    double ssim = 0;
    FlipResult flip;
    Shift shift;
  };
  const Figures& figuresOf(Picture picture) {
    for (const Figures& f : known_)
      if (f.picture.rgb == picture.rgb) return f;
    Figures f;
    f.error = pixelError(reference_, picture);
    f.ssim = report::ssim(reference_, picture);
    f.flip = flip(appearance_, flipAppearance(picture, appearance_.pixelsPerDegree));
    f.shift = findShift(reference_, picture);
    f.picture = std::move(picture);
    return known_.emplace_back(std::move(f));
  }

 private:
  const Picture& reference_;
  FlipAppearance appearance_;
  std::deque<Figures> known_;
};

/// The picture that a run's renderer has just drawn, spoiled where a test wants it so.
Picture pictureOf(const Session& s, const Run& run) {
  Picture picture = run.rig->renderer->readPicture();
  if (s.options.interference.picture) s.options.interference.picture(run.configuration.name, picture);
  return picture;
}

void notePicture(Run& run, const Comparison::Figures& f) {
  run.rmse.push_back(f.error.rmse);
  run.psnr.push_back(std::min(f.error.psnr, kEqualPsnr));
  run.ssims.push_back(f.ssim);
  run.flips.push_back(f.flip.mean);
  run.shifts.push_back({f.shift.x, f.shift.y});
}

// ---- one place, all runs -------------------------------------------------------------------------------------------

/// One frame of every run at a place, one after the other, the first to go changing from place to place. Outside their
/// times the plans are checked against what is in sight and, where the place has a reference, the pictures against
/// that; `rows`, where given, gets those of everything on. Warming up, nothing is noted.
void drawPlace(Session& s, std::vector<Run>& runs, const Place& place, size_t number, bool warmUp,
               std::vector<PictureRow>* rows = nullptr) {
  std::optional<Comparison> comparison;
  if (place.reference && !warmUp) comparison.emplace(*place.reference, s.options.flipPixelsPerDegree);
  for (size_t k = 0; k < runs.size(); ++k) {
    Run& run = runs[(k + number) % runs.size()];
    // Nobody has to find out what is visible for the limit: its plan is made beforehand.
    city::FramePlan plan;
    if (run.configuration.limit) plan = planFor(s, run, place, run.state);
    viewer::FrameRecord record = viewer::drawFrame(
        {&s.city, &run.planner, run.rig->scene.get(), run.rig->renderer.get(), run.rig->context.get()}, Clock::now(),
        [&] { return run.configuration.limit ? std::move(plan) : planFor(s, run, place, run.state); }, &plan);
    noteItems(s, run, plan, place);
    run.geometricPixels = std::max(run.geometricPixels, geometricPixels(s, run, plan));
    if (warmUp) continue;
    run.records.push_back(record);
    if (s.amounts.itemViews == 0) noteDrawn(s, run, plan, place);
    if (!comparison) continue;
    const Comparison::Figures& figures = comparison->figuresOf(pictureOf(s, run));
    notePicture(run, figures);
    if (rows == nullptr || run.configuration.name != "all_on") continue;
    rows->push_back({run.configuration.name, "", static_cast<int>(number), figures.flip.mean,
                     reduced(*place.reference, kPictureWidth), reduced(figures.picture, kPictureWidth),
                     reduced(paintErrors(figures.flip.map), kPictureWidth)});
  }
}

/// Indices of `count` of `all` things, spread evenly, the first among them.
std::set<size_t> spread(size_t count, size_t all) {
  std::set<size_t> out;
  for (size_t k = 0; k < count; ++k) out.insert(k * all / count);
  return out;
}

/// How many places and how many of them with pictures; never fewer than a third and a quarter of what was wanted.
struct Counts {
  int frames = 0, pictures = 0;
};
Counts affordable(Session& s, const std::string& tour, double until, double frame, double picture) {
  const Amounts& a = s.amounts;
  const double share = static_cast<double>(a.pictureViews) / std::max(a.timedFrames, 1);
  Counts counts;
  counts.frames =
      s.budget.affordable(a.timedFrames, std::max((a.timedFrames + 2) / 3, 2), until, frame + share * picture);
  counts.pictures = a.timedFrames == counts.frames ? a.pictureViews
                                                   : std::clamp(static_cast<int>(std::lround(share * counts.frames)),
                                                                (a.pictureViews + 1) / 2, a.pictureViews);
  counts.pictures = std::min(counts.pictures, counts.frames);
  s.noteCut("timed frames on " + tour, counts.frames, a.timedFrames);
  s.noteCut("pictures on " + tour, counts.pictures, a.pictureViews);
  return counts;
}

}  // namespace

std::vector<Place> timeTour(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until) {
  const auto runCount = static_cast<double>(runs.size());
  const Amounts& a = s.amounts;

  // The tour's first place warms everything up and tells what things cost.
  Place first{viewAt(s, tour, tour.keys.front().time, a.size), 0, {}, {}};
  const double items = timeOf([&] { first.items = itemsInSight(s, first.view, a.timedItemSize); });
  const double picture = a.pictureViews == 0 ? 0 : timeOf([&] {
    first.reference = referenceOf(s, first.view);
    flipAppearance(*first.reference, s.options.flipPixelsPerDegree);
  });
  double round = 0;
  for (int k = 0; k < a.warmUpFrames && !s.stopped(); ++k) {
    round = timeOf([&] { drawPlace(s, runs, first, 0, true); });
    s.progress("warming up", runCount);
  }
  if (s.data.runs.empty() && a.secondsForRound > 0)
    s.budget.setSeconds(std::clamp(a.secondsForRound * round, a.seconds, a.mostSeconds));
  const Counts counts = affordable(s, tour.name, until, items + round, picture);

  // Along the tour.
  std::vector<Place> places;
  std::vector<PictureRow> rows;
  const std::set<size_t> withPicture = spread(static_cast<size_t>(counts.pictures), static_cast<size_t>(counts.frames));
  for (const viewer::TourFrame& frame : viewer::spreadFrames(tour, static_cast<size_t>(counts.frames))) {
    if (frame.warmUp) continue;
    if (s.stopped()) break;
    Place place{viewAt(s, tour, frame.time, a.size), frame.dt, {}, {}};
    if (places.empty()) {
      place.items = std::move(first.items), place.reference = std::move(first.reference);
    } else {
      place.items = itemsInSight(s, place.view, a.timedItemSize);
      if (withPicture.contains(places.size())) place.reference = referenceOf(s, place.view);
    }
    drawPlace(s, runs, place, places.size(), false, &rows);
    places.push_back(std::move(place));
    s.progress("measuring " + tour.name, (runCount + 6) * a.timedFrames / counts.frames);
  }

  // For the page: the first place and the one that differs most.
  for (PictureRow& row : rows) row.path = tour.name;
  if (rows.empty()) return places;
  const auto worst =
      std::max_element(rows.begin(), rows.end(), [](const auto& x, const auto& y) { return x.flip < y.flip; });
  s.data.pictures.push_back(rows.front());
  if (worst != rows.begin()) s.data.pictures.push_back(*worst);
  return places;
}

void timePlaces(Session& s, std::vector<Run>& runs, std::vector<Place>& places, double until) {
  if (places.empty()) return;
  constexpr int kFewest = 3;
  double round = 0;
  for (int k = 0; k < std::min(s.amounts.warmUpFrames, 3) && !s.stopped(); ++k)
    round = timeOf([&] { drawPlace(s, runs, places.front(), 0, true); });
  const int frames = s.budget.affordable(std::min(s.amounts.curveFrames, static_cast<int>(places.size())), kFewest,
                                         until, 1.3 * round);  // pictures take the rest
  // Places with pictures first, as many as are wanted, then what lies evenly between.
  std::set<size_t> chosen;
  for (size_t k = 0; k < places.size() && static_cast<int>(chosen.size()) < s.amounts.curveViews; ++k)
    if (places[k].reference) chosen.insert(k);
  std::set<size_t> compared = chosen;
  for (const size_t k : spread(static_cast<size_t>(frames), places.size())) chosen.insert(k);
  for (const size_t k : chosen) {
    if (s.stopped()) return;
    // Others keep their reference for the next curve.
    std::optional<Picture> aside;
    if (!compared.contains(k)) std::swap(aside, places[k].reference);
    drawPlace(s, runs, places[k], k, false);
    if (aside) std::swap(aside, places[k].reference);
  }
}

void compareItems(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until) {
  const double duration = viewer::durationOf(tour);
  int views = s.amounts.itemViews;
  for (int k = 0; k < views && !s.stopped(); ++k) {
    const double each = timeOf([&] {
      Place place{viewAt(s, tour, tour.keys.front().time + duration * (k + 0.5) / views, s.amounts.size), 0, {}, {}};
      place.items = itemsInSight(s, place.view, s.amounts.itemSize);
      for (Run& run : runs) {
        plan::PlannerState state;
        const city::FramePlan plan = planFor(s, run, place, state);
        noteItems(s, run, plan, place);
        noteDrawn(s, run, plan, place);
      }
    });
    if (k == 0) views = s.budget.affordable(views, (views + 2) / 3, until, each);
    s.progress("item buffers of " + tour.name, 6.0 * s.amounts.itemViews / views);
  }
  s.noteCut("item buffers on " + tour.name, views, s.amounts.itemViews);
}

void measurePopping(Session& s, std::vector<Run>& runs, const city::Tour& tour, double until) {
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
      Place place{viewAt(s, tour, start + k * kStep, s.amounts.size), k == 0 ? 0 : kStep, {}, {}};
      place.reference = referenceOf(s, place.view);
      if (std::ranges::any_of(chosen, [](const Run* run) { return run->configuration.limit; }))
        place.items = itemsInSight(s, place.view, s.amounts.timedItemSize);
      Comparison comparison(*place.reference, s.options.flipPixelsPerDegree);
      for (size_t i = 0; i < chosen.size(); ++i) {
        chosen[i]->rig->renderer->draw(planFor(s, *chosen[i], place, states[i]));
        chosen[i]->approach.push_back(comparison.figuresOf(pictureOf(s, *chosen[i])).flip.exactMean);
      }
    });
    if (k == 0) frames = std::max(s.budget.affordable(frames, 3, until, each), 1);
    s.progress("popping on " + tour.name,
               (16.0 + 2.0 * static_cast<double>(chosen.size())) * s.amounts.approachFrames / frames);
  }
  s.noteCut("frames of the slow approach on " + tour.name, frames, s.amounts.approachFrames);
}

}  // namespace vicus::report
