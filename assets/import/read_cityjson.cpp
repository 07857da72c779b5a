// Based on: CityJSON specifications 1.0, 1.1 and 2.0 and CityJSON text sequences (cityjson.org/specs).
#include "assets/import/read_cityjson.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <unordered_map>

#include "assets/import/cityjson_geometry.hpp"
#include "assets/import/cityjson_objects.hpp"
#include "assets/import/cityjson_text.hpp"
#include "assets/import/columns.hpp"
#include "assets/import/parallel.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

using cityjson::Geometry;
using cityjson::Json;
using cityjson::member;
using cityjson::parse;
using cityjson::Role;
using cityjson::shown;
using cityjson::textOf;

class Reader {
 public:
  Reader(const Json& root, const Json& header, const std::string& file, const CityJsonOptions& options,
         city::Diagnostics& diagnostics)
      : root_(root),
        header_(header),
        file_(file),
        options_(options),
        diagnostics_(diagnostics),
        shapes_(root, header, file,
                [this](const std::string& id, const std::string& message) { complain(id, message); }) {}

  Source read();

 private:
  void readCrs(Source& source) const;
  void findFamilies();
  /// The root of the family that an object belongs to.
  std::string ancestorOf(const std::string& id) const;
  std::vector<Geometry> geometriesOf(const std::string& id, const Json& object);
  void addFamily(const std::string& id, const std::vector<std::string>& members, Source& source);
  void addTerrain(const std::string& id, const Json& object, Tin& tin);
  void addArea(const std::string& id, const Json& object, Role role, Source& source);
  void addTree(const std::string& id, const Json& object, Source& source);
  void complain(const std::string& id, const std::string& message);

  const Json& root_;
  const Json& header_;
  const std::string& file_;
  const CityJsonOptions& options_;
  city::Diagnostics& diagnostics_;
  std::set<std::string> complained_;
  std::map<std::string, std::string> parentOf_;
  cityjson::GeometryReader shapes_;
};

/// One message for each object is enough: the first.
void Reader::complain(const std::string& id, const std::string& message) {
  if (complained_.insert(id).second) diagnostics_.error(file_, id, message);
}

