/// Image files through OpenImageIO.
#pragma once

#include <string>

#include "assets/materials/materials.hpp"

namespace vicus::assets {

/// Longest side of a picture in texels; larger files are averaged down by a whole factor.
inline constexpr int kLongestImageSide = 2048;

/// Reads any format that OpenImageIO knows ("FILE#bytes=OFFSET+LENGTH": a JPEG or PNG inside another file) into 8-bit
/// sRGB with straight alpha. One channel becomes grey, two grey with alpha, more than four lose the rest; 16-bit is cut
/// to 8; float pictures are taken as linear light, with what is not finite as 0. Colours are averaged in linear light
/// where a picture is made smaller. What cannot be read becomes a grey picture with an error that names the file; a
/// JPEG that ends early keeps what there is, with a warning.
Image readImageFile(const std::string& path, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
