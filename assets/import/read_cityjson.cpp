// Based on: CityJSON specifications 1.0, 1.1 and 2.0 (cityjson.org/specs).
#include "assets/import/read_cityjson.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_map>

#include "assets/import/columns.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

using Json = nlohmann::json;

/// A member of an object; null where there is none.
const Json& member(const Json& object, const char* name) {
  static const Json kNull;
  if (!object.is_object()) return kNull;
  const auto found = object.find(name);
  return found == object.end() ? kNull : *found;
}

std::string textOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

/// What of an object is a building, and what is not in the city.
enum class Role { Building, Part, Terrain, LeftOut, Unknown };

Role roleOf(const std::string& type) {
  static const std::map<std::string, Role> kRoles = {{"Building", Role::Building},
                                                     {"BuildingPart", Role::Part},
                                                     {"BuildingInstallation", Role::Part},
                                                     {"OtherConstruction", Role::Building},
                                                     {"TINRelief", Role::Terrain}};
  static const std::set<std::string> kOthers = {"Bridge",
                                                "BridgePart",
                                                "BridgeInstallation",
                                                "BridgeConstructionElement",
                                                "BridgeConstructiveElement",
                                                "BridgeRoom",
                                                "BridgeFurniture",
                                                "BuildingConstructiveElement",
                                                "BuildingFurniture",
                                                "BuildingRoom",
                                                "BuildingStorey",
                                                "BuildingUnit",
                                                "CityFurniture",
                                                "CityObjectGroup",
                                                "GenericCityObject",
                                                "LandUse",
                                                "PlantCover",
                                                "Railway",
                                                "Road",
                                                "SolitaryVegetationObject",
                                                "TransportSquare",
                                                "TransportationSquare",
                                                "Tunnel",
                                                "TunnelPart",
                                                "TunnelInstallation",
                                                "TunnelConstructiveElement",
                                                "TunnelHollowSpace",
                                                "TunnelFurniture",
                                                "WaterBody",
                                                "Waterway"};
  const auto found = kRoles.find(type);
  if (found != kRoles.end()) return found->second;
  return kOthers.contains(type) ? Role::LeftOut : Role::Unknown;
}

SurfaceKind kindOfSemantics(const std::string& type) {
  static const std::map<std::string, SurfaceKind> kKinds = {{"WallSurface", SurfaceKind::Wall},
                                                            {"RoofSurface", SurfaceKind::Roof},
                                                            {"GroundSurface", SurfaceKind::Ground},
                                                            {"Window", SurfaceKind::Window},
                                                            {"Door", SurfaceKind::Door},
                                                            {"ClosureSurface", SurfaceKind::Other},
                                                            {"OuterCeilingSurface", SurfaceKind::Other},
                                                            {"OuterFloorSurface", SurfaceKind::Other},
                                                            {"InteriorWallSurface", SurfaceKind::Other},
                                                            {"CeilingSurface", SurfaceKind::Other},
                                                            {"FloorSurface", SurfaceKind::Other}};
  const auto found = kKinds.find(type);
  return found == kKinds.end() ? SurfaceKind::Unknown : found->second;
}

/// Scalars of nested attributes, "roof.type.value".
void flatten(const Json& value, const std::string& name, int depth, city::Attributes& out) {
  constexpr int kDeepest = 8;
  if (value.is_object() && depth < kDeepest) {
    for (const auto& [key, inner] : value.items())
      flatten(inner, name.empty() ? key : name + "." + key, depth + 1, out);
  } else if (value.is_array() && depth < kDeepest) {
    for (size_t i = 0; i < value.size(); ++i)
      flatten(value[i], value.size() == 1 ? name : name + "." + std::to_string(i), depth + 1, out);
  } else if (value.is_string()) {
    out.emplace_back(name, value.get<std::string>());
  } else if (value.is_primitive() && !value.is_null()) {
    out.emplace_back(name, value.dump());
  }
}

/// First number among attributes with one of the usual names; an object's "value" counts as the attribute.
double firstNumberNamed(const city::Attributes& attributes, std::span<const std::string_view> names,
                        double above = -INFINITY) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : attributes)
    keys.push_back(key.ends_with(".value") ? key.substr(0, key.size() - 6) : key);
  for (const size_t i : columnsNamed(keys, names))
    if (const double v = numberIn(attributes[i].second); v > above) return v;
  return kUnknown;
}

