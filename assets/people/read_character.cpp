#include "assets/people/read_character.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "assets/cache/city_codec.hpp"
#include "assets/import/apart.hpp"
#include "assets/import/gltf_faults.hpp"
#include "assets/materials/image_file.hpp"
#include "assets/people/body_builder.hpp"
#include "assets/people/townspeople.hpp"
#include "avatars/cycle.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"
#include "avatars/retarget.hpp"
#include "city/vertex.hpp"

namespace vicus::assets::people {
namespace {

using glm::mat4;
using glm::vec3;

constexpr size_t kMostJoints = 255;                              // a vertex names its joints with a byte
constexpr size_t kMostTriangles = 200'000;                       // people come by the hundred
constexpr double kTallest = 2.3, kSmallest = 0.3, kUsual = 1.7;  // metres

mat4 toGlm(const aiMatrix4x4& m) {
  return glm::transpose(
      mat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}
vec3 toGlm(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}
glm::quat toGlm(const aiQuaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

city::JointTransform transformOf(const aiMatrix4x4& m) {
  aiVector3D scale, position;
  aiQuaternion rotation;
  m.Decompose(scale, rotation, position);
  return {avatars::unitRotation(toGlm(rotation)), toGlm(position), toGlm(scale)};
}

/// Where each vertex takes its colour from: the pictures are read where the file is trusted.
struct Paint {
  std::vector<city::Material> materials;  ///< source and tint
  std::vector<city::Vertex> vertices;     ///< uv and material
};

struct Found {
  city::Character body;
  std::vector<city::Clip> clips;
  Paint paint;
};

/// Gives the vertices their colours: the material's times its picture's, as the square root of linear light.
void paintBody(city::AvatarMesh& mesh, const Paint& paint, city::Diagnostics& diagnostics) {
  std::vector<Image> pictures;
  for (const city::Material& m : paint.materials)
    pictures.push_back(m.source.empty() ? Image{} : readImageFile(m.source, diagnostics));
  const auto texel = [](float x, int size) {
    const float wrapped = std::isfinite(x) ? x - std::floor(x) : 0;
    return std::clamp(static_cast<int>(wrapped * static_cast<float>(size)), 0, size - 1);
  };
  for (size_t v = 0; v < std::min(mesh.vertices.size(), paint.vertices.size()); ++v) {
    const city::Vertex& from = paint.vertices[v];
    if (from.material >= paint.materials.size()) continue;
    vec3 colour = paint.materials[from.material].tint;
    // Both begin at the bottom.
    if (const Image& picture = pictures[from.material]; picture.width > 0) {
      const auto x = static_cast<size_t>(texel(from.uv.x, picture.width)),
                 y = static_cast<size_t>(texel(from.uv.y, picture.height));
      const uint8_t* p = &picture.rgba[4 * (y * static_cast<size_t>(picture.width) + x)];
      for (int k = 0; k < 3; ++k) colour[k] *= std::pow(static_cast<float>(p[k]) / 255, 2.2F);
    }
    for (size_t k = 0; k < 3; ++k)
      mesh.vertices[v].colour[k] =
          static_cast<uint8_t>(std::lround(255 * std::sqrt(std::clamp(colour[static_cast<int>(k)], 0.0F, 1.0F))));
    mesh.vertices[v].colour[3] = 0;
  }
}

/// What is made from one file.
class Reader {
 public:
  Reader(const aiScene& scene, const std::string& file, city::Diagnostics& diagnostics)
      : scene_(scene), file_(file), diagnostics_(diagnostics) {}

  std::optional<Found> read() {
    if (!scene_.mRootNode) return fail("", "holds no nodes");
    size_t bones = 0, triangles = 0;
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) {
      for (unsigned b = 0; b < scene_.mMeshes[m]->mNumBones; ++b)
        needed_.insert(scene_.mMeshes[m]->mBones[b]->mName.C_Str());
      bones += scene_.mMeshes[m]->mNumBones, triangles += scene_.mMeshes[m]->mNumFaces;
    }
    if (bones == 0) return fail("", "holds no mesh with a skeleton");
    if (triangles > kMostTriangles) return fail("", "has more than " + std::to_string(kMostTriangles) + " triangles");

    // The joints: our axes first, then every node that a bone hangs on or a mesh stands at.
    city::Skeleton& skeleton = out_.body.skeleton;
    glm::quat turn = glm::quat_cast(glm::mat3(vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 0, 0)));  // x→y, y→z, z→x
    skeleton.joints.push_back({"axes", city::kNone, {turn, vec3(0), vec3(1)}});
    addNode(*scene_.mRootNode, 0);
    if (skeleton.joints.size() > kMostJoints)
      return fail("", "has more than " + std::to_string(kMostJoints) + " joints");
    if (!scaleToPeople()) return fail("", "has no size");

    fromJoint_.assign(skeleton.joints.size(), std::nullopt);
    axes_ = avatars::matrixOf(skeleton.joints[0].rest);
    addMaterials();
    for (const bool skinned : {true, false})
      for (const auto& [node, joint] : meshNodes_)
        for (unsigned k = 0; k < node->mNumMeshes; ++k)
          if (node->mMeshes[k] < scene_.mNumMeshes && (scene_.mMeshes[node->mMeshes[k]]->mNumBones > 0) == skinned)
            addMesh(*scene_.mMeshes[node->mMeshes[k]], joint);
    if (mesh_.indices.empty()) return fail("", "has no triangles");
    const auto rest = avatars::characterFromJoints(skeleton, avatars::restPose(skeleton));
    for (size_t j = 0; j < rest.size(); ++j)
      out_.body.jointFromSkin.push_back(fromJoint_[j].value_or(glm::inverse(rest[j])));
    out_.body.levels[0] = std::move(mesh_);

    for (unsigned a = 0; a < scene_.mNumAnimations; ++a) addClip(*scene_.mAnimations[a], a);
    return std::move(out_);
  }

 private:
  std::nullopt_t fail(const std::string& place, const std::string& message) {
    diagnostics_.error(file_, place, message);
    return std::nullopt;
  }

  bool leadsToBone(const aiNode& node) const {
    if (needed_.contains(node.mName.C_Str()) || node.mNumMeshes > 0) return true;
    for (unsigned c = 0; c < node.mNumChildren; ++c)
      if (leadsToBone(*node.mChildren[c])) return true;
    return false;
  }

  void addNode(const aiNode& node, uint32_t parent) {
    if (!leadsToBone(node) || out_.body.skeleton.joints.size() > kMostJoints) return;
    auto& joints = out_.body.skeleton.joints;
    const auto self = static_cast<uint32_t>(joints.size());
    joints.push_back({node.mName.C_Str(), parent, transformOf(node.mTransformation)});
    jointOf_.try_emplace(node.mName.C_Str(), self);
    if (node.mNumMeshes > 0) {
      // Hats and capes; what hands hold are weapons for the most part, and several at once.
      const bool skinned = scene_.mMeshes[std::min(node.mMeshes[0], scene_.mNumMeshes - 1)]->mNumBones > 0;
      const bool inHand = joints[parent].name.find("hand") != std::string::npos ||
                          joints[parent].name.find("Hand") != std::string::npos;
      if (skinned || !inHand) meshNodes_.emplace_back(&node, self);
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) addNode(*node.mChildren[c], self);
  }

  /// Brings the file's unit to metres; false where the body is a point.
  bool scaleToPeople() {
    double unit = 1;
    float narrow = 1;
    if (scene_.mMetaData && std::filesystem::path(file_).extension() == ".fbx") {
      if (scene_.mMetaData->Get("UnitScaleFactor", unit))
        unit /= 100;
      else if (scene_.mMetaData->Get("UnitScaleFactor", narrow))
        unit = static_cast<double>(narrow) / 100;
    }
    city::Aabbf box;
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m)
      if (scene_.mMeshes[m]->mNumBones > 0)
        for (unsigned v = 0; v < scene_.mMeshes[m]->mNumVertices; ++v)
          box.extend(toGlm(scene_.mMeshes[m]->mVertices[v]));
    const double height = box.empty() ? 0 : static_cast<double>(box.size().y) * unit;
    if (!(height > 0) || !std::isfinite(height)) return false;
    if (height > kTallest || height < kSmallest) unit *= kUsual / height;
    out_.body.skeleton.joints[0].rest.scale = vec3(static_cast<float>(unit));
    return true;
  }

