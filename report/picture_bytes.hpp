/// Pictures as bytes that a page can carry.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/renderer.hpp"

namespace vicus::report {

/// The picture reduced to at most `width` pixels across by averaging in linear light; never enlarged.
viewer::Picture reduced(const viewer::Picture& picture, int width);

/// Bytes as base64 (RFC 4648, padded).
std::string base64(const std::vector<uint8_t>& bytes);

}  // namespace vicus::report
