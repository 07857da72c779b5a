// Based on: wiki.openstreetmap.org, "Simple 3D Buildings" (what outlines, parts, heights and roof tags mean) and
// "Map features".
#include "assets/import/read_osm.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>

#include "assets/import/assembly.hpp"
#include "assets/import/columns.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/read_footprints.hpp"

namespace vicus::assets {
namespace {

using facade::RoofKind;

constexpr double kDegreesPerMetre = 1 / 111320.0;

/// The tags of one feature. Fields of the driver first, then those that it packs into `other_tags`.
class Tags {
 public:
  explicit Tags(const OGRFeature& feature) {
    for (int i = 0; i < feature.GetFieldCount(); ++i) {
      if (!feature.IsFieldSetAndNotNull(i)) continue;
      const std::string name = feature.GetFieldDefnRef(i)->GetNameRef();
      if (name == "other_tags")
        unpack(feature.GetFieldAsString(i));
      else
        tags_.emplace(name, feature.GetFieldAsString(i));
    }
  }
  std::string operator[](const char* key) const {
    const auto found = tags_.find(key);
    return found == tags_.end() ? std::string() : found->second;
  }
  bool is(const char* key, std::initializer_list<std::string_view> values) const {
    const std::string value = (*this)[key];
    return std::find(values.begin(), values.end(), value) != values.end();
  }
  /// Has the key a value other than "no"?
  bool has(const char* key) const {
    const std::string value = (*this)[key];
    return !value.empty() && value != "no";
  }
  /// Metres: "12", "12.5 m", "40'" or "40 ft".
  double metres(const char* key) const {
    const std::string value = (*this)[key];
    const double number = numberIn(value);
    const bool feet = value.find('\'') != std::string::npos || value.find("ft") != std::string::npos;
    return feet ? number * 0.3048 : number;
  }
  double number(const char* key) const { return numberIn((*this)[key]); }
  city::Attributes attributes() const { return {tags_.begin(), tags_.end()}; }

