#include "assets/import/place_sources.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "assets/import/assembly.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

/// Numbers beyond are no coordinates of any CRS but damage: metres, feet or degrees.
constexpr double kLargestCoordinate = 1e9;
/// Buildings wider or higher than this are damage too: metres.
constexpr double kWidestCity = 200e3;

bool sane(double x, double y) {
  return std::abs(x) <= kLargestCoordinate && std::abs(y) <= kLargestCoordinate;
}

/// All positions of a source that are x and y, one after another.
template <typename Visit>
void forEachPoint(Source& source, const Visit& visit) {
  const auto polygons = [&](std::vector<Polygon>& parts) {
    for (Polygon& p : parts)
      for (Ring& ring : p.rings)
        for (glm::dvec2& q : ring) visit(q.x, q.y);
  };
  const auto line = [&](std::vector<glm::dvec2>& points) {
    for (glm::dvec2& q : points) visit(q.x, q.y);
  };
  for (Footprint& f : source.footprints)
    for (FootprintPart& part : f.parts)
      for (Ring& ring : part.polygon.rings) line(ring);
  for (SurfaceBuilding& b : source.buildings)
    for (glm::dvec3& q : b.points) visit(q.x, q.y);
  for (glm::dvec3& q : source.tin.points) visit(q.x, q.y);
  for (PlacedMesh& m : source.meshes) visit(m.position.x, m.position.y);
  Surroundings& around = source.surroundings;
  for (StreetLine& s : around.streets) line(s.points);
  for (WallLine& w : around.walls) line(w.points);
  for (WaterArea& w : around.water) polygons(w.parts);
  for (CoverArea& c : around.cover) polygons(c.parts);
  for (TreePoint& t : around.trees) visit(t.position.x, t.position.y);
  for (auto& coast : around.coast) line(coast);
}

/// Extent of the buildings and of what has a place of its own; that of all where there are none: lakes and roads reach
/// far beyond a town.
city::Aabb townExtent(Source& source) {
  city::Aabb box;
  const auto add = [&](double x, double y) {
    if (sane(x, y)) box.extend(glm::dvec3(x, y, 0));
  };
  for (const Footprint& f : source.footprints)
    for (const FootprintPart& part : f.parts)
      for (const Ring& ring : part.polygon.rings)
        for (const glm::dvec2& q : ring) add(q.x, q.y);
  for (const SurfaceBuilding& b : source.buildings)
    for (const glm::dvec3& q : b.points) add(q.x, q.y);
  for (const PlacedMesh& m : source.meshes) add(m.position.x, m.position.y);
  for (const glm::dvec3& q : source.tin.points) add(q.x, q.y);
  return box.empty() ? planExtent(source) : box;
}

const glm::dvec2* firstPoint(const Footprint& f) {
  for (const FootprintPart& part : f.parts)
    for (const Ring& ring : part.polygon.rings)
      if (!ring.empty()) return &ring[0];
  return nullptr;
}

/// The median of where the buildings are, which one mistyped coordinate does not move; nothing for fewer than `fewest`.
std::optional<glm::dvec2> medianOf(const Source& source, size_t fewest) {
  std::vector<double> xs, ys;
  const auto add = [&](glm::dvec2 p) {
    if (sane(p.x, p.y)) xs.push_back(p.x), ys.push_back(p.y);
  };
  for (const Footprint& f : source.footprints)
    if (const glm::dvec2* p = firstPoint(f)) add(*p);
  for (const SurfaceBuilding& b : source.buildings)
    if (!b.points.empty()) add(glm::dvec2(b.points[0]));
  if (xs.size() < std::max<size_t>(fewest, 1)) return std::nullopt;
  const auto median = [](std::vector<double>& v) {
    const auto half = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), half, v.end());
    return *half;
  };
  return glm::dvec2(median(xs), median(ys));
}

