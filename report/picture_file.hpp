/// Pictures from files and into bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/renderer.hpp"

namespace vicus::report {

/// Any picture that OpenImageIO reads, as 8-bit sRGB: grey becomes three equal channels, further channels are dropped.
/// Nothing, with the reason in `error`, where it cannot be read.
std::optional<viewer::Picture> readPicture(const std::string& path, std::string& error);

/// The picture as the bytes of a PNG file; empty where there are no pixels.
std::vector<uint8_t> pngBytes(const viewer::Picture& picture);

/// The picture reduced to at most `width` pixels across by averaging in linear light; never enlarged.
viewer::Picture reduced(const viewer::Picture& picture, int width);

/// Bytes as base64 (RFC 4648, padded).
std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace vicus::report
