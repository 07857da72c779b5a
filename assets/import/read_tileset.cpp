// Based on: OGC 18-053r2 (3D Tiles 1.0), §7 tiles and §9 batched 3D models.
#include "assets/import/read_tileset.hpp"

#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/gltf.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;
using cityjson::Json;
using cityjson::member;
using cityjson::textOf;
using Transform = glm::dmat4;
using gltf::countOf;
using gltf::matrixOf;
using gltf::wordAt;

constexpr size_t kMostTiles = 100'000;
constexpr size_t kMostPoints = 50'000'000;

std::optional<std::string> readAll(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) return std::nullopt;
  return std::move(text).str();
}

Json parseQuietly(std::string_view text) {
  return Json::parse(text, nullptr, false);
}

class Reader {
 public:
  Reader(std::string file, city::Diagnostics& diagnostics) : file_(std::move(file)), diagnostics_(diagnostics) {
    source.file = file_;
    source.metric = true;
  }
  void addTileset(const fs::path& path, const Transform& parent, int depth);
  void addModel(const fs::path& path, const Transform& worldFromTile);
  /// Earth-centred coordinates to degrees.
  void finish();
  Source source;

 private:
  void addTile(const Json& tile, const fs::path& folder, const Transform& parent, bool replace, int depth);
  void addGlb(const gltf::Model& model, const std::string& path, const Json& batchTable,
              const Transform& worldFromTile);
  void addPrimitive(const gltf::Model& model, const std::string& path, const Json& primitive,
                    const Transform& worldFromNode, std::map<uint64_t, SurfaceBuilding>& batches);
  uint32_t materialOf(const gltf::Model& model, const std::string& path, const Json& number);
  void complain(const std::string& place, const std::string& message) {
    constexpr size_t kMost = 20;
    if (++complaints_ <= kMost) diagnostics_.error(file_, place, message);
  }

  std::string file_;
  city::Diagnostics& diagnostics_;
  std::map<std::pair<std::string, uint64_t>, uint32_t> materialNumbers_;
  std::set<std::string> tilesets_;  ///< read already: one that names itself must end
  size_t tiles_ = 0, points_ = 0, complaints_ = 0;
};

uint32_t Reader::materialOf(const gltf::Model& model, const std::string& path, const Json& number) {
  const uint64_t n = countOf(number);
  const auto known = materialNumbers_.find({path, n});
  if (known != materialNumbers_.end()) return known->second;
  uint32_t result = kNoMaterial;
  if (auto material = gltf::materialOf(model, number, path);
      material && (!material->image.empty() || material->colour != glm::vec3(1))) {
    result = static_cast<uint32_t>(source.materials.size());
    source.materials.push_back(std::move(*material));
  }
  materialNumbers_[{path, n}] = result;
  return result;
}

void Reader::addPrimitive(const gltf::Model& model, const std::string& path, const Json& primitive,
                          const Transform& worldFromNode, std::map<uint64_t, SurfaceBuilding>& batches) {
  std::string why;
  const auto read = gltf::readPrimitive(model, primitive, why);
  if (!read) return complain(path, why);
  const uint32_t material = materialOf(model, path, member(primitive, "material"));
  points_ += read->indices.size();
  if (points_ > kMostPoints) return complain(path, "more than 50 million corners in all: the rest is left out");
  for (size_t c = 0; c < read->indices.size(); c += 3) {
    SurfaceBuilding& building = batches[read->batchIds.empty() ? 0 : read->batchIds[read->indices[c]]];
    Surface& surface = building.surfaces.emplace_back();
    surface.material = material;
    std::vector<uint32_t>& ring = surface.rings.emplace_back();
    if (!read->uvs.empty()) surface.uvs.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t i = read->indices[c + k];
      ring.push_back(static_cast<uint32_t>(building.points.size()));
      building.points.emplace_back(worldFromNode * glm::dvec4(read->positions[i], 1));
      if (!read->uvs.empty()) surface.uvs[0].push_back(read->uvs[i]);
    }
  }
}

void Reader::addGlb(const gltf::Model& model, const std::string& path, const Json& batchTable,
                    const Transform& worldFromTile) {
  std::map<uint64_t, SurfaceBuilding> batches;
  const Json& meshes = member(model.json, "meshes");
  Transform up(1);  // y up to z up
  up[1] = {0, 0, 1, 0}, up[2] = {0, -1, 0, 0};
  for (const gltf::PlacedNode& placed : gltf::placedNodes(model)) {
    const uint64_t mesh = countOf(member(*placed.node, "mesh"));
    if (!meshes.is_array() || mesh >= meshes.size()) continue;
    if (const Json& primitives = member(meshes[mesh], "primitives"); primitives.is_array())
      for (const Json& primitive : primitives)
        addPrimitive(model, path, primitive, worldFromTile * up * placed.worldFromNode, batches);
  }
  const std::string name = fs::path(path).stem().string();
  for (auto& [id, building] : batches) {
    building.id = name + (batches.size() > 1 ? " " + std::to_string(id) : "");
    if (batchTable.is_object())
      for (const auto& [key, values] : batchTable.items())
        if (values.is_array() && id < values.size() && values[id].is_primitive() && !values[id].is_null())
          building.attributes.emplace_back(key,
                                           values[id].is_string() ? values[id].get<std::string>() : values[id].dump());
    source.buildings.push_back(std::move(building));
  }
}

