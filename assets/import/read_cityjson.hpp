/// CityJSON 1.0, 1.1 and 2.0, and text sequences of it.
#pragma once

#include <string>
#include <string_view>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Does a text look like CityJSON? It has a member "type" with the value "CityJSON".
bool isCityJson(std::string_view text);

struct CityJsonOptions {
  std::string heightColumn;  ///< attribute of building heights; empty: found by its usual names
  double lod = 10;           ///< the finest level of detail that is wanted; default: the finest there is
};

/// Buildings, each with all its parts, terrain, water, what covers the ground, and trees; also from a text sequence
/// (CityJSONSeq: one feature on each line, read in parallel). Of a building's geometry the highest level of detail is
/// taken that `lod` allows and that has any surface that can be used; where only footprints (LoD 0) are left it becomes
/// a footprint with the height that its attributes give. Object types that the standard does not know are taken as
/// buildings. What cannot be read is in the diagnostics with the object's id; the rest is returned.
Source readCityJson(std::string_view text, const std::string& file, const CityJsonOptions& options,
                    city::Diagnostics& diagnostics);

}  // namespace vicus::assets
