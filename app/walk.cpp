#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <set>
#include <sstream>
#include <thread>
#include <utility>

#include "app/commands.hpp"
#include "app/figures.hpp"
#include "app/interrupt.hpp"
#include "app/open_scene.hpp"
#include "app/reload.hpp"
#include "app/visit.hpp"
#include "report/stage_trace.hpp"
#include "viewer/drawing.hpp"
#include "viewer/film.hpp"
#include "viewer/live_view.hpp"
#include "viewer/path_file.hpp"
#include "viewer/pictures.hpp"
#include "viewer/tours.hpp"
#include "viewer/whole_file.hpp"
#include "viewer/window.hpp"

namespace vicus::app {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A view that is known before the walk begins.
struct PlannedView {
  city::ViewPose pose;
  double fov = 0;  ///< radians
  double time = 0, dt = 0;
  bool warmUp = false;
};

/// The frames of a walk whose views do not depend on when they are drawn: single views, N frames spread over a tour,
/// or every frame of a film.
std::vector<PlannedView> plannedViews(const WalkOptions& options, const city::Tour& tour, double fov) {
  constexpr size_t kDefaultFrames = 120;
  std::vector<PlannedView> views;
  for (const ViewOption& v : options.views)
    views.push_back({{v.eye, v.heading, v.pitch, 0}, v.fov.value_or(fov), 0, 0, false});
  if (!views.empty()) {
    views.insert(views.begin(), viewer::kWarmUpFrames, views.front());
    for (size_t k = 0; k < viewer::kWarmUpFrames; ++k) views[k].warmUp = true;
    return views;
  }
  size_t frames = options.frames.value_or(kDefaultFrames);
  if (options.fps) frames = 1 + static_cast<size_t>(std::floor(viewer::durationOf(tour) * *options.fps));
  for (const viewer::TourFrame& f : viewer::spreadFrames(tour, frames))
    views.push_back({viewer::poseAt(tour, f.time), fov, f.time, f.dt, f.warmUp});
  return views;
}

/// Which frames become pictures, and where.
struct PictureChoice {
  std::string folder;  ///< empty: none
  size_t every = 1;
  std::set<size_t> frames;  ///< where not empty: these, and `every` does not count

  bool has(size_t frame) const {
    if (folder.empty()) return false;
    return frames.empty() ? frame % every == 0 : frames.contains(frame);
  }
  std::filesystem::path file(size_t frame) const {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%05zu.png", frame);
    return std::filesystem::path(folder) / name;
  }
};

/// As asked; offscreen with no folder named, eight frames evenly into out/.
PictureChoice choosePictures(const WalkOptions& options, size_t frames) {
  constexpr size_t kPictures = 8;
  PictureChoice choice;
  choice.every = options.every.value_or(1);
  if (!options.film.empty()) return choice;
  // In a window a folder alone is where the visitor's own pictures go.
  if (options.headless || options.every || options.frames || !options.views.empty()) choice.folder = options.out;
  if (!options.out.empty() || !options.headless) return choice;
  choice.folder = "out";
  if (options.every || frames <= kPictures) return choice;
  for (size_t k = 0; k < kPictures; ++k) choice.frames.insert(k * (frames - 1) / (kPictures - 1));
  return choice;
}

/// The context to draw in: a window's, or one without any display.
struct Screen {
  std::unique_ptr<viewer::GlContext> context;
  viewer::Window* window = nullptr;  ///< null offscreen
};

Screen openScreen(const WalkOptions& options, const city::Knobs& knobs, std::string& error) {
  Screen screen;
  if (options.headless) {
    screen.context = viewer::makeOffscreenContext(error);
  } else {
    auto window = viewer::Window::open({"Vicus – " + sceneName(options.scene), options.size, knobs.on("viewer.vsync"),
                                        knobs.on("viewer.touch"), static_cast<int>(knobs["viewer.monitor"])},
                                       error);
    screen.window = window.get();
    screen.context = std::move(window);
  }
  return screen;
}

/// The tour that the user named, `street` where none is (a free walk begins at its start); in `code` the exit code
/// where there is no such tour. In a window `tours` gets all.
std::optional<city::Tour> chooseTour(const WalkOptions& options, const city::City& city, Console& console, int& code,
                                     std::vector<city::Tour>& tours) {
  if (!options.headless) tours = viewer::makeTours(city);
  if (!options.path.empty()) {
    city::Diagnostics diagnostics;
    std::optional<city::Tour> path = viewer::readPath(options.path, diagnostics);
    console.report(diagnostics);
    if (!path) code = kCouldNot;
    return path;
  }
  if (!options.views.empty()) return city::Tour();
  if (tours.empty()) tours = viewer::makeTours(city);
  const std::string name = options.tour.empty() ? "street" : options.tour;
  if (const city::Tour* tour = viewer::findTour(tours, name)) return *tour;
  std::string known;
  for (const city::Tour& t : tours) known += (known.empty() ? "" : ", ") + t.name;
  console.error("--tour: there is no tour '" + name + "'; this scene has " + known);
  code = kWrongUsage;
  return std::nullopt;
}

/// Where the next view comes from, frame after frame.
class Guide {
 public:
  /// `visit`: of the window; null offscreen.
  Guide(const WalkOptions& options, const OpenScene& scene, const city::Tour& tour, Visit* visit)
      : tour_(tour),
        visit_(visit),
        size_(options.size),
        fov_(glm::radians(scene.knobs["viewer.fov"])),
        fps_(options.fps) {
    const bool guided = !options.path.empty() || !options.tour.empty();
    free_ = visit && !guided && options.views.empty() && !options.frames && !options.fps;
    live_ = visit && options.views.empty() && !options.frames;
    if (!live_) planned_ = plannedViews(options, tour, fov_);
  }