bool looksLikeDegrees(const city::Aabb& box) {
  return std::abs(box.min.x) <= 360 && std::abs(box.max.x) <= 360 && std::abs(box.min.y) <= 90 &&
         std::abs(box.max.y) <= 90;
}

}  // namespace

city::Aabb planExtent(Source& source) {
  city::Aabb box;
  forEachPoint(source, [&](double x, double y) {
    if (sane(x, y)) box.extend(glm::dvec3(x, y, 0));
  });
  return box;
}

void dropNonFinite(Source& source, city::Diagnostics& diagnostics) {
  const auto good = [](const glm::dvec3& p) { return sane(p.x, p.y) && std::abs(p.z) <= kLargestCoordinate; };
  const auto badRing = [](const Ring& ring) {
    return std::any_of(ring.begin(), ring.end(), [](const glm::dvec2& q) { return !sane(q.x, q.y); });
  };
  size_t surfaces = 0, triangles = 0, others = 0;
  std::string first;
  for (SurfaceBuilding& b : source.buildings) {
    const size_t lost = std::erase_if(b.surfaces, [&](const Surface& s) {
      for (const auto& ring : s.rings)
        for (const uint32_t i : ring)
          if (!good(b.points[i])) return true;
      return false;
    });
    if (lost > 0 && first.empty()) first = b.id;
    surfaces += lost;
    for (glm::dvec3& p : b.points)
      if (!good(p)) p = glm::dvec3(kUnknown);
    if (!(std::abs(b.ground) <= kLargestCoordinate)) b.ground = kUnknown;
  }
  if (surfaces > 0)
    diagnostics.error(source.file, first,
                      "a coordinate is not a number or beyond all bounds; " +
                          counted(surfaces, "surface is", "surfaces are") + " left out");
  triangles = std::erase_if(source.tin.triangles, [&](const glm::uvec3& t) {
    return !good(source.tin.points[t.x]) || !good(source.tin.points[t.y]) || !good(source.tin.points[t.z]);
  });
  if (triangles > 0) {
    diagnostics.leftOut.push_back({"terrain triangles", triangles, "a coordinate is not a number"});
  }
  for (glm::dvec3& p : source.tin.points)
    if (!good(p)) p = glm::dvec3(kUnknown);
  for (Footprint& f : source.footprints)
    if (!(std::abs(f.ground) <= kLargestCoordinate)) f.ground = kUnknown;
  Surroundings& around = source.surroundings;
  others += std::erase_if(source.meshes, [&](const PlacedMesh& m) { return !good(m.position); });
  others += std::erase_if(around.streets, [&](const StreetLine& s) { return badRing(s.points); });
  others += std::erase_if(around.walls, [&](const WallLine& w) { return badRing(w.points); });
  others += std::erase_if(around.trees, [&](const TreePoint& t) { return !sane(t.position.x, t.position.y); });
  others += std::erase_if(around.coast, badRing);
  if (others > 0)
    diagnostics.leftOut.push_back({"streets, walls, trees or meshes", others, "a coordinate is not a number"});
}

