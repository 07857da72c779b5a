#include <algorithm>
#include <cmath>

#include "assets/import/assembly.hpp"
#include "assets/import/gdal_messages.hpp"

namespace vicus::assets {
namespace {

/// Terrain made up between buildings has samples this far apart: metres.
constexpr double kMadeUpSpacing = 12;
/// Terrain goes on this far beyond the outermost building where no data say so: metres. Streets end before it does.
constexpr double kMadeUpMargin = 150;
/// Share of a building about its middle where the ground made up between buildings has the altitude that is stated.
constexpr double kHold = 0.5;
/// Rise over run of that ground at most: streets that people built on are not steeper, and a step between the altitudes
/// of two neighbours, which are known to a metre or two, is no cliff.
constexpr double kSteepest = 0.3;
/// A raster is read this far beyond the outermost building: metres.
constexpr double kRasterMargin = 500;

}  // namespace

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
    city::Aabb extent;
    if (!box.empty()) {
      extent.extend(box.min - kMadeUpMargin);
      extent.extend(box.max + kMadeUpMargin);
    }
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
    // One altitude for a building is that of its middle. Were it that of its whole outline, all the slope would lie in
    // the streets between.
    glm::dvec2 middle(0);
    for (const glm::dvec2& p : outline) middle += p / static_cast<double>(outline.size());
    for (size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 from = glm::mix(middle, outline[i], kHold),
                       to = glm::mix(middle, outline[(i + 1) % outline.size()], kHold);
      const int pieces = std::clamp(static_cast<int>(std::ceil(glm::length(to - from) / kMadeUpSpacing)), 1, 1000);
      for (int k = 0; k < pieces; ++k) known.emplace_back(glm::mix(from, to, static_cast<double>(k) / pieces), ground);
    }
  };
  for (const Outline& o : outlines)
    if (std::isfinite(o.ground)) {
      know(o.parts[0].polygon.rings[0], o.ground, o.source->file);
      for (size_t p = 1; p < o.parts.size(); ++p)
        know(o.parts[p].polygon.rings[0], o.ground, o.source->file), --buildings;
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
  limitSlope(*a.city.terrain, kSteepest);
  a.diagnostics.warn(groundFile, "",
                     "no elevation given: terrain interpolated from the ground heights of " +
                         counted(buildings, "building", "buildings"));
}

}  // namespace vicus::assets
