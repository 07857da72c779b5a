#include "app/visit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "app/interrupt.hpp"
#include "viewer/panel.hpp"
#include "viewer/path_file.hpp"
#include "viewer/pictures.hpp"
#include "viewer/tours.hpp"
#include "viewer/whole_file.hpp"

namespace vicus::app {
namespace {

/// The first name of the row NAME-001, NAME-002, … that is free in the folder.
std::filesystem::path freeName(const std::string& folder, const std::string& name, const std::string& suffix) {
  for (int number = 1;; ++number) {
    std::filesystem::path path = std::filesystem::path(folder) / fmt::format("{}-{:03}{}", name, number, suffix);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return path;
  }
}

std::string rounded(double value, int decimals) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// Where and of what a picture is.
std::vector<std::pair<std::string, std::string>> notesOf(const OpenScene& scene, const city::ViewPose& pose) {
  const glm::dvec3 at = scene.city->origin + pose.eye;
  const std::string place = rounded(at.x, 2) + ", " + rounded(at.y, 2) + ", " + rounded(at.z, 2);
  const std::string crs = scene.city->crs.empty() ? "local metres" : scene.city->crs;
  const double compass = std::remainder(90 - glm::degrees(pose.heading) - 180, 360) + 180;
  const std::string view = rounded(pose.eye.x, 3) + "," + rounded(pose.eye.y, 3) + "," + rounded(pose.eye.z, 3) + "," +
                           rounded(glm::degrees(pose.heading), 2) + "," + rounded(glm::degrees(pose.pitch), 2);
  return {{"Title", scene.name},
          {"Description", scene.name + ": from " + place + " (" + crs + "), looking to " + rounded(compass, 0) +
                              " degrees from north"},
          {"Software", "Vicus"},
          {"Position", place},
          {"CRS", crs},
          {"View", view}};
}

std::string nameOf(viewer::Mode mode) {
  switch (mode) {
    case viewer::Mode::Walk:
      return "On foot";
    case viewer::Mode::Fly:
      return "Flying: E and Q go up and down, F back to the ground";
    case viewer::Mode::Orbit:
      return "Round about: the mouse turns, W and S or the wheel go nearer and farther, O back to the ground";
    case viewer::Mode::Map:
      return "Map: drag it, click to go there, M back to the ground";
    case viewer::Mode::Tour:
      return "Tour: a step leaves it";
  }
  return {};
}

}  // namespace

Visit::Visit(viewer::Window& window, std::string scene, std::string folder)
    : window_(window), scene_(std::move(scene)), folder_(std::move(folder)) {}

bool Visit::showLoading(const std::string& stage, double fraction) {
  constexpr auto kBetween = std::chrono::milliseconds(100);
  const Clock::time_point now = Clock::now();
  if (lastLoading_ && now - *lastLoading_ < kBetween) return !left_;
  lastLoading_ = now;
  const viewer::Input input = window_.poll();
  left_ = left_ || input.quit || interrupted();
  if (input.fullScreen) window_.toggleFullScreen();
  const glm::ivec2 size = window_.size();
  screen_.set(viewer::drawLoading(size, window_.contentScale(), scene_, left_ ? "leaving" : stage, fraction));
  screen_.paint(size, {0, 0});
  window_.swap();
  return !left_;
}

void Visit::showError(std::span<const std::string> reasons) {
  window_.makeCurrent();
  window_.freeMouse(true);
  glm::ivec2 drawnFor(0);
  while (!left_ && !interrupted()) {
    const viewer::Input input = window_.poll();
    left_ = input.quit;
    if (input.fullScreen) window_.toggleFullScreen();
    const glm::ivec2 size = window_.size();
    if (size != drawnFor)
      screen_.set(viewer::drawError(size, window_.contentScale(), scene_ + " cannot be shown", reasons));
    drawnFor = size;
    screen_.paint(size, {0, 0});
    window_.swap();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

void Visit::arrive(const OpenScene& scene, std::span<const city::Tour> tours, const city::Tour& first) {
  open_ = &scene;
  screen_.set({});
  sights_.tour = first;
  sights_.views = viewer::makeViews(tours);
  navigator_.manners = viewer::mannersFrom(scene.knobs);
  navigator_.pose = viewer::poseAt(first, first.keys.empty() ? 0 : first.keys.front().time);
  say("F1: help");
}

void Visit::say(const std::string& text) {
  constexpr auto kShown = std::chrono::seconds(4);
  const viewer::PanelLine line{text, "", false};
  message_.set(viewer::drawPanel({&line, 1}, window_.contentScale(), window_.size()));
  messageUntil_ = Clock::now() + kShown;
}

void Visit::record(double now) {
  if (!recorder_.recording()) {
    recorder_.begin("recorded");
    recorder_.note(now, navigator_.pose);
    say("Recording; R again keeps the tour");
    return;
  }
  const std::optional<city::Tour> tour = recorder_.end();
  if (!tour) return say("Nothing was recorded: that was too short");
  const std::filesystem::path path = freeName(folder_, "tour", ".json");
  const std::string problem = viewer::writeWhole(path, viewer::pathText(*tour));
  sights_.tour = *tour;
  say(problem.empty() ? "Kept as " + path.string() + "; T plays it" : "Not kept: " + problem);
}

void Visit::handleWindow(const viewer::Input& input) {
  if (input.help) helpShown_ = !helpShown_;
  if (input.screenshot) pictureWanted_ = true;
  if (!input.fullScreen) return;
  if (const std::string problem = window_.toggleFullScreen(); !problem.empty()) say("No full screen: " + problem);
}

void Visit::step(const viewer::Input& input, double now, double dt) {
  if (input.toggleRecord) record(now);
  const viewer::Mode before = navigator_.mode;
  viewer::step(navigator_, input, dt, *open_->city, sights_);
  recorder_.note(now, navigator_.pose);
  if (navigator_.mode != before) say(nameOf(navigator_.mode));
  if (input.takeBack) say("Back at the last good place");
}

void Visit::cityChanged() {
  // What stands near is gathered anew.
  for (viewer::Navigator* navigator : {&navigator_, &stayed_}) navigator->ground.reset(), navigator->standing.reset();
}

void Visit::showProblems(std::vector<viewer::PanelLine> lines) {
  const int margin = static_cast<int>(std::lround(16 * window_.contentScale()));
  problems_.set(lines.empty() ? viewer::Picture()
                              : viewer::drawPanel(lines, window_.contentScale(), window_.size() - 2 * margin));
}

void Visit::flyOut(const city::ViewPose& from) {
  stayed_ = std::move(navigator_);
  navigator_ = {};
  navigator_.pose = from, navigator_.mode = viewer::Mode::Fly, navigator_.manners = stayed_.manners;
}

void Visit::flyBack() {
  navigator_ = std::move(stayed_);
}

void Visit::paint() {
  const glm::ivec2 size = window_.size();
  const int margin = static_cast<int>(std::lround(16 * window_.contentScale()));
  if (helpShown_ && helpFor_ != size) {
    help_.set(viewer::drawPanel(viewer::helpLines(), window_.contentScale(), size - 2 * margin));
    helpFor_ = size;
  }
  if (helpShown_) help_.paint(size, (size - help_.size()) / 2);
  problems_.paint(size, {margin, margin});
  if (messageUntil_ && Clock::now() > *messageUntil_) message_.set({}), messageUntil_.reset();
  message_.paint(size, {(size.x - message_.size().x) / 2, size.y - message_.size().y - margin});
}

void Visit::keepPicture(const city::ViewPose& pose, const std::function<viewer::Picture()>& read) {
  if (!pictureWanted_) return;
  pictureWanted_ = false;
  const std::filesystem::path path = freeName(folder_, "picture", ".png");
  const std::string problem = viewer::writePng(path, read(), notesOf(*open_, pose));
  say(problem.empty() ? "Kept as " + path.string() : "Not kept: " + problem);
}

}  // namespace vicus::app
