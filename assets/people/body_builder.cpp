#include "assets/people/body_builder.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "city/vertex.hpp"

namespace vicus::assets::people {

using glm::vec3;

void BodyBuilder::addVertex(const vec3& p, const Hold& hold, uint8_t part, float shade) {
  city::AvatarVertex v;
  v.position = p;
  v.joints = {static_cast<uint8_t>(hold.a), static_cast<uint8_t>(hold.b), 0, 0};
  const auto ofB = static_cast<uint8_t>(std::lround(255 * std::clamp(hold.ofB, 0.0F, 1.0F)));
  v.weights = {static_cast<uint8_t>(255 - ofB), ofB, 0, 0};
  const auto tone = static_cast<uint8_t>(std::lround(255 * std::sqrt(std::clamp(shade, 0.0F, 1.0F))));
  v.colour = {tone, tone, tone, part};
  mesh_.vertices.push_back(v);
}

void BodyBuilder::smooth(size_t firstVertex, size_t firstIndex) {
  std::vector<vec3> sums(mesh_.vertices.size() - firstVertex, vec3(0));
  for (size_t i = firstIndex; i + 2 < mesh_.indices.size(); i += 3) {
    const uint32_t* t = &mesh_.indices[i];
    const vec3 &a = mesh_.vertices[t[0]].position, &b = mesh_.vertices[t[1]].position,
               &c = mesh_.vertices[t[2]].position;
    const vec3 n = glm::cross(b - a, c - a);  // twice the area long: large triangles count more
    for (int k = 0; k < 3; ++k) sums[t[k] - firstVertex] += n;
  }
  for (size_t k = 0; k < sums.size(); ++k) {
    const float length = glm::length(sums[k]);
    mesh_.vertices[firstVertex + k].normal = city::packNormal(length > 0 ? sums[k] / length : vec3(0, 0, 1));
  }
}

void BodyBuilder::addTube(
    std::span<const Ring> rings, vec3 u, vec3 v, int sides,
    const std::function<bool(const vec3&, std::array<uint8_t, 4>&, std::array<uint8_t, 4>&)>& holdOf) {
  const size_t firstVertex = mesh_.vertices.size(), firstIndex = mesh_.indices.size();
  const auto n = static_cast<uint32_t>(sides);
  for (const Ring& r : rings)
    for (uint32_t k = 0; k < n; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(n);
      addVertex(r.centre + u * (r.radii.x * std::cos(angle)) + v * (r.radii.y * std::sin(angle)), r.hold, r.part,
                r.shade);
      city::AvatarVertex& made = mesh_.vertices.back();
      if (holdOf) holdOf(made.position, made.joints, made.weights);
    }
  const auto base = static_cast<uint32_t>(firstVertex);
  for (uint32_t r = 0; r + 1 < rings.size(); ++r)
    for (uint32_t k = 0; k < n; ++k) {
      const uint32_t a = base + r * n + k, b = base + r * n + (k + 1) % n, c = b + n, d = a + n;
      mesh_.indices.insert(mesh_.indices.end(), {a, b, c, a, c, d});
    }
  const uint32_t last = base + static_cast<uint32_t>(rings.size() - 1) * n;
  for (uint32_t k = 1; k + 1 < n; ++k) {
    mesh_.indices.insert(mesh_.indices.end(), {base, base + k + 1, base + k});
    mesh_.indices.insert(mesh_.indices.end(), {last, last + k, last + k + 1});
  }
  smooth(firstVertex, firstIndex);
}

void BodyBuilder::addEllipsoid(vec3 centre, vec3 radii, uint32_t joint, int sides, int bands,
                               const std::function<uint8_t(const vec3&)>& partOf, float shade) {
  const size_t firstVertex = mesh_.vertices.size(), firstIndex = mesh_.indices.size();
  const auto n = static_cast<uint32_t>(sides), m = static_cast<uint32_t>(bands);
  const auto add = [&](const vec3& direction) {
    addVertex(centre + radii * direction, {joint, joint, 0}, partOf(direction), shade);
  };
  add({0, 0, -1});
  for (uint32_t b = 1; b < m; ++b)
    for (uint32_t k = 0; k < n; ++k) {
      const float tilt = std::numbers::pi_v<float> * (static_cast<float>(b) / static_cast<float>(m) - 0.5F);
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(n);
      add({std::cos(tilt) * std::cos(angle), std::cos(tilt) * std::sin(angle), std::sin(tilt)});
    }
  add({0, 0, 1});
  const auto base = static_cast<uint32_t>(firstVertex), top = static_cast<uint32_t>(mesh_.vertices.size() - 1);
  const auto at = [&](uint32_t band, uint32_t k) { return base + 1 + (band - 1) * n + k % n; };
  for (uint32_t k = 0; k < n; ++k) {
    mesh_.indices.insert(mesh_.indices.end(), {base, at(1, k + 1), at(1, k)});
    for (uint32_t b = 1; b + 1 < m; ++b)
      mesh_.indices.insert(mesh_.indices.end(),
                           {at(b, k), at(b, k + 1), at(b + 1, k + 1), at(b, k), at(b + 1, k + 1), at(b + 1, k)});
    mesh_.indices.insert(mesh_.indices.end(), {at(m - 1, k), at(m - 1, k + 1), top});
  }
  smooth(firstVertex, firstIndex);
}

city::AvatarMesh BodyBuilder::finish() {
  return std::exchange(mesh_, {});
}

namespace {

/// The triangles that are left, with only the vertices that they use.
city::AvatarMesh simplified(const city::AvatarMesh& mesh, double share) {
  city::AvatarMesh out;
  const auto target = static_cast<size_t>(share * static_cast<double>(mesh.indices.size())) / 3 * 3;
  const float* positions = &mesh.vertices[0].position.x;
  out.indices.resize(mesh.indices.size());
  constexpr float kLargestError = 0.05F;  // of the body's size
  size_t count = meshopt_simplify(out.indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                                  mesh.vertices.size(), sizeof(city::AvatarVertex), target, kLargestError, 0, nullptr);
  // Many small closed pieces: where edges alone give too little, vertices are clustered.
  if (count > target + target / 2)
    count = meshopt_simplifySloppy(out.indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                                   mesh.vertices.size(), sizeof(city::AvatarVertex), target, kLargestError, nullptr);
  out.indices.resize(count);
  std::vector<uint32_t> remap(mesh.vertices.size());
  const size_t vertices =
      meshopt_optimizeVertexFetchRemap(remap.data(), out.indices.data(), count, mesh.vertices.size());
  out.vertices.resize(vertices);
  for (size_t v = 0; v < remap.size(); ++v)
    if (remap[v] != ~0U) out.vertices[remap[v]] = mesh.vertices[v];
  for (uint32_t& i : out.indices) i = remap[i];
  return out;
}

}  // namespace

std::array<city::AvatarMesh, city::kAvatarMeshLevels> levelsOf(city::AvatarMesh mesh) {
  std::array<city::AvatarMesh, city::kAvatarMeshLevels> levels;
  if (!mesh.indices.empty()) levels[1] = simplified(mesh, 0.5), levels[2] = simplified(mesh, 0.2);
  levels[0] = std::move(mesh);
  for (size_t k = 1; k < levels.size(); ++k)
    if (levels[k].indices.empty()) levels[k] = levels[k - 1];
  return levels;
}

}  // namespace vicus::assets::people
