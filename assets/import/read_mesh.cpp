// Assimp 5.2 reads; the only file that knows it. It was not made for damaged files (headers that promise billions of
// vertices keep it busy for ever), so it works in a process of its own.
#include "assets/import/read_mesh.hpp"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "assets/import/apart.hpp"
#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/gltf.hpp"
#include "assets/import/gltf_faults.hpp"
#include "assets/import/mesh_packing.hpp"
#include "assets/import/pictures.hpp"
#include "city/aabb.hpp"

namespace vicus::assets {
namespace {

/// Scenes that name one mesh very often may ask for any number; more triangles than these are refused.
constexpr uint64_t kMostTriangles = 60'000'000;

std::string extensionOf(const std::string& file) {
  std::string out = std::filesystem::path(file).extension().string();
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// Where a picture that the file holds lies in it; empty where it lies there in another form.
std::string sliceOf(const std::string& file, const aiTexture& texture) {
  if (texture.mHeight != 0 || texture.mWidth < 16) return {};  // raw texels: no picture format
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  const std::string content = std::move(text).str();
  const std::string_view wanted(reinterpret_cast<const char*>(texture.pcData), texture.mWidth);
  const size_t at = content.find(wanted);
  if (at == std::string::npos) return {};
  return file + "#bytes=" + std::to_string(at) + "+" + std::to_string(wanted.size());
}

std::vector<SourceMaterial> materialsOf(const aiScene& scene, const std::string& file, city::Diagnostics& diagnostics) {
  std::vector<SourceMaterial> out;
  size_t missing = 0;
  std::string first;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    const aiMaterial& m = *scene.mMaterials[i];
    SourceMaterial& material = out.emplace_back();
    material.name = m.GetName().C_Str();
    if (material.name.empty()) material.name = "material " + std::to_string(i);
    aiColor4D colour;
    if (aiGetMaterialColor(&m, AI_MATKEY_BASE_COLOR, &colour) == aiReturn_SUCCESS)
      material.colour = glm::clamp(glm::vec3(colour.r, colour.g, colour.b), 0.0f, 1.0f);  // linear in glTF
    else if (aiGetMaterialColor(&m, AI_MATKEY_COLOR_DIFFUSE, &colour) == aiReturn_SUCCESS)
      material.colour = linearColour({colour.r, colour.g, colour.b});
    if (!std::isfinite(material.colour.x + material.colour.y + material.colour.z)) material.colour = glm::vec3(1);
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
      aiString path;
      if (m.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
      const std::string name = path.C_Str();
      const aiTexture* inside = scene.GetEmbeddedTexture(name.c_str());
      material.image = inside ? sliceOf(file, *inside) : findPicture(file, name);
      if (material.image.empty() && missing++ == 0) first = name;
      break;
    }
  }
  if (missing > 0)
    diagnostics.warn(file, "",
                     std::to_string(missing) + (missing == 1 ? " picture" : " pictures") +
                         " cannot be found (the first: " + first.substr(0, 100) + "); their colours are used");
  return out;
}

using Matrix = aiMatrix4x4t<double>;

Matrix toDouble(const aiMatrix4x4& m) {
  return {static_cast<double>(m.a1), static_cast<double>(m.a2), static_cast<double>(m.a3), static_cast<double>(m.a4),
          static_cast<double>(m.b1), static_cast<double>(m.b2), static_cast<double>(m.b3), static_cast<double>(m.b4),
          static_cast<double>(m.c1), static_cast<double>(m.c2), static_cast<double>(m.c3), static_cast<double>(m.c4),
          static_cast<double>(m.d1), static_cast<double>(m.d2), static_cast<double>(m.d3), static_cast<double>(m.d4)};
}

glm::dvec3 toGlm(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

glm::dvec3 apply(const Matrix& m, glm::dvec3 p, double w) {
  return {m.a1 * p.x + m.a2 * p.y + m.a3 * p.z + m.a4 * w, m.b1 * p.x + m.b2 * p.y + m.b3 * p.z + m.b4 * w,
          m.c1 * p.x + m.c2 * p.y + m.c3 * p.z + m.c4 * w};
}

/// Normals from the triangles about each vertex, weighted by their area.
std::vector<glm::dvec3> smoothNormals(const aiMesh& mesh) {
  std::vector<glm::dvec3> normals(mesh.mNumVertices, glm::dvec3(0));
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const unsigned *i = face.mIndices, n = mesh.mNumVertices;
    if (i[0] >= n || i[1] >= n || i[2] >= n) continue;
    const glm::dvec3 a = toGlm(mesh.mVertices[i[0]]), b = toGlm(mesh.mVertices[i[1]]), c = toGlm(mesh.mVertices[i[2]]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (!std::isfinite(normal.x + normal.y + normal.z)) continue;
    for (unsigned k = 0; k < 3; ++k) normals[i[k]] += normal;
  }
  return normals;
}

/// Appends a mesh as it stands under a node; positions go to `points` in double until the whole's size is known.
void addMesh(const aiMesh& mesh, const Matrix& worldFromNode, city::TriangleMesh& out, std::vector<glm::dvec3>& points,
             size_t& lost) {
  if (!mesh.mVertices || mesh.mNumVertices == 0) return;
  const bool mirrored = worldFromNode.Determinant() < 0;
  const auto base = static_cast<uint32_t>(points.size());
  const std::vector<glm::dvec3> made = mesh.mNormals ? std::vector<glm::dvec3>() : smoothNormals(mesh);
  Matrix normalMatrix = worldFromNode;
  normalMatrix.Inverse().Transpose();
  for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
    points.push_back(apply(worldFromNode, toGlm(mesh.mVertices[v]), 1));
    city::Vertex& vertex = out.vertices.emplace_back();
    const glm::dvec3 normal = apply(normalMatrix, mesh.mNormals ? toGlm(mesh.mNormals[v]) : made[v], 0);
    const double length = glm::length(normal);
    vertex.normal =
        city::packNormal(length > 0 && std::isfinite(length) ? glm::vec3(normal / length) : glm::vec3(0, 0, 1));
    if (mesh.mTextureCoords[0]) {
      vertex.uv = {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
      if (!std::isfinite(vertex.uv.x + vertex.uv.y)) vertex.uv = {0, 0};
    }
    vertex.material = static_cast<city::MaterialId>(std::min(mesh.mMaterialIndex, 65535u));
  }
  const auto good = [&](unsigned i) {
    if (i >= mesh.mNumVertices) return false;
    const glm::dvec3& p = points[base + i];
    constexpr double kLargest = 1e7;
    return std::abs(p.x) < kLargest && std::abs(p.y) < kLargest && std::abs(p.z) < kLargest;
  };
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const unsigned* i = face.mIndices;
    if (!good(i[0]) || !good(i[1]) || !good(i[2])) {
      ++lost;
      continue;
    }
    out.indices.push_back(base + i[0]);
    out.indices.push_back(base + i[mirrored ? 2 : 1]);
    out.indices.push_back(base + i[mirrored ? 1 : 2]);
  }
}

/// Every mesh under every node; false where there are too many triangles.
bool flatten(const aiScene& scene, city::TriangleMesh& out, std::vector<glm::dvec3>& points, size_t& lost) {
  std::vector<std::pair<const aiNode*, Matrix>> open{{scene.mRootNode, Matrix()}};
  uint64_t triangles = 0;
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    if (!node) continue;
    const Matrix here = parent * toDouble(node->mTransformation);
    for (unsigned k = 0; k < node->mNumMeshes; ++k) {
      if (node->mMeshes[k] >= scene.mNumMeshes) continue;
      const aiMesh& mesh = *scene.mMeshes[node->mMeshes[k]];
      triangles += mesh.mNumFaces + mesh.mNumVertices / 3;
      if (triangles > kMostTriangles) return false;
      addMesh(mesh, here, out, points, lost);
    }
    for (unsigned k = 0; k < node->mNumChildren; ++k) open.emplace_back(node->mChildren[k], here);
  }
  return true;
}

/// Metres for each unit, where the format says it (FBX: centimetres for each unit).
double statedUnit(const aiScene& scene, const std::string& extension) {
  double factor = 1;
  float narrow = 1;
  if (extension != ".fbx" || !scene.mMetaData) return 1;
  if (scene.mMetaData->Get("UnitScaleFactor", factor)) return factor > 0 ? factor / 100 : 1;
  if (scene.mMetaData->Get("UnitScaleFactor", narrow)) return narrow > 0 ? static_cast<double>(narrow) / 100 : 1;
  return 1;
}

/// Turns z up, scales, and moves the foot to the origin; drops vertices that no triangle uses.
void settle(city::TriangleMesh& mesh, std::vector<glm::dvec3>& points, bool yUp, double unit,
            const std::optional<double>& height) {
  city::Aabb box;
  std::vector<uint8_t> used(points.size(), 0);
  for (const uint32_t i : mesh.indices) used[i] = 1;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    if (yUp) points[i] = {points[i].x, -points[i].z, points[i].y};
    box.extend(points[i]);
  }
  if (height && box.size().z > 0) unit = *height / box.size().z;
  const glm::dvec3 foot(glm::dvec2(box.centre()), box.min.z);
  std::vector<uint32_t> number(points.size(), 0);
  uint32_t kept = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!used[i]) continue;
    number[i] = kept;
    city::Vertex vertex = mesh.vertices[i];
    vertex.position = glm::vec3((points[i] - foot) * unit);
    if (yUp) {
      const glm::vec3 n = city::unpackNormal(vertex.normal);
      vertex.normal = city::packNormal({n.x, -n.z, n.y});
    }
    mesh.vertices[kept++] = vertex;
  }
  mesh.vertices.resize(kept);
  for (uint32_t& i : mesh.indices) i = number[i];
}

