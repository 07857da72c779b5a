/// OpenStreetMap extracts (.osm.pbf, .osm) through OGR's driver.
#pragma once

#include <string>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

class GDALDataset;

namespace vicus::assets {

class GdalMessages;

/// Is this dataset one of OGR's driver for OpenStreetMap's own formats?
bool isOpenStreetMap(GDALDataset& dataset);

/// Buildings with their parts (`building`, `building:part`, `height`, `min_height`, `building:levels`, `roof:*`),
/// streets (`highway`), water, coast lines, trees, free-standing walls, and what covers the ground. Parts that lie in a
/// building's outline belong to it; where they fill half of it or more they take its place. `height` reaches to the
/// ridge, as the map's rules say, and levels of 3 m to the eaves. What is not shown is counted in the diagnostics.
Source readOsm(GDALDataset& dataset, const std::string& file, GdalMessages& messages, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