  /// Counted frames, where they are known beforehand.
  size_t countedFrames() const {
    return static_cast<size_t>(
        std::count_if(planned_.begin(), planned_.end(), [](const auto& v) { return !v.warmUp; }));
  }
  bool free() const { return free_; }
  const city::ViewPose& pose() const { return pose_; }  ///< of the last view

  /// Where frames have their moments: waits for the next one. Those that would be late are passed over.
  void pause() {
    if (!live_ || !fps_ || frame_ < viewer::kWarmUpFrames) return;
    const double now = secondsSince(begin_);
    due_ = std::max(due_ + 1 / *fps_, std::floor(now * *fps_) / *fps_);
    if (due_ > now) std::this_thread::sleep_for(std::chrono::duration<double>(due_ - now));
  }

  std::optional<viewer::NextView> next() {
    viewer::Input input;
    if (visit_) input = visit_->window().poll(), size_ = visit_->window().size();
    if (input.quit || interrupted()) return std::nullopt;
    if (visit_) visit_->handleWindow(input);
    if (visit_ && live_ && lookedInto_) lookInto(*visit_, input);
    std::optional<viewer::NextView> next = live_ ? liveView(input) : plannedView();
    if (visit_) visit_->window().freeMouse(panelHasMouse_ || (free_ && visit_->navigator().wantsPointer()));
    return next;
  }

  /// F2 and F3 work on it from now on.
  void lookInto(viewer::LiveView& live) { lookedInto_ = &live; }

 private:
  /// P shows the people or not; F2 shows the overlay and gives it the mouse; F3 freezes the plan, and the visitor flies
  /// out to see it. Thawed, the visitor is back where it was frozen.
  void lookInto(Visit& visit, viewer::Input& input) {
    if (input.toggleOverlay) lookedInto_->showOverlay(!lookedInto_->overlayShown());
    if (input.togglePeople) lookedInto_->switchPeople();
    if (input.toggleFreeze) {
      lookedInto_->freeze(!lookedInto_->frozen());
      if (lookedInto_->frozen())
        visit.flyOut(pose_), frozenFree_ = std::exchange(free_, true);
      else
        visit.flyBack(), free_ = frozenFree_;
    }
    // The panel has the mouse, and the head turns only while the right button is held.
    panelHasMouse_ = lookedInto_->overlayShown() && !input.rightButton;
    lookedInto_->point({panelHasMouse_ ? input.pointer : glm::dvec2(-1), input.leftButton, input.wheel});
    if (panelHasMouse_) input.mouse = glm::dvec2(0), input.wheel = 0, input.leftButton = input.tap = false;
  }

