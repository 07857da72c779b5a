/// Terrain heights on a regular grid.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "city/aabb.hpp"

namespace vicus::city {

/// Heights in metres above the city's origin. Sample (column, row) lies at origin + spacing · (column, row); row 0 is
/// the southernmost. NaN marks a sample without data.
///
/// The surface is that of its full-detail triangles: each cell is cut by the diagonal from south-west to north-east
/// where column + row is even, else from north-west to south-east. That is the finest mesh that ROAM's binary triangle
/// trees make, so what stands on `heightAt` stands on what is drawn.
struct HeightField {
  glm::dvec2 origin{0};                ///< position of sample (0, 0), metres from the city's origin
  glm::dvec2 spacing{1};               ///< metres, each > 0
  glm::ivec2 size{0};                  ///< columns, rows
  std::vector<float> heights;          ///< size.x · size.y, row by row
  float minHeight = 0, maxHeight = 0;  ///< of the samples that have data

  bool empty() const { return size.x < 2 || size.y < 2; }
  float at(int column, int row) const {
    return heights[static_cast<size_t>(row) * static_cast<size_t>(size.x) + static_cast<size_t>(column)];
  }
  float& at(int column, int row) {
    return heights[static_cast<size_t>(row) * static_cast<size_t>(size.x) + static_cast<size_t>(column)];
  }
  glm::dvec2 extent() const { return spacing * glm::dvec2(size - 1); }

  /// Height of the surface at (x, y), metres from the city's origin. Outside the field: that of the nearest edge.
  /// Nothing where the triangle there has a corner without data, or the position is not finite.
  std::optional<double> heightAt(double x, double y) const;
  /// Upward unit normal of the surface there; +z where `heightAt` has nothing.
  glm::dvec3 normalAt(double x, double y) const;
  /// Sets minHeight and maxHeight from the samples; both 0 where none has data.
  void updateRange();
  /// Extent and height range.
  Aabb bounds() const;
  /// 2 for each cell whose triangles have data at all their corners.
  uint64_t triangleCount() const;
};

/// What covers the ground, for texturing.
enum class Ground : uint8_t { Grass, Field, Earth, Street, Paving, Garden, Bank, Water };
constexpr int kGroundKinds = 8;

/// A raster of what covers the ground, texel (column, row) spanning origin + spacing · [(column, row), (column + 1, row
/// + 1)].
struct GroundCover {
  glm::dvec2 origin{0};
  double spacing = 1;  ///< metres
  glm::ivec2 size{0};
  std::vector<Ground> kinds;  ///< size.x · size.y, row by row from the south
};

}  // namespace vicus::city
