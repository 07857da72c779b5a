/// Houses by rule: from a footprint and a style to a building type.
///
/// Based on: Müller et al. 2006, "Procedural Modeling of Buildings" (volumes, their faces, splits of these); Magellan,
/// §3 (a party wall has no windows and starts at the neighbour's height).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "city/building_geometry.hpp"
#include "facade/derive_wall.hpp"
#include "facade/roof.hpp"
#include "facade/wall_mesh.hpp"

namespace vicus::facade {

/// What stands on the ground and is to become a house. Metres, z from the house's ground.
struct Lot {
  std::vector<Ring> rings;                      ///< outer counter-clockwise, holes clockwise, simple
  std::vector<std::vector<double>> neighbours;  ///< for each ring and edge: height up to which a neighbour stands
                                                ///< against it; −infinity or NaN: none. May be empty
  std::vector<std::vector<glm::dvec2>> ground;  ///< for each ring and edge: the ground at its ends, where its windows
                                                ///< and doors begin; NaN: `bottom`. May be empty
  double bottom = 0;                            ///< of its walls: 0, or its underside hangs there
  double foundation = 0;                        ///< metres that its walls reach below `bottom`
  std::optional<RoofKind> roof;                 ///< where the sources state it, it takes the place of the style's
  double roofRise = 0;                          ///< metres from eaves to ridge, where they state it; else 0
  HouseFacts facts;                             ///< height, year, use, material, seed; the rest is worked out here
};

/// A style with its paints as the city knows them.
struct StyleInUse {
  const Style* style = nullptr;
  std::vector<PaintLook> looks;  ///< one for each of the style's paints
  /// For each of its paints, the far picture in the colour of a wall of that paint; empty: as the far paint is.
  std::vector<city::MaterialId> farOf;
  std::vector<double> parameters;  ///< one for each of the style's; empty: as the style says
};

/// The side of the house that each edge is on. The longest free edge of the outer ring is the front, one beside a party
/// wall counting three times; edges that look
/// the same way to 60° are fronts too, those that look the other way backs, others sides; holes have backs.
std::vector<std::vector<Face>> facesOf(const Lot& lot);

/// Adds levels, planes, items and occluder lines of one house. Bounded in time; says in `made` what it made.
void addHouse(city::BuildingBuilder& builder, const StyleInUse& use, const Lot& lot, Derivation& made);

}  // namespace vicus::facade
