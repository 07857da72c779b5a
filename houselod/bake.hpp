/// Bakes walls with all that is on them into pictures.
///
/// Based on: Willmott et al. 2001, §4.2.4. There the graphics card draws each wall and its picture is read back; here
/// the few rectangles of a wall are filled on the processor, which gives the same picture on every machine and needs no
/// context.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/material.hpp"
#include "houselod/texture_plan.hpp"

namespace vicus::houselod {

/// A material as the baker sees it: mip levels of size × size texels from the largest down to 1 × 1, RGBA8 with the
/// square root of linear light and alpha, row 0 at the bottom.
struct BakedFrom {
  int size = 0;                                  ///< of the first level; 0: grey
  std::vector<std::span<const uint8_t>> levels;  ///< one for each power of two
  bool repeat = true;
  glm::vec2 metresPerRepeat{1};
  glm::vec3 tint{1};
  float specular = 0;
};

/// Draws one wall into its page of `pageSize`² RGBA8 texels: the square root of linear light, and the specular share of
/// the material that is seen in alpha. Fills the picture's room to its margins. Nearer surfaces hide farther ones;
/// four samples a texel.
void bakePicture(const city::BuildingGeometry& type, const TexturePlan& plan, const PlanePicture& picture,
                 std::span<const BakedFrom> materials, std::span<uint8_t> page);

/// Mip levels of a page for an array of `size`² texels, from that down to 1 × 1; light is averaged, not its root. A
/// larger array repeats texels. Both sizes are powers of two.
std::vector<std::vector<uint8_t>> pageLevels(std::vector<uint8_t> page, int pageSize, int size);

}  // namespace vicus::houselod
