// Based on: OGC 12-019 (CityGML 2.0). libcitygml 2.4 reads; beside citygml_kinds the only file that
// knows it.
#include "assets/import/read_citygml.hpp"

#include <citygml/appearance.h>
#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>
#include <citygml/cityobject.h>
#include <citygml/geometry.h>
#include <citygml/implictgeometry.h>
#include <citygml/material.h>
#include <citygml/polygon.h>
#include <citygml/texture.h>
#include <citygml/texturecoordinates.h>
#include <citygml/texturetargetdefinition.h>
#include <cpl_minixml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <mutex>
#include <set>

#include "assets/import/citygml_kinds.hpp"
#include "assets/import/columns.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/pictures.hpp"
#include "assets/import/projection.hpp"
#include "city/aabb.hpp"

namespace vicus::assets {
namespace {

using citygml_kinds::coverOf;
using citygml_kinds::kindOf;
using citygml_kinds::Role;
using citygml_kinds::roleOf;

/// Keeps the library's first words instead of printing them.
class Logger : public citygml::CityGMLLogger {
 public:
  Logger() : CityGMLLogger(LOGLEVEL::LL_WARNING) {}
  void log(LOGLEVEL level, const std::string& message, const char*, int) const override {
    auto& list = level == LOGLEVEL::LL_ERROR ? errors : warnings;
    constexpr size_t kMost = 5;
    auto& count = level == LOGLEVEL::LL_ERROR ? errorCount : warningCount;
    if (++count <= kMost) list.push_back(message.substr(0, 300));
  }
  mutable std::vector<std::string> errors, warnings;
  mutable size_t errorCount = 0, warningCount = 0;
};

/// Surfaces of an object by level of detail, with the points that they use.
struct Levels {
  std::map<int, SurfaceBuilding> of;
};

class Reader {
 public:
  Reader(const std::string& file, const CityGmlOptions& options, const citygml::CityModel& model)
      : file_(file), options_(options) {
    const std::vector<std::string> all = model.themes();
    themes_ = all;
    source.file = file;
    source.metric = true;
  }

  void addRoot(const citygml::CityObject& object, city::Diagnostics& diagnostics);
  Source source;
  std::set<std::string> missingPictures;
  std::map<std::string, uint64_t> leftOut;

 private:
  using Place = std::function<glm::dvec3(glm::dvec3)>;
  void collect(const citygml::CityObject& object, SurfaceKind kind, int depth, Levels& levels);
  void addGeometry(const citygml::Geometry& geometry, SurfaceKind kind, int lod, const Place& place, int depth,
                   Levels& levels);
  void addPolygon(const citygml::Polygon& polygon, SurfaceKind kind, const Place& place, SurfaceBuilding& out);
  uint32_t materialOf(const citygml::Polygon& polygon, std::vector<TVec2f>& uvs);
  uint32_t number(const SourceMaterial& material);
  /// The finest level that is wanted; else the coarsest there is.
  SurfaceBuilding* best(Levels& levels) const;

