/// Files out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace vicus::viewer {

/// Writes a file whole or not at all: beside `path` first, then renamed, so that nobody ever reads half of one; folders
/// that are missing are made. Returns an empty text, or what went wrong.
std::string writeWhole(const std::filesystem::path& path, std::string_view bytes);

}  // namespace vicus::viewer
