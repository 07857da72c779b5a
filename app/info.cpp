#include <ostream>

#include "app/commands.hpp"
#include "app/figures.hpp"
#include "app/open_scene.hpp"

namespace vicus::app {

int info(const InfoOptions& options, const Surroundings& surroundings) {
  Console console(surroundings);
  int code = kDone;
  std::optional<OpenScene> scene = openScene(options.scene, surroundings, console, code);
  if (!scene) return code;
  if (options.graph) {
    city::Diagnostics diagnostics;
    const scenegraph::Scene graph(*scene->city, scene->knobs, diagnostics,
                                  [&](std::string_view stage, double fraction) { console.progress(stage, fraction); });
    console.progressDone();
    console.report(diagnostics);
    surroundings.out << graph.describeGraph() << std::flush;
    finishCache(*scene, console);
    return kDone;
  }
  const plan::Planner planner(*scene->city, scene->knobs);
  const std::vector<plan::FeatureReport> features = featuresOf(planner, scene->knobs);
  surroundings.out << (options.json ? infoJson(*scene, features) : infoText(*scene, features)) << std::flush;
  finishCache(*scene, console);
  return kDone;
}

int knobs(bool json, const Surroundings& surroundings) {
  const city::Knobs all = allKnobs();
  surroundings.out << (json ? knobsJson(all) : knobsText(all)) << std::flush;
  return kDone;
}

}  // namespace vicus::app
