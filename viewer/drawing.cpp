#include "viewer/drawing.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "houselod/levels.hpp"

namespace vicus::viewer {
namespace {

bool isOf(std::span<const city::Knob> knobs, std::string_view name) {
  return std::ranges::any_of(knobs, [&](const city::Knob& knob) { return knob.name == name; });
}

}  // namespace

void showCity(Drawing& drawing, const city::City& city, std::unique_ptr<plan::Planner> planner,
              std::unique_ptr<scenegraph::Scene> scene) {
  drawing.context.makeCurrent();
  drawing.renderer.reset();
  drawing.city = &city;
  drawing.planner = std::move(planner);
  drawing.scene = std::move(scene);
  drawing.renderer = std::make_unique<Renderer>(drawing.context, *drawing.scene,
                                                static_cast<int>(drawing.knobs["viewer.multisamples"]));
}

bool turn(Drawing& drawing, std::string_view knob, double value) {
  if (!drawing.knobs.set(knob, value).empty()) return false;
  drawing.context.makeCurrent();
  if (isOf(plan::planKnobs(), knob) || isOf(houselod::pictureKnobs(), knob))
    drawing.planner = std::make_unique<plan::Planner>(*drawing.city, drawing.knobs);
  if (knob == "viewer.multisamples") drawing.renderer->setMultisamples(static_cast<int>(value));
  // A scene that was made without people gets them; one that has them only shows none.
  const bool lacksPeople = knob == "avatars.shown" && value != 0 && !drawing.city->people.empty() &&
                           std::ranges::count(drawing.scene->featureNames(), "avatars") == 0;
  // So with pictures of walls and house LOD.
  const bool lacksPictures = knob == "house_lod" && value != 0 && !drawing.scene->madeForHouseLod();
  if (!lacksPeople && !lacksPictures && !isOf(scenegraph::sceneKnobs(), knob)) return true;
  drawing.renderer.reset();
  drawing.scene.reset();
  city::Diagnostics diagnostics;  // the same as when the scene was made first
  drawing.scene = std::make_unique<scenegraph::Scene>(*drawing.city, drawing.knobs, diagnostics, assets::Progress(),
                                                      scenegraph::GroundDetail(), drawing.planner->houses());
  drawing.renderer = std::make_unique<Renderer>(drawing.context, *drawing.scene,
                                                static_cast<int>(drawing.knobs["viewer.multisamples"]));
  return true;
}

}  // namespace vicus::viewer
