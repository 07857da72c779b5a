#include "assets/import/read_file.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "assets/import/gdal_messages.hpp"
#include "assets/import/pictures.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/read_citygml.hpp"
#include "assets/import/read_cityjson.hpp"
#include "assets/import/read_footprints.hpp"
#include "assets/import/read_mesh.hpp"
#include "assets/import/read_osm.hpp"
#include "assets/import/read_tileset.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool endsWithAny(const std::string& file, std::initializer_list<std::string_view> endings) {
  const std::string lower = lowerCase(file);
  return std::any_of(endings.begin(), endings.end(), [&](std::string_view e) { return lower.ends_with(e); });
}

/// Reads a whole file, or its first `most` bytes; nothing, with an error, where it cannot be read.
std::optional<std::string> readText(const std::string& file, city::Diagnostics& diagnostics, size_t most = SIZE_MAX) {
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  if (stream && most != SIZE_MAX) {
    text.resize(most);
    stream.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<size_t>(stream.gcount()));
    return text;
  }
  std::ostringstream all;
  if (stream) all << stream.rdbuf();
  if (!stream) {
    diagnostics.error(file, "", "cannot be read");
    return std::nullopt;
  }
  return std::move(all).str();
}

/// Files whose walls all have one colour, and whose roofs do, say nothing of their buildings with it: finishes with
/// windows tell more. `wanted` decides where it is given.
void dropPlainColours(Source& s, const std::optional<bool>& wanted, city::Diagnostics& diagnostics) {
  constexpr size_t kFew = 10;  // buildings: fewer may have been painted by hand
  // By value: some programs write a material of its own for each building.
  std::map<SurfaceKind, std::set<std::array<float, 3>>> coloursOf;
  size_t painted = 0;
  const auto plain = [&](const Surface& surface) {
    return surface.material < s.materials.size() && s.materials[surface.material].image.empty();
  };
  for (const SurfaceBuilding& b : s.buildings)
    for (const Surface& surface : b.surfaces)
      if (plain(surface)) {
        const glm::vec3 c = s.materials[surface.material].colour;
        coloursOf[surface.kind].insert({c.x, c.y, c.z}), ++painted;
      }
  const bool uniform =
      std::all_of(coloursOf.begin(), coloursOf.end(), [](const auto& c) { return c.second.size() == 1; });
  if (painted == 0 || wanted.value_or(!uniform || s.buildings.size() <= kFew)) return;
  for (SurfaceBuilding& b : s.buildings)
    for (Surface& surface : b.surfaces)
      if (plain(surface)) surface.material = kNoMaterial;
  if (!wanted)
    diagnostics.warn(s.file, "appearance",
                     "all surfaces of a kind have one colour, which is not used; colours = true in a scene description "
                     "would use it");
}

void finishSource(Source& s, const SceneSource& wanted, const std::string& fallbackCrs,
                  city::Diagnostics& diagnostics) {
  s.defaultHeight = wanted.defaultHeight;
  s.styles = wanted.styles;
  dropPlainColours(s, wanted.colours, diagnostics);
  if (!wanted.crs.empty()) {
    s.crs = crsFromText(wanted.crs);
    s.zUnit = heightUnitOf(wanted.crs);
    if (s.crs.empty()) diagnostics.error(s.file, "", "the CRS " + wanted.crs.substr(0, 80) + " is not known");
  }
  if (s.crs.empty()) s.crs = fallbackCrs;
}

void addRaster(FileContent& content, std::unique_ptr<GDALDataset, CloseDataset> dataset, const std::string& file,
               const SceneTerrain& terrain, const std::string& fallbackCrs) {
  if (const std::string why = whyNoElevation(*dataset); !why.empty()) {
    content.diagnostics.error(file, "", "cannot be terrain: " + why);
    return;
  }
  ElevationRaster raster{dataset.get(), file, {}, std::nullopt, std::nullopt};
  const char* wkt = dataset->GetProjectionRef();
  if (!terrain.crs.empty()) {
    raster.crs = crsFromText(terrain.crs);
  } else if (wkt && *wkt) {
    raster.crs = crsFromText(wkt);
    raster.crsHeightUnit = verticalUnitOf(wkt);
  }
  if (raster.crs.empty()) raster.crs = fallbackCrs;
  if (!terrain.unit.empty()) raster.metresPerUnit = metresPerUnit(terrain.unit);
  if (raster.crs.empty()) {
    content.diagnostics.error(file, "", "states no CRS: give one with --crs");
    return;
  }
  content.rasters.push_back(std::move(raster));
  content.datasets.push_back(std::move(dataset));
}