  /// Where a material's picture is: a file, or a slice of this one; empty where it has none.
  std::string pictureOf(const aiMaterial& material) const {
    aiString path;
    for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
      if (material.GetTexture(type, 0, &path) != aiReturn_SUCCESS) continue;
      const aiTexture* inside = scene_.GetEmbeddedTexture(path.C_Str());
      if (!inside) return (std::filesystem::path(file_).parent_path() / path.C_Str()).string();
      if (inside->mHeight != 0) continue;  // raw texels: no picture format
      std::ifstream stream(file_, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      const std::string content = std::move(text).str();
      const size_t at = content.find(std::string_view(reinterpret_cast<const char*>(inside->pcData), inside->mWidth));
      if (at == std::string::npos) continue;
      return file_ + "#bytes=" + std::to_string(at) + "+" + std::to_string(inside->mWidth);
    }
    return {};
  }

  void addMaterials() {
    for (unsigned m = 0; m < scene_.mNumMaterials; ++m) {
      const aiMaterial& from = *scene_.mMaterials[m];
      city::Material& material = out_.paint.materials.emplace_back();
      material.source = pictureOf(from);
      aiColor4D base;
      if (aiGetMaterialColor(&from, AI_MATKEY_BASE_COLOR, &base) == aiReturn_SUCCESS ||
          aiGetMaterialColor(&from, AI_MATKEY_COLOR_DIFFUSE, &base) == aiReturn_SUCCESS)
        material.tint = glm::clamp(vec3(base.r, base.g, base.b), 0.0F, 1.0F);
    }
  }

