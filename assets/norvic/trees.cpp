#include "assets/norvic/trees.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "assets/norvic/palette.hpp"
#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

using city::MaterialId;
using glm::vec2;
using glm::vec3;

/// Points and triangles of a sphere: an icosahedron whose faces are each cut in four.
struct Ball {
  std::vector<vec3> points;
  std::vector<std::array<uint32_t, 3>> faces;
};

Ball icosahedron() {
  const float g = 0.5f * (1 + std::sqrt(5.0f));
  Ball ball;
  for (const float a : {-1.0f, 1.0f})
    for (const float b : {-g, g}) {
      ball.points.push_back(glm::normalize(vec3(0, a, b)));
      ball.points.push_back(glm::normalize(vec3(a, b, 0)));
      ball.points.push_back(glm::normalize(vec3(b, 0, a)));
    }
  // The faces of a convex body: every three neighbours at the edge's length.
  const float edge = 2 / std::sqrt(1 + g * g) * 1.001f;
  const auto near = [&](uint32_t i, uint32_t j) { return glm::length(ball.points[i] - ball.points[j]) < edge; };
  for (uint32_t i = 0; i < 12; ++i)
    for (uint32_t j = i + 1; j < 12; ++j)
      for (uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const vec3 normal = glm::cross(ball.points[j] - ball.points[i], ball.points[k] - ball.points[i]);
        const bool out = glm::dot(normal, ball.points[i]) > 0;
        ball.faces.push_back(out ? std::array{i, j, k} : std::array{i, k, j});
      }
  return ball;
}

Ball cutInFour(const Ball& in) {
  Ball out;
  out.points = in.points;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
  const auto middle = [&](uint32_t i, uint32_t j) {
    const auto [it, fresh] = middles.try_emplace(std::minmax(i, j), static_cast<uint32_t>(out.points.size()));
    if (fresh) out.points.push_back(glm::normalize(out.points[i] + out.points[j]));
    return it->second;
  };
  for (const auto& [i, j, k] : in.faces) {
    const uint32_t a = middle(i, j), b = middle(j, k), c = middle(k, i);
    out.faces.insert(out.faces.end(), {{i, a, c}, {a, j, b}, {c, b, k}, {a, b, c}});
  }
  return out;
}

/// A crown: a ball stretched to `radii`, its surface uneven by `unevenness`. Normals lean outward from its middle, so
/// that its light is soft.
void addCrown(city::TriangleMesh& mesh, const Ball& ball, vec3 centre, vec3 radii, float unevenness, MaterialId leaves,
              city::Random& random) {
  std::vector<vec3> points;
  for (const vec3& p : ball.points) {
    const auto r = static_cast<float>(1 + unevenness * random.uniform(-1, 1));
    points.push_back(centre + p * radii * r);
  }
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  for (size_t i = 0; i < points.size(); ++i) {
    const vec3 out = glm::normalize((points[i] - centre) / radii + vec3(0, 0, 0.25f));
    const float around = std::atan2(ball.points[i].y, ball.points[i].x) * std::max(radii.x, radii.y);
    mesh.vertices.push_back({points[i], {around, points[i].z}, city::packNormal(out), leaves, 0, 0});
  }
  for (const auto& [i, j, k] : ball.faces) mesh.indices.insert(mesh.indices.end(), {base + i, base + j, base + k});
}

void addTrunk(city::TriangleMesh& mesh, float foot, float top, float height, MaterialId bark) {
  constexpr uint32_t kSides = 5;
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  for (uint32_t i = 0; i <= kSides; ++i) {
    const float angle = 6.2831853f * static_cast<float>(i) / kSides;
    const vec3 out(std::cos(angle), std::sin(angle), 0);
    const uint32_t normal = city::packNormal(out);
    mesh.vertices.push_back({out * foot + vec3(0, 0, -0.6f), {angle * foot, -0.6f}, normal, bark, 0, 0});
    mesh.vertices.push_back({out * top + vec3(0, 0, height), {angle * foot, height}, normal, bark, 0, 0});
  }
  for (uint32_t i = 0; i < kSides; ++i) {
    const uint32_t a = base + 2 * i;
    mesh.indices.insert(mesh.indices.end(), {a, a + 2, a + 3, a, a + 3, a + 1});
  }
}

city::MeshGeometry makeTree(TreeKind kind, int shape) {
  static constexpr const char* kNames[kTreeKinds] = {"oak", "apple", "poplar", "willow", "bush"};
  city::Random random(city::hash32(static_cast<uint32_t>(kind), static_cast<uint32_t>(shape)));
  const Ball coarse = icosahedron(), fine = cutInFour(coarse);
  city::MeshGeometry tree;
  tree.name = std::string(kNames[static_cast<size_t>(kind)]) + "/" + std::to_string(shape + 1);
  const auto size = static_cast<float>(random.uniform(0.85, 1.15));
  city::TriangleMesh& mesh = tree.mesh;
  switch (kind) {
    case TreeKind::Oak:
      addTrunk(mesh, 0.42f, 0.26f, 4.5f * size, kBark);
      addCrown(mesh, fine, {0.2f, 0, 7.4f * size}, vec3(4.1f, 3.8f, 3.9f) * size, 0.16f, kLeaves, random);
      break;
    case TreeKind::Apple:
      addTrunk(mesh, 0.2f, 0.13f, 2.0f * size, kBark);
      addCrown(mesh, fine, {0, 0.1f, 3.5f * size}, vec3(2.2f, 2.3f, 1.7f) * size, 0.18f, kLeaves, random);
      break;
    case TreeKind::Poplar:
      addTrunk(mesh, 0.35f, 0.22f, 3.0f * size, kBark);
      addCrown(mesh, fine, {0, 0, 9.2f * size}, vec3(1.9f, 1.8f, 7.2f) * size, 0.12f, kLeavesDark, random);
      break;
    case TreeKind::Willow:
      addTrunk(mesh, 0.5f, 0.4f, 2.6f * size, kBark);
      addCrown(mesh, fine, {0, 0, 4.9f * size}, vec3(3.6f, 3.5f, 3.0f) * size, 0.14f, kLeaves, random);
      addCrown(mesh, coarse, {0.8f, 0.5f, 3.4f * size}, vec3(3.3f, 3.2f, 2.0f) * size, 0.12f, kLeavesDark, random);
      break;
    case TreeKind::Bush:
      addCrown(mesh, coarse, {0, 0, 0.7f * size}, vec3(1.5f, 1.2f, 1.1f) * size, 0.2f, kLeavesDark, random);
      addCrown(mesh, coarse, {1.1f, 0.5f, 0.55f * size}, vec3(1.1f, 1.0f, 0.9f) * size, 0.2f, kLeaves, random);
      break;
  }
  for (const city::Vertex& v : mesh.vertices) tree.bounds.extend(v.position);
  return tree;
}

}  // namespace

std::vector<city::MeshGeometry> makeTrees() {
  std::vector<city::MeshGeometry> out;
  for (int kind = 0; kind < kTreeKinds; ++kind)
    for (int shape = 0; shape < kTreeShapes; ++shape) out.push_back(makeTree(static_cast<TreeKind>(kind), shape));
  return out;
}

}  // namespace vicus::assets::norvic
