#include "app/open_scene.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "assets/load_city.hpp"
#include "assets/scene/apply_scene.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/navigator.hpp"

namespace vicus::app {

city::Knobs allKnobs() {
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  knobs.declare(light::lightKnobs());
  knobs.declare(scenegraph::sceneKnobs());
  knobs.declare(viewer::viewerKnobs());
  knobs.declare(viewer::navigatorKnobs());
  return knobs;
}

std::optional<city::Knobs> knobsFrom(const std::vector<std::string>& settings, Console& console) {
  city::Knobs knobs = allKnobs();
  bool good = true;
  for (const std::string& setting : settings) {
    const std::string problem = knobs.set(setting);
    if (problem.empty()) continue;
    console.error("--set: " + problem);
    good = false;
  }
  if (!good) return std::nullopt;
  return knobs;
}

std::string sceneName(const SceneOptions& options) {
  std::string name;
  for (const std::string& input : options.inputs) name += (name.empty() ? "" : " ") + input;
  return name;
}

assets::LoadOptions loadOptions(const SceneOptions& options, std::string dataFolder) {
  assets::LoadOptions load;
  load.elevation = options.elevation;
  load.heightColumn = options.heightColumn, load.groundColumn = options.groundColumn;
  load.crs = options.crs, load.terrainUnit = options.terrainUnit, load.lod = options.lod;
  load.shift = options.shift;
  load.dataFolder = std::move(dataFolder);
  return load;
}

assets::LoadOptions loadOptions(const SceneOptions& options, const Surroundings& surroundings, Console& console) {
  assets::LoadOptions load = loadOptions(options, surroundings.dataFolder);
  if (!options.noCache) load.cacheFolder = surroundings.cacheFolder;
  load.progress = [&console](std::string_view stage, double fraction) { console.progress(stage, fraction); };
  return load;
}

namespace {

/// The scene's own settings, then the user's over them; false, with messages, where one of the scene's is wrong.
bool applySettings(const std::vector<assets::SceneSetting>& own, const SceneOptions& options, city::Knobs& knobs,
                   Console& console) {
  bool good = true;
  for (const assets::SceneSetting& setting : own)
    if (const std::string problem = knobs.set(setting.text); !problem.empty()) {
      console.error(sceneName(options) + ": " + setting.place + ": " + problem);
      good = false;
    }
  for (const std::string& setting : options.knobs) knobs.set(setting);
  return good;
}

}  // namespace

std::optional<OpenScene> openScene(const SceneOptions& options, const Surroundings& surroundings, Console& console,
                                   int& code) {
  std::optional<city::Knobs> knobs = knobsFrom(options.knobs, console);
  if (!knobs) {
    code = kWrongUsage;
    return std::nullopt;
  }
  OpenScene scene;
  scene.knobs = std::move(*knobs);
  scene.name = sceneName(options);

  const assets::LoadOptions load = loadOptions(options, surroundings, console);

  const auto begin = std::chrono::steady_clock::now();
  assets::LoadResult result = assets::loadCity(options.inputs, load);
  scene.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  console.progressDone();
  console.report(result.diagnostics);
  if (!result.city) {
    console.error(scene.name + ": nothing to show");
    code = kCouldNot;
    return std::nullopt;
  }
  if (!applySettings(result.settings, options, scene.knobs, console)) {
    code = kCouldNot;
    return std::nullopt;
  }
  scene.city = std::make_unique<city::City>(std::move(*result.city));
  light::applyTime(scene.city->environment, assets::placeOf(*scene.city, options.shift), scene.knobs);
  scene.ownFiles = ownFilesOf(result);
  scene.diagnostics = std::move(result.diagnostics);
  scene.fromCache = result.fromCache;
  scene.cached = std::move(result.cached);

  char seconds[32];
  std::snprintf(seconds, sizeof seconds, "%.2f", scene.seconds);
  console.say(scene.name + ": " + std::to_string(scene.city->buildings.size()) + " buildings of " +
              std::to_string(scene.city->buildingTypes.size()) + " types, " +
              std::to_string(scene.city->monuments.size()) + " monuments, " + std::to_string(scene.city->trees.size()) +
              " trees in " + seconds + " s" + (scene.fromCache ? " from the cache" : ""));
  return scene;
}

std::vector<std::string> ownFilesOf(const assets::LoadResult& loaded) {
  std::vector<std::string> files = loaded.rulesFiles;
  if (!loaded.descriptionFile.empty()) files.push_back(loaded.descriptionFile);
  return files;
}

void finishCache(OpenScene& scene, Console& console) {
  if (scene.cached.valid()) console.report(scene.cached.get());
}

city::Knobs withoutTechniques(const city::Knobs& knobs) {
  city::Knobs off = knobs;
  // Techniques are switches without a part's name: "frustum_culling", but not "viewer.vsync".
  for (const city::Knob& knob : knobs.declared())
    if (knob.isSwitch() && knob.name.find('.') == std::string_view::npos) off.set(knob.name, 0);
  return off;
}

std::vector<plan::FeatureReport> featuresOf(const plan::Planner& planner, const city::Knobs& knobs) {
  std::vector<plan::FeatureReport> features = planner.features();
  const auto known = [&](std::string_view name) {
    return std::any_of(features.begin(), features.end(), [&](const auto& f) { return f.name == name; });
  };
  // Techniques of drawing, in the order in which they are declared, after the planner's own.
  for (const city::Knob& knob : scenegraph::sceneKnobs()) {
    if (!knob.isSwitch() || knob.name.find('.') != std::string_view::npos || known(knob.name)) continue;
    const bool on = knobs.on(knob.name);
    const auto afterTechniques =
        std::find_if(features.begin(), features.end(), [](const auto& f) { return !f.technique; });
    features.insert(afterTechniques, {std::string(knob.name), true, on, on ? "draws are grouped by texture" : "knob"});
  }
  return features;
}

}  // namespace vicus::app
