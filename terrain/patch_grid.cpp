#include "terrain/patch_grid.hpp"

#include <bit>
#include <cassert>

namespace vicus::terrain {

PatchGrid patchGridFor(glm::ivec2 samples) {
  PatchGrid grid;
  grid.cells = glm::max(samples - 1, glm::ivec2(0));
  if (grid.cells.x < 1 || grid.cells.y < 1) return grid;
  const int64_t fieldCells = int64_t{grid.cells.x} * grid.cells.y;
  for (int side = 1 << 14; side >= 1; side /= 2) {
    const glm::ivec2 count = (grid.cells + side - 1) / side;
    const int64_t patchCells = int64_t{count.x} * count.y * side * side;
    if (4 * patchCells > 7 * fieldCells) continue;
    grid.side = side;
    grid.count = count;
    break;
  }
  return grid;
}

DiamondShape diamondAt(const PatchGrid& grid, glm::ivec2 centre) {
  assert((centre.x | centre.y) % grid.side != 0 && "a corner of a patch is no diamond's centre");
  (void)grid;
  const auto bits = static_cast<uint32_t>(centre.x | centre.y);
  const int h = 1 << std::countr_zero(bits);
  const bool oddX = (centre.x & h) != 0, oddY = (centre.y & h) != 0;
  DiamondShape shape;
  if (oddX && oddY) {
    // The centre of a square of side 2h. Diagonals of neighbouring squares alternate.
    const glm::ivec2 square = (centre - h) / (2 * h);
    shape.u = (square.x + square.y) % 2 == 0 ? glm::ivec2(h, h) : glm::ivec2(h, -h);
  } else {
    shape.u = oddX ? glm::ivec2(h, 0) : glm::ivec2(0, h);
  }
  shape.v = {-shape.u.y, shape.u.x};
  return shape;
}

}  // namespace vicus::terrain