std::string chooseCrs(std::vector<Source>& sources, std::span<const ElevationRaster> rasters, const std::string& wanted,
                      const std::string& fallback, city::Diagnostics& diagnostics) {
  std::string crs = wanted;
  std::erase_if(sources, [&](Source& s) {
    const city::Aabb box = townExtent(s);
    if (s.crs.empty() || box.empty()) return false;
    if (kindOf(s.crs).geographic && !looksLikeDegrees(box)) {
      const std::string stated = crsName(s.crs);
      if (fallback.empty()) {
        diagnostics.error(s.file, "",
                          "states " + stated + ", degrees, but its coordinates reach from " + metres(box.min.x) +
                              " to " + metres(box.max.x) + ": give their true CRS with --crs");
        return true;
      }
      diagnostics.warn(s.file, "",
                       "states " + stated + ", which its coordinates cannot be in; " + crsName(fallback) +
                           " is taken instead, as --crs says");
      s.crs = fallback;
    }
    const std::string metric = metricCrs(s.crs, medianOf(s, 1).value_or(glm::dvec2(box.centre())));
    if (crs.empty()) crs = metric;
    if (metric.empty())
      diagnostics.error(s.file, "",
                        "its CRS " + crsName(s.crs) +
                            " cannot be brought into metres on the plan; where it is wrong, give the true one with "
                            "--crs");
    return metric.empty();
  });
  for (const ElevationRaster& r : rasters)
    if (crs.empty() && !r.crs.empty()) {
      const city::Aabb box = extentOf(r, r.crs);
      if (!box.empty()) crs = metricCrs(r.crs, box.centre());
    }
  std::erase_if(sources, [&](Source& s) {
    if (!s.crs.empty()) return false;
    const city::Aabb box = townExtent(s);
    if (box.empty()) return false;
    // A town is larger than two metres and smaller than two degrees.
    const glm::dvec3 size = box.size();
    if (!s.metric && std::max(size.x, size.y) < 2 && looksLikeDegrees(box)) {
      diagnostics.error(s.file, "",
                        "states no CRS, and its coordinates look like degrees: give one with --crs "
                        "(EPSG:4326 for longitude and latitude)");
      return true;
    }
    const bool onlyMeshes = s.footprints.empty() && s.buildings.empty() && s.tin.triangles.empty();
    if (!onlyMeshes)
      diagnostics.warn(s.file, "",
                       crs.empty() ? "states no CRS: taken as metres of its own; give one with --crs"
                                   : "states no CRS: taken as that of the other files; give one with --crs");
    return false;
  });
  return crs;
}

void project(Source& source, const std::string& crs, glm::dvec3 shift, city::Diagnostics& diagnostics) {
  if (!crs.empty() && !source.crs.empty()) {
    std::vector<glm::dvec2> points;
    forEachPoint(source, [&](double x, double y) { points.emplace_back(x, y); });
    const auto failed = transform(source.crs, crs, points);
    if (!failed) {
      diagnostics.error(source.file, "", "cannot be brought from " + crsName(source.crs) + " to " + crsName(crs));
      source = Source{};
      return;
    }
    if (*failed > 0)
      diagnostics.error(source.file, "",
                        counted(*failed, "position lies", "positions lie") + " outside " + crsName(source.crs) +
                            "; where that is not the true CRS, give it with --crs");
    size_t i = 0;
    forEachPoint(source, [&](double& x, double& y) { x = points[i].x, y = points[i].y, ++i; });
    dropNonFinite(source, diagnostics);
  }
  forEachPoint(source, [&](double& x, double& y) { x += shift.x, y += shift.y; });
  const double unit = source.zUnit;
  for (Footprint& f : source.footprints) f.ground = f.ground * unit + shift.z;
  for (SurfaceBuilding& b : source.buildings) {
    b.ground = b.ground * unit + shift.z;
    for (glm::dvec3& q : b.points) q.z = q.z * unit + shift.z;
  }
  for (glm::dvec3& q : source.tin.points) q.z = q.z * unit + shift.z;
  for (PlacedMesh& m : source.meshes)
    if (!m.onGround) m.position.z += shift.z;
}