double heightIn(const city::Attributes& attributes, const std::string& column) {
  if (!column.empty()) {
    const std::string_view name[] = {column};
    for (const auto& [key, value] : attributes)
      if (key == name[0] || key == column + ".value") return numberIn(value);
  }
  const double height = firstNumberNamed(attributes, heightNames(), 0);
  if (height > 0) return height;
  const double storeys = firstNumberNamed(attributes, storeyNames(), 0);
  static constexpr std::string_view kStorey[] = {"floorheight", "storeyheight"};
  const double storey = firstNumberNamed(attributes, kStorey, 0);
  return storeys * (storey > 0 ? storey : kStoreyHeight);
}

/// One object's geometry at one level of detail.
struct Geometry {
  double lod = 0;
  std::vector<Surface> surfaces;  ///< indices into the file's vertices
  bool footprint() const { return lod < 1; }
};

class Reader {
 public:
  Reader(const Json& root, const std::string& file, const std::string& heightColumn, city::Diagnostics& diagnostics)
      : root_(root), file_(file), heightColumn_(heightColumn), diagnostics_(diagnostics) {}

  Source read();

 private:
  bool readVertices();
  std::string readCrs() const;
  /// The root of the family that an object belongs to.
  std::string ancestorOf(const std::string& id) const;
  std::vector<Geometry> geometriesOf(const std::string& id, const Json& object);
  std::optional<Geometry> readGeometry(const std::string& id, const Json& geometry);
  void readSurfaces(const std::string& id, const Json& boundaries, const Json& values, int depth, uint32_t& shell,
                    const std::vector<SurfaceKind>& kinds, std::vector<Surface>& out);
  std::optional<Surface> readSurface(const std::string& id, const Json& rings);
  void addFamily(const std::string& id, const std::vector<std::string>& members, Source& source);
  void addTerrain(const std::string& id, const Json& object, Tin& tin);
  void complain(const std::string& id, const std::string& message);

  const Json& root_;
  const std::string& file_;
  const std::string& heightColumn_;
  city::Diagnostics& diagnostics_;
  std::vector<glm::dvec3> vertices_;
  std::map<std::string, std::string> parentOf_;
  std::set<std::string> complained_;
};

/// One message for each object is enough: the first.
void Reader::complain(const std::string& id, const std::string& message) {
  if (complained_.insert(id).second) diagnostics_.error(file_, id, message);
}

bool Reader::readVertices() {
  const Json& list = member(root_, "vertices");
  if (!list.is_array()) {
    diagnostics_.error(file_, "vertices", "there is no list of vertices");
    return false;
  }
  glm::dvec3 scale(1), translate(0);
  const Json& transform = member(root_, "transform");
  for (const auto& [name, target] : {std::pair("scale", &scale), std::pair("translate", &translate)}) {
    const Json& values = member(transform, name);
    if (values.is_null()) continue;
    bool good = values.is_array() && values.size() == 3;
    for (int k = 0; good && k < 3; ++k) {
      good = values[static_cast<size_t>(k)].is_number();
      if (good) (*target)[k] = values[static_cast<size_t>(k)].get<double>();
    }
    if (!good) {
      diagnostics_.error(file_, std::string("transform ") + name, "is not three numbers");
      return false;
    }
  }
  size_t bad = 0, firstBad = 0;
  vertices_.reserve(list.size());
  for (size_t i = 0; i < list.size(); ++i) {
    const Json& v = list[i];
    glm::dvec3 p(kUnknown);
    if (v.is_array() && v.size() >= 3 && v[0].is_number() && v[1].is_number() && v[2].is_number())
      p = glm::dvec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>()) * scale + translate;
    if (!std::isfinite(p.x + p.y + p.z)) {
      p = glm::dvec3(kUnknown);
      if (bad++ == 0) firstBad = i;
    }
    vertices_.push_back(p);
  }
  if (bad > 0)
    diagnostics_.error(file_, "vertex " + std::to_string(firstBad),
                       "is not three numbers" + (bad > 1 ? ", nor are " + std::to_string(bad - 1) + " more" : ""));
  return true;
}

