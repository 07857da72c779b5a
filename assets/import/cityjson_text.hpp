/// CityJSON as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "assets/import/cityjson_geometry.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets::cityjson {

/// The JSON of a text; nothing, with a message, where it is none. `firstLine` is the line of the file that it begins
/// in.
std::optional<Json> parse(std::string_view text, const std::string& file, size_t firstLine,
                          city::Diagnostics& diagnostics);

}  // namespace vicus::assets::cityjson
