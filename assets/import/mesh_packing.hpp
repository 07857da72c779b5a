/// A mesh and what was said of it as bytes, from one process of this machine to another.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "assets/import/read_mesh.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

std::string pack(const std::optional<MeshContent>& content, const city::Diagnostics& diagnostics);

/// The inverse: adds what was said to `diagnostics`. Reads nothing beyond the bytes, whatever they are.
std::optional<MeshContent> unpack(std::string_view bytes, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