std::string Reader::readCrs() const {
  const Json& metadata = member(root_, "metadata");
  std::string name = textOf(member(metadata, "referenceSystem"));
  if (const Json& epsg = member(member(metadata, "crs"), "epsg"); name.empty() && epsg.is_number_integer())
    name = "EPSG:" + std::to_string(epsg.get<int64_t>());
  if (name.empty()) return {};
  const std::string crs = crsFromText(name);
  if (crs.empty()) diagnostics_.error(file_, "metadata", "the CRS " + name + " is not known; give one with --crs");
  return crs;
}

std::string Reader::ancestorOf(const std::string& id) const {
  std::string at = id;
  for (int steps = 0; steps < 16; ++steps) {
    const auto found = parentOf_.find(at);
    if (found == parentOf_.end() || found->second == id) return at;
    at = found->second;
  }
  return id;
}

std::optional<Surface> Reader::readSurface(const std::string& id, const Json& rings) {
  if (!rings.is_array()) {
    complain(id, "a surface is not a list of rings");
    return std::nullopt;
  }
  Surface surface;
  for (const Json& ring : rings) {
    if (!ring.is_array()) {
      complain(id, "a ring is not a list of vertices");
      return std::nullopt;
    }
    std::vector<uint32_t>& out = surface.rings.emplace_back();
    for (const Json& index : ring) {
      const int64_t i = index.is_number_integer() ? index.get<int64_t>() : -1;
      if (i < 0 || i >= static_cast<int64_t>(vertices_.size())) {
        complain(id, "vertex index " + index.dump() + " is out of range (0 to " +
                         std::to_string(static_cast<int64_t>(vertices_.size()) - 1) +
                         "); surfaces with it are left out");
        return std::nullopt;
      }
      if (std::isnan(vertices_[static_cast<size_t>(i)].x)) {
        complain(id, "vertex " + std::to_string(i) + " is not three numbers; surfaces with it are left out");
        return std::nullopt;
      }
      out.push_back(static_cast<uint32_t>(i));
    }
  }
  if (surface.rings.empty() || surface.rings[0].size() < 3) {
    complain(id, "a surface has fewer than three vertices");
    return std::nullopt;
  }
  return surface;
}

/// `depth` 0: boundaries are surfaces; 1: shells of a solid, of which the first bounds it; 2: solids.
void Reader::readSurfaces(const std::string& id, const Json& boundaries, const Json& values, int depth, uint32_t& shell,
                          const std::vector<SurfaceKind>& kinds, std::vector<Surface>& out) {
  if (!boundaries.is_array()) {
    complain(id, "its boundaries are nested less deeply than its type says");
    return;
  }
  const auto valueAt = [&](size_t i) -> const Json& {
    static const Json kNull;
    return values.is_array() && i < values.size() ? values[i] : kNull;
  };
  if (depth > 0) {
    const size_t count = depth == 1 ? std::min<size_t>(boundaries.size(), 1) : boundaries.size();
    for (size_t i = 0; i < count; ++i) readSurfaces(id, boundaries[i], valueAt(i), depth - 1, shell, kinds, out);
    return;
  }
  for (size_t i = 0; i < boundaries.size(); ++i) {
    std::optional<Surface> surface = readSurface(id, boundaries[i]);
    if (!surface) continue;
    const Json& value = valueAt(i);
    if (value.is_number_unsigned() && value.get<uint64_t>() < kinds.size())
      surface->kind = kinds[value.get<uint64_t>()];
    surface->shell = shell;
    out.push_back(std::move(*surface));
  }
  ++shell;
}

std::optional<Geometry> Reader::readGeometry(const std::string& id, const Json& geometry) {
  const std::string type = textOf(member(geometry, "type"));
  static const std::map<std::string, int> kDepths = {
      {"MultiSurface", 0}, {"CompositeSurface", 0}, {"Solid", 1}, {"MultiSolid", 2}, {"CompositeSolid", 2}};
  const auto depth = kDepths.find(type);
  if (depth == kDepths.end()) {
    const bool known = type == "MultiPoint" || type == "MultiLineString" || type == "GeometryInstance";
    if (!known) complain(id, "the geometry type " + (type.empty() ? "is missing" : type + " is not known"));
    return std::nullopt;
  }
  Geometry out;
  const Json& lod = member(geometry, "lod");
  out.lod = lod.is_number() ? lod.get<double>() : lod.is_string() ? numberIn(lod.get<std::string>()) : 1;
  if (!std::isfinite(out.lod)) out.lod = 1;
  std::vector<SurfaceKind> kinds;
  const Json& semantics = member(geometry, "semantics");
  if (const Json& list = member(semantics, "surfaces"); list.is_array())
    for (const Json& s : list) kinds.push_back(kindOfSemantics(textOf(member(s, "type"))));
  uint32_t shell = 0;
  readSurfaces(id, member(geometry, "boundaries"), member(semantics, "values"), depth->second, shell, kinds,
               out.surfaces);
  return out;
}

