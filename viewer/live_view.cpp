#include "viewer/live_view.hpp"

#include <utility>

namespace vicus::viewer {

LiveView::LiveView(Drawing& drawing, Stage& stage, std::string sceneName, Features features)
    : drawing_(drawing),
      stage_(stage),
      sceneName_(std::move(sceneName)),
      rendererName_(drawing.context.rendererName()),
      features_(std::move(features)),
      told_(features_(*drawing.planner, drawing.knobs)),
      overlay_(std::make_unique<Overlay>()) {}

void LiveView::install(LoopHooks& hooks) {
  hooks.pause = [this, before = std::move(hooks.pause)] {
    if (before) before();
    // What the user has turned counts from here on.
    bool turned = false;
    for (std::optional<KnobChange>* wanted : {&change_, &asked_})
      if (const auto change = std::exchange(*wanted, std::nullopt))
        turned |= turn(drawing_, change->name, change->value);
    if (!turned) return;
    stage_ = drawing_.stage();
    told_ = features_(*drawing_.planner, drawing_.knobs);
  };
  hooks.plan = [this](const NextView& next, plan::PlannerState& state) { return plan(next, state); };
  hooks.inScene = [this] {
    if (frozenView_) frozenView_->drawLines(shownView_);
  };
  hooks.overlay = [this](const NextView& next, const FrameRecord& record, const city::FramePlan& plan) {
    drawOver(next, record, plan);
  };
}

void LiveView::freeze(bool frozen) {
  wantsFrozen_ = frozen;
}

void LiveView::cityChanged() {
  frozenView_.reset();
  stage_ = drawing_.stage();
  told_ = features_(*drawing_.planner, drawing_.knobs);
}

void LiveView::switchPeople() {
  asked_ = KnobChange{"avatars.shown", drawing_.knobs.on("avatars.shown") ? 0.0 : 1.0};
}

city::FramePlan LiveView::plan(const NextView& next, plan::PlannerState& state) {
  if (!wantsFrozen_ && !from_) {
    frozenView_.reset();
    return stage_.planner->plan(*stage_.city, next.view, next.dt, state);
  }
  if (!frozenView_ || from_) {
    city::FramePlan plan = stage_.planner->plan(*stage_.city, next.view, next.dt, state);
    stage_.context->makeCurrent();
    const culling::CullMapView cullMap = stage_.planner->cullMap(*stage_.city, next.view);
    frozenView_ = std::make_unique<FrozenView>(*stage_.city, std::move(plan), cullMap, problem_);
  }
  shownView_ = from_.value_or(next.view);
  shownView_.viewport = next.view.viewport;
  return frozenView_->planFrom(shownView_);
}

void LiveView::drawOver(const NextView& next, const FrameRecord& record, const city::FramePlan& plan) {
  overlay_->note(record);
  Renderer& renderer = *stage_.renderer;
  if (frozenView_) frozenView_->drawTints(renderer, renderer.drawItems(plan));
  if (!overlayShown_) return;
  renderer.drawOver([&](glm::ivec2 size) {
    change_ =
        overlay_->draw(size, next.dt, input_,
                       {sceneName_, rendererName_, drawing_.knobs, told_, frozenView_ ? frozenView_->frozen() : plan,
                        record, stage_.scene->gpuBytes() + renderer.gpuBytes(), frozenView_ != nullptr});
  });
}

}  // namespace vicus::viewer
