#include "assets/scene/write_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include "assets/import/columns.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/read_file.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;

/// A TOML text in quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\', out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04X", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += code;
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.1f", v);
  return text;
}

/// The file as the description names it: relative to the description's folder.
std::string relativeTo(const std::string& outputFile, const std::string& file) {
  std::error_code error;
  const fs::path folder = fs::absolute(outputFile, error).parent_path();
  const fs::path relative = fs::relative(fs::absolute(file, error), folder, error);
  return error || relative.empty() ? file : relative.generic_string();
}

std::string commentOf(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\n' || c == '\r' ? ' ' : c;
  return "# " + line + "\n";
}

/// The columns of a source, each with one of its values, as comments.
std::string columnsOf(const Source& s) {
  const city::Attributes* attributes = !s.footprints.empty()  ? &s.footprints[0].attributes
                                       : !s.buildings.empty() ? &s.buildings[0].attributes
                                                              : nullptr;
  if (!attributes || attributes->empty()) return {};
  std::string out = "# Its columns, with the values of the first building:\n";
  constexpr size_t kMost = 30;
  for (size_t i = 0; i < std::min(attributes->size(), kMost); ++i)
    out += commentOf("  " + (*attributes)[i].first + " = " + (*attributes)[i].second.substr(0, 60));
  if (attributes->size() > kMost) out += "#   and " + std::to_string(attributes->size() - kMost) + " more\n";
  return out;
}

std::string countsOf(const Source& s) {
  std::string out;
  const auto add = [&](size_t count, const char* what) {
    if (count > 0) out += (out.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(s.footprints.size(), "footprints");
  add(s.buildings.size(), "buildings of surfaces");
  add(s.tin.triangles.size(), "terrain triangles");
  add(s.materials.size(), "materials");
  add(s.surroundings.streets.size(), "streets");
  add(s.surroundings.water.size(), "waters");
  add(s.surroundings.trees.size(), "trees");
  add(s.surroundings.walls.size(), "walls");
  return out.empty() ? "nothing that can be shown" : out;
}

std::string sourceText(const std::string& file, const Source& s, const std::string& outputFile) {
  std::string out = "\n[[sources]]\nfile = " + quoted(relativeTo(outputFile, file)) + "\n";
  out += commentOf(countsOf(s));
  out += s.crs.empty() ? "# crs = \"EPSG:…\"           # it states none: give the true one here\n"
                       : commentOf("crs = " + quoted(crsName(s.crs)).substr(0, 200) + "   as the file says");
  if (!s.footprints.empty()) {
    const auto known =
        static_cast<size_t>(std::count_if(s.footprints.begin(), s.footprints.end(), [](const Footprint& f) {
          return f.height > 0 || std::any_of(f.parts.begin(), f.parts.end(),
                                             [](const FootprintPart& p) { return p.height > 0 || p.top > 0; });
        }));
    out += commentOf("heights are known of " + std::to_string(known) + " of " + std::to_string(s.footprints.size()));
    out += "# height_column = \"…\"     # where the right one was not found\n";
    out += "# ground_column = \"…\"     # altitude of the ground\n";
    out += "# default_height = 6.0    # metres, of buildings that state none\n";
  }
  if (!s.buildings.empty()) out += "# lod = 2.2               # the finest level of detail that is wanted\n";
  out += columnsOf(s);
  out +=
      "# [[sources.styles]]      # what buildings look like, by their attributes\n"
      "# where = [{ attribute = \"usage\", equals = \"church\" }]\n"
      "# facade = \"facade-limestone\"\n# walls = \"ashlar\"\n# roof = \"slate\"\n";
  return out;
}

std::string monumentText(const std::string& file, const std::string& outputFile, glm::dvec2 place) {
  return "\n[[monuments]]\nname = " + quoted(fs::path(file).stem().string()) +
         "\nfile = " + quoted(relativeTo(outputFile, file)) + "\nposition = [" + number(place.x) + ", " +
         number(place.y) +
         "]   # in the scene's CRS\n# heading = 0.0           # degrees counter-clockwise\n"
         "# height = 4.0            # metres; or scale = 1.0\n# up = \"y\"               # the file's upward axis\n";
}

std::string viewText(const city::City& city) {
  // From the south-east, high enough that the whole lies in the picture.
  const glm::dvec3 middle = city.extent.centre(), size = city.extent.size();
  const double reach = std::clamp(0.5 * std::max(size.x, size.y), 60.0, 1500.0);
  const glm::dvec2 eye = glm::dvec2(middle) + glm::dvec2(0.7, -0.7) * reach + glm::dvec2(city.origin);
  return "\n[[views]]\nname = \"from the air\"\nposition = [" + number(eye.x) + ", " + number(eye.y) +
         "]\nabove_ground = " + number(0.6 * reach) + "\nheading = 135.0\npitch = -30.0\n";
}

}  // namespace

DraftScene draftScene(std::span<const std::string> inputs, const LoadOptions& options, const std::string& outputFile) {
  DraftScene draft;
  LoadResult loaded = loadCity(inputs, options);
  draft.diagnostics = std::move(loaded.diagnostics);
  if (!loaded.city) return draft;
  const city::City& city = *loaded.city;
  std::string& out = draft.text;
  out = "# A scene of Vicus; docs/scene.md says what every key means.\n\nname = " + quoted(city.name) + "\n";
  if (city.crs.starts_with("EPSG:"))
    out += "crs = " + quoted(city.crs) + "          # that all is brought into, and positions below are in\n";

  std::string sources, rasters, monuments;
  for (const std::string& input : inputs) {
    SceneSource source;
    source.file = input, source.crs = options.crs, source.lod = options.lod;
    source.heightColumn = options.heightColumn, source.groundColumn = options.groundColumn;
    const FileContent content = readFile(source, {});
    for (const Source& s : content.sources) {
      if (!s.meshes.empty())
        monuments += monumentText(input, outputFile, glm::dvec2(city.origin));
      else
        sources += sourceText(input, s, outputFile);
    }
    if (!content.rasters.empty()) rasters += (rasters.empty() ? "" : ", ") + quoted(relativeTo(outputFile, input));
  }
  for (const std::string& file : options.elevation)
    rasters += (rasters.empty() ? "" : ", ") + quoted(relativeTo(outputFile, file));
  if (!rasters.empty()) {
    out += "\n[terrain]\nfiles = [" + rasters + "]\n";
    out += options.terrainUnit.empty() ? "# unit = \"m\"              # of its heights: m, dm, cm, ft, us-ft\n"
                                       : "unit = " + quoted(options.terrainUnit) + "\n";
  }
  out += sources + monuments + viewText(city);
  out += "\n# [knobs]                 # vicus knobs lists them\n# \"viewer.fov\" = 60\n";
  return draft;
}

}  // namespace vicus::assets
