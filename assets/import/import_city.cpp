#include "assets/import/import_city.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <unordered_map>

#include "assets/import/columns.hpp"
#include "assets/import/extrude.hpp"
#include "assets/import/finishes.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/ground_cover.hpp"
#include "assets/import/parallel.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/surfaces.hpp"
#include "assets/import/terrain.hpp"
#include "city/random.hpp"

namespace vicus::assets {
namespace {

/// Terrain made up between buildings: samples this far apart (metres), and this far beyond the outermost building.
constexpr double kMadeUpSpacing = 12;
constexpr double kMadeUpMargin = 150;
/// A raster is read this far beyond the outermost building: metres.
constexpr double kRasterMargin = 500;

void report(const LoadOptions& options, std::string_view stage, double fraction) {
  if (options.progress) options.progress(stage, fraction);
}

/// "17, 33, 41 and 12 more".
std::string list(const std::vector<std::string>& names) {
  constexpr size_t kShown = 10;
  std::string out;
  for (size_t i = 0; i < std::min(names.size(), kShown); ++i) out += (i ? ", " : "") + names[i];
  if (names.size() > kShown) out += " and " + std::to_string(names.size() - kShown) + " more";
  return out;
}

std::string counted(size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string metres(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", v);
  return text;
}

/// FNV-1a, for seeds from names.
uint32_t seedOf(std::string_view text) {
  uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<uint8_t>(c)) * 16777619u;
  return city::hash32(h);
}

std::string_view attribute(const city::Attributes& attributes, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    for (const auto& [key, value] : attributes)
      if (key == name) return value;
  return {};
}

/// All positions of a source that are x and y, one after another.
template <typename Visit>
void forEachPoint(Source& source, const Visit& visit) {
  for (Footprint& f : source.footprints)
    for (Polygon& p : f.parts)
      for (Ring& ring : p.rings)
        for (glm::dvec2& q : ring) visit(q.x, q.y);
  for (SurfaceBuilding& b : source.buildings)
    for (glm::dvec3& q : b.points) visit(q.x, q.y);
  for (glm::dvec3& q : source.tin.points) visit(q.x, q.y);
}

city::Aabb planExtent(Source& source) {
  city::Aabb box;
  forEachPoint(source, [&](double x, double y) {
    if (std::isfinite(x) && std::isfinite(y)) box.extend(glm::dvec3(x, y, 0));
  });
  return box;
}

/// Drops sources that cannot be placed; returns the CRS (WKT) of the city, empty for local metres.
std::string chooseCrs(std::vector<Source>& sources, std::span<const ElevationRaster> rasters,
                      city::Diagnostics& diagnostics) {
  std::string crs;
  std::erase_if(sources, [&](Source& s) {
    const city::Aabb box = planExtent(s);
    if (s.crs.empty() || box.empty()) return false;
    const std::string metric = metricCrs(s.crs, box.centre());
    if (crs.empty()) crs = metric;
    if (metric.empty())
      diagnostics.error(s.file, "", "its CRS " + crsName(s.crs) + " cannot be brought into metres on the plan");
    return metric.empty();
  });
  for (const ElevationRaster& r : rasters)
    if (crs.empty() && !r.crs.empty()) {
      const city::Aabb box = extentOf(r, r.crs);
      if (!box.empty()) crs = metricCrs(r.crs, box.centre());
    }
  std::erase_if(sources, [&](Source& s) {
    if (!s.crs.empty()) return false;
    const city::Aabb box = planExtent(s);
    if (box.empty()) return false;
    // A town is larger than two metres and smaller than two degrees.
    const glm::dvec3 size = box.size();
    if (!s.metric && std::max(size.x, size.y) < 2 && std::abs(box.min.x) <= 360 && std::abs(box.max.x) <= 360 &&
        std::abs(box.min.y) <= 90 && std::abs(box.max.y) <= 90) {
      diagnostics.error(s.file, "",
                        "states no CRS, and its coordinates look like degrees: give one with --crs "
                        "(EPSG:4326 for longitude and latitude)");
      return true;
    }
    diagnostics.warn(s.file, "",
                     crs.empty() ? "states no CRS: taken as metres of its own; give one with --crs"
                                 : "states no CRS: taken as that of the other files; give one with --crs");
    return false;
  });
  return crs;
}

/// Brings all positions of a source into the city's CRS and adds the shift.
void project(Source& source, const std::string& crs, glm::dvec3 shift, city::Diagnostics& diagnostics) {
  if (!crs.empty() && !source.crs.empty()) {
    std::vector<glm::dvec2> points;
    forEachPoint(source, [&](double x, double y) { points.emplace_back(x, y); });
    const auto failed = transform(source.crs, crs, points);
    if (!failed) {
      diagnostics.error(source.file, "", "cannot be brought from " + crsName(source.crs) + " to " + crsName(crs));
      source.footprints.clear(), source.buildings.clear(), source.tin = {};
      return;
    }
    if (*failed > 0)
      diagnostics.error(source.file, "",
                        counted(*failed, "position lies", "positions lie") + " outside " + crsName(source.crs));
    size_t i = 0;
    forEachPoint(source, [&](double& x, double& y) { x = points[i].x, y = points[i].y, ++i; });
  }
  forEachPoint(source, [&](double& x, double& y) { x += shift.x, y += shift.y; });
  for (Footprint& f : source.footprints) f.ground += shift.z;
  for (SurfaceBuilding& b : source.buildings) {
    b.ground += shift.z;
    for (glm::dvec3& q : b.points) q.z += shift.z;
  }
  for (glm::dvec3& q : source.tin.points) q.z += shift.z;
}

/// The city's origin: the middle of the data on the plan and its lowest known altitude, in whole metres.
glm::dvec3 originOf(std::vector<Source>& sources, double shiftZ) {
  city::Aabb box;
  double lowest = INFINITY;
  const auto lower = [&](double z) {
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  };
  for (Source& s : sources) {
    box.extend(planExtent(s));
    for (const Footprint& f : s.footprints) lower(f.ground);
    for (const SurfaceBuilding& b : s.buildings)
      for (const glm::dvec3& q : b.points) lower(q.z);
    for (const glm::dvec3& q : s.tin.points) lower(q.z);
  }
  if (box.empty()) return {0, 0, std::round(shiftZ)};
  return {glm::round(glm::dvec2(box.centre())), std::isfinite(lowest) ? std::floor(lowest) : std::round(shiftZ)};
}

/// A footprint on its way into the city; positions in metres from the city's origin.
struct Outline {
  const Footprint* source = nullptr;
  const std::string* file = nullptr;
  CleanedPolygons cleaned;
  std::vector<Extrusion::Part> parts;
  double ground = kUnknown;  ///< as its source says, metres above the city's origin
  GroundUnder under;
};

/// Where an edge lies, whichever way it runs.
uint64_t edgeKey(glm::dvec2 a, glm::dvec2 b) {
  if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
  uint64_t h = 1469598103934665603ULL;
  for (const double v : {a.x, a.y, b.x, b.y}) {
    h ^= static_cast<uint64_t>(static_cast<int64_t>(v / kSnap));
    h *= 0x9e3779b97f4a7c15ULL;
    h ^= h >> 29;
  }
  return h;
}

/// Marks the edges that two buildings, or two parts of one, have in common.
void markSharedEdges(std::vector<Outline>& outlines) {
  std::vector<std::vector<uint64_t>> keys(outlines.size());
  parallelFor(outlines.size(), 256, [&](size_t i) {
    for (const Polygon& p : outlines[i].cleaned.polygons)
      for (const Ring& ring : p.rings)
        for (size_t k = 0; k < ring.size(); ++k) keys[i].push_back(edgeKey(ring[k], ring[(k + 1) % ring.size()]));
  });
  std::vector<uint64_t> all;
  for (const auto& k : keys) all.insert(all.end(), k.begin(), k.end());
  std::sort(all.begin(), all.end());
  parallelFor(outlines.size(), 256, [&](size_t i) {
    size_t next = 0;
    for (Polygon& p : outlines[i].cleaned.polygons) {
      Extrusion::Part& part = outlines[i].parts.emplace_back();
      for (const Ring& ring : p.rings) {
        std::vector<uint8_t>& shared = part.shared.emplace_back();
        for (size_t k = 0; k < ring.size(); ++k) {
          const auto range = std::equal_range(all.begin(), all.end(), keys[i][next++]);
          shared.push_back(range.second - range.first > 1 ? 1 : 0);
        }
      }
      part.polygon = std::move(p);
    }
  });
}

/// Everything that decides a geometry, as bytes: equal where the geometries are.
std::string keyOf(const Extrusion& e) {
  std::string key;
  const auto add = [&key](const auto& value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    key.append(bytes, sizeof value);
  };
  add(e.height), add(e.foundation), add(e.pitch), add(e.style.facade), add(e.style.plain), add(e.style.roof);
  for (const Extrusion::Part& part : e.parts) {
    add(part.polygon.rings.size());
    for (size_t r = 0; r < part.polygon.rings.size(); ++r) {
      add(part.polygon.rings[r].size());
      for (const glm::dvec2& p : part.polygon.rings[r]) add(p.x), add(p.y);
      key.append(part.shared[r].begin(), part.shared[r].end());
    }
  }
  return key;
}

/// The city while it is put together.
struct Assembly {
  city::City city;
  city::CityParts parts;
  const LoadOptions& options;
  city::Diagnostics& diagnostics;
};

/// Cleans all footprints; reports what was repaired and what cannot be used.
std::vector<Outline> cleanFootprints(const std::vector<Source>& sources, glm::dvec3 origin,
                                     city::Diagnostics& diagnostics) {
  std::vector<Outline> outlines;
  for (const Source& s : sources)
    for (const Footprint& f : s.footprints) {
      Outline& o = outlines.emplace_back();
      o.source = &f, o.file = &s.file;
      o.ground = f.ground - origin.z;
    }
  parallelFor(outlines.size(), 64, [&](size_t i) {
    Outline& o = outlines[i];
    if (o.source->parts.empty()) o.cleaned.problem = "it has no outline";
    for (const Polygon& raw : o.source->parts) {
      if (raw.rings.empty() || raw.rings[0].empty()) {
        o.cleaned.problem = "it has no outline";
        continue;
      }
      // Near the polygon's own first point numbers are exact; whole metres keep the snapping grid.
      const glm::dvec2 toLocal = -glm::dvec2(origin), base = glm::round(raw.rings[0][0] + toLocal);
      Polygon local = raw;
      for (Ring& ring : local.rings)
        for (glm::dvec2& q : ring) q = (q + toLocal) - base;
      CleanedPolygons c = cleanPolygon(local);
      o.cleaned.repaired = o.cleaned.repaired || c.repaired;
      if (c.polygons.empty()) o.cleaned.problem = c.problem;
      for (Polygon& p : c.polygons) {
        for (Ring& ring : p.rings)
          for (glm::dvec2& q : ring) q += base;
        o.cleaned.polygons.push_back(std::move(p));
      }
    }
  });

  for (const Source& s : sources) {
    std::vector<std::string> repaired, partly;
    for (const Outline& o : outlines) {
      if (o.file != &s.file) continue;
      if (o.cleaned.polygons.empty()) {
        diagnostics.warn(s.file, o.source->id, "left out: " + o.cleaned.problem);
        diagnostics.leftOut.push_back({"building " + o.source->id, 1, o.cleaned.problem});
        continue;
      }
      if (o.cleaned.repaired) repaired.push_back(o.source->id);
      if (!o.cleaned.problem.empty()) partly.push_back(o.source->id + " (" + o.cleaned.problem + ")");
    }
    if (!repaired.empty())
      diagnostics.warn(s.file, "",
                       counted(repaired.size(), "footprint crossed or touched itself and was repaired: ",
                               "footprints crossed or touched themselves and were repaired: ") +
                           list(repaired));
    if (!partly.empty())
      diagnostics.warn(s.file, "",
                       counted(partly.size(), "footprint lost a part: ", "footprints lost a part: ") + list(partly));
  }
  std::erase_if(outlines, [](const Outline& o) { return o.cleaned.polygons.empty(); });
  return outlines;
}

glm::dvec2 middleOf(const Outline& o) {
  const Extrusion::Part* largest = &o.parts[0];
  for (const Extrusion::Part& p : o.parts)
    if (area(p.polygon) > area(largest->polygon)) largest = &p;
  return snapped(centroid(largest->polygon));
}

/// The terrain, from the best that there is. `box` is the plan of all buildings, from the origin.
void makeTerrain(Assembly& a, const std::vector<Source>& sources, const std::vector<Outline>& outlines,
                 std::span<const ElevationRaster> rasters, const std::string& crs, const city::Aabb& box,
                 GdalMessages& messages) {
  if (!rasters.empty()) {
    ElevationRequest request;
    request.crs = crs;
    request.toLocal = a.options.shift - a.city.origin;
    if (!box.empty()) {
      request.extent.extend(box.min - request.toLocal - kRasterMargin);
      request.extent.extend(box.max - request.toLocal + kRasterMargin);
    }
    a.city.terrain = readElevation(rasters, request, messages, a.diagnostics);
    if (a.city.terrain) return;
  }

  Tin tin;
  std::string tinFile;
  for (const Source& s : sources) {
    const auto base = static_cast<uint32_t>(tin.points.size());
    for (const glm::dvec3& p : s.tin.points) tin.points.push_back(p - a.city.origin);
    for (const glm::uvec3& t : s.tin.triangles) tin.triangles.push_back(t + base);
    if (!s.tin.triangles.empty() && tinFile.empty()) tinFile = s.file;
  }
  if (!tin.triangles.empty()) {
    city::Aabb extent = box;
    for (const glm::uvec3& t : tin.triangles)
      for (int k = 0; k < 3; ++k) extent.extend(tin.points[t[k]]);
    city::HeightField field = fieldOver(extent, spacingOf(tin));
    const uint64_t covered = rasteriseTin(tin, field);
    if (covered == 0) {
      a.diagnostics.error(tinFile, "terrain", "its triangles cover no ground");
    } else {
      const uint64_t filled = fillByMembrane(field);
      field.updateRange();
      if (filled > 0)
        a.diagnostics.warn(tinFile, "terrain",
                           counted(filled, "sample lies", "samples lie") + " outside the triangles (of " +
                               std::to_string(field.heights.size()) + ") and follow from their surroundings");
      a.city.terrain = std::move(field);
      return;
    }
  }

  std::vector<glm::dvec3> known;
  std::string groundFile;
  size_t buildings = 0;
  const auto know = [&](std::span<const glm::dvec2> outline, double ground, const std::string& file) {
    ++buildings;
    if (groundFile.empty()) groundFile = file;
    for (size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 from = outline[i], to = outline[(i + 1) % outline.size()];
      const int pieces = std::clamp(static_cast<int>(std::ceil(glm::length(to - from) / kMadeUpSpacing)), 1, 1000);
      for (int k = 0; k < pieces; ++k) known.emplace_back(glm::mix(from, to, static_cast<double>(k) / pieces), ground);
    }
  };
  for (const Outline& o : outlines)
    if (std::isfinite(o.ground)) {
      know(o.parts[0].polygon.rings[0], o.ground, *o.file);
      for (size_t p = 1; p < o.parts.size(); ++p) know(o.parts[p].polygon.rings[0], o.ground, *o.file), --buildings;
    }
  for (const Source& s : sources)
    for (const SurfaceBuilding& b : s.buildings) {
      city::Aabb around;
      for (const glm::dvec3& p : b.points)
        if (std::isfinite(p.x + p.y + p.z)) around.extend(p - a.city.origin);
      if (around.empty()) continue;
      const double ground = std::isfinite(b.ground) ? b.ground - a.city.origin.z : around.min.z;
      const glm::dvec2 low(around.min), high(around.max);
      const Ring corners{low, {high.x, low.y}, high, {low.x, high.y}};
      know(corners, ground, s.file);
    }
  constexpr size_t kFewest = 3;  // fewer say nothing of a terrain's form
  if (buildings < kFewest) return;
  city::Aabb extent = box;
  extent.extend(box.min - kMadeUpMargin);
  extent.extend(box.max + kMadeUpMargin);
  a.city.terrain = fieldThrough(known, extent, kMadeUpSpacing);
  a.diagnostics.warn(groundFile, "",
                     "no elevation given: terrain interpolated from the ground heights of " +
                         counted(buildings, "building", "buildings"));
}

/// The differences between what a source says of the ground and the terrain that its buildings stand on.
void reportGaps(const std::string& file, std::vector<double> gaps, const char* what, city::Diagnostics& diagnostics) {
  if (gaps.empty()) return;
  std::sort(gaps.begin(), gaps.end());
  diagnostics.warn(file, "",
                   std::string(what) + " and the terrain differ by " + metres(gaps[gaps.size() / 2]) + " (median) to " +
                       metres(gaps.back()));
}

void addFootprints(Assembly& a, std::vector<Outline>& outlines) {
  const std::optional<city::HeightField>& terrain = a.city.terrain;
  std::vector<glm::dvec2> middles(outlines.size());
  std::vector<Extrusion> extrusions(outlines.size());
  std::vector<double> bases(outlines.size(), 0);
  std::vector<std::string> keys(outlines.size());
  parallelFor(outlines.size(), 64, [&](size_t i) {
    Outline& o = outlines[i];
    Extrusion& e = extrusions[i];
    middles[i] = middleOf(o);
    const uint32_t seed = seedOf(o.source->id);
    const uint32_t variant = seed % 8;

    // Where it stands: the terrain along its outline, else what its source says.
    double lowest = 0;
    if (terrain) {
      GroundUnder& all = o.under;
      double sum = 0;
      for (const Extrusion::Part& p : o.parts) {
        const GroundUnder g = groundUnder(*terrain, p.polygon.rings[0]);
        if (!g.known) continue;
        all.lowest = all.known ? std::min(all.lowest, g.lowest) : g.lowest;
        sum += g.mean * area(p.polygon), all.mean += area(p.polygon);
        all.known = true;
      }
      if (all.known) all.mean = sum / all.mean;
    }
    if (o.under.known) {
      bases[i] = o.under.mean, lowest = o.under.lowest;
    } else {
      bases[i] = lowest = std::isfinite(o.ground) ? o.ground : 0;
    }
    bases[i] = std::nearbyint(bases[i] / kSnap) * kSnap;

    e.height = o.source->height > 0 ? o.source->height : kDefaultHeight;
    // In steps of 0.25 m, so that equal footprints on nearly level ground remain equal.
    e.foundation = std::ceil(std::max(0.5, bases[i] - lowest + 0.3) * 4) / 4;
    e.pitch = glm::radians(25.0 + 5.0 * variant / 7.0);
    e.style = styleFor(attribute(o.source->attributes, {"material", "material.value", "building:material", "materiau"}),
                       variant);
    e.parts = std::move(o.parts);
    for (Extrusion::Part& p : e.parts)
      for (Ring& ring : p.polygon.rings)
        for (glm::dvec2& q : ring) q -= middles[i];
    keys[i] = keyOf(e);
  });

  // One geometry for each distinct footprint.
  std::unordered_map<std::string_view, uint32_t> typeOf;
  std::vector<size_t> firstWith;
  std::vector<uint32_t> geometry(outlines.size());
  for (size_t i = 0; i < outlines.size(); ++i) {
    const auto [found, isNew] = typeOf.emplace(keys[i], static_cast<uint32_t>(firstWith.size()));
    if (isNew) firstWith.push_back(i);
    geometry[i] = found->second;
  }
  std::vector<std::optional<city::BuildingGeometry>> built(firstWith.size());
  parallelFor(built.size(), 32, [&](size_t t) {
    const size_t i = firstWith[t];
    built[t] = extrude(extrusions[i], outlines[i].source->id);
  });

  std::vector<uint32_t> number(built.size(), city::kNone);
  for (size_t t = 0; t < built.size(); ++t) {
    if (!built[t]) continue;
    number[t] = static_cast<uint32_t>(a.city.buildingTypes.size());
    a.city.buildingTypes.push_back(std::move(*built[t]));
  }
  std::vector<std::string> withoutHeight;
  const std::string* file = nullptr;
  std::vector<double> gaps;
  const auto finishFile = [&] {
    if (!file) return;
    if (!withoutHeight.empty())
      a.diagnostics.warn(*file, "",
                         counted(withoutHeight.size(), "building has", "buildings have") + " no height and became " +
                             std::to_string(static_cast<int>(kDefaultHeight)) + " m high: " + list(withoutHeight));
    reportGaps(*file, std::move(gaps), "the buildings' ground altitudes", a.diagnostics);
    withoutHeight.clear();
    gaps = {};
  };
  for (size_t i = 0; i < outlines.size(); ++i) {
    const Outline& o = outlines[i];
    if (file != o.file) finishFile();
    file = o.file;
    if (number[geometry[i]] == city::kNone) {
      a.diagnostics.warn(*o.file, o.source->id, "left out: its roof could not be cut into triangles");
      a.diagnostics.leftOut.push_back({"building " + o.source->id, 1, "its roof could not be cut into triangles"});
      continue;
    }
    if (!(o.source->height > 0)) withoutHeight.push_back(o.source->id);
    if (o.under.known && std::isfinite(o.ground)) gaps.push_back(std::abs(o.under.mean - o.ground));
    city::Instance instance;
    instance.position = {middles[i], bases[i]};
    instance.geometry = number[geometry[i]];
    instance.seed = seedOf(o.source->id);
    instance.attributes = static_cast<uint32_t>(a.city.attributes.size());
    a.city.attributes.push_back(o.source->attributes);
    a.parts.buildings.push_back(instance);
  }
  finishFile();
}

void addSurfaceBuildings(Assembly& a, const std::vector<Source>& sources) {
  for (const Source& s : sources) {
    const size_t count = s.buildings.size();
    std::vector<std::optional<city::BuildingGeometry>> built(count);
    std::vector<SurfaceReport> reports(count);
    std::vector<glm::dvec3> positions(count);
    parallelFor(count, 16, [&](size_t i) {
      SurfaceBuilding local = s.buildings[i];
      city::Aabb box;
      for (glm::dvec3& p : local.points) {
        p = snapped(p - a.city.origin);
        if (std::isfinite(p.x + p.y + p.z)) box.extend(p);
      }
      if (box.empty()) return;
      // On the ground within the footprint, as far as it is known.
      glm::dvec3 position(glm::round(glm::dvec2(box.centre())), box.min.z);
      for (glm::dvec3& p : local.points) p -= position;
      positions[i] = position;
      SurfaceOptions options;
      const std::string_view material = attribute(s.buildings[i].attributes, {"material", "material.value"});
      // The cities that come as surfaces alone are mostly of brick; beside footprints a building looks like those.
      options.style =
          s.footprints.empty() ? brickStyleFor(material) : styleFor(material, seedOf(s.buildings[i].id) % 8);
      if (a.city.terrain)
        options.groundAt = [&](glm::dvec2 p) {
          const auto h = a.city.terrain->heightAt(p.x + position.x, p.y + position.y);
          return h ? *h - position.z : kUnknown;
        };
      built[i] = buildFromSurfaces(local, s.buildings[i].id, options, reports[i]);
    });

    std::vector<std::string> turned, repaired, lost;
    double highest = 0, deepest = 0;
    std::string highestId, deepestId;
    for (size_t i = 0; i < count; ++i) {
      const SurfaceBuilding& b = s.buildings[i];
      const SurfaceReport& r = reports[i];
      if (!built[i]) {
        a.diagnostics.warn(s.file, b.id, "left out: none of its surfaces can be drawn");
        a.diagnostics.leftOut.push_back({"building " + b.id, 1, "none of its surfaces can be drawn"});
        continue;
      }
      if (r.turned > 0) turned.push_back(b.id);
      if (r.repaired > 0) repaired.push_back(b.id);
      if (r.leftOut > 0) lost.push_back(b.id + " (" + std::to_string(r.leftOut) + ")");
      if (r.floating > highest) highest = r.floating, highestId = b.id;
      if (-r.floating > deepest) deepest = -r.floating, deepestId = b.id;
      city::Instance instance;
      instance.position = positions[i];
      instance.geometry = static_cast<uint32_t>(a.city.buildingTypes.size());
      instance.seed = seedOf(b.id);
      instance.attributes = static_cast<uint32_t>(a.city.attributes.size());
      a.city.buildingTypes.push_back(std::move(*built[i]));
      a.city.attributes.push_back(b.attributes);
      a.parts.buildings.push_back(instance);
    }
    if (!turned.empty())
      a.diagnostics.warn(s.file, "",
                         counted(turned.size(), "building has", "buildings have") +
                             " surfaces wound the wrong way round, which were turned: " + list(turned));
    if (!repaired.empty())
      a.diagnostics.warn(s.file, "",
                         counted(repaired.size(), "building has", "buildings have") +
                             " surfaces that cross or touch themselves, which were repaired: " + list(repaired));
    if (!lost.empty())
      a.diagnostics.warn(s.file, "",
                         counted(lost.size(), "building has", "buildings have") +
                             " surfaces without area, which are not drawn: " + list(lost));
    if (highest > 0.05)
      a.diagnostics.warn(s.file, highestId,
                         "hangs " + metres(highest) +
                             " above the terrain, the most of all; walls that end above it were "
                             "lengthened");
    if (deepest > 0.05)
      a.diagnostics.warn(s.file, deepestId, "reaches " + metres(deepest) + " into the terrain, the most of all");
  }
}

}  // namespace

std::optional<city::City> assembleCity(std::vector<Source> sources, std::span<const ElevationRaster> rasters,
                                       const LoadOptions& options, GdalMessages& messages,
                                       city::Diagnostics& diagnostics) {
  Assembly a{{}, {}, options, diagnostics};
  report(options, "coordinates", 0);
  const std::string crs = chooseCrs(sources, rasters, diagnostics);
  for (Source& s : sources) project(s, crs, options.shift, diagnostics);
  a.city.crs = crsName(crs);
  a.city.origin = originOf(sources, options.shift.z);
  // A raster alone is a city too: its middle is the origin.
  city::Aabb content;
  for (Source& s : sources) content.extend(planExtent(s));
  if (content.empty() && !rasters.empty()) {
    city::Aabb box;
    for (const ElevationRaster& r : rasters) box.extend(extentOf(r, crs));
    if (!box.empty()) a.city.origin += glm::dvec3(glm::round(glm::dvec2(box.centre() + options.shift)), 0);
  }

  report(options, "footprints", 0);
  std::vector<Outline> outlines = cleanFootprints(sources, a.city.origin, diagnostics);
  markSharedEdges(outlines);

  report(options, "terrain", 0);
  city::Aabb box;
  for (const Outline& o : outlines)
    for (const Extrusion::Part& p : o.parts)
      for (const glm::dvec2& q : p.polygon.rings[0]) box.extend(glm::dvec3(q, 0));
  for (const Source& s : sources)
    for (const SurfaceBuilding& b : s.buildings)
      for (const glm::dvec3& q : b.points)
        if (std::isfinite(q.x + q.y + q.z)) box.extend(glm::dvec3(glm::dvec2(q - a.city.origin), 0));
  makeTerrain(a, sources, outlines, rasters, crs, box, messages);

  report(options, "buildings", 0);
  addFootprints(a, outlines);
  report(options, "buildings", 0.5);
  addSurfaceBuildings(a, sources);
  if (a.parts.buildings.empty() && !a.city.terrain) return std::nullopt;

  report(options, "tiles", 0);
  keepUsedFinishes(a.city);
  finishCity(a.city, std::move(a.parts));
  report(options, "ground", 0);
  a.city.groundCover = guessGroundCover(a.city);
  report(options, "ground", 1);
  return std::move(a.city);
}

}  // namespace vicus::assets