/// A mesh that came without a place: it stands in the middle of the scene.
void addBareMesh(FileContent& content, const std::string& file) {
  auto mesh = readMesh(file, {}, content.diagnostics);
  if (!mesh) return;
  Source s;
  s.file = file, s.metric = true, s.materials = std::move(mesh->materials);
  PlacedMesh& placed = s.meshes.emplace_back();
  placed.id = fs::path(file).stem().string();
  placed.mesh = std::move(mesh->mesh);
  content.sources.push_back(std::move(s));
}

void readWithGdal(FileContent& content, const SceneSource& source, const std::string& fallbackCrs,
                  const std::string& heightUnit) {
  const std::string& file = source.file;
  GdalMessages messages;
  std::unique_ptr<GDALDataset, CloseDataset> dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_READONLY | GDAL_OF_RASTER | GDAL_OF_VECTOR));
  if (!dataset) {
    const std::string why = messages.take();
    content.diagnostics.error(file, "",
                              "is of no kind that can be read (footprints, CityJSON, CityGML, OpenStreetMap, 3D Tiles, "
                              "elevation, a mesh)" +
                                  (why.empty() ? "" : ": " + why));
    return;
  }
  if (isOpenStreetMap(*dataset)) {
    content.sources.push_back(readOsm(*dataset, file, messages, content.diagnostics));
    if (content.sources.back().footprints.empty()) content.diagnostics.warn(file, "", "holds no buildings");
  } else if (dataset->GetLayerCount() > 0) {
    Source s = readFootprints(*dataset, file, {source.heightColumn, source.groundColumn, source.layer}, messages,
                              content.diagnostics);
    if (s.footprints.empty()) content.diagnostics.error(file, "", "holds no building footprints");
    content.sources.push_back(std::move(s));
  }
  if (dataset->GetRasterCount() > 0) addRaster(content, std::move(dataset), file, {{}, {}, heightUnit}, fallbackCrs);
}

void read(FileContent& content, const SceneSource& source, const std::string& fallbackCrs,
          const std::string& heightUnit) {
  const std::string& file = source.file;
  std::error_code error;
  if (!fs::exists(file, error)) {
    content.diagnostics.error(file, "", "there is no such file");
    return;
  }
  const bool regular = fs::is_regular_file(file, error);
  if (regular && endsWithAny(file, {".json", ".jsonl", ".cityjson", ".cityjsonl"})) {
    const auto text = readText(file, content.diagnostics);
    if (!text) return;
    if (isCityJson(*text) || endsWithAny(file, {".city.json", ".cityjson", ".jsonl", ".cityjsonl"})) {
      content.sources.push_back(readCityJson(*text, file, {source.heightColumn, source.lod}, content.diagnostics));
      return;
    }
    if (isTileset(*text)) {
      content.sources.push_back(readTileset(file, content.diagnostics));
      return;
    }
  }
  if (regular && endsWithAny(file, {".gml", ".xml", ".citygml"})) {
    const auto head = readText(file, content.diagnostics, 64 << 10);
    if (head && isCityGml(*head)) {
      content.sources.push_back(readCityGml(file, {source.lod}, content.diagnostics));
      return;
    }
  }
  if (regular && endsWithAny(file, {".b3dm"})) {
    content.sources.push_back(readBatchedModel(file, content.diagnostics));
    return;
  }
  if (regular && isMeshFile(file)) {
    addBareMesh(content, file);
    return;
  }
  readWithGdal(content, source, fallbackCrs, heightUnit);
}