/// All that can be used, the highest level of detail first.
std::vector<Geometry> Reader::geometriesOf(const std::string& id, const Json& object) {
  std::vector<Geometry> out;
  const Json& list = member(object, "geometry");
  if (!list.is_array()) return out;
  for (const Json& g : list)
    if (auto geometry = readGeometry(id, g); geometry && !geometry->surfaces.empty())
      out.push_back(std::move(*geometry));
  std::stable_sort(out.begin(), out.end(), [](const Geometry& a, const Geometry& b) { return a.lod > b.lod; });
  return out;
}

void Reader::addFamily(const std::string& id, const std::vector<std::string>& members, Source& source) {
  const Json& objects = member(root_, "CityObjects");
  city::Attributes attributes;
  SurfaceBuilding building;
  Footprint footprint;
  std::unordered_map<uint32_t, uint32_t> localIndex;
  uint32_t shells = 0;
  double lowest = kUnknown, partHeight = kUnknown;
  for (const std::string& m : members) {
    const Json& object = objects.at(m);
    if (m == id) {
      flatten(member(object, "attributes"), "", 0, attributes);
    } else {
      city::Attributes own;
      flatten(member(object, "attributes"), "", 0, own);
      const double h = heightIn(own, heightColumn_);
      if (h > 0 && !(partHeight >= h)) partHeight = h;
    }
    const std::vector<Geometry> geometries = geometriesOf(m, object);
    if (geometries.empty()) continue;
    const Geometry& best = geometries.front();
    if (best.footprint()) {
      for (const Surface& s : best.surfaces) {
        Polygon& polygon = footprint.parts.emplace_back();
        for (const auto& ring : s.rings) {
          Ring& out = polygon.rings.emplace_back();
          for (const uint32_t i : ring) {
            out.emplace_back(vertices_[i]);
            lowest = std::isnan(lowest) ? vertices_[i].z : std::min(lowest, vertices_[i].z);
          }
        }
      }
      continue;
    }
    uint32_t used = 0;
    for (Surface s : best.surfaces) {
      used = std::max(used, s.shell + 1);
      s.shell += shells;
      for (auto& ring : s.rings)
        for (uint32_t& i : ring) {
          const auto [found, isNew] = localIndex.emplace(i, static_cast<uint32_t>(building.points.size()));
          if (isNew) building.points.push_back(vertices_[i]);
          i = found->second;
        }
      building.surfaces.push_back(std::move(s));
    }
    shells += used;
  }
  if (!building.surfaces.empty()) {
    building.id = id;
    building.ground = firstNumberNamed(attributes, groundNames());
    building.attributes = std::move(attributes);
    source.buildings.push_back(std::move(building));
  } else if (!footprint.parts.empty()) {
    footprint.id = id;
    footprint.height = heightIn(attributes, heightColumn_);
    if (!(footprint.height > 0)) footprint.height = partHeight;
    footprint.ground = lowest;
    footprint.attributes = std::move(attributes);
    source.footprints.push_back(std::move(footprint));
  } else {
    diagnostics_.leftOut.push_back({"building " + id, 1, "it has no geometry that can be used"});
    if (!complained_.contains(id)) diagnostics_.warn(file_, id, "left out: it has no geometry that can be used");
  }
}

void Reader::addTerrain(const std::string& id, const Json& object, Tin& tin) {
  const std::vector<Geometry> geometries = geometriesOf(id, object);
  if (geometries.empty()) {
    complain(id, "the terrain has no triangles");
    return;
  }
  std::unordered_map<uint32_t, uint32_t> index;
  const auto point = [&](uint32_t i) {
    const auto [found, isNew] = index.emplace(i, static_cast<uint32_t>(tin.points.size()));
    if (isNew) tin.points.push_back(vertices_[i]);
    return found->second;
  };
  for (const Surface& s : geometries.front().surfaces) {
    const std::vector<uint32_t>& ring = s.rings[0];
    for (size_t k = 2; k < ring.size(); ++k)
      tin.triangles.emplace_back(point(ring[0]), point(ring[k - 1]), point(ring[k]));
  }
}

