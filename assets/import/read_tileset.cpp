// Based on: OGC 18-053r2 (3D Tiles 1.0), §7 tiles and §9 batched 3D models; Khronos glTF 2.0 specification, §4.4 (GLB)
// and §3.6 (accessors).
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
#include "assets/import/pictures.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

namespace fs = std::filesystem;
using cityjson::Json;
using cityjson::member;
using cityjson::textOf;
using Transform = glm::dmat4;

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

uint64_t countOf(const Json& value, uint64_t otherwise = UINT64_MAX) {
  return value.is_number_unsigned() ? value.get<uint64_t>() : otherwise;
}

std::optional<Transform> matrixOf(const Json& value) {
  if (!value.is_array() || value.size() != 16) return std::nullopt;
  Transform m(1);
  for (int k = 0; k < 16; ++k) {
    const Json& v = value[static_cast<size_t>(k)];
    if (!v.is_number()) return std::nullopt;
    m[k / 4][k % 4] = v.get<double>();
  }
  return m;
}

uint32_t wordAt(std::string_view bytes, size_t at) {
  uint32_t v = 0;
  if (at + 4 <= bytes.size()) std::memcpy(&v, bytes.data() + at, 4);
  return v;
}

/// A glTF binary: its JSON and the place of its bytes in the file.
struct Glb {
  Json json;
  std::string_view bin;
  size_t binOffset = 0;  ///< in the file
};

std::optional<Glb> openGlb(std::string_view bytes, size_t offsetInFile) {
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") return std::nullopt;
  Glb glb;
  size_t at = 12;
  while (at + 8 <= bytes.size()) {
    const size_t length = wordAt(bytes, at);
    const std::string_view type = bytes.substr(at + 4, 4);
    at += 8;
    if (length > bytes.size() - at) return std::nullopt;
    if (type == "JSON") glb.json = parseQuietly(bytes.substr(at, length));
    if (type.substr(0, 3) == "BIN") glb.bin = bytes.substr(at, length), glb.binOffset = offsetInFile + at;
    at += length;
  }
  if (!glb.json.is_object()) return std::nullopt;
  return glb;
}

/// Numbers of an accessor; invariant: every element lies within the file's bytes.
class Accessor {
 public:
  Accessor(const Glb& glb, const Json& number) : bytes_(glb.bin) {
    const Json& accessors = member(glb.json, "accessors");
    const uint64_t n = countOf(number);
    if (!accessors.is_array() || n >= accessors.size()) return;
    const Json& a = accessors[n];
    const Json& views = member(glb.json, "bufferViews");
    const uint64_t v = countOf(member(a, "bufferView"));
    if (!views.is_array() || v >= views.size() || !member(a, "sparse").is_null()) return;
    if (countOf(member(views[v], "buffer"), 0) != 0) return;
    type_ = countOf(member(a, "componentType"), 0);
    static const std::map<std::string, size_t> kComponents = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
    const auto components = kComponents.find(textOf(member(a, "type")));
    if (components == kComponents.end() || width() == 0) return;
    components_ = components->second;
    const uint64_t stride = countOf(member(views[v], "byteStride"), 0);
    stride_ = stride > 0 ? stride : width() * components_;
    const uint64_t begin = countOf(member(views[v], "byteOffset"), 0), more = countOf(member(a, "byteOffset"), 0);
    if (begin > bytes_.size() || more > bytes_.size() || begin + more > bytes_.size() || stride_ > 4096) return;
    begin_ = begin + more;
    const uint64_t wanted = countOf(member(a, "count"), 0), element = width() * components_;
    if (bytes_.size() - begin_ < element) return;
    count_ = std::min<uint64_t>(wanted, (bytes_.size() - begin_ - element) / stride_ + 1);
  }
  size_t count() const { return count_; }
  double at(size_t element, size_t component) const {
    const char* p = bytes_.data() + begin_ + element * stride_ + component * width();
    const auto as = [p](auto value) {
      std::memcpy(&value, p, sizeof value);
      return static_cast<double>(value);
    };
    switch (type_) {
      case 5120:
        return as(int8_t{});
      case 5121:
        return as(uint8_t{});
      case 5122:
        return as(int16_t{});
      case 5123:
        return as(uint16_t{});
      case 5125:
        return as(uint32_t{});
      default:
        return as(float{});
    }
  }
  size_t components() const { return components_; }