 private:
  /// "key"=>"value","key"=>"value", with \ before quotes and itself.
  void unpack(std::string_view text) {
    size_t at = 0;
    const auto quoted = [&](std::string& out) {
      if (at >= text.size() || text[at] != '"') return false;
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\' && at + 1 < text.size()) ++at;
        out.push_back(text[at]);
      }
      return at++ < text.size();
    };
    while (at < text.size()) {
      std::string key, value;
      if (!quoted(key) || text.substr(at, 2) != "=>") return;
      at += 2;
      if (!quoted(value)) return;
      tags_.emplace(std::move(key), std::move(value));
      if (at < text.size() && text[at] == ',') ++at;
    }
  }
  std::map<std::string, std::string> tags_;
};

std::optional<RoofKind> roofOf(const std::string& shape) {
  static const std::map<std::string, RoofKind> kForms = {
      {"flat", RoofKind::Flat},           {"gabled", RoofKind::Gable},    {"gambrel", RoofKind::Gambrel},
      {"saltbox", RoofKind::Gable},       {"round", RoofKind::Gambrel},   {"hipped", RoofKind::Hip},
      {"half-hipped", RoofKind::HalfHip}, {"mansard", RoofKind::Mansard}, {"pyramidal", RoofKind::Pyramid},
      {"dome", RoofKind::Dome},           {"onion", RoofKind::Dome},      {"cone", RoofKind::Pyramid},
      {"skillion", RoofKind::Shed},       {"lean_to", RoofKind::Shed},    {"monopitched", RoofKind::Shed}};
  const auto found = kForms.find(shape);
  return found == kForms.end() ? std::nullopt : std::optional(found->second);
}

/// What stands in for a roof shape that is not built as such; empty where none does.
std::string simplified(const std::string& shape) {
  static const std::map<std::string, const char*> kInstead = {
      {"saltbox", "gables"}, {"round", "gambrels"}, {"onion", "domes"}};
  if (const auto found = kInstead.find(shape); found != kInstead.end()) return found->second;
  return !shape.empty() && !roofOf(shape) ? "what suits the outline" : "";
}

FootprintPart partOf(Polygon polygon, const Tags& tags) {
  FootprintPart part;
  part.polygon = std::move(polygon);
  part.roof = roofOf(tags["roof:shape"]);
  part.top = tags.metres("height");
  if (!(part.top > 0)) part.top = tags.metres("building:height");
  part.bottom = tags.metres("min_height");
  if (!(part.bottom > 0)) part.bottom = tags.number("building:min_level") * kStoreyHeight;
  if (!(part.bottom > 0)) part.bottom = 0;
  part.roofHeight = tags.metres("roof:height");
  if (const double levels = tags.number("roof:levels"); !(part.roofHeight > 0) && levels > 0)
    part.roofHeight = levels * kStoreyHeight;
  if (part.roof == RoofKind::Flat) part.roofHeight = kUnknown;
  if (!(part.top > 0)) {
    double levels = tags.number("building:levels");
    if (!(levels > 0)) levels = tags.number("levels");
    if (levels > 0) part.height = levels * kStoreyHeight;
  } else if (part.roof == RoofKind::Flat) {
    part.height = part.top;
  }
  return part;
}

struct StreetUse {
  city::StreetKind kind;
  double width;  ///< metres
};

std::optional<StreetUse> streetOf(const std::string& highway) {
  using city::StreetKind;
  static const std::map<std::string, StreetUse> kUses = {{"motorway", {StreetKind::Road, 12}},
                                                         {"trunk", {StreetKind::Road, 10}},
                                                         {"primary", {StreetKind::Road, 9}},
                                                         {"secondary", {StreetKind::Road, 8}},
                                                         {"tertiary", {StreetKind::HighStreet, 7}},
                                                         {"residential", {StreetKind::Street, 6}},
                                                         {"unclassified", {StreetKind::Street, 6}},
                                                         {"living_street", {StreetKind::Street, 5}},
                                                         {"pedestrian", {StreetKind::HighStreet, 6}},
                                                         {"service", {StreetKind::Street, 4}},
                                                         {"track", {StreetKind::Lane, 3}},
                                                         {"footway", {StreetKind::Lane, 2}},
                                                         {"path", {StreetKind::Lane, 1.5}},
                                                         {"steps", {StreetKind::Lane, 2}},
                                                         {"cycleway", {StreetKind::Lane, 2.5}},
                                                         {"bridleway", {StreetKind::Lane, 2}}};
  std::string plain = highway;
  if (plain.ends_with("_link")) plain.resize(plain.size() - 5);
  const auto found = kUses.find(plain);
  if (found == kUses.end()) return std::nullopt;
  return found->second;
}

std::optional<city::Ground> coverOf(const Tags& tags) {
  using city::Ground;
  if (tags.is("leisure", {"park", "garden", "dog_park"}) || tags.is("landuse", {"allotments", "orchard", "vineyard"}))
    return Ground::Garden;
  if (tags.is("leisure", {"pitch", "golf_course", "common"}) ||
      tags.is("landuse", {"grass", "forest", "meadow", "village_green", "recreation_ground", "cemetery"}) ||
      tags.is("natural", {"wood", "scrub", "grassland", "heath"}))
    return Ground::Grass;
  if (tags.is("landuse", {"farmland", "farmyard"})) return Ground::Field;
  if (tags.is("natural", {"sand", "beach", "bare_rock", "scree", "shingle"}) ||
      tags.is("landuse", {"construction", "brownfield", "quarry"}))
    return Ground::Earth;
  if (tags.is("place", {"square"}) || tags.has("highway") || tags.is("amenity", {"parking", "marketplace"}) ||
      tags.is("man_made", {"pier", "breakwater", "quay"}))
    return Ground::Paving;
  return std::nullopt;
}

bool isWater(const Tags& tags) {
  return tags.is("natural", {"water", "bay"}) || tags.is("waterway", {"riverbank", "dock", "river", "canal"}) ||
         tags.is("landuse", {"reservoir", "basin"}) || tags.is("leisure", {"swimming_pool"}) ||
         tags.is("amenity", {"fountain"});
}

std::vector<glm::dvec2> lineOf(const OGRLineString& line) {
  std::vector<glm::dvec2> out;
  for (int i = 0; i < line.getNumPoints(); ++i) out.emplace_back(line.getX(i), line.getY(i));
  return out;
}

/// Parts of a geometry that are lines.
std::vector<std::vector<glm::dvec2>> linesOf(const OGRGeometry& geometry) {
  std::vector<std::vector<glm::dvec2>> out;
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type == wkbLineString) {
    out.push_back(lineOf(*geometry.toLineString()));
  } else if (type == wkbMultiLineString) {
    for (const OGRLineString* line : *geometry.toMultiLineString()) out.push_back(lineOf(*line));
  }
  return out;
}

class OsmReader {
 public:
  explicit OsmReader(Source& source) : around_(source.surroundings), source_(source) {}

  void add(const OGRFeature& feature, const std::string& layer);
  /// Puts parts into the outlines that they lie in, and hands over all buildings.
  void finish();
  void report(const std::string& file, city::Diagnostics& diagnostics) const;

