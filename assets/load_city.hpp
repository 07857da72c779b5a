/// A city from what the user names: a built-in scene or files as they come.
#pragma once

#include <functional>
#include <future>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/scene/scene_setting.hpp"
#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Called from the loading thread with what is being done and how far it is, 0 to 1.
using Progress = std::function<void(std::string_view stage, double fraction)>;

struct LoadOptions {
  std::vector<std::string> elevation;  ///< rasters for the terrain (`--dem`)
  std::string heightColumn;            ///< column of building heights, metres; empty: found by its usual names
  std::string groundColumn;            ///< column of ground altitude; empty: found by its usual names
  std::string crs;                     ///< CRS of sources that state none (`--crs EPSG:…`)
  double lod = 10;                     ///< finest level of detail that is wanted of CityJSON and CityGML (`--lod`)
  std::string terrainUnit;             ///< of the rasters' heights: m, dm, cm, ft, us-ft; empty: as they say
  std::string dataFolder;              ///< where files of scene descriptions lie that are not beside these
  glm::dvec3 shift{0};                 ///< metres added to all coordinates (`--shift`), for tests of far coordinates
  std::string cacheFolder;             ///< where the cache lies; empty: no cache
  Progress progress;                   ///< may be empty
};

struct LoadResult {
  std::optional<city::City> city;  ///< nothing where there was nothing that could be shown
  city::Diagnostics diagnostics;
  bool fromCache = false;
  /// Where the city is written to the cache: that goes on while it is shown. Gives what there is to say of it; waited
  /// for where it is dropped.
  std::future<city::Diagnostics> cached;
  std::vector<SceneSetting> settings;   ///< of knobs, as the scene description gives them
  std::vector<std::string> rulesFiles;  ///< the user's own files of rules (*.rules) that its houses follow
  std::string descriptionFile;          ///< the scene description; empty where there is none
};

/// Inputs are `norvic`, `norvic:8000`, `norwich-2001`, a scene description (*.toml), or paths of data files of any kind
/// that `readFile` knows, all brought into one city. Files are read in parallel. Never throws: what could not be read
/// is in the diagnostics.
LoadResult loadCity(std::span<const std::string> inputs, const LoadOptions& options);

}  // namespace vicus::assets
