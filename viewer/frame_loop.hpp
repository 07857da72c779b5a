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

/// Knobs of the viewer: viewer.multisamples, viewer.fov, viewer.vsync.
std::span<const city::Knob> viewerKnobs();

/// The view that is to be drawn next.
struct NextView {
  city::ViewState view;
  double dt = 0;        ///< seconds since the view before
  bool warmUp = false;  ///< drawn, but not counted
};

/// One stage of a frame.
struct StageSample {
  std::string_view name;
  double milliseconds = 0;
};

/// What one frame cost. The frame's time runs from its start to `glFinish`; showing it (`swap`) comes after.
struct FrameRecord {
  double milliseconds = 0;
  std::vector<StageSample> stages;  ///< input, the plan's steps, apply, traverse, finish, swap
  city::PlanCounts counts;
  scenegraph::DrawCounts draw;
};

/// What the loop works with: all made by the caller, all outliving the loop.
struct Stage {
  const city::City& city;
  const plan::Planner& planner;
  scenegraph::Scene& scene;
  Renderer& renderer;
  GlContext& context;
};

/// The measured part of a frame: makes the plan, draws it and waits for the card. The record's stages are the plan's
/// steps, apply, traverse and finish; its time runs from `begin`. The plan is handed over to `planned` where given.
FrameRecord drawFrame(const Stage& stage, std::chrono::steady_clock::time_point begin,
                      const std::function<city::FramePlan()>& makePlan, city::FramePlan* planned = nullptr);

/// What differs between a window and a row of pictures.
struct LoopHooks {
  /// Before each frame, outside its time: waits for the frame's moment. May be empty.
  std::function<void()> pause;
  /// Reads the devices or the tour: the next view, or nothing to end.
  std::function<std::optional<NextView>()> nextView;
  /// Pixels of the framebuffer that shows the frame; empty where nothing is shown.
  std::function<glm::ivec2()> windowSize;
  /// After each counted frame, outside its time; may read the picture. `frame` counts from 0. May be empty.
  std::function<void(size_t frame, const FrameRecord& record)> drawn;
  /// False where nobody will ask for the figures: a kiosk runs for weeks.
  bool keepRecords = true;
};

/// Draws frame after frame until there is no next view. Returns the records of all but the warm-up frames.
std::vector<FrameRecord> runFrames(const Stage& stage, const LoopHooks& hooks);

/// Frame and stage times of a run. Stages are in the order of their first appearance.
struct RunTimes {
  Percentiles frame;
  std::vector<std::pair<std::string, Percentiles>> stages;
};
RunTimes timesOf(std::span<const FrameRecord> records);

/// Counts of a run by the names that people see, in the order in which they are told.
std::vector<std::pair<std::string, MeanMax>> countsOf(std::span<const FrameRecord> records);

}  // namespace vicus::viewer
