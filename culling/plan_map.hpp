/// The cull map on the plan: how high everything is hidden in each cell of the ground.
///
/// Based on: Wonka and Schmalstieg 1999, "Occluder Shadows for Fast Walkthroughs of Urban Environments"; Willmott et
/// al. 2001, §3.2. Departs: nested grids with cells that double outward reach the horizon; a cell counts only where a
/// shadow holds all of it, with the shadow's least height; the processor draws, so that nobody waits for a graphics
/// card; walls that share a corner throw one shadow. As published, for comparison: one grid, cells drawn where a shadow
/// holds their centre, heights of 16 bits, and only the centre of a box is looked up.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "culling/horizon.hpp"

namespace vicus::culling {

/// Positions relative to the eye, z the height of the wall's top above it: from `right` to `left` counter-clockwise.
struct ShadowWall {
  glm::dvec3 right, left;
};

/// Heights below which everything is hidden. Invariant: after `finish`, each cell of a coarser mip holds the least of
/// the four below it.
class PlanMap {
 public:
  /// `cells` to a side, rounded up to a power of two; grids are added until they reach `reach` metres from the eye.
  /// `finest`: metres, the side of a cell of the innermost grid. `published` makes one grid that reaches as far.
  PlanMap(uint32_t cells, double finest, double reach, double sway, bool published);

  /// Draws a wall's shadow.
  void add(const ShadowWall& wall);
  /// Draws the shadow that two walls throw together, of which the first ends where the second begins.
  void addJoint(const ShadowWall& first, const ShadowWall& second);
  /// Completes the mips. `lowest` and `highest`: of all content above the eye, the range of the published map's 16
  /// bits.
  void finish(double lowest, double highest);

  /// Whether everything over the rectangle up to `top` above the eye is hidden; as published: whether the point over
  /// its centre is.
  bool hides(const PlanBox& box, double top) const;

  /// For pictures of the map: the innermost grid's heights above the eye, row by row from the south; −∞ where nothing
  /// is hidden.
  const std::vector<float>& heights() const { return grids_.front().mips.front(); }
  uint32_t cells() const { return cells_; }
  double cellSize() const { return grids_.front().cell; }

 private:
  struct Grid {
    double cell = 1;  ///< metres
    std::vector<std::vector<float>> mips;
  };
  struct HalfPlane {
    glm::dvec2 normal;  ///< inward
    double distance;    ///< inside where dot(normal, p) ≥ distance
  };
  void draw(const std::array<HalfPlane, 4>& edges, const std::array<glm::dvec2, 2>& heights);
  bool covered(const Grid& grid, size_t mip, glm::ivec2 cell, glm::ivec2 first, glm::ivec2 last, float height) const;

  uint32_t cells_;
  double sway_;
  bool published_;
  std::vector<Grid> grids_;
};

}  // namespace vicus::culling
