/// Where towers stand at a footprint.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "facade/straight_skeleton.hpp"

namespace vicus::facade {

/// A square of `size` metres before the western of the two ends of a footprint, in its longest wall's direction: half a
/// metre of it and no less stands out, so that no two walls lie in one plane. It is made smaller where it would be
/// wider than nine tenths of the footprint. Nothing under a metre.
std::optional<Ring> endTower(const Ring& outline, double size);

/// Squares of `size` metres about the outward corners that are within 20° of right angles and whose edges are both
/// free; none where an edge is too short for the two at its ends.
std::vector<Ring> cornerTurrets(const Ring& outline, std::span<const uint8_t> party, double size);

}  // namespace vicus::facade
