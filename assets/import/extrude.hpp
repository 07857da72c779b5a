/// A building from its footprint and height.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/import/finishes.hpp"
#include "assets/import/polygon.hpp"
#include "assets/import/source.hpp"
#include "city/building_geometry.hpp"
#include "facade/house.hpp"

namespace vicus::assets {

/// What a building is made from. Positions in metres in the geometry's frame.
struct Extrusion {
  struct Part {
    Polygon polygon;                              ///< valid
    std::vector<std::vector<double>> neighbours;  ///< for each ring and edge: height up to which a neighbour stands
                                                  ///< against it; −infinity: none
    std::vector<std::vector<glm::dvec2>> ground;  ///< for each ring and edge: the ground at its ends; empty: 0
    double height = 6;                            ///< metres from z = 0 to the eaves, > bottom
    double bottom = 0;                            ///< 0: stands on the foundation; else its underside hangs there
    std::optional<facade::RoofKind> roof;         ///< what the source states; nothing: what the style says
    double roofHeight = kUnknown;                 ///< from eaves to ridge, metres; unknown: by the pitch
  };
  std::vector<Part> parts;
  double foundation = 0;            ///< metres that the walls reach below z = 0, ≥ 0
  uint32_t seed = 0;                ///< of the rules' choices
  size_t style = 0;                 ///< number of the style in use
  std::string use, material, roof;  ///< as the sources say it
  double year = 0;                  ///< 0: unknown
};

/// Metres from the eaves to the ridge or tip of the roof that a footprint gets.
double roofRise(const Polygon& footprint, facade::RoofKind form, double pitch);

/// The building by the rules of its style; points of walls in line merged to 3 cm. Adds what was derived to `made`.
city::BuildingGeometry extrude(const Extrusion& extrusion, const facade::StyleInUse& style, std::string name,
                               facade::Derivation& made);

}  // namespace vicus::assets
