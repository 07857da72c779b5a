/// A building from its footprint and height.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/finishes.hpp"
#include "assets/import/polygon.hpp"
#include "assets/import/source.hpp"
#include "city/building_geometry.hpp"

namespace vicus::assets {

/// Roofs rise at most this far above the eaves: metres.
constexpr double kHighestRoof = 4.5;

/// The widest span that gets a pitched roof, by half: metres.
constexpr double kWidestSlope = 12;

/// The roof that a footprint gets. Gable: four corners, convex, each angle within 30° of a right one. Hip: the rest,
/// with a slope over every eave and gables where neighbours stand; `extrude` makes it flat where a slope would be
/// longer on the plan than kWidestSlope.
RoofForm roofFormOf(const Polygon& footprint);
/// The same for a footprint whose source states a form, where it can be built over it: gables and slopes need the four
/// corners of a gable, pyramids a convex outline.
RoofForm roofFormOf(const Polygon& footprint, RoofForm stated);
/// Metres from the eaves to the ridge or tip of the roof that `extrude` builds for this footprint.
double roofRise(const Polygon& footprint, RoofForm form, double pitch);

/// What a building is made from. Positions in metres in the geometry's frame.
struct Extrusion {
  struct Part {
    Polygon polygon;                           ///< valid
    std::vector<std::vector<uint8_t>> shared;  ///< for each ring, for each edge: 1 where a neighbour stands against it
    double height = 6;                         ///< metres from z = 0 to the eaves, > bottom
    double bottom = 0;                         ///< 0: stands on the foundation; else its underside hangs there: metres
    RoofForm roof = RoofForm::Unknown;
    double roofHeight = kUnknown;  ///< from eaves to ridge, metres; unknown: by the pitch
  };
  std::vector<Part> parts;
  double foundation = 0;  ///< metres that the walls reach below z = 0, ≥ 0
  double pitch = 0.48;    ///< radians, of pitched roofs; less where the roof would rise above kHighestRoof
  Style style;
};

/// Walls (one plane for each edge, points in line merged to 3 cm), gables and roofs; occluder lines from the walls'
/// feet to the eaves. Nothing where the footprint cannot be cut into triangles.
std::optional<city::BuildingGeometry> extrude(const Extrusion& extrusion, std::string name);

}  // namespace vicus::assets
