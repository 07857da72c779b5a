#include "assets/import/read_footprints.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <map>

#include "assets/import/columns.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

Ring readRing(const OGRLinearRing& line) {
  Ring ring;
  const int count = line.getNumPoints();
  ring.reserve(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) ring.emplace_back(line.getX(i), line.getY(i));
  return ring;
}

/// The columns of a layer that matter here.
struct Columns {
  std::vector<std::string> names;
  std::vector<size_t> height, storeys, ground, uphill, roof;
  std::optional<size_t> building;  ///< only in OpenStreetMap's own tables, which hold every kind of polygon
  std::optional<size_t> tags;
  bool noBuildings = false;  ///< one of OpenStreetMap's tables that hold none
};

Columns findColumns(OGRLayer& layer, const FootprintColumns& wanted, const std::string& file,
                    city::Diagnostics& diagnostics) {
  Columns out;
  OGRFeatureDefn& table = *layer.GetLayerDefn();
  for (int i = 0; i < table.GetFieldCount(); ++i) out.names.emplace_back(table.GetFieldDefn(i)->GetNameRef());
  out.height = columnsNamed(out.names, heightNames());
  out.storeys = columnsNamed(out.names, storeyNames());
  out.ground = columnsNamed(out.names, groundNames());
  if (wanted.ground.empty()) out.uphill = columnsNamed(out.names, uphillNames());
  out.roof = columnsNamed(out.names, roofNames());
  const auto named = [&](const std::string& name, std::vector<size_t>& list, const char* what) {
    if (name.empty()) return;
    const auto found = std::find(out.names.begin(), out.names.end(), name);
    if (found != out.names.end()) {
      list = {static_cast<size_t>(found - out.names.begin())};
      return;
    }
    std::string all;
    for (const std::string& n : out.names) all += (all.empty() ? "" : ", ") + n;
    diagnostics.error(file, std::string("layer ") + layer.GetName(),
                      "there is no column " + name + " for the " + what + "; the columns are " + all);
  };
  named(wanted.height, out.height, "height");
  named(wanted.ground, out.ground, "ground altitude");
  std::optional<size_t> building;
  bool fromOpenStreetMap = false;
  for (size_t i = 0; i < out.names.size(); ++i) {
    if (out.names[i] == "building") building = i;
    if (out.names[i] == "other_tags") out.tags = i;
    fromOpenStreetMap = fromOpenStreetMap || out.names[i] == "osm_id" || out.names[i] == "@id";
  }
  if (fromOpenStreetMap) out.building = building;
  out.noBuildings = fromOpenStreetMap && !building;
  return out;
}

double number(const OGRFeature& feature, size_t column) {
  const int i = static_cast<int>(column);
  if (!feature.IsFieldSetAndNotNull(i)) return kUnknown;
  switch (feature.GetFieldDefnRef(i)->GetType()) {
    case OFTInteger:
    case OFTInteger64:
    case OFTReal: {
      const double v = feature.GetFieldAsDouble(i);
      return std::isfinite(v) ? v : kUnknown;
    }
    case OFTString:
      return numberIn(feature.GetFieldAsString(i));
    default:
      return kUnknown;
  }
}

/// Value of a key in OpenStreetMap's column of further tags: "key"=>"value","key"=>"value".
double numberInTags(const OGRFeature& feature, size_t column, const std::string& key) {
  const std::string text = feature.GetFieldAsString(static_cast<int>(column));
  const size_t at = text.find("\"" + key + "\"=>\"");
  return at == std::string::npos ? kUnknown : numberIn(std::string_view(text).substr(at + key.size() + 5, 24));
}

double firstPositive(const OGRFeature& feature, const std::vector<size_t>& columns) {
  for (const size_t c : columns)
    if (const double v = number(feature, c); v > 0) return v;
  return kUnknown;
}

double firstFinite(const OGRFeature& feature, const std::vector<size_t>& columns) {
  for (const size_t c : columns)
    if (const double v = number(feature, c); std::isfinite(v)) return v;
  return kUnknown;
}

/// From the ground to the eaves: as its own column says, else from the altitudes of roof and ground, else by storeys.
double heightOf(const OGRFeature& feature, const Columns& columns, double ground) {
  double height = firstPositive(feature, columns.height);
  if (!(height > 0) && columns.tags) height = numberInTags(feature, *columns.tags, "height");
  if (height > 0) return height;
  for (const size_t c : columns.roof)
    if (const double h = number(feature, c) - ground; h > 0) return h;
  double storeys = firstPositive(feature, columns.storeys);
  if (!(storeys > 0) && columns.tags) storeys = numberInTags(feature, *columns.tags, "building:levels");
  return storeys > 0 ? storeys * kStoreyHeight : kUnknown;
}

}  // namespace