  std::optional<viewer::NextView> plannedView() {
    if (frame_ == planned_.size()) return std::nullopt;
    const PlannedView& planned = planned_[frame_++];
    return nextView(planned.pose, planned.fov, planned.time, planned.dt, planned.warmUp);
  }

  /// A view of this moment: the visitor's own, or the tour's.
  std::optional<viewer::NextView> liveView(const viewer::Input& input) {
    // The clock starts when the first frames have warmed everything up.
    const bool warmUp = frame_++ < viewer::kWarmUpFrames;
    if (warmUp) begin_ = Clock::now();
    const double now = warmUp ? 0 : fps_ ? due_ : secondsSince(begin_);
    const double dt = now - time_;
    time_ = now;
    if (visit_ && free_) {
      visit_->step(input, now, dt);
      return nextView(visit_->navigator().pose, fov_, now, dt, warmUp);
    }
    if (now > viewer::durationOf(tour_)) return std::nullopt;
    return nextView(viewer::poseAt(tour_, tour_.keys.front().time + now), fov_, now, dt, warmUp);
  }

  viewer::NextView nextView(const city::ViewPose& pose, double fov, double time, double dt, bool warmUp) {
    pose_ = pose;
    view_ = city::makeView(pose, fov, size_, view_);
    view_.time = time;
    return {view_, dt, warmUp};
  }

  const city::Tour& tour_;
  Visit* visit_;
  glm::ivec2 size_;
  double fov_;
  std::optional<double> fps_;
  bool free_ = false;  ///< the visitor walks
  bool live_ = false;  ///< views depend on the clock
  std::vector<PlannedView> planned_;
  size_t frame_ = 0;
  viewer::LiveView* lookedInto_ = nullptr;
  bool frozenFree_ = false;  ///< whether the visitor walked freely when the plan was frozen
  bool panelHasMouse_ = false;
  Clock::time_point begin_ = Clock::now();
  double time_ = 0;      ///< of the frame before, seconds since begin_
  double due_ = 0;       ///< moment of the next frame, seconds since begin_
  city::ViewPose pose_;  ///< of the last view
  city::ViewState view_;
};

/// Shows what came of changed rules, or says what is wrong with them.
void showRebuilt(Rebuilt rebuilt, OpenScene& scene, viewer::Drawing& drawing, viewer::LiveView& live, Visit& visit,
                 Console& console) {
  if (!rebuilt.city) {
    console.report(rebuilt.diagnostics);
    std::vector<viewer::PanelLine> lines{{"The town stays as it was", "", true}};
    constexpr size_t kMost = 4;
    for (const city::Diagnostic& d : rebuilt.diagnostics.messages)
      if (d.severity == city::Severity::Error && lines.size() < 3 * kMost) {
        std::istringstream text(city::describe(d));
        for (std::string line; std::getline(text, line);) lines.push_back({line, "", false, line.starts_with("  ")});
      }
    visit.showProblems(std::move(lines));
    return;
  }
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f", rebuilt.seconds);
  show(std::move(rebuilt), scene, drawing);
  live.cityChanged();
  visit.cityChanged();
  visit.showProblems({});
  visit.say(std::string("Built anew in ") + seconds + " s");
  console.say(std::to_string(scene.city->buildings.size()) + " buildings built anew in " + seconds + " s");
}

void tellTimes(const std::vector<viewer::FrameRecord>& records, const std::string& renderer, Console& console) {
  if (records.empty()) return;
  const viewer::RunTimes times = viewer::timesOf(records);
  char text[160];
  std::snprintf(text, sizeof text, "%zu frames: median %.1f ms, 95 %% under %.1f ms, longest %.1f ms", records.size(),
                times.frame.median, times.frame.p95, times.frame.max);
  console.say(std::string(text) + " (" + renderer + ")");
}

}  // namespace

