/// Which texture goes into which array, and the mip levels of each: no GL.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assets/materials/materials.hpp"
#include "city/material.hpp"

namespace vicus::scenegraph {

/// A picture to be placed: one for each different source.
struct TextureDemand {
  int size = 1;        ///< longer side in pixels, ≥ 1
  bool repeat = true;  ///< else clamped at its edges
};

/// One array: square layers of one size.
struct TextureClass {
  int size = 0;  ///< a power of two
  bool repeat = true;
  uint32_t layers = 0;
};

struct TexturePlace {
  uint32_t textureClass = 0;
  uint32_t layer = 0;
};

struct TexturePlan {
  std::vector<TextureClass> classes;  ///< largest first
  std::vector<TexturePlace> places;   ///< one for each demand
  uint64_t bytes = 0;                 ///< of all arrays with their mip levels
  int halvings = 0;                   ///< times that a class was halved to keep within the budget
};

constexpr size_t kMostTextureClasses = 4;
constexpr int kLargestTexture = 2048;

/// Sizes each demand to a power of two, and arrays by size and wrap. Few arrays are good, because a surface's shader
/// may have to look into all: classes are joined to the next larger one while all together stay under a quarter of the
/// budget, and always down to kMostTextureClasses. Over the budget, the largest class is halved until all fits (or all
/// are 1 × 1).
TexturePlan planTextures(std::span<const TextureDemand> demands, uint64_t budgetBytes);

/// Bytes of one layer with all its mip levels, RGBA8.
uint64_t layerBytes(int size);

/// Mip levels of a picture resampled to size × size, from `size` down to 1, each RGBA8 with the square root of linear
/// light in rgb (as shaders expect it) and alpha. Averages are of linear light weighted by alpha; where the picture has
/// holes, each level keeps the full picture's covered fraction at the threshold 0.5, so that leaves do not thin out far
/// away (Castaño 2010). An empty picture gives mid grey.
std::vector<std::vector<uint8_t>> mipLevels(const assets::Image& image, int size);

/// True where some pixel's alpha lies under 0.9.
bool hasHoles(const assets::Image& image);

/// A mip level over a coarser one of the same picture (interpolated, repeating at its edges), halved: 128 where a pixel
/// is as bright as its surroundings. Sizes are sides in pixels.
std::vector<uint8_t> overSurroundings(std::span<const uint8_t> level, int size, std::span<const uint8_t> coarse,
                                      int coarseSize);

}  // namespace vicus::scenegraph
