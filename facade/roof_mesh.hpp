/// The surfaces of roofs and what stands on them. Used by house.cpp.
#pragma once

#include <span>
#include <vector>

#include "facade/roof.hpp"
#include "facade/wall_mesh.hpp"

namespace vicus::facade {

/// A slope in its place: metres, z from the house's ground.
struct Slope {
  uint32_t ring = 0, edge = 0;
  std::vector<glm::dvec3> polygon;
  glm::dvec3 normal{0, 0, 1};
};

struct BuiltRoof {
  RoofShape shape;
  double eaves = 0;
  std::vector<Slope> slopes;
};

/// Adds a slope as a plane of its own, triangulated, and enters it into `slopes`. Nothing where it has no area.
void addRoofSlope(city::BuildingBuilder& builder, const RoofSurface& surface, double eaves, const PaintLook& covering,
                  std::vector<Slope>& slopes);

/// Adds a gable: its outline in the first texture of `detail`, else plain, and those shapes that lie wholly within it.
/// Steps and bells stand before it and reach over the roof.
void addGable(city::BuildingBuilder& builder, const RoofSurface& surface, const WallFrame& frame,
              const WallDetail& detail, std::span<const PaintLook> looks, uint32_t plain);

/// A level roof over the rings; `parapet` metres of wall around it.
void addFlatRoof(city::BuildingBuilder& builder, std::span<const Ring> rings, double z, double parapet,
                 const PaintLook& covering, const PaintLook& wall);

/// What hangs over the walls under slopes: covering and soffit. Not where neighbours stand.
void addEaves(city::BuildingBuilder& builder, std::span<const Ring> rings, std::span<const std::vector<uint8_t>> party,
              const BuiltRoof& roof, double overhang, const PaintLook& covering, const PaintLook& board);

struct ChimneySize {
  double width = 0.8, depth = 0.5, height = 1.2;  ///< metres; height over the highest point
};
void addChimney(city::BuildingBuilder& builder, const BuiltRoof& roof, const ChimneySize& size, const PaintLook& look,
                uint32_t seed);

struct DormerSize {
  double width = 1.2, height = 1.4, spacing = 4;  ///< metres
};
struct PlacedDormer {
  glm::dvec3 origin{0};  ///< lower left corner of its face
  glm::dvec2 along{1, 0};
  double tangent = 1;  ///< of the slope behind it
};
/// Where dormers fit: on slopes over fronts, side by side, with their roofs ending on the slope.
std::vector<PlacedDormer> dormerPlaces(const BuiltRoof& roof, std::span<const std::vector<Face>> faces,
                                       const DormerSize& size);
void addDormer(city::BuildingBuilder& builder, const PlacedDormer& place, const DormerSize& size,
               const WallDetail& detail, std::span<const PaintLook> looks, const PaintLook& covering, uint32_t plain);

}  // namespace vicus::facade
