#include "assets/import/projection.hpp"

#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

namespace vicus::assets {
namespace {

/// A CRS from WKT with x east and y north, whatever order its authority states.
std::optional<OGRSpatialReference> fromWkt(const std::string& wkt) {
  OGRSpatialReference crs;
  if (wkt.empty() || crs.importFromWkt(wkt.c_str()) != OGRERR_NONE) return std::nullopt;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return crs;
}

std::string toWkt(const OGRSpatialReference& crs) {
  char* text = nullptr;
  static constexpr const char* kOptions[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  std::string out;
  if (crs.exportToWkt(&text, kOptions) == OGRERR_NONE && text) out = text;
  CPLFree(text);
  return out;
}

/// The code in any of the OGC's spellings of an EPSG name, also those with https that CityJSON uses and PROJ does not
/// know; empty for other texts.
std::string epsgCode(const std::string& text) {
  std::string lower;
  for (const char c : text)
    if (c != ' ') lower.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  std::string_view rest = lower;
  for (const std::string_view prefix :
       {"https://www.opengis.net/def/crs/", "https://opengis.net/def/crs/", "http://www.opengis.net/def/crs/",
        "http://opengis.net/def/crs/", "urn:ogc:def:crs:", "urn:x-ogc:def:crs:"})
    if (rest.starts_with(prefix)) {
      rest.remove_prefix(prefix.size());
      break;
    }
  if (!rest.starts_with("epsg")) return {};
  rest.remove_prefix(4);
  // Perhaps a version between two separators, then the code.
  const size_t separator = rest.find_last_of(":/");
  if (separator == std::string_view::npos) return {};
  const std::string_view code = rest.substr(separator + 1);
  const bool digits = !code.empty() && code.find_first_not_of("0123456789") == std::string_view::npos;
  const bool version = rest.substr(0, separator + 1).find_first_not_of("0123456789.:/") == std::string_view::npos;
  return digits && version ? std::string(code) : std::string();
}

/// What a person or a file calls a CRS; nothing where it is not known.
std::optional<OGRSpatialReference> fromText(const std::string& text) {
  constexpr size_t kLongest = 100000;
  if (text.empty() || text.size() > kLongest) return std::nullopt;
  const std::string code = epsgCode(text);
  const std::string name = code.empty() ? text : "EPSG:" + code;
  OGRSpatialReference crs;
  static constexpr const char* kOptions[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  CPLPushErrorHandler(CPLQuietErrorHandler);  // that it is not known is this function's answer, not a message
  const bool known = crs.SetFromUserInput(name.c_str(), kOptions) == OGRERR_NONE;
  CPLPopErrorHandler();
  if (!known) return std::nullopt;
  return crs;
}

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
};
using Transformation = std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation>;

}  // namespace

std::string crsFromText(const std::string& text) {
  std::optional<OGRSpatialReference> crs = fromText(text);
  if (!crs) return {};
  crs->StripVertical();
  return toWkt(*crs);
}

std::optional<double> verticalUnitOf(const std::string& text) {
  const std::optional<OGRSpatialReference> crs = fromText(text);
  if (!crs || !crs->IsVertical()) return std::nullopt;
  const double unit = crs->GetTargetLinearUnits("VERT_CS");
  return unit > 0 ? unit : 1;
}

double heightUnitOf(const std::string& text) {
  if (const auto vertical = verticalUnitOf(text)) return *vertical;
  const std::optional<OGRSpatialReference> crs = fromText(text);
  if (!crs) return 1;
  return crs->IsProjected() && crs->GetLinearUnits() > 0 ? crs->GetLinearUnits() : 1;
}

CrsKind kindOf(const std::string& wkt) {
  CrsKind kind;
  const auto crs = fromWkt(wkt);
  if (!crs) return kind;
  kind.known = true;
  kind.geographic = crs->IsGeographic();
  if (!kind.geographic) kind.metresPerUnit = crs->GetLinearUnits();
  return kind;
}

std::string metricCrs(const std::string& wkt, glm::dvec2 centre) {
  const auto crs = fromWkt(wkt);
  if (!crs) return {};
  if (crs->IsGeocentric()) return {};
  if ((crs->IsProjected() || crs->IsLocal()) && std::abs(crs->GetLinearUnits() - 1) < 1e-9) return wkt;
  OGRSpatialReference degrees;
  degrees.SetWellKnownGeogCS("WGS84");
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const Transformation toDegrees(OGRCreateCoordinateTransformation(&*crs, &degrees));
  if (!toDegrees || !toDegrees->Transform(1, &centre.x, &centre.y)) return {};
  if (!(std::abs(centre.x) <= 360 && std::abs(centre.y) <= 90)) return {};
  const double longitude = std::remainder(centre.x, 360.0);
  const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180) / 6)) + 1, 1, 60);
  OGRSpatialReference utm;
  if (utm.importFromEPSG((centre.y >= 0 ? 32600 : 32700) + zone) != OGRERR_NONE) return {};
  return toWkt(utm);
}

std::string crsName(const std::string& wkt) {
  const auto crs = fromWkt(wkt);
  if (!crs) return {};
  const char* authority = crs->GetAuthorityName(nullptr);
  const char* code = crs->GetAuthorityCode(nullptr);
  return authority && code ? std::string(authority) + ":" + code : wkt;
}

std::optional<size_t> transform(const std::string& from, const std::string& to, std::span<glm::dvec2> points) {
  const auto source = fromWkt(from), target = fromWkt(to);
  if (!source || !target) return std::nullopt;
  if (source->IsSame(&*target)) return 0;
  const Transformation t(OGRCreateCoordinateTransformation(&*source, &*target));
  if (!t) return std::nullopt;
  std::vector<double> x(points.size()), y(points.size());
  std::vector<int> ok(points.size(), 0);
  for (size_t i = 0; i < points.size(); ++i) x[i] = points[i].x, y[i] = points[i].y;
  t->Transform(static_cast<int>(points.size()), x.data(), y.data(), nullptr, ok.data());
  size_t failed = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = {x[i], y[i]};
    if (ok[i] && std::isfinite(x[i]) && std::isfinite(y[i])) continue;
    points[i] = glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    ++failed;
  }
  return failed;
}

}  // namespace vicus::assets
