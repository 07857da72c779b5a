/// What the user asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vicus::app {

/// The program's exit codes.
constexpr int kDone = 0, kCouldNot = 1, kWrongUsage = 2;

/// Which scene, and how it is read.
struct SceneOptions {
  std::vector<std::string> inputs;
  std::vector<std::string> elevation;
  std::string heightColumn, groundColumn, crs;
  std::string terrainUnit;  ///< of the elevation rasters; empty: as they say
  double lod = 10;          ///< finest level of detail that is wanted
  glm::dvec3 shift{0};      ///< metres
  bool noCache = false;
  std::vector<std::string> knobs;  ///< name=value
};

/// A single view, as `--view` names it.
struct ViewOption {
  glm::dvec3 eye{0};              ///< metres from the city's origin
  double heading = 0, pitch = 0;  ///< radians
  std::optional<double> fov;      ///< radians between top and bottom; the knob's where not given
};

struct WalkOptions {
  SceneOptions scene;
  bool headless = false;
  std::string path, tour;
  std::vector<ViewOption> views;
  std::optional<size_t> frames;
  std::optional<double> fps;
  glm::ivec2 size{1280, 720};
  std::string out;  ///< folder for pictures; empty: not given
  std::optional<size_t> every;
  std::string film;                    ///< video file; empty: none
  std::string json;                    ///< file for the figures; empty: none
  bool overlay = false;                ///< the overlay (F2) from the start
  std::optional<ViewOption> seenFrom;  ///< each frame's plan frozen (F3) and seen from there
  std::string trace;                   ///< file for the stages of every frame; empty: none
};

struct InfoOptions {
  SceneOptions scene;
  bool json = false;
  bool graph = false;
};

struct ImportOptions {
  SceneOptions scene;
  std::string out;  ///< the description's file
  bool overwrite = false;
};

struct ReportCommandOptions {
  SceneOptions scene;
  std::string out;  ///< folder
  bool quick = false;
};

struct CheckOptions {
  SceneOptions scene;
  size_t views = 100;
  uint32_t seed = 1;
  glm::ivec2 size{320, 180};
  bool street = false;             ///< at eye level only
  size_t picturesEvery = 1;        ///< pictures are compared in each so many views; 0: in none
  std::vector<ViewOption> single;  ///< these views instead of random ones
};

/// "1280x720" (or with ×); nothing where it is no such text or a side is not 1 to 16384.
std::optional<glm::ivec2> parseSize(std::string_view text);
/// Numbers between commas; nothing where one is none or not finite, or where there are fewer than `least` or more than
/// `most`.
std::optional<std::vector<double>> parseNumbers(std::string_view text, size_t least, size_t most);
/// "x,y,z,heading,pitch" or with ",fov" at its end, angles in degrees. The reason in `error` where it is none.
std::optional<ViewOption> parseView(std::string_view text, std::string& error);

}  // namespace vicus::app
