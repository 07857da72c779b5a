/// What a window does for its visitor beside showing frames: loading, errors, help, short messages, pictures, recorded
/// tours, and the way through the city.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/open_scene.hpp"
#include "viewer/navigator.hpp"
#include "viewer/panel.hpp"
#include "viewer/recorder.hpp"
#include "viewer/shown_picture.hpp"
#include "viewer/window.hpp"

namespace vicus::app {

/// Lives while the window does. Invariant: what it paints is made anew only when it changed.
class Visit {
 public:
  /// Pictures and recorded tours go to `folder`.
  Visit(viewer::Window& window, std::string scene, std::string folder);

  viewer::Window& window() { return window_; }

  /// Paints how far loading is, at most ten times a second. False once the visitor has asked to leave.
  bool showLoading(const std::string& stage, double fraction);
  /// Says what went wrong until the visitor closes the window.
  void showError(std::span<const std::string> reasons);

  /// The city is there. It must outlive this.
  void arrive(const OpenScene& scene, std::span<const city::Tour> tours, const city::Tour& first);
  /// What the devices ask of the window: help, full screen, a picture.
  void handleWindow(const viewer::Input& input);
  /// The visitor's next place: where the devices ask for.
  void step(const viewer::Input& input, double now, double dt);
  const viewer::Navigator& navigator() const { return navigator_; }
  /// Leaves the visitor where he is and flies out from a pose; back again.
  void flyOut(const city::ViewPose& from);
  void flyBack();
  /// The city became another one at the same place.
  void cityChanged();
  /// Shows a few words for some seconds.
  void say(const std::string& text);
  /// Shows what is wrong until it is right: one text or a quoted piece of a file a line. Nothing: it is right.
  void showProblems(std::vector<viewer::PanelLine> lines);
  /// Paints over the frame, just before it is shown.
  void paint();
  /// After a frame from that pose: keeps its picture where the visitor asked for one.
  void keepPicture(const city::ViewPose& pose, const std::function<viewer::Picture()>& read);

 private:
  void record(double now);

  using Clock = std::chrono::steady_clock;
  viewer::Window& window_;
  std::string scene_, folder_;
  const OpenScene* open_ = nullptr;
  viewer::Navigator navigator_, stayed_;
  viewer::Sights sights_;
  viewer::Recorder recorder_;
  bool helpShown_ = false, pictureWanted_ = false, left_ = false;
  glm::ivec2 helpFor_{0};  ///< window size that the help was made for
  viewer::ShownPicture help_, message_, problems_, screen_;
  std::optional<Clock::time_point> messageUntil_, lastLoading_;
};

}  // namespace vicus::app
