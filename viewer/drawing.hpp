/// Planner, scene graph and renderer of one city by one set of knobs, which may change while they run.
#pragma once

#include <memory>
#include <string_view>

#include "city/city.hpp"
#include "city/diagnostics.hpp"
#include "city/knob.hpp"
#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Declared in the order in which they need each other. Let go with the context current.
struct Drawing {
  const city::City* city = nullptr;
  GlContext& context;
  city::Knobs knobs;
  std::unique_ptr<plan::Planner> planner;
  std::unique_ptr<scenegraph::Scene> scene;
  std::unique_ptr<Renderer> renderer;

  /// What the render loop works with, as of now.
  Stage stage() const { return {city, planner.get(), scene.get(), renderer.get(), &context}; }
};

/// Shows another city from now on, with a planner and a scene graph that were made for it by the same knobs. Not within
/// a frame; the former city must live until this returns.
void showCity(Drawing& drawing, const city::City& city, std::unique_ptr<plan::Planner> planner,
              std::unique_ptr<scenegraph::Scene> scene);

/// Turns a knob and makes anew what depends on it: the planner for knobs of planning, scene graph and renderer for
/// those of drawing. Not within a frame. False, and nothing changed, where there is no such knob or the value is out of
/// its range.
bool turn(Drawing& drawing, std::string_view knob, double value);

}  // namespace vicus::viewer