 private:
  size_t width() const {
    if (type_ == 5120 || type_ == 5121) return 1;
    if (type_ == 5122 || type_ == 5123) return 2;
    return type_ == 5125 || type_ == 5126 ? 4 : 0;
  }
  std::string_view bytes_;
  uint64_t type_ = 0;
  size_t components_ = 0, stride_ = 0, begin_ = 0, count_ = 0;
};

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
  void addGlb(const Glb& glb, const std::string& path, const Json& batchTable, const Transform& worldFromTile);
  void addPrimitive(const Glb& glb, const std::string& path, const Json& primitive, const Transform& worldFromNode,
                    std::map<uint64_t, SurfaceBuilding>& batches);
  uint32_t materialOf(const Glb& glb, const std::string& path, const Json& number);
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

uint32_t Reader::materialOf(const Glb& glb, const std::string& path, const Json& number) {
  const uint64_t n = countOf(number);
  const Json& materials = member(glb.json, "materials");
  if (!materials.is_array() || n >= materials.size()) return kNoMaterial;
  const auto known = materialNumbers_.find({path, n});
  if (known != materialNumbers_.end()) return known->second;
  const Json& pbr = member(materials[n], "pbrMetallicRoughness");
  SourceMaterial material;
  material.name = fs::path(path).filename().string() + " " + std::to_string(n);
  const Json& factor = member(pbr, "baseColorFactor");
  for (size_t k = 0; k < 3; ++k)
    if (factor.is_array() && k < factor.size() && factor[k].is_number())
      material.colour[static_cast<int>(k)] = std::clamp(factor[k].get<float>(), 0.0f, 1.0f);
  const Json& textures = member(glb.json, "textures");
  const uint64_t t = countOf(member(member(pbr, "baseColorTexture"), "index"));
  const Json& images = member(glb.json, "images");
  if (textures.is_array() && t < textures.size()) {
    const uint64_t i = countOf(member(textures[t], "source"));
    if (images.is_array() && i < images.size()) {
      const Json& views = member(glb.json, "bufferViews");
      const uint64_t v = countOf(member(images[i], "bufferView"));
      if (views.is_array() && v < views.size()) {
        const uint64_t begin = countOf(member(views[v], "byteOffset"), 0),
                       length = countOf(member(views[v], "byteLength"), 0);
        if (begin < glb.bin.size() && length <= glb.bin.size() - begin)
          material.image = path + "#bytes=" + std::to_string(glb.binOffset + begin) + "+" + std::to_string(length);
      } else {
        material.image = findPicture(path, textOf(member(images[i], "uri")));
      }
    }
  }
  uint32_t result = kNoMaterial;
  if (!material.image.empty() || material.colour != glm::vec3(1)) {
    result = static_cast<uint32_t>(source.materials.size());
    source.materials.push_back(std::move(material));
  }
  materialNumbers_[{path, n}] = result;
  return result;
}

