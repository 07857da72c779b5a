/// Scene graphs and renderers for settings that are compared in one run.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/knob.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/renderer.hpp"

namespace vicus::report {

/// A scene graph with its own context, so that no state leaks from one to another. Declared in the order in which they
/// need each other.
struct Rig {
  std::vector<double> settings;  ///< values of the knobs that shape a rig
  std::unique_ptr<viewer::GlContext> context;
  std::unique_ptr<scenegraph::Scene> scene;
  std::unique_ptr<viewer::Renderer> renderer;
};

/// Makes rigs as they are asked for. Invariant: settings that differ only in knobs of planning share one rig.
class Rigs {
 public:
  explicit Rigs(const city::City& city) : city_(city) {}

  /// The rig for these knobs; null, with the reason in `error`, where there is no context to draw in.
  Rig* rigFor(const city::Knobs& knobs, std::string& error);
  /// Drops all rigs made since there were `count`, with what they hold on the graphics card.
  void keepFirst(size_t count);
  size_t count() const { return rigs_.size(); }

 private:
  const city::City& city_;
  std::vector<std::unique_ptr<Rig>> rigs_;
};

}  // namespace vicus::report