  const std::string& file_;
  const CityGmlOptions& options_;
  std::vector<std::string> themes_;
  std::map<std::string, uint32_t> materialNumbers_;
};

uint32_t Reader::number(const SourceMaterial& material) {
  const std::string key = material.image + "|" + std::to_string(material.colour.x) + " " +
                          std::to_string(material.colour.y) + " " + std::to_string(material.colour.z) +
                          (material.repeat ? "r" : "c");
  const auto [found, isNew] = materialNumbers_.emplace(key, static_cast<uint32_t>(source.materials.size()));
  if (isNew) source.materials.push_back(material);
  return found->second;
}

/// The texture coordinates of a polygon's outer ring, one for each of its points; empty where there are none.
std::vector<TVec2f> coordinatesOf(const citygml::Polygon& polygon, const std::string& theme) {
  for (const bool front : {true, false}) {
    const auto target = polygon.getTextureTargetDefinitionForTheme(theme, front);
    if (!target) continue;
    for (unsigned i = 0; i < target->getTextureCoordinatesCount(); ++i)
      if (const auto coordinates = target->getTextureCoordinates(i);
          coordinates && coordinates->targets(*polygon.exteriorRing()))
        return coordinates->getCoords();
  }
  return {};
}

uint32_t Reader::materialOf(const citygml::Polygon& polygon, std::vector<TVec2f>& uvs) {
  for (const std::string& theme : themes_) {
    const auto texture = polygon.getTextureFor(theme);
    if (!texture) continue;
    const std::string found = findPicture(file_, texture->getUrl());
    if (found.empty()) {
      missingPictures.insert(texture->getUrl());
      continue;
    }
    uvs = coordinatesOf(polygon, theme);
    if (uvs.empty()) continue;
    const auto wrap = texture->getWrapMode();
    const bool repeat = wrap == citygml::Texture::WrapMode::WM_WRAP || wrap == citygml::Texture::WrapMode::WM_MIRROR;
    return number({texture->getUrl(), found, glm::vec3(1), repeat});
  }
  for (const std::string& theme : themes_)
    if (const auto material = polygon.getMaterialFor(theme)) {
      const TVec3f c = material->getDiffuse();
      return number({"colour", {}, linearColour({c.x, c.y, c.z}), true});
    }
  return kNoMaterial;
}

void Reader::addPolygon(const citygml::Polygon& polygon, SurfaceKind kind, const Place& place, SurfaceBuilding& out) {
  Surface surface;
  surface.kind = kind;
  const auto addRing = [&](const citygml::LinearRing& ring) {
    std::vector<uint32_t>& indices = surface.rings.emplace_back();
    for (const TVec3d& p : ring.getVertices()) {
      indices.push_back(static_cast<uint32_t>(out.points.size()));
      out.points.push_back(place({p.x, p.y, p.z}));
    }
  };
  const auto exterior = polygon.exteriorRing();
  if (!exterior || exterior->getVertices().size() < 3) return;
  addRing(*exterior);
  for (const auto& ring : polygon.interiorRings())
    if (ring && ring->getVertices().size() >= 3) addRing(*ring);
  std::vector<TVec2f> uvs;
  surface.material = materialOf(polygon, uvs);
  // Coordinates of the outer ring suffice: a picture lies flat on its surface.
  if (uvs.size() >= surface.rings[0].size())
    for (size_t k = 0; k < surface.rings[0].size(); ++k) {
      if (surface.uvs.empty()) surface.uvs.resize(surface.rings.size());
      const glm::vec2 uv(uvs[k].x, uvs[k].y);
      surface.uvs[0].push_back(std::isfinite(uv.x + uv.y) ? uv : glm::vec2(0));
    }
  else if (!uvs.empty())
    surface.material = kNoMaterial;
  out.surfaces.push_back(std::move(surface));
}

void Reader::addGeometry(const citygml::Geometry& geometry, SurfaceKind kind, int lod, const Place& place, int depth,
                         Levels& levels) {
  constexpr int kDeepest = 100;
  if (depth > kDeepest) return;
  const SurfaceKind own = kindOf(geometry.getType());
  if (kind == SurfaceKind::Unknown) kind = own;
  SurfaceBuilding& out = levels.of[lod];
  for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
    if (const auto polygon = geometry.getPolygon(i)) addPolygon(*polygon, kind, place, out);
  for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
    addGeometry(geometry.getGeometry(i), kind, lod, place, depth + 1, levels);
}

void Reader::collect(const citygml::CityObject& object, SurfaceKind kind, int depth, Levels& levels) {
  constexpr int kDeepest = 100;
  if (depth > kDeepest || (depth > 0 && roleOf(object.getType()) == Role::Inside)) return;
  if (const SurfaceKind own = kindOf(object.getType()); own != SurfaceKind::Unknown) kind = own;
  const Place asItIs = [](glm::dvec3 p) { return p; };
  for (unsigned i = 0; i < object.getGeometriesCount(); ++i) {
    const citygml::Geometry& g = object.getGeometry(i);
    addGeometry(g, kind, static_cast<int>(g.getLOD()), asItIs, 0, levels);
  }
  for (unsigned i = 0; i < object.getImplicitGeometryCount(); ++i) {
    const citygml::ImplicitGeometry& implicit = object.getImplicitGeometry(i);
    const double* m = implicit.getTransformMatrix().getMatrix();
    const TVec3d at = implicit.getReferencePoint();
    const Place moved = [m, at](glm::dvec3 p) {
      return glm::dvec3(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3] + at.x,
                        m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7] + at.y,
                        m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11] + at.z);
    };
    for (unsigned k = 0; k < implicit.getGeometriesCount(); ++k) {
      const citygml::Geometry& g = implicit.getGeometry(k);
      addGeometry(g, kind, static_cast<int>(g.getLOD()), moved, 0, levels);
    }
  }
  for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
    collect(object.getChildCityObject(i), kind, depth + 1, levels);
}

