/// Roofs over any footprint: a slope over every eave, gables where a neighbour stands.
#pragma once

#include <vector>

#include "facade/straight_skeleton.hpp"

namespace vicus::facade {

struct RoofPiece {
  uint32_t ring = 0, edge = 0;      ///< of the footprint, that it rises from
  bool gable = false;               ///< upright, in the wall's plane; else a slope
  std::vector<glm::dvec3> polygon;  ///< flat, counter-clockwise from outside, the edge first; z from the eaves, metres
};

struct HipRoof {
  std::vector<RoofPiece> pieces;
  double height = 0;  ///< of the highest ridge over the eaves
  double reach = 0;   ///< on the plan from an eave to the farthest point of its slope, metres
};

/// All slopes rise `tangent` metres for each metre, or less where the ridge would be higher than `highest` metres.
/// `gables` says for each ring and edge whether its triangular hip stands up to a gable; other shapes stay slopes, and
/// so do those whose ridge would leave the wall. Nothing where there is no skeleton.
std::optional<HipRoof> hipRoof(std::span<const Ring> rings, std::span<const std::vector<uint8_t>> gables,
                               double tangent, double highest);

}  // namespace vicus::facade
