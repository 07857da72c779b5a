/// The parts of glTF 2.0 that buildings and statues are read from where assimp does not do: batch ids, and triangles
/// compressed with Draco.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/source.hpp"

namespace vicus::assets::gltf {

using Json = nlohmann::json;

/// A model: its JSON and the bytes of its first buffer, which others own.
struct Model {  // NOLINT(bugprone-exception-escape): the JSON library moves without throwing, and says so
  Json json;
  std::string_view bin;
  std::string binFile;   ///< that `bin` comes from
  size_t binOffset = 0;  ///< in that file
};

/// A glTF binary of which `bytes` is the whole, standing `offsetInFile` bytes into `file`. Nothing where it is none.
std::optional<Model> openBinary(std::string_view bytes, const std::string& file, size_t offsetInFile);

/// Triangles of one primitive, in the file's own frame (y up). Lists other than positions and indices are empty where
/// the file has none.
struct Primitive {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> uvs;  ///< rows counted from the bottom
  std::vector<uint64_t> batchIds;
  std::vector<uint32_t> indices;  ///< three for each triangle, each smaller than positions.size()
};

/// Reads a primitive; nothing, with the reason in `why`, where it cannot be read. Triangles with an index out of range
/// are dropped.
std::optional<Primitive> readPrimitive(const Model& model, const Json& primitive, std::string& why);

/// A node's place in the world.
struct PlacedNode {
  const Json* node = nullptr;
  glm::dmat4 worldFromNode{1};
};
/// All nodes of the default scene, with their matrices in the file's own frame (y up). At most a million.
std::vector<PlacedNode> placedNodes(const Model& model);

/// The material of that number: its base colour and picture. `modelFile` is where pictures are looked for.
std::optional<SourceMaterial> materialOf(const Model& model, const Json& number, const std::string& modelFile);

/// Sixteen numbers column by column.
std::optional<glm::dmat4> matrixOf(const Json& value);

/// A count or an index; `otherwise` where the value is none.
uint64_t countOf(const Json& value, uint64_t otherwise = UINT64_MAX);

/// Four bytes, little-endian; 0 where they are not there.
uint32_t wordAt(std::string_view bytes, size_t at);

}  // namespace vicus::assets::gltf
