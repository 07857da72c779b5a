/// What a scene is made of: the content of a scene description (*.toml), or of what the command line names.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/style_rules.hpp"
#include "assets/scene/scene_setting.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// A file of buildings, or of several things at once.
struct SceneSource {
  std::string file;          ///< as written
  std::string crs;           ///< takes the place of what the file says; empty: the file's own
  std::string heightColumn;  ///< empty: found by its usual names
  std::string groundColumn;
  std::string layer;              ///< only this layer; empty: all
  double lod = 10;                ///< finest level of detail that is wanted
  double defaultHeight = 6;       ///< metres, of buildings that state none
  std::vector<StyleRule> styles;  ///< before those of the scene
  std::optional<bool> colours;    ///< plain colours of the file's surfaces: used, or not; nothing: where they differ
};

struct SceneTerrain {
  std::vector<std::string> files;
  std::string crs;   ///< takes the place of what the files say
  std::string unit;  ///< of their heights: m, dm, cm, ft, us-ft; empty: what they say, else metres
};

/// A place in the scene's CRS, or by longitude and latitude.
struct ScenePlace {
  glm::dvec2 position{0};
  bool degrees = false;            ///< position is longitude and latitude (WGS 84)
  std::optional<double> altitude;  ///< metres, in the CRS's own zero; nothing: above ground
  double aboveGround = 0;          ///< metres
};

/// A mesh in its place.
struct SceneMonument {
  std::string name, file;
  ScenePlace place;
  double heading = 0;            ///< radians counter-clockwise
  double scale = 1;              ///< metres for each unit of the file
  std::string up;                ///< "y" or "z"; empty: by the format's rule
  std::optional<double> height;  ///< metres from its lowest to its highest point; takes the place of `scale`
};

/// Where the eye stands or passes: a view has one key, a tour several.
struct SceneKey {
  double time = 0;  ///< seconds
  ScenePlace place;
  double heading = 0, pitch = 0;  ///< radians; heading counter-clockwise from east
};
struct SceneTour {
  std::string name;
  std::vector<SceneKey> keys;
  bool jumps = false;
};

/// People to walk in the streets.
struct SceneAvatars {
  bool on = true;
  uint32_t count = 0;                   ///< 0: as `density` says
  double density = 0;                   ///< people for each hundred buildings
  std::string dress;                    ///< "medieval" or "modern"; empty: medieval
  std::vector<std::string> characters;  ///< glTF, FBX or COLLADA files; none: people made by code
  std::vector<std::string> motions;     ///< BVH files: the people's walks, one after another
  uint32_t seed = 1;
};

struct SceneEnvironment {
  std::optional<double> sunAzimuth, sunElevation;  ///< radians
  /// The sun by date and time in their place: days since 2000-01-01 00:00, in local mean solar time, or where
  /// `utcOffset` (hours) is there in a clock's time.
  std::optional<double> days;
  std::optional<double> utcOffset;
  std::optional<glm::dvec2> lonlat;    ///< radians; else where the city's CRS puts it
  std::optional<double> hazeDistance;  ///< metres
};

struct SceneDescription {
  std::string file;    ///< of the description; empty: from the command line
  std::string folder;  ///< where relative paths begin
  std::string name;
  std::string crs;  ///< that the city is built in; empty: chosen from the data
  SceneTerrain terrain;
  std::vector<SceneSource> sources;
  std::vector<StyleRule> styles;
  std::vector<SceneMonument> monuments;
  std::vector<SceneTour> tours;  ///< views first: tours of one key
  std::vector<SceneSetting> knobs;
  SceneAvatars avatars;
  SceneEnvironment environment;
};

/// Reads a scene description. Every error names file, line and column, and for a mistyped key the nearest known one.
/// Nothing where there was any error. The JSON Schema docs/scene.schema.json says the same in a form that editors read.
std::optional<SceneDescription> parseScene(std::string_view text, const std::string& file,
                                           city::Diagnostics& diagnostics);

}  // namespace vicus::assets