/// The bytes of a glTF model whose triangles are compressed with Draco, which assimp as Debian builds it cannot read.
struct DracoFile {
  std::string bytes, buffer;  ///< of the file, and of the buffer that it names
  gltf::Model model;
};

std::string readAll(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

/// Nothing where the file is not one of these.
std::unique_ptr<DracoFile> openDraco(const std::string& file, const std::string& extension) {
  if (extension != ".gltf" && extension != ".glb") return nullptr;
  auto out = std::make_unique<DracoFile>();
  out->bytes = readAll(file);
  if (out->bytes.find("KHR_draco_mesh_compression") == std::string::npos) return nullptr;
  if (extension == ".glb") {
    auto model = gltf::openBinary(out->bytes, file, 0);
    if (!model) return nullptr;
    out->model = std::move(*model);
    return out;
  }
  out->model.json = gltf::Json::parse(out->bytes, nullptr, false);
  const gltf::Json& buffers = cityjson::member(out->model.json, "buffers");
  if (!buffers.is_array() || buffers.empty()) return nullptr;
  out->model.binFile = findPicture(file, cityjson::textOf(cityjson::member(buffers[0], "uri")));
  if (out->model.binFile.empty()) return nullptr;
  out->buffer = readAll(out->model.binFile);
  out->model.bin = out->buffer;
  return out;
}

/// All primitives under all nodes.
std::vector<SourceMaterial> flatten(const DracoFile& from, const std::string& file, city::TriangleMesh& out,
                                    std::vector<glm::dvec3>& points, city::Diagnostics& diagnostics) {
  std::vector<SourceMaterial> materials;
  std::map<uint64_t, city::MaterialId> numbers;
  const gltf::Json& meshes = cityjson::member(from.model.json, "meshes");
  for (const gltf::PlacedNode& placed : gltf::placedNodes(from.model)) {
    const uint64_t mesh = gltf::countOf(cityjson::member(*placed.node, "mesh"));
    if (!meshes.is_array() || mesh >= meshes.size()) continue;
    const gltf::Json& primitives = cityjson::member(meshes[mesh], "primitives");
    if (!primitives.is_array()) continue;
    const glm::dmat3 normalMatrix = glm::transpose(glm::inverse(glm::dmat3(placed.worldFromNode)));
    for (const gltf::Json& primitive : primitives) {
      std::string why;
      const auto read = gltf::readPrimitive(from.model, primitive, why);
      if (!read) {
        diagnostics.error(file, "mesh " + std::to_string(mesh), why);
        continue;
      }
      if (out.indices.size() / 3 + read->indices.size() / 3 > kMostTriangles) return materials;
      const gltf::Json& number = cityjson::member(primitive, "material");
      const auto [found, isNew] = numbers.emplace(
          gltf::countOf(number), static_cast<city::MaterialId>(std::min<size_t>(materials.size(), 65535)));
      if (isNew)
        materials.push_back(
            gltf::materialOf(from.model, number, file).value_or(SourceMaterial{"stone", {}, glm::vec3(1), true}));
      const auto base = static_cast<uint32_t>(points.size());
      for (size_t i = 0; i < read->positions.size(); ++i) {
        points.emplace_back(placed.worldFromNode * glm::dvec4(read->positions[i], 1));
        city::Vertex& vertex = out.vertices.emplace_back();
        vertex.material = found->second;
        if (!read->uvs.empty()) vertex.uv = read->uvs[i];
        const glm::dvec3 n = read->normals.empty() ? glm::dvec3(0) : normalMatrix * glm::dvec3(read->normals[i]);
        vertex.normal = city::packNormal(glm::length(n) > 0 ? glm::vec3(glm::normalize(n)) : glm::vec3(0, 1, 0));
      }
      for (size_t i = 0; i < read->indices.size(); i += 3) {
        bool finite = true;
        for (size_t k = 0; k < 3; ++k) {
          const glm::dvec3& p = points[base + read->indices[i + k]];
          finite = finite && std::isfinite(p.x + p.y + p.z) && glm::length(p) < 1e7;
        }
        for (size_t k = 0; finite && k < 3; ++k) out.indices.push_back(base + read->indices[i + k]);
      }
    }
  }
  return materials;
}

/// Says that a mesh cannot be read: where it can be found out the place, else in the library's words.
void fail(const std::string& file, const std::string& why, city::Diagnostics& diagnostics) {
  if (const auto fault = gltf::firstFaultIn(file))
    diagnostics.error(file, fault->place, "the mesh cannot be read: " + fault->what);
  else
    diagnostics.error(file, "", "the mesh cannot be read" + (why.empty() ? "" : ": " + why.substr(0, 300)));
}

std::optional<MeshContent> readHere(const std::string& file, const MeshOptions& options,
                                    city::Diagnostics& diagnostics) {
  const std::string extension = extensionOf(file);
  MeshContent content;
  std::vector<glm::dvec3> points;
  size_t lost = 0;
  double unit = options.scale;
  if (const auto compressed = openDraco(file, extension)) {
    content.materials = flatten(*compressed, file, content.mesh, points, diagnostics);
  } else {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate | aiProcess_SortByPType);
    if (!scene || !scene->mRootNode) {
      fail(file, importer.GetErrorString(), diagnostics);
      return std::nullopt;
    }
    if (!flatten(*scene, content.mesh, points, lost)) {
      diagnostics.error(file, "", "has more than " + std::to_string(kMostTriangles) + " triangles");
      return std::nullopt;
    }
    content.materials = materialsOf(*scene, file, diagnostics);
    unit *= statedUnit(*scene, extension);
  }
  if (lost > 0)
    diagnostics.warn(file, "",
                     std::to_string(lost) + (lost == 1 ? " triangle was" : " triangles were") +
                         " left out: a coordinate is not a number, or there is no such vertex");
  if (content.mesh.indices.empty()) {
    diagnostics.error(file, "", "holds no triangles");
    return std::nullopt;
  }
  const bool zUp = options.up.empty()
                       ? extension == ".ply" || extension == ".stl" || extension == ".3ds" || extension == ".off"
                       : options.up == "z";
  settle(content.mesh, points, !zUp, unit, options.height);
  return content;
}

}  // namespace

bool isMeshFile(const std::string& file) {
  static constexpr std::array<std::string_view, 13> kExtensions = {
      ".gltf", ".glb", ".obj", ".ply", ".dae", ".fbx", ".stl", ".3ds", ".off", ".x", ".ac", ".lwo", ".blend"};
  return std::find(kExtensions.begin(), kExtensions.end(), extensionOf(file)) != kExtensions.end();
}

std::optional<MeshContent> readMesh(const std::string& file, const MeshOptions& options,
                                    city::Diagnostics& diagnostics) {
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(file, error));
  ApartLimits limits;
  if (!error) {
    limits.seconds += size / 1e6;  // a megabyte a second is slow for any of the formats
    limits.bytes += static_cast<uint64_t>(60 * size);
  }
  std::string why;
  const auto packed = runApart(
      [&] {
        city::Diagnostics said;
        const auto content = readHere(file, options, said);
        return pack(content, said);
      },
      limits, why);
  if (packed) return unpack(*packed, diagnostics);
  fail(file, why, diagnostics);
  return std::nullopt;
}

}  // namespace vicus::assets
