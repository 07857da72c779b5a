/// What stands about a point of the plan: how far the nearest wall is, how high the ground and the roofs are.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::walking {

/// Height of a visitor's eye above the ground, metres (the mean of adults' eye heights, 1.5 to 1.75 m).
constexpr double kEyeHeight = 1.65;

/// Signed distance from a point to the nearest building's outline on the plan, metres: negative inside a building,
/// `reach` where none is nearer than `reach`. Buildings without a footprint count with their bounds. Exact.
double clearance(const city::City& city, glm::dvec2 point, double reach);

/// Height of what one stands on, metres above the city's origin: the terrain, or water that lies over it; without
/// terrain there, the ground of the buildings within 60 m, weighted by 1 / (distance² + 25 m²), else that of the
/// nearest one; 0 in a city of neither. A position that is not finite gives 0.
double groundAt(const city::City& city, glm::dvec2 point);

/// The same without water: the bed of a river.
double dryGroundAt(const city::City& city, glm::dvec2 point);

/// The highest point of ground, buildings, trees and monuments in a square about `centre`, metres above the city's
/// origin; `groundAt` the centre where there is nothing else.
double highestWithin(const city::City& city, glm::dvec2 centre, double halfSide);

/// Where the town is densest: the middle of the buildings on the tile with the most built-up ground on it and its eight
/// neighbours, no building counting more than a house. Without buildings the middle of the extent, in an empty city the
/// origin.
glm::dvec2 densestPoint(const city::City& city);

/// Footprint of a building in the city's frame: outer ring, then holes; the corners of its bounds where it has none.
std::vector<std::vector<glm::dvec2>> footprintOf(const city::City& city, const city::Instance& building);

/// Indices of the instances whose bounds touch a square about `centre`, ascending.
std::vector<uint32_t> instancesWithin(const city::InstanceSet& set, glm::dvec2 centre, double halfSide);

/// Whether a box touches a square about `centre` on the plan.
bool touchesSquare(const city::Aabbf& box, glm::dvec2 centre, double halfSide);

/// Whether a triangle of the plan covers a point, its edges included, whichever way round it is.
bool triangleCovers(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 point);

}  // namespace vicus::walking
