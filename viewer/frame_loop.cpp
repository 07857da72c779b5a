#include "viewer/frame_loop.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace vicus::viewer {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

constexpr city::Knob kViewerKnobs[] = {
    {"viewer.multisamples", 4, 1, 8, "samples", "Samples of each pixel that smooth the edges of what is drawn.",
     "jagged, crawling edges", "slower, and smoother than one sees"},
    {"viewer.fov", 60, 1, 170, "degrees", "Angle between the top and the bottom of the picture.",
     "like looking through a telescope", "the picture's edges are stretched"},
    {"viewer.vsync", 1, 0, 1, "on/off", "Shows a frame only when the screen begins a new one.",
     "off: faster than the screen, and frames may tear", "on is the most"},
    {"viewer.monitor", 0, 0, 16, "number", "Monitor that full screen fills; 0 is the one that the window is on.",
     "0: wherever the window is", "a number without a monitor: F11 says so"},
    {"viewer.touch", 0, 0, 1, "on/off", "One finger looks, two fingers move, a tap goes there; the pointer stays free.",
     "off: the mouse looks, without a button", "on: with a mouse, hold the left button to look"},
};

}  // namespace

std::span<const city::Knob> viewerKnobs() {
  return kViewerKnobs;
}

FrameRecord drawFrame(const Stage& stage, Clock::time_point begin, const std::function<city::FramePlan()>& makePlan,
                      city::FramePlan* planned, const std::function<void()>& inScene) {
  FrameRecord record;

  // Plan: everything decided, nothing drawn.
  city::FramePlan plan = makePlan();
  for (const city::StageTime& s : plan.stages) record.stages.add(s.name, s.milliseconds);

  // The plan into the scene graph, and the scene graph onto the card.
  const DrawTimes times = stage.renderer->draw(plan, inScene);
  for (const StageSample& s : times.stages) record.stages.add(s.name, s.milliseconds);
  record.milliseconds = millisecondsSince(begin);
  record.gpuMilliseconds = times.gpuMilliseconds;
  record.counts = plan.counts;
  record.draw = stage.scene->counts();
  if (planned) *planned = std::move(plan);
  return record;
}

std::vector<FrameRecord> runFrames(const Stage& stage, const LoopHooks& hooks) {
  std::vector<FrameRecord> records;
  if (hooks.keepRecords) records.reserve(hooks.expectedFrames);
  size_t frame = 0;
  plan::PlannerState state;
  const plan::Planner* planner = stage.planner;
  for (;;) {
    if (hooks.pause) hooks.pause();
    // Another planner remembers other things.
    if (std::exchange(planner, stage.planner) != stage.planner) state = {};
    const Clock::time_point begin = Clock::now();

    // Input: where the eye is now.
    const std::optional<NextView> next = hooks.nextView();
    if (!next) return records;
    const double input = millisecondsSince(begin);

    city::FramePlan plan;
    FrameRecord drawn = drawFrame(
        stage, begin,
        [&] {
          return hooks.plan ? hooks.plan(*next, state) : stage.planner->plan(*stage.city, next->view, next->dt, state);
        },
        &plan, hooks.inScene);
    FrameRecord record = drawn;
    record.stages = {{"input", input}};
    for (const StageSample& s : drawn.stages) record.stages.add(s.name, s.milliseconds);

    // Overlay and swap: show it.
    StageClock after;
    if (hooks.overlay) {
      hooks.overlay(*next, record, plan);
      record.stages.add("overlay", after.lap());
    }
    if (hooks.windowSize) stage.renderer->present(hooks.windowSize());
    if (hooks.overWindow) hooks.overWindow();
    stage.context->swap();
    record.stages.add("swap", after.lap());

    if (next->warmUp) continue;
    if (hooks.drawn) hooks.drawn(frame, record);
    ++frame;
    if (hooks.keepRecords) records.push_back(record);
  }
}

RunTimes timesOf(std::span<const FrameRecord> records) {
  std::vector<double> frames, gpu;
  std::vector<std::pair<std::string, std::vector<double>>> stages;
  for (const FrameRecord& r : records) {
    frames.push_back(r.milliseconds);
    if (r.gpuMilliseconds) gpu.push_back(*r.gpuMilliseconds);
    for (const StageSample& s : r.stages) {
      auto it = std::find_if(stages.begin(), stages.end(), [&](const auto& known) { return known.first == s.name; });
      if (it == stages.end()) it = stages.insert(stages.end(), {std::string(s.name), {}});
      it->second.push_back(s.milliseconds);
    }
  }
  RunTimes out;
  out.frame = percentiles(frames);
  if (!gpu.empty()) out.gpu = percentiles(gpu);
  for (const auto& [name, values] : stages) out.stages.emplace_back(name, percentiles(values));
  return out;
}

std::vector<std::pair<std::string, MeanMax>> countsOf(std::span<const FrameRecord> records) {
  std::vector<std::pair<std::string, MeanMax>> out;
  const auto add = [&](const char* name, auto&& valueOf) {
    std::vector<double> values;
    for (const FrameRecord& r : records) values.push_back(static_cast<double>(valueOf(r)));
    out.emplace_back(name, meanMax(values));
  };
  add("tiles", [](const FrameRecord& r) { return r.counts.tiles; });
  add("tiles_drawn", [](const FrameRecord& r) { return r.counts.tilesDrawn; });
  add("instances", [](const FrameRecord& r) { return r.counts.instances; });
  add("instances_in_frustum", [](const FrameRecord& r) { return r.counts.instancesInFrustum; });
  add("instances_occluded", [](const FrameRecord& r) { return r.counts.instancesOccluded; });
  add("instances_drawn", [](const FrameRecord& r) { return r.counts.instancesDrawn; });
  add("instances_flat", [](const FrameRecord& r) { return r.counts.instancesFlat; });
  add("trees_drawn", [](const FrameRecord& r) { return r.counts.treesDrawn; });
  add("box_tests", [](const FrameRecord& r) { return r.counts.boxTests; });
  add("triangles", [](const FrameRecord& r) { return r.draw.triangles; });
  add("terrain_triangles", [](const FrameRecord& r) { return r.draw.terrainTriangles; });
  add("draw_calls", [](const FrameRecord& r) { return r.draw.drawCalls; });
  add("indirect_commands", [](const FrameRecord& r) { return r.draw.indirectCommands; });
  add("texture_binds", [](const FrameRecord& r) { return r.draw.textureBinds; });
  // No scene has this yet; readers of the figures may count on it.
  add("blockmaps", [](const FrameRecord&) { return 0; });
  add("avatars", [](const FrameRecord& r) { return r.counts.avatarsDrawn; });
  add("avatar_poses", [](const FrameRecord& r) { return r.counts.avatarPoses; });
  return out;
}

}  // namespace vicus::viewer
