/// Distance to the nearest footprint over a window of the plan, and the way that keeps to its ridges.
///
/// Based on: Felzenszwalb and Huttenlocher 2012, "Distance Transforms of Sampled Functions" (exact, two passes);
/// Dijkstra's shortest paths.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::viewer {

/// Cell (column, row) has its centre at origin + cell · (column, row).
struct DistanceMap {
  glm::dvec2 origin{0};         ///< metres from the city's origin
  double cell = 1;              ///< metres
  glm::ivec2 size{0};           ///< columns, rows
  std::vector<float> distance;  ///< metres from a cell's centre to the nearest occupied cell's centre; 0 occupied
  /// How built-in a cell is, 0 (open country) to 1 (a court): the share of directions in which a building stands within
  /// 40 m. Empty: not known.
  std::vector<float> enclosure;

  size_t index(glm::ivec2 c) const {
    return static_cast<size_t>(c.y) * static_cast<size_t>(size.x) + static_cast<size_t>(c.x);
  }
  glm::dvec2 centre(glm::ivec2 c) const { return origin + cell * glm::dvec2(c); }
};

/// Distances from each cell to the nearest cell where `occupied` is not 0, in cells; infinity where none is.
std::vector<float> distanceTransform(const std::vector<uint8_t>& occupied, glm::ivec2 size);

/// Fills in `enclosure` from `distance`.
void findEnclosure(DistanceMap& map);

/// The square of side 2 · halfSide about `centre` in cells of `cell` metres, occupied where a building stands or a wall
/// passes, with its enclosure.
DistanceMap distanceToFootprints(const city::City& city, glm::dvec2 centre, double halfSide, double cell);

/// A long way through the map that follows the ridges of the distance (the middles of streets and squares): the
/// longest of the cheapest ways in the largest connected piece of street, corner by corner. It keeps between houses
/// where it can: built-in ground is cheaper than the town's outer edge. Cells nearer than `keepClear` metres to a
/// building are never entered. Empty where there is no room.
std::vector<glm::dvec2> ridgeWay(const DistanceMap& map, double keepClear);

}  // namespace vicus::viewer