void dropFarBuildings(Source& source, city::Diagnostics& diagnostics) {
  // Three say nothing of where the rest is.
  constexpr size_t kFewest = 4;
  constexpr double kNear = 5000, kTimes = 10, kMost = 0.8;
  const auto middle = medianOf(source, kFewest);
  if (!middle) return;

  // A building is as far off as its farthest point: one mistyped corner makes it useless too.
  std::vector<double> distances;
  const auto reachOf = [&](const Footprint& f) {
    double reach = 0;
    for (const FootprintPart& part : f.parts)
      for (const Ring& ring : part.polygon.rings)
        for (const glm::dvec2& q : ring)
          if (sane(q.x, q.y)) reach = std::max(reach, glm::length(q - *middle));
    return reach;
  };
  const auto reachOfSurfaces = [&](const SurfaceBuilding& b) {
    double reach = 0;
    for (const glm::dvec3& q : b.points)
      if (sane(q.x, q.y)) reach = std::max(reach, glm::length(glm::dvec2(q) - *middle));
    return reach;
  };
  for (const Footprint& f : source.footprints) distances.push_back(reachOf(f));
  for (const SurfaceBuilding& b : source.buildings) distances.push_back(reachOfSurfaces(b));
  const auto nth = static_cast<size_t>(kMost * static_cast<double>(distances.size() - 1));
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(nth), distances.end());
  const double farthest = std::max(kNear, kTimes * distances[nth]);

  std::vector<std::string> lost;
  double most = 0;
  const auto isFar = [&](const std::string& id, double reach) {
    if (!(reach > farthest)) return false;
    lost.push_back(id), most = std::max(most, reach);
    return true;
  };
  std::erase_if(source.footprints, [&](const Footprint& f) { return isFar(f.id, reachOf(f)); });
  std::erase_if(source.buildings, [&](const SurfaceBuilding& b) { return isFar(b.id, reachOfSurfaces(b)); });
  const auto far = [&](uint32_t i) { return glm::length(glm::dvec2(source.tin.points[i]) - *middle) > farthest; };
  const size_t triangles =
      std::erase_if(source.tin.triangles, [&](const glm::uvec3& t) { return far(t.x) || far(t.y) || far(t.z); });
  if (triangles > 0) diagnostics.leftOut.push_back({"terrain triangles", triangles, "far from all buildings"});
  if (lost.empty()) return;
  diagnostics.leftOut.push_back({"buildings", lost.size(), "far from all others of " + source.file});
  diagnostics.warn(source.file, "",
                   counted(lost.size(), "building reaches", "buildings reach") + " up to " + shortNumber(most / 1000) +
                       " km from the middle of all, where four in five lie within " +
                       shortNumber(distances[nth] / 1000) + " km; left out: " + list(lost));
}

void dropFarSources(std::vector<Source>& sources, city::Diagnostics& diagnostics) {
  std::optional<glm::dvec2> home;
  std::string homeFile;
  for (Source& s : sources) {
    const city::Aabb box = townExtent(s);
    if (box.empty()) continue;
    const glm::dvec2 middle(box.centre());
    if (!home) {
      home = middle, homeFile = s.file;
      continue;
    }
    const double distance = glm::length(middle - *home);
    if (distance <= kWidestCity) continue;
    diagnostics.error(s.file, "",
                      "lies " + std::to_string(static_cast<long long>(distance / 1000)) + " km from " + homeFile +
                          " and is left out: is its CRS right? Give it with --crs, or as crs of this source in the "
                          "scene description");
    const std::string file = s.file;
    s = Source{};
    s.file = file;
  }
}

glm::dvec3 originOf(std::vector<Source>& sources, double shiftZ) {
  city::Aabb box;
  double lowest = INFINITY;
  const auto lower = [&](double z) {
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  };
  for (Source& s : sources) {
    box.extend(townExtent(s));
    for (const Footprint& f : s.footprints) lower(f.ground);
    for (const SurfaceBuilding& b : s.buildings)
      for (const glm::dvec3& q : b.points) lower(q.z);
    for (const glm::dvec3& q : s.tin.points) lower(q.z);
    for (const PlacedMesh& m : s.meshes)
      if (!m.onGround) lower(m.position.z);
  }
  if (box.empty()) return {0, 0, std::round(shiftZ)};
  return {glm::round(glm::dvec2(box.centre())), std::isfinite(lowest) ? std::floor(lowest) : std::round(shiftZ)};
}

}  // namespace vicus::assets
