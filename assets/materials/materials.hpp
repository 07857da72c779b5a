/// Textures: those made by code, and image files read through OpenImageIO.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "city/diagnostics.hpp"
#include "city/material.hpp"

namespace vicus::assets {

/// 8-bit sRGB colour with straight alpha, row 0 at the bottom (as GL reads it). Never empty.
struct Image {
  int width = 0, height = 0;
  std::vector<uint8_t> rgba;  ///< width · height · 4
};

/// Names of the textures made by code, without the `builtin:` prefix.
std::vector<std::string> builtinMaterialNames();

/// A material made by code with its size, tint and gloss set. Wood grain, boards, reed and the slope of roofs run along
/// the picture's height; `facade-…` show one bay of one storey, `leaves…` one cut-out cluster (alpha 0 or 255); `name`
/// without prefix. An unknown name gives `plaster`.
city::Material builtinMaterial(std::string_view name);

/// The picture of a material: made by code for `builtin:…`, else read from the file it names (paths relative to the
/// working folder). What cannot be read becomes a plain grey picture with an error in `diagnostics`. Deterministic.
Image materialImage(const city::Material& material, city::Diagnostics& diagnostics);

/// The pictures of many materials, made in parallel; pictures and diagnostics in the materials' order, as if made one
/// after another.
std::vector<Image> materialImages(std::span<const city::Material> materials, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
