/// Roofs of the forms that styles name, over any footprint.
#pragma once

#include <span>
#include <vector>

#include "facade/rules.hpp"
#include "facade/straight_skeleton.hpp"

namespace vicus::facade {

/// Roofs rise at most this far above the eaves unless a height is asked for: metres.
constexpr double kHighestRoof = 4.5;
/// Roofs of steep forms (gambrel, mansard, dome) and of steep pitches: metres.
constexpr double kHighestSteepRoof = 9;
/// Pitches from here on are meant: radians (50°). Pyramids from 60° on are spires.
constexpr double kSteepPitch = 0.872, kSpirePitch = 1.047;
constexpr double kHighestSpire = 45;
/// The widest span that gets a pitched roof, by half: metres.
constexpr double kWidestSlope = 12;

struct RoofRequest {
  RoofKind form = RoofKind::Gable;
  double pitch = 0.48;  ///< radians, 0 to under π/2
  double rise = 0;      ///< metres from the eaves to the ridge; 0: by the pitch
};

/// A flat piece of a roof.
struct RoofSurface {
  uint32_t ring = 0, edge = 0;      ///< of the footprint, that it rises from
  bool gable = false;               ///< upright, in the wall's plane
  std::vector<glm::dvec3> polygon;  ///< counter-clockwise from outside; z above the eaves, metres
};

struct RoofShape {
  std::vector<RoofSurface> surfaces;
  double height = 0;                ///< of the highest ridge over the eaves
  RoofKind built = RoofKind::Flat;  ///< the form that could be built
};

/// `party` says for each ring and edge whether a neighbour stands against it: gables come there first. Forms that the
/// footprint does not allow become the next simpler one: half-hip and shed without four corners become hip; all become
/// flat (no surfaces) where there is no skeleton or a slope would be longer than kWidestSlope. Rings as for
/// `straightSkeleton`.
RoofShape roofOver(std::span<const Ring> rings, std::span<const std::vector<uint8_t>> party,
                   const RoofRequest& request);

/// Whether a footprint has four corners, is convex, and each of its angles lies within 30° of a right one.
bool isNearlyRectangular(std::span<const Ring> rings);

}  // namespace vicus::facade