SurfaceBuilding* Reader::best(Levels& levels) const {
  SurfaceBuilding* found = nullptr;
  for (auto& [lod, building] : levels.of) {
    if (building.surfaces.empty()) continue;
    if (!found || lod <= options_.lod + 1e-6) found = &building;
  }
  return found;
}

std::vector<Polygon> plansOf(const SurfaceBuilding& shape) {
  std::vector<Polygon> out;
  for (const Surface& s : shape.surfaces) {
    Polygon& polygon = out.emplace_back();
    for (const auto& ring : s.rings) {
      Ring& line = polygon.rings.emplace_back();
      for (const uint32_t i : ring) line.emplace_back(shape.points[i]);
    }
  }
  return out;
}

void Reader::addRoot(const citygml::CityObject& object, city::Diagnostics& diagnostics) {
  const Role role = roleOf(object.getType());
  if (role == Role::LeftOut || role == Role::Inside) {
    ++leftOut[object.getTypeAsString()];
    return;
  }
  Levels levels;
  collect(object, SurfaceKind::Unknown, 0, levels);
  SurfaceBuilding* shape = best(levels);
  const std::string id = object.getId().empty() ? "object without id" : object.getId().substr(0, 200);
  if (!shape) {
    diagnostics.warn(file_, id, "left out: it has no geometry that can be used");
    diagnostics.leftOut.push_back({"building " + id, 1, "it has no geometry that can be used"});
    return;
  }
  switch (role) {
    case Role::Building: {
      shape->id = id;
      for (const auto& [name, value] : object.getAttributes()) shape->attributes.emplace_back(name, value.asString());
      std::vector<std::string> names;
      for (const auto& [name, value] : shape->attributes) names.push_back(name);
      for (const size_t i : columnsNamed(names, groundNames()))
        if (const double v = numberIn(shape->attributes[i].second); std::isfinite(v) && std::isnan(shape->ground))
          shape->ground = v;
      source.buildings.push_back(std::move(*shape));
      break;
    }
    case Role::Terrain:
      for (const Surface& s : shape->surfaces) {
        const std::vector<uint32_t>& ring = s.rings[0];
        const auto base = static_cast<uint32_t>(source.tin.points.size());
        for (const uint32_t i : ring) source.tin.points.push_back(shape->points[i]);
        for (uint32_t k = 2; k < ring.size(); ++k) source.tin.triangles.emplace_back(base, base + k - 1, base + k);
      }
      break;
    case Role::Water:
      source.surroundings.water.push_back({id, plansOf(*shape)});
      break;
    case Role::Cover:
      source.surroundings.cover.push_back({coverOf(object.getType()), plansOf(*shape)});
      break;
    default: {
      city::Aabb box;
      for (const glm::dvec3& p : shape->points) box.extend(p);
      source.surroundings.trees.push_back(
          {glm::dvec2(box.centre()), box.size().z > 0.5 ? box.size().z : kUnknown, false});
    }
  }
}

/// The CRS that the model, or the first of its objects, states.
std::string crsNameOf(const citygml::CityModel& model) {
  if (!model.getSRSName().empty()) return model.getSRSName();
  for (const citygml::CityObject* object : model.getRootCityObjects()) {
    if (object && object->getGeometriesCount() > 0 && !object->getGeometry(0).getSRSName().empty())
      return object->getGeometry(0).getSRSName();
  }
  return {};
}

/// The first srsName in the file's beginning: the library hands over only those of geometries.
std::string crsInHead(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(64 << 10, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(stream.gcount()));
  constexpr std::string_view kName = "srsName=\"";
  const size_t at = head.find(kName), begin = at + kName.size();
  const size_t end = at == std::string::npos ? at : head.find('"', begin);
  return end == std::string::npos ? std::string() : head.substr(begin, end - begin);
}

