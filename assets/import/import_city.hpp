/// Puts the content of all files together into one city.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/import/read_elevation.hpp"
#include "assets/import/source.hpp"
#include "assets/load_city.hpp"
#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

class GdalMessages;

/// A building without a known height gets kDefaultHeight (6 m). Its frame has its origin at the footprint's centroid
/// and z = 0 at the mean height of the ground along its outline, from where its height counts; its walls reach 0.3 m
/// below the lowest ground there, and at least 0.5 m down.
///
/// Terrain: the rasters where there are any; else the sources' triangulated terrain; else, where footprints say their
/// ground's altitude, a surface through these; else none, and the city is flat.
///
/// Nothing where neither buildings nor terrain are left.
std::optional<city::City> assembleCity(std::vector<Source> sources, std::span<const ElevationRaster> rasters,
                                       const LoadOptions& options, GdalMessages& messages,
                                       city::Diagnostics& diagnostics);

}  // namespace vicus::assets
