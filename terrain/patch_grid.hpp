/// How a height field is covered by square patches, and where the diamonds of their triangle trees lie.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace vicus::terrain {

/// Square patches of `side` × `side` cells that cover a field of any size.
///
/// The last patches may reach beyond the field. Their samples out there are drawn in to the field's edge: sample
/// (column, row) of the patches is sample (min(column, cells.x), min(row, cells.y)) of the field. Triangles across the
/// edge are pressed together, triangles beyond it have no area. So the mesh ends where the field ends, and flat ground
/// of any size is two triangles for each patch.
struct PatchGrid {
  glm::ivec2 cells{0};  ///< of the field: samples − 1
  int side = 1;         ///< cells along a patch, a power of two
  glm::ivec2 count{0};  ///< patches

  glm::ivec2 span() const { return count * side; }  ///< cells of all patches together, ≥ `cells`
  bool empty() const { return count.x < 1 || count.y < 1; }
};

/// The largest patches whose cells are at most 1¾ times those of the field: one patch of 512² for 401 × 401 samples,
/// one of 1 024² for 1 025², a row of single cells for 2 × N. No patches where a side has fewer than 2 samples.
PatchGrid patchGridFor(glm::ivec2 samples);

/// A diamond: two right triangles that share their hypotenuse a–b and are split together at its middle, the centre.
///
///            p0            u = from the centre to b
///           /  \           v = from the centre to p0 = u turned left by 90°
///          a -c- b         side 0 is (a, b, p0), side 1 is (b, a, p1)
///           \  /           children: 0 over edge b–p0, 1 over p0–a, 2 over a–p1, 3 over p1–b
///            p1
///
/// Every sample of the patches except their corners is the centre of exactly one diamond. Apexes p0 and p1 are the
/// centres of its parents: splitting p0 makes side 0, splitting p1 makes side 1.
struct DiamondShape {
  glm::ivec2 u{0};  ///< samples; a square's half diagonal or half edge
  glm::ivec2 v{0};
};

/// Shape of the diamond centred at a sample of the patches; (0, 0) and its multiples of `side` are corners and have
/// none (broken precondition).
DiamondShape diamondAt(const PatchGrid& grid, glm::ivec2 centre);

/// Which of a diamond's two entries in tables belongs to the side whose apex lies in direction `apex` from the centre.
inline uint32_t canonicalSide(glm::ivec2 apex) {
  return apex.y > 0 || (apex.y == 0 && apex.x > 0) ? 0 : 1;
}

}  // namespace vicus::terrain