  void addMesh(const aiMesh& mesh, uint32_t node) {
    // From the mesh's frame to the common one of all at rest: our axes, unless joints already say otherwise.
    mat4 commonFromMesh = axes_;
    bool decided = false;
    const auto jointNamed = [&](const aiString& name) -> std::optional<uint32_t> {
      const auto it = jointOf_.find(name.C_Str());
      return it == jointOf_.end() ? std::nullopt : std::optional(it->second);
    };
    for (unsigned b = 0; b < mesh.mNumBones && !decided; ++b)
      if (const auto j = jointNamed(mesh.mBones[b]->mName); j && fromJoint_[*j])
        commonFromMesh = glm::inverse(*fromJoint_[*j]) * toGlm(mesh.mBones[b]->mOffsetMatrix), decided = true;
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
      if (const auto j = jointNamed(mesh.mBones[b]->mName); j && !fromJoint_[*j])
        fromJoint_[*j] = toGlm(mesh.mBones[b]->mOffsetMatrix) * glm::inverse(commonFromMesh);
    if (mesh.mNumBones == 0) {
      const auto rest = avatars::characterFromJoints(out_.body.skeleton, avatars::restPose(out_.body.skeleton));
      if (!fromJoint_[node]) fromJoint_[node] = glm::inverse(rest[node]);
      commonFromMesh = glm::inverse(*fromJoint_[node]);
    }

    struct Share {
      float weight;
      uint32_t joint;
    };
    std::vector<std::vector<Share>> shares(mesh.mNumVertices);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const auto j = jointNamed(mesh.mBones[b]->mName);
      for (unsigned w = 0; j && w < mesh.mBones[b]->mNumWeights; ++w) {
        const aiVertexWeight& weight = mesh.mBones[b]->mWeights[w];
        if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0)
          shares[weight.mVertexId].push_back({weight.mWeight, *j});
      }
    }
    const auto base = static_cast<uint32_t>(mesh_.vertices.size());
    const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(commonFromMesh)));
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      city::AvatarVertex& out = mesh_.vertices.emplace_back();
      out.position = vec3(commonFromMesh * glm::vec4(toGlm(mesh.mVertices[v]), 1));
      if (!(glm::length(out.position) < 1e4F)) out.position = vec3(0);
      const vec3 normal = mesh.mNormals ? normals * toGlm(mesh.mNormals[v]) : vec3(0, 0, 1);
      const float length = glm::length(normal);
      out.normal = city::packNormal(length > 0 && std::isfinite(length) ? normal / length : vec3(0, 0, 1));
      city::Vertex& painted = out_.paint.vertices.emplace_back();
      painted.material = static_cast<city::MaterialId>(std::min(mesh.mMaterialIndex, 65535U));
      if (mesh.mTextureCoords[0]) painted.uv = {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
      auto& list = shares[v];
      if (list.empty()) list.push_back({1, node});
      std::stable_sort(list.begin(), list.end(), [](const Share& a, const Share& b) { return a.weight > b.weight; });
      if (list.size() > 4) list.resize(4);
      float sum = 0;
      for (const Share& s : list) sum += s.weight;
      out.weights = {0, 0, 0, 0};
      int left = 255;
      for (size_t k = list.size(); k-- > 0;) {
        const int w = k == 0 ? left : std::min(left, static_cast<int>(std::lround(255 * list[k].weight / sum)));
        out.joints[k] = static_cast<uint8_t>(list[k].joint), out.weights[k] = static_cast<uint8_t>(w);
        left -= w;
      }
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      if (std::max({face.mIndices[0], face.mIndices[1], face.mIndices[2]}) >= mesh.mNumVertices) continue;
      for (int k = 0; k < 3; ++k) mesh_.indices.push_back(base + face.mIndices[k]);
    }
  }

  void addClip(const aiAnimation& animation, unsigned number) {
    const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 25;
    city::Clip clip;
    clip.name = animation.mName.length > 0 ? animation.mName.C_Str() : "clip " + std::to_string(number);
    clip.duration = animation.mDuration > 0 ? animation.mDuration / ticks : 0;
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const aiNodeAnim& channel = *animation.mChannels[c];
      const auto joint = jointOf_.find(channel.mNodeName.C_Str());
      if (joint == jointOf_.end()) continue;
      city::Track& track = clip.tracks.emplace_back();
      track.joint = joint->second;
      const auto take = [&](const auto* keys, unsigned count, auto& times, auto& values) {
        for (unsigned k = 0; k < count; ++k) {
          const auto at = static_cast<float>(keys[k].mTime / ticks);
          if (!std::isfinite(at) || (!times.empty() && at < times.back())) continue;
          times.push_back(at), values.push_back(toGlm(keys[k].mValue));
        }
      };
      take(channel.mRotationKeys, channel.mNumRotationKeys, track.rotationTimes, track.rotations);
      take(channel.mPositionKeys, channel.mNumPositionKeys, track.translationTimes, track.translations);
      take(channel.mScalingKeys, channel.mNumScalingKeys, track.scaleTimes, track.scales);
    }
    out_.clips.push_back(std::move(clip));
  }

  const aiScene& scene_;
  const std::string& file_;
  city::Diagnostics& diagnostics_;
  Found out_;
  std::set<std::string> needed_;
  std::map<std::string, uint32_t> jointOf_;
  std::vector<std::pair<const aiNode*, uint32_t>> meshNodes_;
  std::vector<std::optional<mat4>> fromJoint_;
  city::AvatarMesh mesh_;
  mat4 axes_{1};
};

