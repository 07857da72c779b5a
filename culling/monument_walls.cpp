#include "culling/monument_walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace vicus::culling {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kUpright = 1e-3;    ///< vertical part of a unit normal, at most
constexpr double kLeastWidth = 0.5;  ///< metres
constexpr double kLeastHeight = 1;   ///< metres

}  // namespace

std::vector<MeshWall> uprightQuadsOf(const city::TriangleMesh& mesh) {
  using Point = std::tuple<float, float, float>;
  const auto place = [&](uint32_t i) { return mesh.vertices[mesh.indices[i]].position; };
  const auto key = [&](uint32_t i) {
    const glm::vec3 p = place(i);
    return Point(p.x, p.y, p.z);
  };
  // Triangles by their longest edge: two that share it from both sides make a quadrilateral.
  std::map<std::pair<Point, Point>, uint32_t> waiting;
  std::vector<MeshWall> walls;
  for (uint32_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const dvec3 normal = glm::cross(dvec3(place(t + 1) - place(t)), dvec3(place(t + 2) - place(t)));
    if (!(glm::length(normal) > 0) || std::abs(normal.z) > kUpright * glm::length(normal)) continue;
    uint32_t longest = 0;
    const auto lengthOf = [&](uint32_t k) { return glm::distance(place(t + k), place(t + (k + 1) % 3)); };
    for (uint32_t k = 1; k < 3; ++k)
      if (lengthOf(k) > lengthOf(longest)) longest = k;
    const Point from = key(t + longest), to = key(t + (longest + 1) % 3);
    const auto partner = waiting.find({to, from});
    if (partner == waiting.end()) {
      waiting[{from, to}] = t + (longest + 2) % 3;
      continue;
    }
    const dvec3 diagonal[] = {dvec3(place(t + longest)), dvec3(place(t + (longest + 1) % 3))};
    dvec3 corners[] = {diagonal[0], dvec3(place(partner->second)), diagonal[1], dvec3(place(t + (longest + 2) % 3))};
    waiting.erase(partner);
    // Seen from outside the right is at normal turned by a quarter, counter-clockwise.
    const dvec2 along = glm::normalize(dvec2(-normal.y, normal.x));
    std::sort(std::begin(corners), std::end(corners),
              [&](const dvec3& p, const dvec3& q) { return glm::dot(dvec2(p), along) < glm::dot(dvec2(q), along); });
    const auto same = [&](const dvec3& p, const dvec3& q) { return glm::distance(dvec2(p), dvec2(q)) <= kSamePoint; };
    if (!same(corners[0], corners[1]) || !same(corners[2], corners[3])) continue;
    MeshWall wall;
    wall.a = dvec2(corners[0]), wall.b = dvec2(corners[2]);
    wall.bottom = std::max(std::min(corners[0].z, corners[1].z), std::min(corners[2].z, corners[3].z));
    wall.topA = std::max(corners[0].z, corners[1].z), wall.topB = std::max(corners[2].z, corners[3].z);
    if (glm::distance(wall.a, wall.b) >= kLeastWidth && std::min(wall.topA, wall.topB) - wall.bottom >= kLeastHeight)
      walls.push_back(wall);
  }
  return walls;
}

}  // namespace vicus::culling