void Reader::addModel(const fs::path& path, const Transform& worldFromTile) {
  const auto bytes = readAll(path);
  if (!bytes) return complain(path.string(), "the tile's content cannot be read");
  std::string_view rest(*bytes);
  Json batchTable;
  Transform transform = worldFromTile;
  size_t offset = 0;
  if (rest.substr(0, 4) == "b3dm") {
    constexpr size_t kHeader = 28;
    const size_t featureJson = wordAt(rest, 12), featureBin = wordAt(rest, 16), batchJson = wordAt(rest, 20),
                 batchBin = wordAt(rest, 24);
    const size_t before = kHeader + featureJson + featureBin + batchJson + batchBin;
    if (before > rest.size()) return complain(path.string(), "the b3dm file ends within its tables");
    const Json featureTable = parseQuietly(rest.substr(kHeader, featureJson));
    if (batchJson > 0) batchTable = parseQuietly(rest.substr(kHeader + featureJson + featureBin, batchJson));
    if (const Json& c = member(featureTable, "RTC_CENTER");
        c.is_array() && c.size() == 3 && c[0].is_number() && c[1].is_number() && c[2].is_number()) {
      Transform moved(1);
      moved[3] = glm::dvec4(c[0].get<double>(), c[1].get<double>(), c[2].get<double>(), 1);
      transform = transform * moved;
    }
    offset = before;
    rest.remove_prefix(before);
  }
  const auto glb = gltf::openBinary(rest, path.string(), offset);
  if (!glb) return complain(path.string(), "holds no glTF binary that can be read");
  addGlb(*glb, path.string(), batchTable, transform);
}

void Reader::addTile(const Json& tile, const fs::path& folder, const Transform& parent, bool replace, int depth) {
  constexpr int kDeepest = 64;
  if (depth > kDeepest) return complain("", "its tiles are nested more than 64 deep");
  if (++tiles_ > kMostTiles) return complain("", "it has more than 100000 tiles: the rest is left out");
  const Transform here = parent * matrixOf(member(tile, "transform")).value_or(Transform(1));
  const std::string refine = textOf(member(tile, "refine"));
  if (!refine.empty()) replace = refine != "ADD" && refine != "add";
  const Json& children = member(tile, "children");
  const bool leaf = !children.is_array() || children.empty();
  const Json& content = member(tile, "content");
  std::string uri = textOf(member(content, "uri"));
  if (uri.empty()) uri = textOf(member(content, "url"));
  const bool nested = uri.ends_with(".json");
  if (!uri.empty() && (leaf || !replace || nested)) {
    if (uri.find("://") != std::string::npos || uri.find('\0') != std::string::npos || uri.size() > 1000)
      complain(uri.substr(0, 100), "only files beside the tileset are read");
    else if (nested)
      addTileset(folder / uri, here, depth + 1);
    else if (uri.ends_with(".b3dm") || uri.ends_with(".glb"))
      addModel(folder / uri, here);
    else
      complain(uri, "content of this kind is not read: only b3dm and glb");
  }
  if (!leaf)
    for (const Json& child : children) addTile(child, folder, here, replace, depth + 1);
}

void Reader::addTileset(const fs::path& path, const Transform& parent, int depth) {
  if (!tilesets_.insert(path.lexically_normal().string()).second)
    return complain(path.string(), "the tileset is named twice; the second time it is left out");
  const auto text = readAll(path);
  if (!text) return complain(path.string(), "the tileset cannot be read");
  const Json root = parseQuietly(*text);
  if (!member(root, "root").is_object()) return complain(path.string(), "this is no tileset: it has no root tile");
  addTile(member(root, "root"), path.parent_path(), parent, true, depth);
}

void Reader::finish() {
  constexpr double kLeastRadius = 6e6;  // the earth's surface is farther from its centre
  bool onEarth = false;
  for (const SurfaceBuilding& b : source.buildings)
    if (!b.points.empty() && glm::length(b.points[0]) > kLeastRadius) onEarth = true;
  if (!onEarth) return;
  OGRSpatialReference centred, degrees;
  if (centred.importFromEPSG(4978) != OGRERR_NONE || degrees.importFromEPSG(4979) != OGRERR_NONE) return;
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const auto destroy = [](OGRCoordinateTransformation* t) { OGRCoordinateTransformation::DestroyCT(t); };
  const std::unique_ptr<OGRCoordinateTransformation, decltype(destroy)> transform(
      OGRCreateCoordinateTransformation(&centred, &degrees), destroy);
  if (!transform) return;
  for (SurfaceBuilding& b : source.buildings)
    for (glm::dvec3& p : b.points)
      if (!transform->Transform(1, &p.x, &p.y, &p.z)) p = glm::dvec3(kUnknown);
  source.crs = crsFromText("EPSG:4326");
}

}  // namespace

bool isTileset(std::string_view text) {
  return text.find("\"geometricError\"") != std::string_view::npos && text.find("\"root\"") != std::string_view::npos &&
         text.find("\"asset\"") != std::string_view::npos;
}

Source readTileset(const std::string& file, city::Diagnostics& diagnostics) {
  Reader reader(file, diagnostics);
  reader.addTileset(file, Transform(1), 0);
  reader.finish();
  return std::move(reader.source);
}

Source readBatchedModel(const std::string& file, city::Diagnostics& diagnostics) {
  Reader reader(file, diagnostics);
  reader.addModel(file, Transform(1));
  reader.finish();
  return std::move(reader.source);
}

}  // namespace vicus::assets