/// Says that a character cannot be read: where it can be found out the place, else in the library's words.
void fail(const std::string& file, const std::string& why, city::Diagnostics& diagnostics) {
  if (const auto fault = gltf::firstFaultIn(file))
    diagnostics.error(file, fault->place, "could not be read: " + fault->what);
  else
    diagnostics.error(file, "", "could not be read: " + why);
}

/// In the other process: the character, its clips and its paint as the cache writes cities, each clip with a body of
/// its own.
std::string readHere(const std::string& file) {
  CachedCity out;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);  // one joint for each bone, not a chain
  const aiScene* scene =
      importer.ReadFile(file, aiProcess_Triangulate | aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices |
                                  aiProcess_LimitBoneWeights | aiProcess_ValidateDataStructure);
  if (!scene) {
    fail(file, importer.GetErrorString(), out.diagnostics);
    return encodeCity(out);
  }
  if (auto read = Reader(*scene, file, out.diagnostics).read()) {
    out.city.people.characters.push_back(std::move(read->body));
    out.city.materials = std::move(read->paint.materials);
    out.city.meshes.emplace_back().mesh.vertices = std::move(read->paint.vertices);
    for (city::Clip& clip : read->clips) out.city.people.characters.emplace_back().clips[0] = std::move(clip);
  }
  return encodeCity(out);
}

