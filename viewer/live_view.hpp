/// Looking into a scene while it runs: the overlay (F2) and the frozen view (F3).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viewer/drawing.hpp"
#include "viewer/frozen_view.hpp"
#include "viewer/overlay.hpp"

namespace vicus::viewer {

/// Hooks into the render loop. Invariant: while nothing is shown it costs nothing but a note of each frame's times. Let
/// go with the context current.
class LiveView {
 public:
  /// The technique and content of the scene as people are told of them.
  using Features = std::function<std::vector<plan::FeatureReport>(const plan::Planner&, const city::Knobs&)>;

  /// `drawing` and `stage` are the loop's; turning a knob changes both between two frames.
  LiveView(Drawing& drawing, Stage& stage, std::string sceneName, Features features);

  /// Puts itself into the loop's hooks; what `pause` did before it still does.
  void install(LoopHooks& hooks);

  void showOverlay(bool shown) { overlayShown_ = shown; }
  bool overlayShown() const { return overlayShown_; }
  /// Freezes the plan of the next frame, or thaws it.
  void freeze(bool frozen);
  bool frozen() const { return wantsFrozen_; }
  /// The loop's drawing shows another city: between two frames. A frozen view is frozen anew.
  void cityChanged();
  /// Shows the people from the next frame on, or no longer.
  void switchPeople();
  /// Freezes every frame's plan and shows it from this place.
  void showFrom(const city::ViewState& view) { from_ = view; }
  void point(const OverlayInput& input) { input_ = input; }
  /// What could not be drawn, in plain words; empty is good.
  const std::string& problem() const { return problem_; }

 private:
  city::FramePlan plan(const NextView& next, plan::PlannerState& state);
  void drawOver(const NextView& next, const FrameRecord& record, const city::FramePlan& plan);

  Drawing& drawing_;
  Stage& stage_;
  std::string sceneName_, rendererName_, problem_;
  Features features_;
  std::vector<plan::FeatureReport> told_;  ///< features of the present planner
  std::unique_ptr<Overlay> overlay_;       ///< made when first shown
  std::unique_ptr<FrozenView> frozenView_;
  bool overlayShown_ = false, wantsFrozen_ = false;
  std::optional<city::ViewState> from_;
  city::ViewState shownView_;
  OverlayInput input_;
  std::optional<KnobChange> change_, asked_;  ///< from the panel, and from a key
};

}  // namespace vicus::viewer
