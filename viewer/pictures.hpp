/// Pictures to and from files, and how far two of them differ.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Texts that go into a picture's file, keyword and text; "Title", "Description" and "Software" are PNG's own keywords.
using PictureNotes = std::span<const std::pair<std::string, std::string>>;

/// The picture as the bytes of an 8-bit sRGB PNG file; empty, with the reason in `error`, where that cannot be: no
/// pixels, or not as many bytes as pixels need.
std::vector<uint8_t> pngBytes(const Picture& picture, std::string& error, PictureNotes notes = {});

/// Writes an 8-bit sRGB PNG, whole or not at all (whole_file.hpp). Returns an empty text, or what went wrong.
std::string writePng(const std::filesystem::path& path, const Picture& picture, PictureNotes notes = {});

/// Reads a picture of any format that OpenImageIO knows as 8-bit RGB; nothing, with the reason in `error`, where it
/// cannot be read.
std::optional<Picture> readPicture(const std::filesystem::path& path, std::string& error);

/// How far two pictures of one size differ.
struct PictureDifference {
  int largest = 0;               ///< of any channel, 0 (equal) to 255
  uint64_t differingPixels = 0;  ///< pixels in which any channel differs by more than the tolerance
  double share = 0;              ///< differingPixels over all pixels, 0 to 1
};

/// Counts the pixels in which some channel differs by more than `tolerance` (0 to 255). Pictures of different sizes
/// differ everywhere: largest 255, share 1.
PictureDifference compare(const Picture& a, const Picture& b, int tolerance = 0);

}  // namespace vicus::viewer
