/// What it would cost not to leave out what a scene does not need.
#pragma once

#include <optional>
#include <string_view>

#include "city/city.hpp"

namespace vicus::report {

/// The city with the least of one kind of content that it lacks, out of sight, so that the composition makes that part
/// of the program: `terrain` (a flat field of 257 × 257 heights under all), `water` (one body under all), `trees`
/// (one), `monuments` (one), `buildings` (one), `avatars` (one person). Nothing for other names, and where the city has
/// that content.
std::optional<city::City> withPart(const city::City& city, std::string_view part);

}  // namespace vicus::report