void Reader::readCrs(Source& source) const {
  const Json& own = member(root_, "metadata");
  const Json& metadata = own.is_null() ? member(header_, "metadata") : own;
  std::string name = textOf(member(metadata, "referenceSystem"));
  if (const Json& epsg = member(member(metadata, "crs"), "epsg"); name.empty() && epsg.is_number_integer())
    name = "EPSG:" + std::to_string(epsg.get<int64_t>());
  if (name.empty()) return;
  source.crs = crsFromText(name);
  source.zUnit = heightUnitOf(name);
  if (source.crs.empty())
    diagnostics_.error(file_, "metadata", "the CRS " + name.substr(0, 80) + " is not known; give one with --crs");
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

/// All that can be used, the wanted level of detail first: the highest, or the highest that is no finer than what the
/// user asks for, then coarser ones, then finer ones.
std::vector<Geometry> Reader::geometriesOf(const std::string& id, const Json& object) {
  std::vector<Geometry> out;
  const Json& list = member(object, "geometry");
  if (!list.is_array()) return out;
  for (const Json& g : list)
    if (auto geometry = shapes_.read(id, g); geometry && !geometry->surfaces.empty())
      out.push_back(std::move(*geometry));
  const auto rank = [&](const Geometry& g) { return g.lod <= options_.lod + 1e-6 ? g.lod : -1 - g.lod; };
  std::stable_sort(out.begin(), out.end(), [&](const Geometry& a, const Geometry& b) { return rank(a) > rank(b); });
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
      cityjson::flatten(member(object, "attributes"), "", 0, attributes);
    } else {
      city::Attributes own;
      cityjson::flatten(member(object, "attributes"), "", 0, own);
      const double h = cityjson::heightIn(own, options_.heightColumn);
      if (h > 0 && !(partHeight >= h)) partHeight = h;
    }
    std::vector<Geometry> geometries = geometriesOf(m, object);
    std::erase_if(geometries, [](const Geometry& g) { return g.points; });
    if (geometries.empty()) continue;
    const std::vector<glm::dvec3>& vertices = shapes_.vertices();
    const Geometry& best = geometries.front();
    if (best.lod < 1) {
      for (const Surface& s : best.surfaces) {
        Polygon& polygon = footprint.parts.emplace_back().polygon;
        for (const auto& ring : s.rings) {
          Ring& out = polygon.rings.emplace_back();
          for (const uint32_t i : ring) {
            out.emplace_back(vertices[i]);
            lowest = std::isnan(lowest) ? vertices[i].z : std::min(lowest, vertices[i].z);
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
          if (isNew) building.points.push_back(vertices[i]);
          i = found->second;
        }
      building.surfaces.push_back(std::move(s));
    }
    shells += used;
  }
  if (!building.surfaces.empty()) {
    building.id = id;
    building.ground = cityjson::firstNumberNamed(attributes, groundNames());
    building.attributes = std::move(attributes);
    source.buildings.push_back(std::move(building));
  } else if (!footprint.parts.empty()) {
    footprint.id = id;
    footprint.height = cityjson::heightIn(attributes, options_.heightColumn);
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
  if (geometries.empty() || geometries.front().points) {
    complain(id, "the terrain has no triangles");
    return;
  }
  std::unordered_map<uint32_t, uint32_t> index;
  const auto point = [&](uint32_t i) {
    const auto [found, isNew] = index.emplace(i, static_cast<uint32_t>(tin.points.size()));
    if (isNew) tin.points.push_back(shapes_.vertices()[i]);
    return found->second;
  };
  for (const Surface& s : geometries.front().surfaces) {
    const std::vector<uint32_t>& ring = s.rings[0];
    for (size_t k = 2; k < ring.size(); ++k)
      tin.triangles.emplace_back(point(ring[0]), point(ring[k - 1]), point(ring[k]));
  }
}

/// Water, roads and plants: their surfaces on the plan.
void Reader::addArea(const std::string& id, const Json& object, Role role, Source& source) {
  std::vector<Polygon> parts;
  for (const Geometry& g : geometriesOf(id, object)) {
    if (g.points) continue;
    for (const Surface& s : g.surfaces) {
      Polygon& polygon = parts.emplace_back();
      for (const auto& ring : s.rings) {
        Ring& out = polygon.rings.emplace_back();
        for (const uint32_t i : ring) out.emplace_back(shapes_.vertices()[i]);
      }
    }
    break;
  }
  if (parts.empty()) return;
  if (role == Role::Water)
    source.surroundings.water.push_back({id, std::move(parts)});
  else
    source.surroundings.cover.push_back({cityjson::coverOf(textOf(member(object, "type"))), std::move(parts)});
}

/// A tree in the middle of its geometry, as high as that.
void Reader::addTree(const std::string& id, const Json& object, Source& source) {
  for (const Geometry& g : geometriesOf(id, object)) {
    city::Aabb box;
    for (const Surface& s : g.surfaces)
      for (const auto& ring : s.rings)
        for (const uint32_t i : ring) box.extend(shapes_.vertices()[i]);
    if (box.empty()) continue;
    const double height = box.size().z;
    source.surroundings.trees.push_back({glm::dvec2(box.centre()), height > 0.5 ? height : kUnknown, false});
    return;
  }
}

/// Who belongs to whom, by what the children say or else the parents.
void Reader::findFamilies() {
  const Json& objects = member(root_, "CityObjects");
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
}

Source Reader::read() {
  Source source;
  source.file = file_;
  source.metric = true;
  const Json& objects = member(root_, "CityObjects");
  if (!objects.is_object()) {
    diagnostics_.error(file_, "CityObjects", "there are no city objects");
    return source;
  }
  if (!shapes_.readVertices(diagnostics_)) return source;
  shapes_.readAppearance(diagnostics_);
  readCrs(source);
  findFamilies();

  std::map<std::string, std::vector<std::string>> families;
  std::map<std::string, uint64_t> leftOut, unknown;
  for (const auto& [id, object] : objects.items()) {
    const std::string type = textOf(member(object, "type"));
    const Role role = cityjson::roleOf(type);
    switch (role) {
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
      case Role::Water:
      case Role::Cover:
        addArea(id, object, role, source);
        break;
      case Role::Tree:
        addTree(id, object, source);
        break;
      case Role::LeftOut:
        ++leftOut[type];
        break;
    }
  }
  for (const auto& [id, members] : families) addFamily(id, members, source);
  source.materials = shapes_.materials();
  for (const auto& [type, count] : unknown)
    diagnostics_.warn(file_, "",
                      std::to_string(count) + " objects of the type " + type.substr(0, 40) +
                          ", which the standard does not know, taken as buildings");
  for (const auto& [type, count] : leftOut)
    diagnostics_.leftOut.push_back({type, count, "objects of this type are not shown"});
  return source;
}

void checkVersion(const Json& root, const std::string& file, city::Diagnostics& diagnostics) {
  const std::string version = textOf(member(root, "version"));
  if (!(version.starts_with("1.") || version.starts_with("2.")))
    diagnostics.warn(file, "version",
                     (version.empty() ? std::string("none is stated")
                                      : version.substr(0, 40) + " is older or newer than 1.0 to 2.0") +
                         "; read as far as it agrees with these");
}

/// Entries of what was left out that say the same, added up.
struct LeftOutSum {
  city::LeftOut entry;
  uint64_t count = 0;
};

/// A text sequence: a header, then one feature on each line.
Source readSequence(const Json& header, std::string_view rest, const std::string& file, const CityJsonOptions& options,
                    city::Diagnostics& diagnostics) {
  std::vector<std::pair<size_t, std::string_view>> lines;  // number and text
  size_t number = 1;
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    ++number;
    if (rest.substr(0, end).find_first_not_of(" \t\r\x1e") != std::string_view::npos)
      lines.emplace_back(number, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  std::vector<Source> parts(lines.size());
  std::vector<city::Diagnostics> said(lines.size());
  parallelFor(lines.size(), 8, [&](size_t i) {
    const auto& [line, text] = lines[i];
    const auto root = parse(text, file, line, said[i]);
    if (!root) return;
    if (textOf(member(*root, "type")) != "CityJSONFeature") {
      said[i].error(file, "line " + std::to_string(line), "this is no CityJSONFeature");
      return;
    }
    if (const std::string id = textOf(member(*root, "id")); !id.empty() && !member(*root, "CityObjects").contains(id))
      said[i].warn(file, "line " + std::to_string(line),
                   "the feature " + shown(member(*root, "id")) + " has no object of that name");
    parts[i] = Reader(*root, header, file, options, said[i]).read();
  });
  // Objects of the header's own, in older files.
  city::Diagnostics quiet;
  Source whole = Reader(header, header, file, options, lines.empty() ? diagnostics : quiet).read();
  std::map<std::string, LeftOutSum> leftOut;
  for (size_t i = 0; i < parts.size(); ++i) {
    for (city::Diagnostic& m : said[i].messages) {
      // What the header says is said once.
      const bool again =
          std::any_of(diagnostics.messages.begin(), diagnostics.messages.end(),
                      [&](const city::Diagnostic& d) { return d.place == m.place && d.message == m.message; });
      constexpr size_t kMost = 1000;
      if (!again && diagnostics.messages.size() < kMost) diagnostics.messages.push_back(std::move(m));
    }
    for (city::LeftOut& l : said[i].leftOut) {
      LeftOutSum& sum = leftOut[l.what + "\n" + l.why];
      sum.entry = l;
      sum.count += l.count;
    }
    cityjson::append(whole, std::move(parts[i]));
  }
  for (auto& [key, sum] : leftOut) {
    sum.entry.count = sum.count;
    diagnostics.leftOut.push_back(std::move(sum.entry));
  }
  return whole;
}

}  // namespace

Source readCityJson(std::string_view text, const std::string& file, const CityJsonOptions& options,
                    city::Diagnostics& diagnostics) {
  Source source;
  source.file = file;
  // The whole text, or else its first line with features after it.
  const size_t lineEnd = std::min(text.find('\n'), text.size());
  const bool sequence = text.find("\"CityJSONFeature\"", lineEnd) != std::string_view::npos;
  const auto root = parse(sequence ? text.substr(0, lineEnd) : text, file, 1, diagnostics);
  if (!root) return source;
  if (textOf(member(*root, "type")) != "CityJSON") {
    diagnostics.error(file, "type",
                      textOf(member(*root, "type")) == "CityJSONFeature"
                          ? "this is a feature without the line before it that says where it lies"
                          : "this is not CityJSON");
    return source;
  }
  checkVersion(*root, file, diagnostics);
  if (sequence) return readSequence(*root, text.substr(std::min(lineEnd + 1, text.size())), file, options, diagnostics);
  return Reader(*root, *root, file, options, diagnostics).read();
}

}  // namespace vicus::assets