int walk(const WalkOptions& options, const Surroundings& surroundings) {
  Console console(surroundings);
  if (const std::string problem = options.headless ? "" : viewer::displayProblem(); !problem.empty()) {
    console.error(problem);
    return kCouldNot;
  }
  const std::optional<city::Knobs> knobs = knobsFrom(options.scene.knobs, console);
  if (!knobs) return kWrongUsage;

  // The city is read while the screen opens: starting a driver takes as long as reading a small town.
  int code = kDone;
  std::future<std::optional<OpenScene>> opening =
      std::async(std::launch::async, [&] { return openScene(options.scene, surroundings, console, code); });
  std::string screenProblem;
  const Screen screen = openScreen(options, *knobs, screenProblem);
  city::Diagnostics diagnostics;
  std::optional<Visit> visit;
  if (screen.window) visit.emplace(*screen.window, sceneName(options.scene), options.out.empty() ? "out" : options.out);
  std::future<scenegraph::GroundDetail> painting = std::async(
      visit ? std::launch::async : std::launch::deferred, [&] { return scenegraph::paintGroundDetail(diagnostics); });
  // A window says how far it is. A visitor who leaves is not kept until the end: what is written is written whole or
  // not at all.
  const auto showLoading = [&] {
    const auto [stage, fraction] = console.shownProgress();
    if (visit && !visit->showLoading(stage, fraction)) std::quick_exit(kDone);
  };
  const auto fail = [&](int exitCode) {
    if (visit) visit->showError(console.errors());
    return exitCode;
  };
  while (visit && opening.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) showLoading();
  std::optional<OpenScene> scene = opening.get();
  scenegraph::GroundDetail groundDetail = painting.get();
  if (!screen.context) console.error(screenProblem);
  if (!scene || !screen.context) return fail(scene ? kCouldNot : code);
  std::vector<city::Tour> tours;
  std::future<std::optional<city::Tour>> choosing =
      std::async(std::launch::async, [&] { return chooseTour(options, *scene->city, console, code, tours); });

  // The scene graph and the renderer; the city's buffers reach the card with the first frame.
  screen.context->makeCurrent();
  viewer::Drawing drawing{scene->city.get(), *screen.context, scene->knobs, {}, {}, {}};
  drawing.planner = std::make_unique<plan::Planner>(*scene->city, scene->knobs);
  drawing.scene = std::make_unique<scenegraph::Scene>(
      *scene->city, scene->knobs, diagnostics,
      [&](std::string_view stage, double fraction) {
        console.progress(stage, fraction);
        showLoading();
      },
      std::move(groundDetail), drawing.planner->houses());
  while (visit && choosing.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) showLoading();
  const std::optional<city::Tour> tour = choosing.get();
  if (!tour) return fail(code);
  console.progressDone();
  console.report(diagnostics);
  drawing.renderer = std::make_unique<viewer::Renderer>(*screen.context, *drawing.scene,
                                                        static_cast<int>(scene->knobs["viewer.multisamples"]));
  const std::string rendererName = screen.context->rendererName();

  // The walk.
  if (visit) visit->arrive(*scene, tours, *tour);
  Guide guide(options, *scene, *tour, visit ? &*visit : nullptr);
  const PictureChoice pictures = choosePictures(options, guide.countedFrames());
  std::string pictureProblem;
  size_t written = 0;
  std::unique_ptr<viewer::Film> film;
  if (!options.film.empty()) film = viewer::Film::open(options.film, options.size, *options.fps, pictureProblem);
  glm::ivec2 size = options.size;
  viewer::LoopHooks hooks;
  hooks.nextView = [&] {
    if (!pictureProblem.empty()) return std::optional<viewer::NextView>();
    std::optional<viewer::NextView> next = guide.next();
    if (next) size = next->view.viewport;
    return next;
  };
  double firstFrame = 0;  // seconds from the program's start to the end of the first frame
  size_t frames = 0;
  hooks.pause = [&] {
    if (++frames == 2) firstFrame = viewer::secondsSinceProcessStart();
    guide.pause();
  };
  if (screen.window) hooks.windowSize = [&] { return screen.window->size(); };
  size_t problemsTold = 0;
  if (visit)
    hooks.overWindow = [&] {
      const std::vector<std::string>& problems = drawing.renderer->problems();
      if (problems.size() > problemsTold) visit->say(problems[problemsTold++]);
      visit->paint();
    };
  hooks.keepRecords = !guide.free() || !options.json.empty() || !options.trace.empty();
  hooks.expectedFrames = guide.countedFrames();
  hooks.drawn = [&](size_t frame, const viewer::FrameRecord&) {
    if (guide.countedFrames() > 0)
      console.progress("drawing", static_cast<double>(frame + 1) / static_cast<double>(guide.countedFrames()));
    if (visit) visit->keepPicture(guide.pose(), [&] { return drawing.renderer->readPicture(); });
    if (film) pictureProblem = film->add(drawing.renderer->readPicture());
    if (!pictures.has(frame)) return;
    pictureProblem = viewer::writePng(pictures.file(frame), drawing.renderer->readPicture());
    if (pictureProblem.empty()) ++written;
  };
  // Looking into it: in a window with F2 and F3, offscreen where it is asked for.
  viewer::Stage stage = drawing.stage();
  std::optional<viewer::LiveView> live;
  if (screen.window || options.overlay || options.seenFrom) {
    live.emplace(drawing, stage, scene->name, featuresOf);
    live->showOverlay(options.overlay);
    if (options.seenFrom)
      live->showFrom(city::makeView({options.seenFrom->eye, options.seenFrom->heading, options.seenFrom->pitch, 0},
                                    options.seenFrom->fov.value_or(glm::radians(scene->knobs["viewer.fov"])),
                                    options.size));
    live->install(hooks);
    guide.lookInto(*live);
  }
  // Changes of rules show while one walks.
  std::optional<Reload> reload;
  if (visit && !scene->ownFiles.empty()) {
    reload.emplace(*scene, options.scene, surroundings.dataFolder);
    hooks.pause = [&, before = std::move(hooks.pause)] {
      before();
      if (std::optional<Rebuilt> rebuilt = reload->poll(drawing.knobs))
        showRebuilt(std::move(*rebuilt), *scene, drawing, *live, *visit, console);
    };
  }
  const std::vector<viewer::FrameRecord> records = viewer::runFrames(stage, hooks);
  console.progressDone();

  // What came of it.
  if (film && pictureProblem.empty() && !interrupted()) {
    pictureProblem = film->finish();
    if (pictureProblem.empty()) console.say("film in " + options.film);
  }
  finishCache(*scene, console);
  if (live && !live->problem().empty()) console.error(live->problem()), code = kCouldNot;
  for (const std::string& problem : drawing.renderer->problems()) console.error(problem), code = kCouldNot;
  if (!pictureProblem.empty()) console.error(pictureProblem), code = kCouldNot;
  tellTimes(records, rendererName, console);
  if (written > 0)
    console.say(std::to_string(written) + (written == 1 ? " picture in " : " pictures in ") +
                std::filesystem::absolute(pictures.folder).lexically_normal().string());
  if (!options.trace.empty()) {
    const std::string problem = viewer::writeWhole(options.trace, report::chromeTrace(report::tracedFrames(records)));
    if (!problem.empty()) console.error(problem), code = kCouldNot;
  }
  if (!options.json.empty()) {
    const std::vector<plan::FeatureReport> features = featuresOf(*drawing.planner, drawing.knobs);
    const uint64_t gpuBytes = drawing.scene->gpuBytes() + drawing.renderer->gpuBytes();
    const std::string problem = viewer::writeWhole(
        options.json,
        walkJson({*scene, features, records, rendererName, size, firstFrame, gpuBytes, viewer::peakResidentBytes()}));
    if (!problem.empty()) console.error(problem), code = kCouldNot;
  }
  return code;
}

}  // namespace vicus::app
