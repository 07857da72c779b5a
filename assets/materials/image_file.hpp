/// Image files through OpenImageIO.
#pragma once

#include <string>

#include "assets/materials/materials.hpp"

namespace vicus::assets {

/// Longest side of a picture in texels; larger files are reduced by whole factors or to this.
inline constexpr int kLongestImageSide = 2048;

/// Reads any format that OpenImageIO knows into 8-bit sRGB with straight alpha. Grey becomes three equal channels, four
/// channels without alpha are taken as CMYK when the file says so, 16-bit and float are reduced (float pictures are
/// taken as linear light, NaN as 0), pictures longer than `kLongestImageSide` are made smaller. What cannot be read
/// becomes a grey picture with an error that names the file.
Image readImageFile(const std::string& path, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
