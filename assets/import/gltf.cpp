// Based on: Khronos glTF 2.0 specification, §3.6 (accessors), §3.5 (nodes), §4.4 (GLB);
// KHR_draco_mesh_compression, through Google's Draco 1.5.
#include "assets/import/gltf.hpp"

#include <draco/compression/decode.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/pictures.hpp"

namespace vicus::assets::gltf {

using cityjson::member;
using cityjson::textOf;

namespace {

/// Numbers of an accessor; invariant: every element lies within the file's bytes.
class Accessor {
 public:
  Accessor(const Model& model, const Json& number) : bytes_(model.bin) {
    const Json& accessors = member(model.json, "accessors");
    const uint64_t n = countOf(number);
    if (!accessors.is_array() || n >= accessors.size()) return;
    const Json& a = accessors[n];
    const Json& views = member(model.json, "bufferViews");
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

/// What an attribute's values are asked for: how many, and each component of each.
template <typename Count, typename At>
void fill(Primitive& out, const std::string& name, size_t components, const Count& count, const At& at) {
  const size_t n = count();
  if (name == "POSITION" && components == 3)
    for (size_t i = 0; i < n; ++i) out.positions.emplace_back(at(i, 0), at(i, 1), at(i, 2));
  else if (name == "NORMAL" && components == 3)
    for (size_t i = 0; i < n; ++i) out.normals.emplace_back(at(i, 0), at(i, 1), at(i, 2));
  else if (name == "TEXCOORD_0" && components == 2)
    for (size_t i = 0; i < n; ++i) out.uvs.emplace_back(at(i, 0), 1 - at(i, 1));
  else if ((name == "_BATCHID" || name == "_FEATURE_ID_0") && components == 1)
    for (size_t i = 0; i < n; ++i) {
      const double id = at(i, 0);
      out.batchIds.push_back(id >= 0 && id < 1e9 ? static_cast<uint64_t>(id) : 0);
    }
}

/// Decodes what KHR_draco_mesh_compression holds; false with the reason where it cannot.
bool readDraco(const Model& model, const Json& extension, Primitive& out, std::string& why) {
  const Json& views = member(model.json, "bufferViews");
  const uint64_t v = countOf(member(extension, "bufferView"));
  why = "its Draco data are damaged";
  if (!views.is_array() || v >= views.size() || countOf(member(views[v], "buffer"), 0) != 0) return false;
  const uint64_t begin = countOf(member(views[v], "byteOffset"), 0),
                 length = countOf(member(views[v], "byteLength"), 0);
  if (begin > model.bin.size() || length > model.bin.size() - begin) return false;
  draco::DecoderBuffer buffer;
  buffer.Init(model.bin.data() + begin, length);
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    why += std::string(": ") + decoded.status().error_msg();
    return false;
  }
  const draco::Mesh& mesh = *decoded.value();
  const Json& attributes = member(extension, "attributes");
  if (!attributes.is_object()) return false;
  for (const auto& [name, number] : attributes.items()) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(static_cast<uint32_t>(countOf(number, 0)));
    if (!attribute) continue;
    const auto components = static_cast<size_t>(attribute->num_components());
    constexpr size_t kMostComponents = 4;
    if (components == 0 || components > kMostComponents) continue;
    fill(
        out, name, components, [&] { return static_cast<size_t>(mesh.num_points()); },
        [&](size_t i, size_t c) {
          double value[kMostComponents] = {0, 0, 0, 0};
          attribute->ConvertValue<double>(attribute->mapped_index(draco::PointIndex(static_cast<uint32_t>(i))),
                                          static_cast<int8_t>(components), value);
          return value[c];
        });
  }
  for (uint32_t f = 0; f < mesh.num_faces(); ++f)
    for (int k = 0; k < 3; ++k) out.indices.push_back(mesh.face(draco::FaceIndex(f))[static_cast<size_t>(k)].value());
  return true;
}

/// The matrix of a node, from its own matrix or its parts.
glm::dmat4 nodeTransform(const Json& node) {
  const auto list = [&](const char* name, size_t count, std::vector<double> otherwise) {
    const Json& v = member(node, name);
    if (!v.is_array() || v.size() != count) return otherwise;
    for (size_t k = 0; k < count; ++k)
      if (v[k].is_number()) otherwise[k] = v[k].get<double>();
    return otherwise;
  };
  glm::dmat4 m(1);
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
  return m;
}

}  // namespace

uint64_t countOf(const Json& value, uint64_t otherwise) {
  return value.is_number_unsigned() ? value.get<uint64_t>() : otherwise;
}

std::optional<glm::dmat4> matrixOf(const Json& value) {
  if (!value.is_array() || value.size() != 16) return std::nullopt;
  glm::dmat4 m(1);
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

std::optional<Model> openBinary(std::string_view bytes, const std::string& file, size_t offsetInFile) {
  if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF") return std::nullopt;
  Model model;
  model.binFile = file;
  size_t at = 12;
  while (at + 8 <= bytes.size()) {
    const size_t length = wordAt(bytes, at);
    const std::string_view type = bytes.substr(at + 4, 4);
    at += 8;
    if (length > bytes.size() - at) return std::nullopt;
    if (type == "JSON") model.json = Json::parse(bytes.substr(at, length), nullptr, false);
    if (type.substr(0, 3) == "BIN") model.bin = bytes.substr(at, length), model.binOffset = offsetInFile + at;
    at += length;
  }
  if (!model.json.is_object()) return std::nullopt;
  return model;
}

std::optional<Primitive> readPrimitive(const Model& model, const Json& primitive, std::string& why) {
  if (countOf(member(primitive, "mode"), 4) != 4) {
    why = "only triangles are read";
    return std::nullopt;
  }
  Primitive out;
  const Json& draco = member(member(primitive, "extensions"), "KHR_draco_mesh_compression");
  if (!draco.is_null()) {
    if (!readDraco(model, draco, out, why)) return std::nullopt;
  } else {
    if (const Json& attributes = member(primitive, "attributes"); attributes.is_object())
      for (const auto& [name, number] : attributes.items()) {
        const Accessor values(model, number);
        fill(
            out, name, values.components(), [&] { return values.count(); },
            [&](size_t i, size_t c) { return values.at(i, c); });
      }
    if (const Json& number = member(primitive, "indices"); !number.is_null()) {
      const Accessor indices(model, number);
      for (size_t i = 0; i < indices.count(); ++i) {
        const double index = indices.at(i, 0);
        out.indices.push_back(index >= 0 && index < 4294967295.0 ? static_cast<uint32_t>(index) : UINT32_MAX);
      }
    } else {
      for (size_t i = 0; i < out.positions.size(); ++i) out.indices.push_back(static_cast<uint32_t>(i));
    }
  }
  if (out.positions.empty()) {
    why = "a primitive has no positions";
    return std::nullopt;
  }
  std::vector<uint32_t> good;
  for (size_t i = 0; i + 2 < out.indices.size(); i += 3)
    if (std::all_of(&out.indices[i], &out.indices[i] + 3, [&](uint32_t k) { return k < out.positions.size(); }))
      good.insert(good.end(), &out.indices[i], &out.indices[i] + 3);
  out.indices = std::move(good);
  if (out.normals.size() != out.positions.size()) out.normals.clear();
  if (out.uvs.size() != out.positions.size()) out.uvs.clear();
  if (out.batchIds.size() != out.positions.size()) out.batchIds.clear();
  return out;
}

std::vector<PlacedNode> placedNodes(const Model& model) {
  std::vector<PlacedNode> out;
  const Json &nodes = member(model.json, "nodes"), &scenes = member(model.json, "scenes");
  const uint64_t number = countOf(member(model.json, "scene"), 0);
  struct Open {
    uint64_t node;
    glm::dmat4 parent;
    int depth;
  };
  std::vector<Open> open;
  if (scenes.is_array() && number < scenes.size())
    if (const Json& roots = member(scenes[number], "nodes"); roots.is_array())
      for (const Json& root : roots) open.push_back({countOf(root), glm::dmat4(1), 0});
  constexpr size_t kMostNodes = 1'000'000;
  constexpr int kDeepest = 64;
  while (!open.empty() && out.size() < kMostNodes) {
    const Open here = open.back();
    open.pop_back();
    if (!nodes.is_array() || here.node >= nodes.size() || here.depth > kDeepest) continue;
    const Json& node = nodes[here.node];
    out.push_back({&node, here.parent * nodeTransform(node)});
    if (const Json& children = member(node, "children"); children.is_array())
      for (const Json& child : children) open.push_back({countOf(child), out.back().worldFromNode, here.depth + 1});
  }
  return out;
}

std::optional<SourceMaterial> materialOf(const Model& model, const Json& number, const std::string& modelFile) {
  const uint64_t n = countOf(number);
  const Json& materials = member(model.json, "materials");
  if (!materials.is_array() || n >= materials.size()) return std::nullopt;
  const Json& pbr = member(materials[n], "pbrMetallicRoughness");
  SourceMaterial material;
  material.name = textOf(member(materials[n], "name"));
  if (material.name.empty())
    material.name = std::filesystem::path(modelFile).filename().string() + " " + std::to_string(n);
  const Json& factor = member(pbr, "baseColorFactor");
  for (size_t k = 0; k < 3; ++k)
    if (factor.is_array() && k < factor.size() && factor[k].is_number())
      material.colour[static_cast<int>(k)] = std::clamp(factor[k].get<float>(), 0.0f, 1.0f);
  const Json &textures = member(model.json, "textures"), &images = member(model.json, "images"),
             &views = member(model.json, "bufferViews");
  const uint64_t t = countOf(member(member(pbr, "baseColorTexture"), "index"));
  const uint64_t i = textures.is_array() && t < textures.size() ? countOf(member(textures[t], "source")) : UINT64_MAX;
  if (!images.is_array() || i >= images.size()) return material;
  const uint64_t v = countOf(member(images[i], "bufferView"));
  if (views.is_array() && v < views.size()) {
    const uint64_t begin = countOf(member(views[v], "byteOffset"), 0),
                   length = countOf(member(views[v], "byteLength"), 0);
    if (begin < model.bin.size() && length <= model.bin.size() - begin)
      material.image =
          model.binFile + "#bytes=" + std::to_string(model.binOffset + begin) + "+" + std::to_string(length);
  } else {
    material.image = findPicture(modelFile, textOf(member(images[i], "uri")));
  }
  return material;
}

}  // namespace vicus::assets::gltf
