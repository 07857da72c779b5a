// Based on: CityJSON specifications 1.0, 1.1 and 2.0 (cityjson.org/specs), §3 geometry, §4 templates, §6 appearance.
#include "assets/import/cityjson_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "assets/import/columns.hpp"
#include "assets/import/pictures.hpp"

namespace vicus::assets::cityjson {
namespace {

/// Instances of templates may ask for any number of points; more than these are refused.
constexpr size_t kMostVertices = 50'000'000;

const Json kNull;

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

std::optional<glm::dvec3> vectorOf(const Json& v) {
  if (!v.is_array() || v.size() < 3 || !v[0].is_number() || !v[1].is_number() || !v[2].is_number()) return std::nullopt;
  return glm::dvec3(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
}

const Json& entry(const Json& list, size_t i) {
  return list.is_array() && i < list.size() ? list[i] : kNull;
}

/// The values of the theme that is shown: the stated one, else the first that there is.
const Json& valuesOf(const Json& themes, const std::string& theme, const char* name) {
  if (!themes.is_object() || themes.empty()) return kNull;
  const auto stated = themes.find(theme);
  return member(stated != themes.end() ? *stated : *themes.begin(), name);
}

/// A boundary value of nesting `depth`, or the same value for all below.
const Json& below(const Json& values, size_t i) {
  return values.is_array() ? entry(values, i) : values;
}

}  // namespace

const Json& member(const Json& object, const char* name) {
  if (!object.is_object()) return kNull;
  const auto found = object.find(name);
  return found == object.end() ? kNull : *found;
}

std::string textOf(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

std::string shown(const Json& value) {
  if (value.is_array()) return "a list";
  if (value.is_object()) return "an object";
  if (value.is_string()) return "\"" + value.get<std::string>().substr(0, 40) + "\"";
  return value.dump();
}

GeometryReader::GeometryReader(const Json& root, const Json& defaults, const std::string& file, Complain complain)
    : root_(root), defaults_(defaults), file_(file), complain_(std::move(complain)) {}

const Json& GeometryReader::fromEither(const char* name) const {
  const Json& own = member(root_, name);
  return own.is_null() ? member(defaults_, name) : own;
}

bool GeometryReader::readVertices(city::Diagnostics& diagnostics) {
  const Json& list = member(root_, "vertices");
  if (!list.is_array()) {
    diagnostics.error(file_, "vertices", "there is no list of vertices");
    return false;
  }
  glm::dvec3 scale(1), translate(0);
  const Json& transform = fromEither("transform");
  for (const auto& [name, target] : {std::pair("scale", &scale), std::pair("translate", &translate)}) {
    const Json& values = member(transform, name);
    if (values.is_null()) continue;
    const auto vector = values.size() == 3 ? vectorOf(values) : std::nullopt;
    if (!vector) {
      diagnostics.error(file_, std::string("transform ") + name, "is not three numbers");
      return false;
    }
    *target = *vector;
  }
  size_t bad = 0, firstBad = 0;
  vertices_.reserve(list.size());
  for (size_t i = 0; i < list.size(); ++i) {
    const auto raw = vectorOf(list[i]);
    glm::dvec3 p = raw ? *raw * scale + translate : glm::dvec3(kUnknown);
    if (!std::isfinite(p.x + p.y + p.z)) {
      p = glm::dvec3(kUnknown);
      if (bad++ == 0) firstBad = i;
    }
    vertices_.push_back(p);
  }
  if (bad > 0)
    diagnostics.error(file_, "vertex " + std::to_string(firstBad),
                      "is not three numbers" + (bad > 1 ? ", nor are " + std::to_string(bad - 1) + " more" : ""));
  ownVertices_ = vertices_.size();
  const Json& templates = member(fromEither("geometry-templates"), "vertices-templates");
  if (templates.is_array())
    for (const Json& v : templates) templateVertices_.push_back(vectorOf(v).value_or(glm::dvec3(kUnknown)));
  return true;
}

void GeometryReader::readAppearance(city::Diagnostics& diagnostics) {
  const Json& appearance = fromEither("appearance");
  colourTheme_ = textOf(member(appearance, "default-theme-material"));
  textureTheme_ = textOf(member(appearance, "default-theme-texture"));
  if (const Json& list = member(appearance, "materials"); list.is_array())
    for (const Json& m : list) {
      const auto colour = vectorOf(member(m, "diffuseColor"));
      colourMaterials_.push_back(kNoMaterial);
      if (!colour) continue;
      colourMaterials_.back() = static_cast<uint32_t>(materials_.size());
      const std::string name = textOf(member(m, "name"));
      materials_.push_back({name.empty() ? "colour" : name, {}, linearColour(glm::vec3(*colour)), true});
    }
  size_t missing = 0;
  std::string firstMissing;
  if (const Json& list = member(appearance, "textures"); list.is_array())
    for (const Json& t : list) {
      const std::string image = textOf(member(t, "image")), found = findPicture(file_, image);
      textureMaterials_.push_back(kNoMaterial);
      if (found.empty()) {
        if (missing++ == 0) firstMissing = image;
        continue;
      }
      const std::string wrap = textOf(member(t, "wrapMode"));
      textureMaterials_.back() = static_cast<uint32_t>(materials_.size());
      materials_.push_back({image, found, glm::vec3(1), wrap == "wrap" || wrap == "mirror"});
    }
  if (missing > 0)
    diagnostics.warn(file_, "appearance",
                     std::to_string(missing) + (missing == 1 ? " picture is" : " pictures are") +
                         " not beside the file (the first: " + shown(firstMissing) +
                         "); their surfaces look as those without");
  if (const Json& list = member(appearance, "vertices-texture"); list.is_array())
    for (const Json& uv : list) {
      const bool good = uv.is_array() && uv.size() >= 2 && uv[0].is_number() && uv[1].is_number();
      const glm::vec2 value = good ? glm::vec2(uv[0].get<float>(), uv[1].get<float>()) : glm::vec2(0);
      textureVertices_.push_back(std::isfinite(value.x + value.y) ? value : glm::vec2(0));
    }
}

std::optional<Surface> GeometryReader::readSurface(const std::string& id, const Json& rings,
                                                   std::span<const glm::dvec3> points) {
  if (!rings.is_array()) {
    complain_(id, "a surface is not a list of rings");
    return std::nullopt;
  }
  Surface surface;
  for (const Json& ring : rings) {
    if (!ring.is_array()) {
      complain_(id, "a ring is not a list of vertices");
      return std::nullopt;
    }
    std::vector<uint32_t>& out = surface.rings.emplace_back();
    for (const Json& index : ring) {
      const int64_t i = index.is_number_integer() ? index.get<int64_t>() : -1;
      if (i < 0 || i >= static_cast<int64_t>(points.size())) {
        complain_(id, "vertex index " + shown(index) + " is out of range (0 to " +
                          std::to_string(static_cast<int64_t>(points.size()) - 1) + "); surfaces with it are left out");
        return std::nullopt;
      }
      if (std::isnan(points[static_cast<size_t>(i)].x)) {
        complain_(id, "vertex " + std::to_string(i) + " is not three numbers; surfaces with it are left out");
        return std::nullopt;
      }
      out.push_back(static_cast<uint32_t>(i));
    }
  }
  if (surface.rings.empty() || surface.rings[0].size() < 3) {
    complain_(id, "a surface has fewer than three vertices");
    return std::nullopt;
  }
  return surface;
}

/// Texture of a surface: for each ring the number of the picture, then one coordinate for each point.
void GeometryReader::paint(Surface& surface, const Json& textures, const Json& colour) const {
  if (colour.is_number_unsigned() && colour.get<uint64_t>() < colourMaterials_.size())
    surface.material = colourMaterials_[colour.get<uint64_t>()];
  const Json& first = entry(entry(textures, 0), 0);
  if (!first.is_number_unsigned() || first.get<uint64_t>() >= textureMaterials_.size()) return;
  const uint32_t picture = textureMaterials_[first.get<uint64_t>()];
  if (picture == kNoMaterial) return;
  std::vector<std::vector<glm::vec2>> uvs;
  for (size_t r = 0; r < surface.rings.size(); ++r) {
    const Json& ring = entry(textures, r);
    std::vector<glm::vec2>& out = uvs.emplace_back();
    for (size_t k = 0; k < surface.rings[r].size(); ++k) {
      const Json& index = entry(ring, k + 1);
      if (!index.is_number_unsigned() || index.get<uint64_t>() >= textureVertices_.size()) return;
      out.push_back(textureVertices_[index.get<uint64_t>()]);
    }
  }
  surface.material = picture;
  surface.uvs = std::move(uvs);
}

/// `depth` 0: boundaries are surfaces; 1: shells of a solid, of which the first bounds it; 2: solids.
void GeometryReader::readSurfaces(const std::string& id, const Json& boundaries, const Beside& beside, int depth,
                                  uint32_t& shell, const std::vector<SurfaceKind>& kinds,
                                  std::span<const glm::dvec3> points, std::vector<Surface>& out) {
  if (!boundaries.is_array()) {
    complain_(id, "its boundaries are nested less deeply than its type says");
    return;
  }
  if (depth > 0) {
    const size_t count = depth == 1 ? std::min<size_t>(boundaries.size(), 1) : boundaries.size();
    for (size_t i = 0; i < count; ++i)
      readSurfaces(id, boundaries[i],
                   {&below(*beside.semantics, i), &below(*beside.textures, i), &below(*beside.colours, i)}, depth - 1,
                   shell, kinds, points, out);
    return;
  }
  for (size_t i = 0; i < boundaries.size(); ++i) {
    std::optional<Surface> surface = readSurface(id, boundaries[i], points);
    if (!surface) continue;
    const Json& value = entry(*beside.semantics, i);
    if (value.is_number_unsigned() && value.get<uint64_t>() < kinds.size())
      surface->kind = kinds[value.get<uint64_t>()];
    surface->shell = shell;
    paint(*surface, entry(*beside.textures, i), below(*beside.colours, i));
    out.push_back(std::move(*surface));
  }
  ++shell;
}

std::optional<Geometry> GeometryReader::readShape(const std::string& id, const Json& geometry,
                                                  std::span<const glm::dvec3> points) {
  const std::string type = textOf(member(geometry, "type"));
  static const std::map<std::string, int> kDepths = {
      {"MultiSurface", 0}, {"CompositeSurface", 0}, {"Solid", 1}, {"MultiSolid", 2}, {"CompositeSolid", 2}};
  Geometry out;
  const Json& lod = member(geometry, "lod");
  out.lod = lod.is_number() ? lod.get<double>() : lod.is_string() ? numberIn(lod.get<std::string>()) : 1;
  if (!std::isfinite(out.lod)) out.lod = 1;
  if (type == "MultiPoint") {
    std::vector<uint32_t> ring;
    if (const Json& list = member(geometry, "boundaries"); list.is_array())
      for (const Json& i : list)
        if (i.is_number_unsigned() && i.get<uint64_t>() < points.size() && !std::isnan(points[i.get<uint64_t>()].x))
          ring.push_back(i.get<uint32_t>());
    out.points = true;
    out.surfaces.emplace_back().rings.push_back(std::move(ring));
    return out;
  }
  const auto depth = kDepths.find(type);
  if (depth == kDepths.end()) {
    if (type != "MultiLineString")
      complain_(id, "the geometry type " + (type.empty() ? "is missing" : type.substr(0, 40) + " is not known"));
    return std::nullopt;
  }
  std::vector<SurfaceKind> kinds;
  const Json& semantics = member(geometry, "semantics");
  if (const Json& list = member(semantics, "surfaces"); list.is_array())
    for (const Json& s : list) kinds.push_back(kindOfSemantics(textOf(member(s, "type"))));
  const Json& colours = valuesOf(member(geometry, "material"), colourTheme_, "values");
  const Json& colour = valuesOf(member(geometry, "material"), colourTheme_, "value");
  const Beside beside{&member(semantics, "values"), &valuesOf(member(geometry, "texture"), textureTheme_, "values"),
                      colour.is_null() ? &colours : &colour};
  uint32_t shell = 0;
  readSurfaces(id, member(geometry, "boundaries"), beside, depth->second, shell, kinds, points, out.surfaces);
  if (depth->second > 0)
    for (Surface& s : out.surfaces) s.solid = true;
  return out;
}

/// A template's geometry, turned and put at its reference point.
std::optional<Geometry> GeometryReader::readInstance(const std::string& id, const Json& geometry) {
  const Json& number = member(geometry, "template");
  const Json& templates = member(fromEither("geometry-templates"), "templates");
  const size_t t = number.is_number_unsigned() ? number.get<size_t>() : SIZE_MAX;
  if (!templates.is_array() || t >= templates.size()) {
    complain_(id, "there is no geometry template " + shown(number));
    return std::nullopt;
  }
  const Json& reference = entry(member(geometry, "boundaries"), 0);
  const size_t r = reference.is_number_unsigned() ? reference.get<size_t>() : SIZE_MAX;
  if (r >= ownVertices_ || std::isnan(vertices_[r].x)) {
    complain_(id, "the reference point " + shown(reference) + " of a template is out of range");
    return std::nullopt;
  }
  double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  if (const Json& matrix = member(geometry, "transformationMatrix"); !matrix.is_null()) {
    bool good = matrix.is_array() && matrix.size() == 16;
    for (size_t k = 0; good && k < 16; ++k) {
      good = matrix[k].is_number();
      if (good) m[k] = matrix[k].get<double>();
    }
    if (!good) {
      complain_(id, "the transformation matrix of a template is not sixteen numbers");
      return std::nullopt;
    }
  }
  auto found = templates_.find(t);
  if (found == templates_.end()) {
    std::optional<Geometry> shape = readShape("template " + std::to_string(t), templates[t], templateVertices_);
    found = templates_.emplace(t, std::move(shape)).first;
  }
  if (!found->second) return std::nullopt;
  Geometry out = *found->second;
  std::map<uint32_t, uint32_t> moved;
  for (Surface& s : out.surfaces)
    for (auto& ring : s.rings)
      for (uint32_t& i : ring) {
        const auto [at, isNew] = moved.emplace(i, static_cast<uint32_t>(vertices_.size()));
        if (isNew) {
          if (vertices_.size() >= kMostVertices) {
            complain_(id, "the templates of this file ask for more than 50 million points");
            return std::nullopt;
          }
          const glm::dvec3 p = templateVertices_[i];
          const glm::dvec3 turned(m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                                  m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                                  m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]);
          vertices_.push_back(vertices_[r] + turned);
        }
        i = at->second;
      }
  return out;
}

std::optional<Geometry> GeometryReader::read(const std::string& id, const Json& geometry) {
  return textOf(member(geometry, "type")) == "GeometryInstance"
             ? readInstance(id, geometry)
             : readShape(id, geometry, std::span(vertices_).first(ownVertices_));
}

}  // namespace vicus::assets::cityjson
