/// The exact error of every triangle of the binary triangle trees, computed once for a height field.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "city/height_field.hpp"
#include "terrain/patch_grid.hpp"

namespace vicus::terrain {

/// Errors in 16 bits, never less than the true one: 0, else 5 bits of exponent and 11 of mantissa, 1.2e-4 m to 2.6e5 m
/// in steps of 1/2048. Larger errors become the largest code, smaller ones the smallest.
using ErrorCode = uint16_t;
constexpr ErrorCode kNoGround = 0xffff;  ///< the triangle covers nothing that has data: it is left out of the mesh

ErrorCode encodeError(float metres);
/// Metres; 0 for `kNoGround`.
float decodeError(ErrorCode code);

/// What ROAM knows of a height field beside its heights. 4 bytes for each sample of the patches; 4 more for each sample
/// of the field where it has gaps.
struct ErrorTable {
  PatchGrid patches;
  /// For the diamond centred at (column, row): entries 2 · (row · (span.x + 1) + column) + canonicalSide.
  ///
  /// The error of a triangle is the largest vertical distance between it and the full-detail surface's samples under
  /// it, its edges among them. It is that triangle's own: a child may have a larger one. A triangle that covers ground
  /// with and without data has at least the length of its hypotenuse: so far may its edge lie from the ground's true
  /// edge.
  std::vector<ErrorCode> codes;
  /// The field's heights with the gaps filled from their neighbours, for triangles that reach over a gap's edge. Empty
  /// where the field has no gaps.
  std::vector<float> filled;

  size_t bytes() const { return codes.size() * sizeof(ErrorCode) + filled.size() * sizeof(float); }
};

/// Computes the table with `threads` threads (0: as many as the machine has cores). The result does not depend on their
/// number. A field with fewer than 2 × 2 samples, or without one sample that has data, gives no patches.
///
/// With `weights`, one finite number ≥ 1 for each sample, the distance at a sample counts so many times: errors where
/// they show most are kept smaller.
ErrorTable buildErrorTable(const city::HeightField& field, std::span<const float> weights = {}, unsigned threads = 0);

}  // namespace vicus::terrain