/// Texts of all members "uri" of a JSON text, without reading it whole.
std::vector<std::string> urisIn(const std::string& text) {
  std::vector<std::string> out;
  for (const std::string_view key : {"\"uri\"", "\"url\""})
    for (size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) {
      const size_t colon = text.find_first_not_of(" \t\r\n", at + key.size());
      if (colon == std::string::npos || text[colon] != ':') continue;
      const size_t quote = text.find_first_not_of(" \t\r\n", colon + 1);
      if (quote == std::string::npos || text[quote] != '"') continue;
      const size_t end = text.find('"', quote + 1);
      if (end == std::string::npos) break;
      if (end - quote < 1000) out.push_back(text.substr(quote + 1, end - quote - 1));
    }
  return out;
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const {
  GDALClose(dataset);
}

FileContent readFile(const SceneSource& source, const std::string& fallbackCrs, const std::string& heightUnit) {
  FileContent content;
  try {
    read(content, source, fallbackCrs, heightUnit);
  } catch (const std::exception& e) {
    content.diagnostics.error(source.file, "", std::string("could not be read: ") + e.what());
  }
  for (Source& s : content.sources) finishSource(s, source, fallbackCrs, content.diagnostics);
  return content;
}

FileContent readElevationFile(const std::string& file, const SceneTerrain& terrain, const std::string& fallbackCrs) {
  FileContent content;
  std::error_code error;
  if (!fs::exists(file, error)) {
    content.diagnostics.error(file, "", "there is no such file");
    return content;
  }
  GdalMessages messages;
  std::unique_ptr<GDALDataset, CloseDataset> dataset(
      GDALDataset::Open(file.c_str(), GDAL_OF_READONLY | GDAL_OF_RASTER));
  if (!dataset) {
    const std::string why = messages.take();
    content.diagnostics.error(file, "", "cannot be read as terrain" + (why.empty() ? "" : ": " + why));
    return content;
  }
  addRaster(content, std::move(dataset), file, terrain, fallbackCrs);
  return content;
}

FileContent readMonument(const SceneMonument& monument, const std::string& path, const std::string& crs) {
  FileContent content;
  std::error_code error;
  if (!fs::exists(path, error)) {
    content.diagnostics.error(path, monument.name, "there is no such file");
    return content;
  }
  try {
    auto mesh = readMesh(path, {monument.up, monument.scale, monument.height}, content.diagnostics);
    if (!mesh) return content;
    Source s;
    s.file = path, s.metric = true, s.materials = std::move(mesh->materials);
    s.crs = monument.place.degrees ? crsFromText("EPSG:4326") : crs;
    PlacedMesh& placed = s.meshes.emplace_back();
    placed.id = monument.name.empty() ? fs::path(path).stem().string() : monument.name;
    placed.mesh = std::move(mesh->mesh);
    placed.heading = monument.heading;
    placed.onGround = !monument.place.altitude;
    placed.position = glm::dvec3(monument.place.position, monument.place.altitude.value_or(monument.place.aboveGround));
    content.sources.push_back(std::move(s));
  } catch (const std::exception& e) {
    content.diagnostics.error(path, monument.name, std::string("could not be read: ") + e.what());
  }
  return content;
}

std::vector<std::string> filesNamedIn(const std::string& file) {
  std::vector<std::string> out;
  std::set<std::string> seen{file};
  std::vector<std::string> open{file};
  constexpr size_t kMost = 100'000;
  while (!open.empty() && seen.size() < kMost) {
    const std::string here = open.back();
    open.pop_back();
    city::Diagnostics quiet;
    std::vector<std::string> names;
    if (endsWithAny(here, {".gltf"}) || endsWithAny(here, {"tileset.json"}) ||
        (here != file && endsWithAny(here, {".json"}))) {
      if (const auto text = readText(here, quiet)) names = urisIn(*text);
    } else if (endsWithAny(here, {".obj"})) {
      std::ifstream stream(here);
      for (std::string line; std::getline(stream, line);)
        if (line.starts_with("mtllib ")) names.push_back(line.substr(7, line.find_last_not_of(" \r") - 6));
    }
    for (const std::string& name : names) {
      if (name.starts_with("data:") || name.find("://") != std::string::npos) continue;
      const std::string path = (fs::path(here).parent_path() / name).string();
      if (!seen.insert(path).second) continue;
      out.push_back(path);
      open.push_back(path);
    }
  }
  return out;
}

}  // namespace vicus::assets
