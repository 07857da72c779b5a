/// The one render loop.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/measure.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Knobs of the viewer: viewer.multisamples, viewer.fov, viewer.vsync, viewer.monitor, viewer.touch.
std::span<const city::Knob> viewerKnobs();

/// The view that is to be drawn next.
struct NextView {
  city::ViewState view;
  double dt = 0;        ///< seconds since the view before
  bool warmUp = false;  ///< drawn, but not counted
};

/// What one frame cost. The frame's time runs from its start to `glFinish`; the overlay and showing it (`swap`) come
/// after.
struct FrameRecord {
  double milliseconds = 0;
  /// input, the plan's steps, apply FEATURE…, update, cull, draw, finish, overlay, swap. Names live as long as the
  /// scene.
  StageSamples stages;
  std::optional<double>
      gpuMilliseconds;  ///< between the first and the last GL command; nothing where the driver tells none
  city::PlanCounts counts;
  scenegraph::DrawCounts draw;
};

/// What the loop works with: all made by the caller, none of it null. The caller may put others in their places between
/// two frames, in `LoopHooks::pause`.
struct Stage {
  const city::City* city = nullptr;
  const plan::Planner* planner = nullptr;
  scenegraph::Scene* scene = nullptr;
  Renderer* renderer = nullptr;
  GlContext* context = nullptr;
};

/// The measured part of a frame: makes the plan, draws it and waits for the card. The record's stages are the plan's
/// steps and those of `Renderer::draw`; its time runs from `begin`. The plan is handed over to `planned` where given.
/// `inScene` as in `Renderer::draw`.
FrameRecord drawFrame(const Stage& stage, std::chrono::steady_clock::time_point begin,
                      const std::function<city::FramePlan()>& makePlan, city::FramePlan* planned = nullptr,
                      const std::function<void()>& inScene = {});

/// What differs between a window and a row of pictures.
struct LoopHooks {
  /// Before each frame, outside its time: waits for the frame's moment. May be empty.
  std::function<void()> pause;
  /// Reads the devices or the tour: the next view, or nothing to end.
  std::function<std::optional<NextView>()> nextView;
  /// Makes the plan instead of the planner, in the frame's time: the frozen view. May be empty.
  std::function<city::FramePlan(const NextView& next, plan::PlannerState& state)> plan;
  /// Draws more into the scene, with its depth; see `Renderer::draw`. May be empty.
  std::function<void()> inScene;
  /// Draws over the finished picture, outside the frame's time. May be empty.
  std::function<void(const NextView& next, const FrameRecord& record, const city::FramePlan& plan)> overlay;
  /// Pixels of the framebuffer that shows the frame; empty where nothing is shown.
  std::function<glm::ivec2()> windowSize;
  /// After the frame was copied to the window and before it is shown: paints what is ours over it. May be empty.
  std::function<void()> overWindow;
  /// After each counted frame, outside its time; may read the picture. `frame` counts from 0. May be empty.
  std::function<void(size_t frame, const FrameRecord& record)> drawn;
  /// False where nobody will ask for the figures: a kiosk runs for weeks.
  bool keepRecords = true;
  /// Counted frames to make room for, so that keeping their records allocates nothing; 0 where nobody knows.
  size_t expectedFrames = 0;
};

/// Draws frame after frame until there is no next view. Returns the records of all but the warm-up frames.
std::vector<FrameRecord> runFrames(const Stage& stage, const LoopHooks& hooks);

/// Frame and stage times of a run. Stages are in the order of their first appearance.
struct RunTimes {
  Percentiles frame;
  std::optional<Percentiles> gpu;  ///< nothing where the driver tells none
  std::vector<std::pair<std::string, Percentiles>> stages;
};
RunTimes timesOf(std::span<const FrameRecord> records);

/// Counts of a run by the names that people see, in the order in which they are told.
std::vector<std::pair<std::string, MeanMax>> countsOf(std::span<const FrameRecord> records);

}  // namespace vicus::viewer
