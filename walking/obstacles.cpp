/// Based on: the uniform grid as in Ericson 2005, "Real-Time Collision Detection", §7.1, here over the plan alone and
/// over what is near the visitor alone.
#include "walking/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "walking/surroundings.hpp"

namespace vicus::walking {
namespace {

constexpr double kTrunk = 0.15;    ///< metres: radius of a street tree's trunk
constexpr double kLevel = 0.64;    ///< cosine of 50°: roofs and banks that nobody walks up are steeper
constexpr double kCell = 1;        ///< metres: about a step, so that a step looks at some four cells
constexpr int kLargestGrid = 256;  ///< cells to a side

glm::dvec4 boxOf(std::initializer_list<glm::dvec2> points, double margin) {
  glm::dvec2 min(*points.begin()), max(min);
  for (const glm::dvec2& p : points) min = glm::min(min, p), max = glm::max(max, p);
  return {min - margin, max + margin};
}

bool overlaps(const glm::dvec4& box, glm::dvec2 centre, double halfSide) {
  return box.x <= centre.x + halfSide && box.z >= centre.x - halfSide && box.y <= centre.y + halfSide &&
         box.w >= centre.y - halfSide;
}

/// The monument's triangles that touch the square.
void gatherFaces(const city::City& city, uint32_t index, Obstacles& out, std::vector<glm::dvec4>& boxes) {
  const city::Monument& monument = city.monuments[index];
  const city::TriangleMesh& mesh = city.meshes[monument.mesh].mesh;
  const double c = std::cos(static_cast<double>(monument.heading)), s = std::sin(static_cast<double>(monument.heading));
  const auto place = [&](uint32_t vertex) {
    const glm::dvec3 p(mesh.vertices[vertex].position);
    return monument.position + glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
  };
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    Face face;
    for (size_t k = 0; k < 3; ++k) face.corners[k] = place(mesh.indices[t + k]);
    const auto& [p, q, r] = face.corners;
    const glm::dvec4 box = boxOf({glm::dvec2(p), glm::dvec2(q), glm::dvec2(r)}, 0);
    if (!overlaps(box, out.centre, out.halfSide)) continue;
    const glm::dvec3 across = glm::cross(q - p, r - p);
    const double area = glm::length(across);
    if (!(area > 1e-12)) continue;
    face.monument = index;
    face.walkable = std::abs(across.z) >= kLevel * area;
    out.faces.push_back(face);
    boxes.push_back(box);
  }
}

}  // namespace

glm::ivec2 CellLists::cellOf(glm::dvec2 p) const {
  const glm::dvec2 at = glm::clamp((p - corner_) / cell_, glm::dvec2(0), glm::dvec2(size_ - 1));
  return glm::ivec2(at);
}

void CellLists::build(glm::dvec2 corner, double cell, int size, const std::vector<glm::dvec4>& boxes) {
  corner_ = corner, cell_ = cell, size_ = size;
  starts_.assign(static_cast<size_t>(size * size) + 1, 0);
  const auto forCells = [&](const glm::dvec4& box, const auto& act) {
    const glm::ivec2 first = cellOf({box.x, box.y}), last = cellOf({box.z, box.w});
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) act(static_cast<size_t>(row * size_ + column));
  };
  for (const glm::dvec4& box : boxes) forCells(box, [&](size_t at) { ++starts_[at + 1]; });
  for (size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
  things_.resize(starts_.back());
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (uint32_t i = 0; i < boxes.size(); ++i) forCells(boxes[i], [&](size_t at) { things_[next[at]++] = i; });
}

bool Obstacles::covers(glm::dvec2 point, double about) const {
  const glm::dvec2 apart = glm::abs(point - centre);
  return std::max(apart.x, apart.y) + about <= halfSide;
}

Obstacles gatherObstacles(const city::City& city, glm::dvec2 centre, double halfSide) {
  Obstacles out;
  out.centre = centre, out.halfSide = halfSide;

  std::vector<glm::dvec4> boxes;
  const auto addWall = [&](const Wall& wall) {
    const glm::dvec4 box = boxOf({wall.a, wall.b}, wall.thickness);
    if (!overlaps(box, centre, halfSide)) return;
    out.walls.push_back(wall);
    boxes.push_back(box);
  };
  // Nobody walks over houses, also where the ground about them is higher than their roofs.
  constexpr double kNoTop = std::numeric_limits<double>::infinity();
  for (const uint32_t i : instancesWithin(city.buildings, centre, halfSide))
    for (const auto& ring : footprintOf(city, city.buildings.instances[i]))
      for (size_t k = 0; k < ring.size(); ++k) addWall({ring[k], ring[(k + 1) % ring.size()], kNoTop, 0});
  for (const uint32_t i : instancesWithin(city.trees, centre, halfSide)) {
    const glm::dvec2 at(city.trees.instances[i].position);
    addWall({at, at, static_cast<double>(city.trees.bounds[i].max.z), kTrunk});
  }
  const int size = std::clamp(static_cast<int>(std::ceil(2 * halfSide / kCell)), 1, kLargestGrid);
  const double cell = 2 * halfSide / size;
  const glm::dvec2 corner = centre - halfSide;
  out.wallCells.build(corner, cell, size, boxes);

  boxes.clear();
  for (uint32_t m = 0; m < city.monuments.size(); ++m)
    if (touchesSquare(city.monuments[m].bounds, centre, halfSide)) gatherFaces(city, m, out, boxes);
  out.faceCells.build(corner, cell, size, boxes);

  boxes.clear();
  for (const city::WaterBody& body : city.water)
    for (size_t t = 0; t + 2 < body.indices.size(); t += 3) {
      const WaterTriangle w{
          {body.points[body.indices[t]], body.points[body.indices[t + 1]], body.points[body.indices[t + 2]]},
          body.level};
      const glm::dvec4 box = boxOf({w.corners[0], w.corners[1], w.corners[2]}, 0);
      if (!overlaps(box, centre, halfSide)) continue;
      out.water.push_back(w);
      boxes.push_back(box);
    }
  out.waterCells.build(corner, cell, size, boxes);
  return out;
}

}  // namespace vicus::walking