/// URNs of geographic systems give latitude first.
void swapAxes(Source& source) {
  for (SurfaceBuilding& b : source.buildings)
    for (glm::dvec3& p : b.points) std::swap(p.x, p.y);
  for (glm::dvec3& p : source.tin.points) std::swap(p.x, p.y);
  const auto swapAll = [](std::vector<Polygon>& parts) {
    for (Polygon& p : parts)
      for (Ring& ring : p.rings)
        for (glm::dvec2& q : ring) std::swap(q.x, q.y);
  };
  for (WaterArea& w : source.surroundings.water) swapAll(w.parts);
  for (CoverArea& c : source.surroundings.cover) swapAll(c.parts);
  for (TreePoint& t : source.surroundings.trees) std::swap(t.position.x, t.position.y);
}

/// Where a text stops being XML, in the words of GDAL's small parser; empty where that finds nothing wrong.
std::string placeOfDamage(const std::string& file) {
  GdalMessages messages;
  if (CPLXMLNode* tree = CPLParseXMLFile(file.c_str())) CPLDestroyXMLNode(tree);
  const std::string what = messages.take();
  return what.empty() ? std::string() : ": " + what.substr(0, 200);
}

}  // namespace

bool isCityGml(std::string_view text) {
  constexpr size_t kHead = 64 << 10;
  text = text.substr(0, kHead);
  return text.find("/citygml/") != std::string_view::npos || text.find("citygml4j") != std::string_view::npos ||
         text.find(":CityModel") != std::string_view::npos || text.find("<CityModel") != std::string_view::npos;
}

Source readCityGml(const std::string& file, const CityGmlOptions& options, city::Diagnostics& diagnostics) {
  // The library's XML parser is set up for the whole process.
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  Source source;
  source.file = file;
  citygml::ParserParams params;
  params.tesselate = false, params.keepVertices = true, params.pruneEmptyObjects = true;
  const auto logger = std::make_shared<Logger>();
  std::shared_ptr<const citygml::CityModel> model;
  std::string why;
  try {
    model = citygml::load(file, params, logger);
  } catch (const std::exception& e) {
    why = e.what();
  } catch (...) {
    // The XML parser's own exceptions are no standard ones.
    why = "not well-formed XML" + placeOfDamage(file);
  }
  for (const std::string& message : logger->errors) diagnostics.error(file, "", message);
  for (const std::string& message : logger->warnings) diagnostics.warn(file, "", message);
  if (logger->warningCount > logger->warnings.size())
    diagnostics.warn(file, "",
                     std::to_string(logger->warningCount - logger->warnings.size()) + " more warnings of this kind");
  if (!model) {
    if (logger->errors.empty() || !why.empty())
      diagnostics.error(file, "", "the CityGML cannot be read" + (why.empty() ? "" : ": " + why.substr(0, 300)));
    return source;
  }
  Reader reader(file, options, *model);
  for (const citygml::CityObject* object : model->getRootCityObjects())
    if (object) reader.addRoot(*object, diagnostics);
  source = std::move(reader.source);
  std::string crs = crsNameOf(*model);
  if (crs.empty()) crs = crsInHead(file);
  if (!crs.empty()) {
    source.crs = crsFromText(crs);
    source.zUnit = heightUnitOf(crs);
    if (source.crs.empty())
      diagnostics.error(file, "", "the CRS " + crs.substr(0, 100) + " is not known; give one with --crs");
    else if (vicus::assets::kindOf(source.crs).geographic && crs.starts_with("urn:"))
      swapAxes(source);
  }
  for (const auto& [type, count] : reader.leftOut)
    diagnostics.leftOut.push_back({type, count, "objects of this type are not shown"});
  if (!reader.missingPictures.empty())
    diagnostics.warn(file, "",
                     std::to_string(reader.missingPictures.size()) + " pictures are not beside the file (the first: " +
                         reader.missingPictures.begin()->substr(0, 100) + ")");
  return source;
}

}  // namespace vicus::assets