/// The clip whose name says it best; null where none does.
const city::Clip* clipNamed(const std::vector<city::Clip>& clips, std::initializer_list<std::string_view> words) {
  for (const std::string_view word : words)
    for (const city::Clip& clip : clips) {
      std::string lower = clip.name;
      for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      if (lower.starts_with(word)) return &clip;
    }
  return nullptr;
}

void assignRoles(CharacterFile& read) {
  city::Character& body = read.body;
  const std::initializer_list<std::string_view> names[] = {
      {"walk"}, {"idle", "survey", "stand"}, {"talk", "interact", "idle"}, {"carry", "walk"}};
  const bool ours = avatars::canWalk(avatars::bonesOf(body.skeleton));
  for (size_t role = 0; role < city::kRoles; ++role) {
    city::Clip& clip = body.clips[role];
    if (const city::Clip* own = clipNamed(read.clips, names[role])) {
      clip = *own;
    } else if (ours) {
      clip = avatars::retarget(townSkeleton(), makeClip(static_cast<city::Role>(role)), body.skeleton);
      avatars::settleFeet(body.skeleton, clip);
    } else if (!read.clips.empty()) {
      clip = read.clips.front();
    }
    clip.loops = true;
    const bool moves = role == static_cast<size_t>(city::Role::Walk) || role == static_cast<size_t>(city::Role::Carry);
    if (!moves || clip.stride > 0) continue;
    clip.stride = avatars::strideOf(body.skeleton, clip);
    // Whose legs have names that nobody knows, goes his own height in a cycle.
    if (!(clip.stride > 0)) {
      city::Aabbf box;
      for (const city::AvatarVertex& v : body.levels[0].vertices) box.extend(v.position);
      clip.stride = box.empty() ? 1 : static_cast<double>(box.size().z);
    }
  }
}

}  // namespace

std::optional<CharacterFile> readCharacter(const std::string& file, city::Diagnostics& diagnostics) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    diagnostics.error(file, "", "cannot be read");
    return std::nullopt;
  }
  std::string why;
  const std::optional<std::string> bytes = runApart([&] { return readHere(file); }, {}, why);
  auto read = bytes ? decodeCity(*bytes) : std::nullopt;
  if (!read) {
    fail(file, why.empty() ? "damaged" : why, diagnostics);
    return std::nullopt;
  }
  auto& messages = read->diagnostics.messages;
  diagnostics.messages.insert(diagnostics.messages.end(), messages.begin(), messages.end());
  std::vector<city::Character>& bodies = read->city.people.characters;
  if (bodies.empty() || read->city.meshes.empty()) return std::nullopt;
  paintBody(bodies[0].levels[0], {read->city.materials, read->city.meshes[0].mesh.vertices}, diagnostics);
  CharacterFile out;
  for (size_t k = 1; k < bodies.size(); ++k) out.clips.push_back(std::move(bodies[k].clips[0]));
  out.body = std::move(bodies[0]);
  out.body.name = std::filesystem::path(file).stem().string();
  assignRoles(out);
  city::Dress own;
  own.fill(vec3(1));
  out.body.dresses = {own};
  out.body.levels = levelsOf(std::move(out.body.levels[0]));
  out.body.bounds = avatars::boundsInClips(out.body);
  return out;
}

bool useMotion(city::Character& character, const city::Skeleton& skeleton, const city::Clip& clip,
               const std::string& file, city::Diagnostics& diagnostics) {
  const auto cycle = avatars::cutCycle(skeleton, clip);
  if (!cycle) {
    diagnostics.warn(file, clip.name, "holds no walk that can be repeated");
    return false;
  }
  city::Clip made = avatars::retarget(skeleton, *cycle, character.skeleton);
  if (made.tracks.empty()) {
    diagnostics.warn(file, clip.name, "its bones are not those of " + character.name);
    return false;
  }
  avatars::settleFeet(character.skeleton, made);
  made = avatars::compress(character.skeleton, made, 0.001).clip;
  character.clips[static_cast<size_t>(city::Role::Walk)] = std::move(made);
  character.bounds = avatars::boundsInClips(character);
  return true;
}

}  // namespace vicus::assets::people
