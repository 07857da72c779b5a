/// Ways that people write themselves.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::viewer {

/// Reads a path from JSON text:
///
///     { "name": "to the market",
///       "jumps": false,
///       "keys": [ { "time": 0,  "position": [12.5, -40, 3.1], "heading": 90, "pitch": 0 },
///                 { "time": 20, "position": [12.5,  10, 3.4], "heading": 75, "pitch": -5 } ] }
///
/// `time` in seconds, greater than the key's before; `position` of the eye in metres from the city's origin (x east,
/// y north, z up); `heading` in degrees counter-clockwise from east (90 looks north), `pitch` in degrees from −90 to
/// 90, up positive. `heading` and `pitch` may be left out (0), `name` (the file's name) and `jumps` (false) too. With
/// `"jumps": true` the eye stays at each key until the next one's time instead of moving there.
///
/// Nothing where the text is no such path; `diagnostics` says why, with line and column or the key that is wrong.
/// Fields with other names get a warning. `file` is only named in messages.
std::optional<city::Tour> parsePath(std::string_view text, const std::string& file, city::Diagnostics& diagnostics);

/// The tour as such a text; `parsePath` reads the same tour from it, angles to the last bits of a conversion to
/// degrees.
std::string pathText(const city::Tour& tour);

/// The same from a file.
std::optional<city::Tour> readPath(const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::viewer