Source Reader::read() {
  Source source;
  source.file = file_;
  source.metric = true;
  const std::string version = textOf(member(root_, "version"));
  if (!(version.starts_with("1.") || version.starts_with("2.")))
    diagnostics_.warn(
        file_, "version",
        (version.empty() ? std::string("none is stated") : version + " is older or newer than 1.0 to 2.0") +
            "; read as far as it agrees with these");
  const Json& objects = member(root_, "CityObjects");
  if (!objects.is_object()) {
    diagnostics_.error(file_, "CityObjects", "there are no city objects");
    return source;
  }
  if (!readVertices()) return source;
  source.crs = readCrs();

  // Who belongs to whom, by what the children say or else the parents.
  for (const auto& [id, object] : objects.items()) {
    const Json& parents = member(object, "parents");
    if (parents.is_array() && !parents.empty() && parents[0].is_string()) {
      const std::string parent = parents[0].get<std::string>();
      if (objects.contains(parent))
        parentOf_[id] = parent;
      else
        diagnostics_.warn(file_, id, "its parent " + parent + " is missing; taken as a building of its own");
    }
    if (const Json& children = member(object, "children"); children.is_array())
      for (const Json& child : children)
        if (child.is_string() && objects.contains(child.get<std::string>()))
          parentOf_.emplace(child.get<std::string>(), id);
  }
  std::map<std::string, std::vector<std::string>> families;
  std::map<std::string, uint64_t> leftOut, unknown;
  for (const auto& [id, object] : objects.items()) {
    const std::string type = textOf(member(object, "type"));
    switch (roleOf(type)) {
      case Role::Unknown:
        if (type.empty()) {
          complain(id, "it has no type");
          break;
        }
        if (member(object, "geometry").empty()) break;
        ++unknown[type];
        families[ancestorOf(id)].push_back(id);
        break;
      case Role::Building:
      case Role::Part:
        families[ancestorOf(id)].push_back(id);
        break;
      case Role::Terrain:
        addTerrain(id, object, source.tin);
        break;
      case Role::LeftOut:
        ++leftOut[type];
        break;
    }
  }
  for (const auto& [id, members] : families) addFamily(id, members, source);
  for (const auto& [type, count] : unknown)
    diagnostics_.warn(file_, "",
                      std::to_string(count) + " objects of the type " + type +
                          ", which the standard does not know, taken as buildings");
  for (const auto& [type, count] : leftOut)
    diagnostics_.leftOut.push_back({type, count, "objects of this type are not shown"});
  return source;
}

/// "line 3, column 17" of a byte.
std::string lineAndColumn(std::string_view text, size_t byte) {
  byte = std::min(byte, text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n') + 1;
  const size_t start = byte == 0 ? std::string_view::npos : text.rfind('\n', byte - 1);
  const size_t column = byte - (start == std::string_view::npos ? 0 : start + 1);
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

}  // namespace

bool isCityJson(std::string_view text) {
  // The member may stand anywhere at the top level, and before or after megabytes of others.
  for (size_t at = text.find("\"CityJSON\""); at != std::string_view::npos; at = text.find("\"CityJSON\"", at + 1)) {
    size_t before = at;
    const auto skipSpace = [&] {
      while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\t' || text[before - 1] == '\n' ||
                            text[before - 1] == '\r'))
        --before;
    };
    skipSpace();
    if (before == 0 || text[before - 1] != ':') continue;
    --before;
    skipSpace();
    if (before >= 6 && text.substr(before - 6, 6) == "\"type\"") return true;
  }
  return false;
}

Source readCityJson(std::string_view text, const std::string& file, const std::string& heightColumn,
                    city::Diagnostics& diagnostics) {
  Source source;
  source.file = file;
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::parse_error& e) {
    std::string what = e.what();
    if (const size_t at = what.find("; last read"); at != std::string::npos) what = what.substr(0, at);
    if (const size_t at = what.rfind(": "); at != std::string::npos) what = what.substr(at + 2);
    diagnostics.error(file, lineAndColumn(text, e.byte), "this is not JSON: " + what);
    return source;
  }
  if (textOf(member(root, "type")) != "CityJSON") {
    diagnostics.error(file, "type", "this is not CityJSON");
    return source;
  }
  return Reader(root, file, heightColumn, diagnostics).read();
}

}  // namespace vicus::assets
