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

struct AssemblyRequest {
  std::string crs;          ///< WKT of the CRS that the city is built in; empty: chosen
  std::string fallbackCrs;  ///< WKT of what the user says of files whose own CRS is missing or wrong; may be empty
};

/// A building without a known height gets its source's default (6 m). Its frame has its origin at the footprint's
/// centroid and z = 0 at the mean height of the ground along its outline, from where its height counts; its walls reach
/// 0.3 m below the lowest ground there, and at least 0.5 m down.
///
/// A building of surfaces keeps its own altitude.
///
/// Terrain: the rasters where there are any; else the sources' triangulated terrain; else a surface through the ground
/// altitudes that footprints state and those that buildings of surfaces state or begin at; else none, and the city is
/// flat.
///
/// Nothing where neither buildings nor meshes nor terrain are left.
std::optional<city::City> assembleCity(std::vector<Source> sources, std::span<const ElevationRaster> rasters,
                                       const AssemblyRequest& request, const LoadOptions& options,
                                       GdalMessages& messages, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
