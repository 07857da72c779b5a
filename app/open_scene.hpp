/// From what the user names to a city with its knobs and features.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/options.hpp"
#include "assets/load_city.hpp"
#include "city/city.hpp"
#include "city/knob.hpp"
#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"

namespace vicus::app {

/// A scene as the commands work with it.
struct OpenScene {
  std::string name;                  ///< the inputs as given
  std::unique_ptr<city::City> city;  ///< never null; another one when its rules change (reload.hpp)
  city::Knobs knobs;
  city::Diagnostics diagnostics;
  bool fromCache = false;
  double seconds = 0;                     ///< that loading took
  std::vector<std::string> ownFiles;      ///< whose change while it is shown should show: its rules and description
  std::future<city::Diagnostics> cached;  ///< the writing of the cache, which may go on
};

/// All knobs of the program at their defaults.
city::Knobs allKnobs();

/// The knobs with the user's settings; an empty result with messages on the console where a setting is wrong.
std::optional<city::Knobs> knobsFrom(const std::vector<std::string>& settings, Console& console);

/// The inputs as given.
std::string sceneName(const SceneOptions& options);

/// How the loader is asked for what the user named; without cache and progress.
assets::LoadOptions loadOptions(const SceneOptions& options, std::string dataFolder);
/// The same with both.
assets::LoadOptions loadOptions(const SceneOptions& options, const Surroundings& surroundings, Console& console);

/// Loads the city, telling progress and messages. On failure nothing, with the exit code in `code`.
std::optional<OpenScene> openScene(const SceneOptions& options, const Surroundings& surroundings, Console& console,
                                   int& code);

/// The user's own files of rules that a scene follows, and its description: what is worth watching.
std::vector<std::string> ownFilesOf(const assets::LoadResult& loaded);

/// Waits until the cache is written and says what went wrong with it.
void finishCache(OpenScene& scene, Console& console);

/// The same knobs with every technique off.
city::Knobs withoutTechniques(const city::Knobs& knobs);

/// Every technique and kind of content: what the planner decides and what drawing adds.
std::vector<plan::FeatureReport> featuresOf(const plan::Planner& planner, const city::Knobs& knobs);

}  // namespace vicus::app
