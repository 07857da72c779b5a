/// Walls with holes, what fills the holes, timbers and roofs: the parts that houses and monuments are made of.
///
/// A wall is drawn on a flat frame, u to the right and v up as seen from outside, metres.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "city/building_geometry.hpp"

namespace vicus::assets::norvic {

/// Where a wall stands. `u` is a horizontal unit vector; outward is u × z.
struct WallFrame {
  glm::vec3 origin{0};
  glm::vec3 u{1, 0, 0};

  glm::vec3 normal() const { return {u.y, -u.x, 0}; }
  /// The point at (u, v), `out` metres in front of the wall.
  glm::vec3 at(float along, float up, float out = 0) const {
    return origin + u * along + glm::vec3(0, 0, up) + normal() * out;
  }
};

/// A trapezoid of a wall's outline, from `v0` up to `v1`, between `left` and `right` at its foot and at its top.
struct WallBand {
  float v0, v1;
  float left0, right0;
  float left1, right1;
};

/// A rectangular hole in a wall.
struct WallHole {
  float u0, u1, v0, v1;
};

/// Adds the wall's surface to the current plane: with its holes as the cut surface and, where there are holes, without
/// them as the flat one. Bands lie on one another from the lowest up; holes lie inside the bands and apart from each
/// other. The triangles have no T-junctions within the wall.
void addWall(city::BuildingBuilder& builder, const WallFrame& frame, std::span<const WallBand> bands,
             std::span<const WallHole> holes, city::MaterialId material);

/// What is in a hole: its four reveals and, `depth` metres in, the pane or door leaf. `front` is how far the reveals
/// come out of the wall, to meet a frame.
void addOpening(city::BuildingBuilder& builder, const WallFrame& frame, const WallHole& hole, float depth,
                city::MaterialId pane, city::MaterialId reveal, float front = 0);

/// Sides of a bar that are drawn beside its front.
enum BarSides : unsigned { kLeft = 1, kRight = 2, kBelow = 16, kAbove = 32, kEnds = kLeft | kRight, kAll = 51 };

/// A bar on the wall, from its surface `depth` metres out.
void addBar(city::BuildingBuilder& builder, const WallFrame& frame, const WallHole& area, float depth,
            city::MaterialId material, unsigned sides);
/// A slanting bar between two points (u, v) of the wall, `width` metres broad.
void addBrace(city::BuildingBuilder& builder, const WallFrame& frame, glm::vec2 from, glm::vec2 to, float width,
              float depth, city::MaterialId material);
/// Bars left, right and above a hole (and below where `sill`).
void addSurround(city::BuildingBuilder& builder, const WallFrame& frame, const WallHole& hole, float width, float depth,
                 city::MaterialId material, bool sill);

/// Adds a quadrilateral whose front is towards `outward`, u along a–b and v along a–d in metres.
void addQuadFacing(city::BuildingBuilder& builder, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d,
                   glm::vec3 outward, city::MaterialId material);
/// The same for a triangle.
void addTriangleFacing(city::BuildingBuilder& builder, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 outward,
                       city::MaterialId material);

/// A roof over a rectangle of walls. Its underside rests on the walls' outer edges, its top lies `thickness` above.
///
///                 /\            ridge
///               / /\ \          thickness, measured across the slope
///             / /    \ \        .
///           / /|      |\ \      eaves: `overhang` out from the walls, lower by overhang · slope
///             |        |
struct RoofShape {
  glm::vec3 centre{0};       ///< centre of the rectangle at the walls' top
  glm::vec3 ridge{1, 0, 0};  ///< unit, horizontal, along the ridge
  float halfLength = 1;      ///< of the walls, along the ridge
  float halfSpan = 1;        ///< of the walls, across it
  float slope = 1;           ///< rise over run
  float overhang = 0.3f;     ///< at the eaves
  float verge = 0.1f;        ///< at the gables
  float thickness = 0.15f;
  city::MaterialId covering = 0, edge = 0;

  float rise() const { return halfSpan * slope; }
  float thicknessUp() const { return thickness * glm::sqrt(1 + slope * slope); }
};

/// Two slopes. The gables' walls are not part of it.
void addGableRoof(city::BuildingBuilder& builder, const RoofShape& shape);
/// Four slopes of the same steepness; a pyramid where the rectangle is square. `halfLength` ≥ `halfSpan`.
void addHipRoof(city::BuildingBuilder& builder, const RoofShape& shape);

/// A chimney stack of four planes with a cap, from `bottom` to `top`, centred at (x, y).
void addChimney(city::BuildingBuilder& builder, glm::vec2 centre, glm::vec2 half, float bottom, float top,
                city::MaterialId material);

}  // namespace vicus::assets::norvic
