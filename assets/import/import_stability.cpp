// Lengths on the ellipsoid: radii of curvature in the meridian and in the prime vertical, WGS 84.
#include "assets/import/import_stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "assets/import/gdal_messages.hpp"
#include "assets/import/import_city.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

constexpr double kSide = 20;  // metres

/// Degrees of longitude and latitude that are `kSide` metres long at a latitude in degrees.
glm::dvec2 degreesOfSide(double latitude) {
  constexpr double kRadius = 6378137, kEccentricity2 = 6.69437999014e-3;
  const double phi = latitude * std::numbers::pi / 180, sine = std::sin(phi);
  const double under = 1 - kEccentricity2 * sine * sine;
  const double primeVertical = kRadius / std::sqrt(under);
  const double meridian = kRadius * (1 - kEccentricity2) / (under * std::sqrt(under));
  return glm::dvec2(kSide / (primeVertical * std::cos(phi)), kSide / meridian) * (180 / std::numbers::pi);
}

/// A square with its south-west corner at `corner`, in the source's units.
Footprint square(glm::dvec2 corner, glm::dvec2 side, const std::string& id) {
  Footprint f;
  f.id = id;
  Polygon ring;
  ring.rings.push_back({corner, corner + glm::dvec2(side.x, 0), corner + side, corner + glm::dvec2(0, side.y)});
  f.parts.emplace_back().polygon = std::move(ring);
  f.height = 6;
  return f;
}

/// The largest error of a side of the buildings that come of a source; infinite where one is missing.
double largestSideError(Source source) {
  const size_t wanted = source.footprints.size();
  GdalMessages messages;
  city::Diagnostics diagnostics;
  std::vector<Source> sources;
  sources.push_back(std::move(source));
  const auto city = assembleCity(std::move(sources), {}, AssemblyRequest{}, LoadOptions{}, messages, diagnostics);
  double worst = city && city->buildings.size() == wanted ? 0 : std::numeric_limits<double>::infinity();
  if (!city) return worst;
  for (const city::BuildingGeometry& type : city->buildingTypes) {
    if (type.footprint.empty() || type.footprint[0].size() != 4) return std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < 4; ++i) {
      const glm::dvec2 side(type.footprint[0][(i + 1) % 4] - type.footprint[0][i]);
      worst = std::max(worst, std::abs(glm::length(side) - kSide));
    }
  }
  return worst;
}

Source sourceIn(const char* crs) {
  Source source;
  source.file = crs;
  source.crs = crsFromText(crs);
  return source;
}

}  // namespace

std::vector<city::StabilityRow> importStability() {
  std::vector<city::StabilityRow> rows;
  const auto add = [&](const char* caseName, Source source, double bound) {
    rows.push_back(city::stabilityRow("coordinates", caseName, "error of a side of 20 m, metres",
                                      largestSideError(std::move(source)), bound));
  };
  const auto degrees = [](const std::vector<glm::dvec2>& corners) {
    Source source = sourceIn("EPSG:4326");
    for (const glm::dvec2 corner : corners)
      source.footprints.push_back(
          square(corner, degreesOfSide(corner.y), "square " + std::to_string(source.footprints.size())));
    return source;
  };
  constexpr double kUtm = 0.02;  // its scale is within 0.001 of 1 throughout a zone
  add("geographic input at the equator", degrees({{36.8, 0}, {36.81, -0.01}, {36.8, 0.01}}), kUtm);
  add("geographic input, 52° N", degrees({{1.29, 52.63}, {1.30, 52.64}}), kUtm);
  add("geographic input, 78° N", degrees({{15.6, 78.2}, {15.7, 78.21}}), kUtm);
  add("geographic input, 54° S", degrees({{-68.3, -54.8}, {-68.31, -54.81}}), kUtm);
  add("geographic input across 180°", degrees({{179.99, -16.5}, {-179.99, -16.51}}), kUtm);
  add("geographic input beside 180°", degrees({{179.97, -16.5}, {179.99, -16.51}}), kUtm);

  // Eastings far beyond any zone's.
  for (const auto& [name, easting] :
       {std::pair("metric input at easting 0", 0.0), std::pair("metric input at easting 1 000 000", 1e6),
        std::pair("metric input at easting 10 000 000", 1e7)}) {
    Source source = sourceIn("EPSG:25832");
    source.metric = true;
    for (int i = 0; i < 3; ++i)
      source.footprints.push_back(
          square({easting + 50.0 * i, 5.4e6 + 30.0 * i}, glm::dvec2(kSide), "square " + std::to_string(i)));
    add(name, std::move(source), 1e-5);
  }
  return rows;
}

}  // namespace vicus::assets
