/// CityGML 1 and 2.
#pragma once

#include <string>
#include <string_view>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Does a text begin as CityGML does? It names the OGC's citygml namespace in its first 64 KiB.
bool isCityGml(std::string_view text);

struct CityGmlOptions {
  double lod = 10;  ///< the finest level of detail that is wanted
};

/// Buildings with all their parts, bridges and tunnels, TIN terrain, water, roads and trees, through libcitygml; with
/// semantics, attributes, pictures and colours, xlinks and implicit geometry. Of an object the finest level of detail
/// is taken that `lod` allows. What cannot be read is in the diagnostics.
Source readCityGml(const std::string& file, const CityGmlOptions& options, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
