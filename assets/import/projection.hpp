/// Coordinate reference systems: everything comes into one metric CRS.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

namespace vicus::assets {

/// WKT of what a person or a file calls a CRS ("EPSG:2154", an OGC URN or URL, WKT, PROJ), without a vertical part.
/// Empty where it cannot be understood. Reads no file and no network.
std::string crsFromText(const std::string& text);

/// Metres for each unit of the heights in a CRS given as text: that of its vertical part, else of its axes where it is
/// projected, else 1 (also where it is not known).
double heightUnitOf(const std::string& text);

/// Metres for each unit of the vertical part of a CRS given as text; nothing where it has none.
std::optional<double> verticalUnitOf(const std::string& text);

struct CrsKind {
  bool known = false;
  bool geographic = false;   ///< degrees
  double metresPerUnit = 1;  ///< of a projected CRS
};
CrsKind kindOf(const std::string& wkt);

/// The CRS that a city whose centre lies at `centre` (in `wkt`) is built in: `wkt` itself where it is projected and in
/// metres, else the UTM zone of the centre. Empty where the centre cannot be placed on the earth, and for geocentric
/// CRSs, whose z is no height.
std::string metricCrs(const std::string& wkt, glm::dvec2 centre);

/// "EPSG:2154" where the CRS has a code, else its WKT on one line.
std::string crsName(const std::string& wkt);

/// Brings points (x east or longitude, y north or latitude) from one CRS into another, in place. Points that cannot be
/// brought there become NaN; returns how many. Nothing where the transformation itself cannot be made.
std::optional<size_t> transform(const std::string& from, const std::string& to, std::span<glm::dvec2> points);

}  // namespace vicus::assets