 private:
  struct Building {
    Footprint footprint;
    std::vector<Footprint> parts;
  };
  void addArea(const Tags& tags, const std::string& id, std::vector<Polygon> polygons);
  void addLine(const Tags& tags, const std::string& id, std::vector<glm::dvec2> points);

  Surroundings& around_;
  Source& source_;
  std::vector<Building> buildings_;
  std::vector<Footprint> parts_;
  std::map<std::string, uint64_t> leftOut_;
  std::map<std::pair<std::string, std::string>, uint64_t> simplified_;  ///< roof shapes and what stands in for them
};

Footprint footprintOf(const Tags& tags, const std::string& id, std::vector<Polygon> polygons) {
  Footprint f;
  f.id = id;
  for (Polygon& p : polygons) f.parts.push_back(partOf(std::move(p), tags));
  f.attributes = tags.attributes();
  return f;
}

void OsmReader::addArea(const Tags& tags, const std::string& id, std::vector<Polygon> polygons) {
  if (tags.has("building:part") || tags.has("building")) {
    const std::string shape = tags["roof:shape"];
    if (const std::string instead = simplified(shape); !instead.empty()) ++simplified_[{shape.substr(0, 40), instead}];
  }
  if (tags.has("building:part")) {
    parts_.push_back(footprintOf(tags, id, std::move(polygons)));
  } else if (tags.has("building")) {
    if (tags.is("location", {"underground"}))
      ++leftOut_["buildings under the ground"];
    else
      buildings_.push_back({footprintOf(tags, id, std::move(polygons)), {}});
  } else if (isWater(tags)) {
    around_.water.push_back({tags["name"], std::move(polygons)});
  } else if (const auto cover = coverOf(tags)) {
    around_.cover.push_back({*cover, std::move(polygons)});
  } else {
    ++leftOut_["other areas"];
  }
}

void OsmReader::addLine(const Tags& tags, const std::string& id, std::vector<glm::dvec2> points) {
  const bool closed = points.size() > 3 && points.front() == points.back();
  if (closed && (tags.has("building:part") || tags.has("building"))) return addArea(tags, id, {{{points}}});
  if (tags.is("natural", {"coastline"})) {
    around_.coast.push_back(std::move(points));
  } else if (const auto street = streetOf(tags["highway"])) {
    if (tags.has("tunnel") || tags.is("location", {"underground"})) {
      ++leftOut_["streets in tunnels"];
      return;
    }
    const double width = tags.metres("width");
    around_.streets.push_back({tags["name"], tags.has("bridge") ? city::StreetKind::Bridge : street->kind,
                               width > 0.5 && width < 100 ? width : street->width, std::move(points)});
  } else if (tags.is("barrier", {"wall", "city_wall", "retaining_wall"})) {
    const bool cityWall = tags.is("barrier", {"city_wall"});
    WallLine wall;
    wall.id = id;
    wall.height = tags.metres("height"), wall.thickness = tags.metres("width");
    if (!(wall.height > 0.1 && wall.height < 100)) wall.height = cityWall ? 7 : 2;
    if (!(wall.thickness > 0.05 && wall.thickness < 30)) wall.thickness = cityWall ? 1.8 : 0.4;
    wall.points = std::move(points);
    around_.walls.push_back(std::move(wall));
  } else if (tags.is("natural", {"tree_row"})) {
    constexpr double kApart = 8 * kDegreesPerMetre;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const double length = glm::length(points[i + 1] - points[i]);
      const int count = std::clamp(static_cast<int>(length / kApart), 1, 1000);
      for (int k = 0; k < count; ++k)
        around_.trees.push_back({glm::mix(points[i], points[i + 1], (k + 0.5) / count), tags.metres("height"), false});
    }
  } else if (tags.has("waterway")) {
    ++leftOut_["water courses without banks"];
  } else if (tags.has("highway")) {
    ++leftOut_["streets of unknown kinds"];
  } else {
    ++leftOut_["other lines"];
  }
}

void OsmReader::add(const OGRFeature& feature, const std::string& layer) {
  const OGRGeometry* geometry = feature.GetGeometryRef();
  if (!geometry) return;
  const Tags tags(feature);
  if (layer == "points") {
    if (!tags.is("natural", {"tree"})) return;
    const OGRPoint& p = *geometry->toPoint();
    around_.trees.push_back({{p.getX(), p.getY()}, tags.metres("height"), tags.is("leaf_type", {"needleleaved"})});
    return;
  }
  const std::string number = tags["osm_id"].empty() ? tags["osm_way_id"] : tags["osm_id"];
  const std::string id = (layer == "lines" || tags["osm_id"].empty() ? "way " : "relation ") + number;
  if (layer == "multipolygons") {
    std::vector<Polygon> polygons;
    readPolygons(*geometry, polygons);
    if (!polygons.empty()) addArea(tags, id, std::move(polygons));
    return;
  }
  for (auto& line : linesOf(*geometry)) addLine(tags, id, std::move(line));
}

