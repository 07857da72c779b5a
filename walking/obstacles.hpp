/// What a visitor on foot can meet about a place: walls, monuments' surfaces, trunks, water.
///
/// Nothing is built for the whole city: what stands near is gathered from the city's own hierarchies when the visitor
/// comes near, into a small uniform grid over the plan. A city of any size then starts at once and costs the same
/// memory.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::walking {

/// A vertical wall over a segment of the plan, from any depth up to `top`; of no length a post.
struct Wall {
  glm::dvec2 a{0}, b{0};  ///< metres from the city's origin
  double top = 0;         ///< metres above the city's origin
  double thickness = 0;   ///< metres that it reaches out to all sides
};

/// A triangle of a monument.
struct Face {
  std::array<glm::dvec3, 3> corners;  ///< metres from the city's origin
  uint32_t monument = 0;              ///< index into City::monuments
  bool walkable = false;              ///< level enough to stand on: within 50° of the horizontal
};

/// A triangle of water.
struct WaterTriangle {
  std::array<glm::dvec2, 3> corners;
  double level = 0;
};

/// For each cell of a square of the plan, which of a list of things touch it.
class CellLists {
 public:
  /// `boxes[i]` is the box on the plan (min x, min y, max x, max y) of thing i.
  void build(glm::dvec2 corner, double cell, int size, const std::vector<glm::dvec4>& boxes);
  /// Calls `visit(i)` for the things whose cells touch the box; one may come several times.
  template <typename Visit>
  void visit(glm::dvec2 min, glm::dvec2 max, const Visit& visit) const {
    if (size_ == 0) return;
    const glm::ivec2 first = cellOf(min), last = cellOf(max);
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column) {
        const auto at = static_cast<size_t>(row * size_ + column);
        for (uint32_t k = starts_[at]; k < starts_[at + 1]; ++k) visit(things_[k]);
      }
  }

 private:
  glm::ivec2 cellOf(glm::dvec2 p) const;
  glm::dvec2 corner_{0};
  double cell_ = 1;
  int size_ = 0;
  std::vector<uint32_t> starts_, things_;
};

/// Everything within a square of the plan.
struct Obstacles {
  glm::dvec2 centre{0};
  double halfSide = 0;  ///< metres; 0: nothing was gathered yet
  std::vector<Wall> walls;
  std::vector<Face> faces;
  std::vector<WaterTriangle> water;
  CellLists wallCells, faceCells, waterCells;

  /// Whether the square with this half side about a point lies within what was gathered.
  bool covers(glm::dvec2 point, double about) const;
};

/// Gathers what touches the square. Buildings are their footprints (the outlines of their bounds where they have none),
/// at every height; trees are posts of 0.15 m. Monuments' triangles without area are left out.
Obstacles gatherObstacles(const city::City& city, glm::dvec2 centre, double halfSide);

}  // namespace vicus::walking
