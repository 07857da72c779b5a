/// Where a city lies: one metric CRS for all sources, and an origin near them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assets/import/read_elevation.hpp"
#include "assets/import/source.hpp"
#include "city/aabb.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Drops positions that are not finite from every source, and what then cannot be built; says how many.
void dropNonFinite(Source& source, city::Diagnostics& diagnostics);

/// The CRS (WKT) of the city: `wanted` where it is not empty, else the first source's own where it is metric, else the
/// UTM zone of its centre, else that of the rasters; empty for local metres. Sources that cannot be placed are dropped
/// with an error that says what `--crs` could do. A source whose stated CRS cannot be that of its coordinates gets
/// `fallback` (what the user says of files without one).
std::string chooseCrs(std::vector<Source>& sources, std::span<const ElevationRaster> rasters, const std::string& wanted,
                      const std::string& fallback, city::Diagnostics& diagnostics);

/// Brings all positions of a source into the city's CRS and metres, and adds the shift.
void project(Source& source, const std::string& crs, glm::dvec3 shift, city::Diagnostics& diagnostics);

/// Leaves out buildings (four or more are needed to tell) any point of which lies more than 5 km, and more than ten
/// times as far as four in five of the buildings reach, from the median of all, and triangles of the terrain that do:
/// mistyped coordinates.
void dropFarBuildings(Source& source, city::Diagnostics& diagnostics);

/// Leaves out sources that lie farther from the first than a city can be wide (200 km), with a hint at their CRS.
void dropFarSources(std::vector<Source>& sources, city::Diagnostics& diagnostics);

/// Extent of all positions on the plan; z is 0.
city::Aabb planExtent(Source& source);

/// The city's origin: the middle of the data on the plan and its lowest known altitude, in whole metres.
glm::dvec3 originOf(std::vector<Source>& sources, double shiftZ);

}  // namespace vicus::assets