double areaOf(const Footprint& f) {
  double sum = 0;
  for (const FootprintPart& p : f.parts) sum += area(p.polygon);
  return sum;
}

void OsmReader::finish() {
  // Outlines in squares of about 100 m, by their boxes.
  constexpr double kSquare = 100 * kDegreesPerMetre;
  std::map<std::pair<int64_t, int64_t>, std::vector<size_t>> squares;
  const auto squareOf = [](double v) { return static_cast<int64_t>(std::floor(v / kSquare)); };
  for (size_t b = 0; b < buildings_.size() && !parts_.empty(); ++b)
    for (const FootprintPart& p : buildings_[b].footprint.parts) {
      if (p.polygon.rings.empty() || p.polygon.rings[0].empty()) continue;
      glm::dvec2 low(INFINITY), high(-INFINITY);
      for (const glm::dvec2& q : p.polygon.rings[0]) low = glm::min(low, q), high = glm::max(high, q);
      if (!(high.x - low.x < 0.1 && high.y - low.y < 0.1)) continue;  // ten kilometres: no building
      for (int64_t x = squareOf(low.x); x <= squareOf(high.x); ++x)
        for (int64_t y = squareOf(low.y); y <= squareOf(high.y); ++y) squares[{x, y}].push_back(b);
    }
  for (Footprint& part : parts_) {
    Building* home = nullptr;
    if (!part.parts.empty() && !part.parts[0].polygon.rings.empty() && !part.parts[0].polygon.rings[0].empty()) {
      const glm::dvec2 middle = centroid(part.parts[0].polygon);
      for (const size_t b : squares[{squareOf(middle.x), squareOf(middle.y)}]) {
        Building& building = buildings_[b];
        const bool inside =
            std::any_of(building.footprint.parts.begin(), building.footprint.parts.end(), [&](const FootprintPart& p) {
              return !p.polygon.rings.empty() && !p.polygon.rings[0].empty() && insideRing(p.polygon.rings[0], middle);
            });
        if (inside && (!home || areaOf(building.footprint) < areaOf(home->footprint))) home = &building;
      }
    }
    if (home)
      home->parts.push_back(std::move(part));
    else
      source_.footprints.push_back(std::move(part));
  }
  for (Building& b : buildings_) {
    double filled = 0;
    for (const Footprint& p : b.parts) filled += areaOf(p);
    if (filled >= 0.5 * areaOf(b.footprint) && filled > 0) b.footprint.parts.clear();
    for (Footprint& p : b.parts)
      for (FootprintPart& piece : p.parts) b.footprint.parts.push_back(std::move(piece));
    source_.footprints.push_back(std::move(b.footprint));
  }
}

void OsmReader::report(const std::string& file, city::Diagnostics& diagnostics) const {
  std::vector<std::string> shapes;
  for (const auto& [names, count] : simplified_)
    shapes.push_back(std::to_string(count) + " " + names.first + " as " + names.second);
  if (!shapes.empty()) diagnostics.warn(file, "roof:shape", "roofs that are simplified: " + list(shapes));
  for (const auto& [what, count] : leftOut_) diagnostics.leftOut.push_back({what, count, "not shown"});
}

}  // namespace

bool isOpenStreetMap(GDALDataset& dataset) {
  GDALDriver* driver = dataset.GetDriver();
  return driver && EQUAL(driver->GetDescription(), "OSM");
}

Source readOsm(GDALDataset& dataset, const std::string& file, GdalMessages& messages, city::Diagnostics& diagnostics) {
  Source source;
  source.file = file;
  source.crs = crsFromText("EPSG:4326");
  OsmReader reader(source);
  // The driver gives features of all layers in turn; asking for one layer at a time would keep the others in memory.
  OGRLayer* layer = nullptr;
  while (const std::unique_ptr<OGRFeature> feature{dataset.GetNextFeature(&layer, nullptr, nullptr, nullptr)})
    if (layer) reader.add(*feature, layer->GetName());
  if (const std::string failure = messages.take(); !failure.empty()) diagnostics.error(file, "", failure);
  reader.finish();
  reader.report(file, diagnostics);
  return source;
}

}  // namespace vicus::assets
