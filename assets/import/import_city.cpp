#include "assets/import/import_city.hpp"

#include <algorithm>
#include <cmath>

#include "assets/import/assembly.hpp"
#include "assets/import/gdal_messages.hpp"
#include "assets/import/place_sources.hpp"
#include "assets/import/projection.hpp"

namespace vicus::assets {
namespace {

void report(const LoadOptions& options, std::string_view stage, double fraction) {
  if (options.progress) options.progress(stage, fraction);
}

/// Plan of all buildings and meshes, metres from the city's origin.
city::Aabb planOf(const std::vector<Source>& sources, const std::vector<Outline>& outlines, glm::dvec3 origin) {
  city::Aabb box;
  for (const Outline& o : outlines)
    for (const Extrusion::Part& p : o.parts)
      for (const glm::dvec2& q : p.polygon.rings[0]) box.extend(glm::dvec3(q, 0));
  for (const Source& s : sources) {
    for (const SurfaceBuilding& b : s.buildings)
      for (const glm::dvec3& q : b.points)
        if (std::isfinite(q.x + q.y + q.z)) box.extend(glm::dvec3(glm::dvec2(q - origin), 0));
    for (const PlacedMesh& m : s.meshes) box.extend(glm::dvec3(glm::dvec2(m.position - origin), 0));
  }
  return box;
}

}  // namespace

std::optional<city::City> assembleCity(std::vector<Source> sources, std::span<const ElevationRaster> rasters,
                                       const AssemblyRequest& request, const LoadOptions& options,
                                       GdalMessages& messages, city::Diagnostics& diagnostics) {
  Assembly a{{}, {}, options, diagnostics, {}, {}};
  report(options, "coordinates", 0);
  for (Source& s : sources) dropNonFinite(s, diagnostics);
  const std::string crs = chooseCrs(sources, rasters, request.crs, request.fallbackCrs, diagnostics);
  for (Source& s : sources) project(s, crs, options.shift, diagnostics);
  for (Source& s : sources) dropFarBuildings(s, diagnostics);
  dropFarSources(sources, diagnostics);
  footprintsFromFlatSolids(sources, diagnostics);
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

  report(options, "terrain", 0);
  const city::Aabb box = planOf(sources, outlines, a.city.origin);
  makeTerrain(a, sources, outlines, rasters, crs, box, messages);
  addWaters(a, sources, box);

  report(options, "buildings", 0);
  addFootprints(a, outlines);
  report(options, "buildings", 0.5);
  addSurfaceBuildings(a, sources);
  addSurroundings(a, sources, box);
  if (a.parts.buildings.empty() && a.city.monuments.empty() && !a.city.terrain) return std::nullopt;

  report(options, "tiles", 0);
  keepUsedMaterials(a.city, a.materials);
  finishCity(a.city, std::move(a.parts));
  report(options, "ground", 0);
  paintGroundCover(a.city, sources);
  report(options, "ground", 1);
  return std::move(a.city);
}

}  // namespace vicus::assets