bool readPolygons(const OGRGeometry& geometry, std::vector<Polygon>& out) {
  switch (wkbFlatten(geometry.getGeometryType())) {
    case wkbPolygon:
    case wkbTriangle: {
      const OGRPolygon& p = *geometry.toPolygon();
      if (!p.getExteriorRing()) return true;
      Polygon polygon;
      polygon.rings.push_back(readRing(*p.getExteriorRing()));
      for (int i = 0; i < p.getNumInteriorRings(); ++i) polygon.rings.push_back(readRing(*p.getInteriorRing(i)));
      out.push_back(std::move(polygon));
      return true;
    }
    case wkbMultiPolygon:
    case wkbGeometryCollection: {
      bool all = true;
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) all = readPolygons(*part, out) && all;
      return all;
    }
    case wkbCurvePolygon:
    case wkbMultiSurface: {
      const std::unique_ptr<OGRGeometry> straight(geometry.getLinearGeometry());
      return straight && wkbFlatten(straight->getGeometryType()) != wkbFlatten(geometry.getGeometryType()) &&
             readPolygons(*straight, out);
    }
    default:
      return false;
  }
}

Source readFootprints(GDALDataset& dataset, const std::string& file, const FootprintColumns& wanted,
                      GdalMessages& messages, city::Diagnostics& diagnostics) {
  Source source;
  source.file = file;
  const bool severalLayers = dataset.GetLayerCount() > 1;
  std::map<std::string, uint64_t> otherGeometry;
  uint64_t notBuildings = 0;
  bool layerFound = wanted.layer.empty();
  for (OGRLayer* layer : dataset.GetLayers()) {
    if (!wanted.layer.empty() && wanted.layer != layer->GetName()) continue;
    layerFound = true;
    const OGRwkbGeometryType type = wkbFlatten(layer->GetGeomType());
    if (type == wkbNone || OGR_GT_IsSubClassOf(type, wkbPoint) || OGR_GT_IsSubClassOf(type, wkbCurve) ||
        type == wkbMultiPoint || OGR_GT_IsSubClassOf(type, wkbMultiCurve)) {
      diagnostics.leftOut.push_back(
          {std::string("layer ") + layer->GetName(), 1,
           "it holds " + std::string(OGRToOGCGeomType(type)) + ", and footprints are polygons"});
      continue;
    }
    const Columns columns = findColumns(*layer, wanted, file, diagnostics);
    if (columns.noBuildings) {
      diagnostics.leftOut.push_back(
          {std::string("layer ") + layer->GetName(), 1, "it has no column building, so its shapes are no buildings"});
      continue;
    }
    std::string crs;
    if (const OGRSpatialReference* reference = layer->GetSpatialRef()) {
      char* wkt = nullptr;
      if (reference->exportToWkt(&wkt) == OGRERR_NONE && wkt) crs = crsFromText(wkt);
      CPLFree(wkt);
    }
    if (source.footprints.empty()) {
      source.crs = crs;
    } else if (source.crs != crs) {
      diagnostics.error(file, std::string("layer ") + layer->GetName(),
                        "its CRS differs from that of the layers before; left out. Give it as a file of its own");
      continue;
    }

    layer->ResetReading();
    while (const std::unique_ptr<OGRFeature> feature{layer->GetNextFeature()}) {
      if (columns.building) {
        const int i = static_cast<int>(*columns.building);
        const std::string value = feature->IsFieldSetAndNotNull(i) ? feature->GetFieldAsString(i) : "";
        if (value.empty() || value == "no") {
          ++notBuildings;
          continue;
        }
      }
      Footprint f;
      f.id = (severalLayers ? std::string(layer->GetName()) + " " : std::string()) + "feature " +
             std::to_string(feature->GetFID());
      const OGRGeometry* geometry = feature->GetGeometryRef();
      std::vector<Polygon> polygons;
      const bool all = !geometry || readPolygons(*geometry, polygons);
      for (Polygon& polygon : polygons) f.parts.emplace_back().polygon = std::move(polygon);
      if (!all && f.parts.empty()) {
        ++otherGeometry[geometry->getGeometryName()];
        continue;
      }
      f.ground = firstFinite(*feature, columns.ground);
      // On a slope: half way between its downhill and its uphill side.
      if (const double uphill = firstFinite(*feature, columns.uphill); uphill > f.ground)
        f.ground = (f.ground + uphill) / 2;
      f.height = heightOf(*feature, columns, f.ground);
      for (size_t c = 0; c < columns.names.size(); ++c)
        if (const int i = static_cast<int>(c); feature->IsFieldSetAndNotNull(i))
          f.attributes.emplace_back(columns.names[c], feature->GetFieldAsString(i));
      source.footprints.push_back(std::move(f));
    }
    if (const std::string failure = messages.take(); !failure.empty())
      diagnostics.error(file, std::string("layer ") + layer->GetName(), failure);
  }
  if (!layerFound) {
    std::string all;
    for (OGRLayer* layer : dataset.GetLayers()) all += (all.empty() ? "" : ", ") + std::string(layer->GetName());
    diagnostics.error(file, "", "there is no layer " + wanted.layer + "; the layers are " + all);
  }
  for (const auto& [name, count] : otherGeometry)
    diagnostics.leftOut.push_back({"features", count, "a " + name + " is no footprint"});
  if (notBuildings > 0) diagnostics.leftOut.push_back({"polygons", notBuildings, "their column building has no value"});
  return source;
}

}  // namespace vicus::assets