void Reader::addPrimitive(const Glb& glb, const std::string& path, const Json& primitive,
                          const Transform& worldFromNode, std::map<uint64_t, SurfaceBuilding>& batches) {
  if (countOf(member(primitive, "mode"), 4) != 4) return complain(path, "only triangles are read");
  if (!member(member(primitive, "extensions"), "KHR_draco_mesh_compression").is_null())
    return complain(path, "its triangles are compressed with Draco, which is not read");
  const Json& attributes = member(primitive, "attributes");
  const Accessor positions(glb, member(attributes, "POSITION")), uvs(glb, member(attributes, "TEXCOORD_0")),
      indices(glb, member(primitive, "indices"));
  const Accessor batchIds(glb, member(attributes, "_BATCHID").is_null() ? member(attributes, "_FEATURE_ID_0")
                                                                        : member(attributes, "_BATCHID"));
  if (positions.count() == 0 || positions.components() != 3) return complain(path, "a primitive has no positions");
  const uint32_t material = materialOf(glb, path, member(primitive, "material"));
  const bool indexed = !member(primitive, "indices").is_null();
  const size_t corners = indexed ? indices.count() : positions.count();
  points_ += corners;
  if (points_ > kMostPoints) return complain(path, "more than 50 million corners in all: the rest is left out");
  for (size_t c = 0; c + 2 < corners; c += 3) {
    size_t corner[3];
    bool good = true;
    for (size_t k = 0; k < 3; ++k) {
      const double index = indexed ? indices.at(c + k, 0) : static_cast<double>(c + k);
      good = good && index >= 0 && index < static_cast<double>(positions.count());
      corner[k] = good ? static_cast<size_t>(index) : 0;
    }
    if (!good) continue;
    const double id = corner[0] < batchIds.count() ? batchIds.at(corner[0], 0) : 0;
    SurfaceBuilding& building = batches[id >= 0 && id < 1e9 ? static_cast<uint64_t>(id) : 0];
    Surface& surface = building.surfaces.emplace_back();
    surface.material = material;
    std::vector<uint32_t>& ring = surface.rings.emplace_back();
    std::vector<glm::vec2> coordinates;
    for (const size_t i : corner) {
      const glm::dvec4 p(positions.at(i, 0), -positions.at(i, 2), positions.at(i, 1), 1);  // y up to z up
      ring.push_back(static_cast<uint32_t>(building.points.size()));
      building.points.emplace_back(worldFromNode * p);
      // Texture rows count from the top in glTF.
      if (i < uvs.count() && uvs.components() == 2)
        coordinates.emplace_back(static_cast<float>(uvs.at(i, 0)), 1 - static_cast<float>(uvs.at(i, 1)));
    }
    if (coordinates.size() == 3) surface.uvs.push_back(std::move(coordinates));
  }
}

/// The matrix of a node, from its own matrix or its parts, in a frame whose z is up.
Transform nodeTransform(const Json& node) {
  const auto list = [&](const char* name, size_t count, std::vector<double> otherwise) {
    const Json& v = member(node, name);
    if (!v.is_array() || v.size() != count) return otherwise;
    for (size_t k = 0; k < count; ++k)
      if (v[k].is_number()) otherwise[k] = v[k].get<double>();
    return otherwise;
  };
  Transform m(1);
  if (const auto whole = matrixOf(member(node, "matrix"))) {
    m = *whole;
  } else {
    const auto t = list("translation", 3, {0, 0, 0}), s = list("scale", 3, {1, 1, 1}),
               q = list("rotation", 4, {0, 0, 0, 1});
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    m[0] = glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0) * s[0];
    m[1] = glm::dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0) * s[1];
    m[2] = glm::dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0) * s[2];
    m[3] = glm::dvec4(t[0], t[1], t[2], 1);
  }
  Transform up(1);  // y up to z up
  up[1] = {0, 0, 1, 0}, up[2] = {0, -1, 0, 0};
  return up * m * glm::transpose(up);
}

void Reader::addGlb(const Glb& glb, const std::string& path, const Json& batchTable, const Transform& worldFromTile) {
  std::map<uint64_t, SurfaceBuilding> batches;
  const Json &nodes = member(glb.json, "nodes"), &meshes = member(glb.json, "meshes"),
             &scenes = member(glb.json, "scenes");
  const uint64_t sceneNumber = countOf(member(glb.json, "scene"), 0);
  struct Open {
    uint64_t node;
    Transform parent;
    int depth;
  };
  std::vector<Open> open;
  if (scenes.is_array() && sceneNumber < scenes.size())
    if (const Json& roots = member(scenes[sceneNumber], "nodes"); roots.is_array())
      for (const Json& root : roots) open.push_back({countOf(root), worldFromTile, 0});
  size_t visited = 0;
  constexpr size_t kMostNodes = 1'000'000;
  constexpr int kDeepest = 64;
  while (!open.empty() && ++visited < kMostNodes) {
    const Open here = open.back();
    open.pop_back();
    if (!nodes.is_array() || here.node >= nodes.size() || here.depth > kDeepest) continue;
    const Json& node = nodes[here.node];
    const Transform transform = here.parent * nodeTransform(node);
    const uint64_t mesh = countOf(member(node, "mesh"));
    if (meshes.is_array() && mesh < meshes.size())
      if (const Json& primitives = member(meshes[mesh], "primitives"); primitives.is_array())
        for (const Json& primitive : primitives) addPrimitive(glb, path, primitive, transform, batches);
    if (const Json& children = member(node, "children"); children.is_array())
      for (const Json& child : children) open.push_back({countOf(child), transform, here.depth + 1});
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
  const auto glb = openGlb(rest, offset);
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
