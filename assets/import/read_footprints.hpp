/// Building footprints from any vector format that OGR reads.
#pragma once

#include <string>
#include <vector>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

class GDALDataset;
class OGRGeometry;

namespace vicus::assets {

class GdalMessages;

struct FootprintColumns {
  std::string height;  ///< named by the user; empty: found by the usual names
  std::string ground;
  std::string layer;  ///< only this one; empty: all
};

/// Appends the polygons of a geometry; false where it has something that is no polygon.
bool readPolygons(const OGRGeometry& geometry, std::vector<Polygon>& out);

/// All polygon features of all layers, one building each. In a layer of OpenStreetMap data (it
/// has a column `osm_id` or `@id`) with a column `building` only those with a value there other than "no". Heights: the
/// first height column with a number > 0, else storeys × 3 m, else unknown.
Source readFootprints(GDALDataset& dataset, const std::string& file, const FootprintColumns& columns,
                      GdalMessages& messages, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
