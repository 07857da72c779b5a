/// A building from its footprint and height.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/finishes.hpp"
#include "assets/import/polygon.hpp"
#include "city/building_geometry.hpp"

namespace vicus::assets {

/// Roofs rise at most this far above the eaves: metres.
constexpr double kHighestRoof = 4.5;

enum class RoofShape : uint8_t { Flat, Gable, Pyramid };

/// The roof that a footprint gets. Gable: four corners, convex, each angle within 30° of a right one. Pyramid: other
/// convex footprints with at most six corners. Flat: the rest.
RoofShape roofShapeOf(const Polygon& footprint);

/// What a building is made from. Positions in metres in the geometry's frame.
struct Extrusion {
  struct Part {
    Polygon polygon;                           ///< valid
    std::vector<std::vector<uint8_t>> shared;  ///< for each ring, for each edge: 1 where a neighbour stands against it
    bool operator==(const Part& other) const { return polygon.rings == other.polygon.rings && shared == other.shared; }
  };
  std::vector<Part> parts;
  double height = 6;      ///< metres from z = 0 to the eaves, > 0
  double foundation = 0;  ///< metres that the walls reach below z = 0, ≥ 0
  double pitch = 0.48;    ///< radians, of pitched roofs; less where the roof would rise above kHighestRoof
  Style style;

  bool operator==(const Extrusion&) const = default;
};

/// Walls (one plane for each edge, points in line merged to 3 cm), gables and roofs; occluder lines from the walls'
/// feet to the eaves. Nothing where the footprint cannot be cut into triangles.
std::optional<city::BuildingGeometry> extrude(const Extrusion& extrusion, std::string name);

}  // namespace vicus::assets
