#include "assets/import/extrude.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vicus::assets {
namespace {

/// Points nearer to a wall's line than this are no corners of it: metres.
constexpr double kInLine = 0.03;

/// A footprint whose corners all matter, with what stands against its edges.
Extrusion::Part merged(const Extrusion::Part& part) {
  Extrusion::Part out = part;
  out.polygon = {}, out.neighbours.clear(), out.ground.clear();
  for (size_t r = 0; r < part.polygon.rings.size(); ++r) {
    const Ring& ring = part.polygon.rings[r];
    // Edges in line are one wall where the same stands against them.
    std::vector<uint8_t> group;
    std::map<double, uint8_t> numberOf;
    for (const double height : part.neighbours[r])
      group.push_back(numberOf.emplace(height, static_cast<uint8_t>(numberOf.size())).first->second);
    Ring& kept = out.polygon.rings.emplace_back();
    std::vector<double>& neighbours = out.neighbours.emplace_back();
    const std::vector<uint32_t> corners = cornersOf(ring, group, kInLine);
    for (const uint32_t i : corners) {
      kept.push_back(ring[i]);
      neighbours.push_back(part.neighbours[r][i]);
    }
    if (r >= part.ground.size()) continue;
    std::vector<glm::dvec2>& ground = out.ground.emplace_back();
    for (size_t k = 0; k < corners.size(); ++k) {
      const size_t end = corners[(k + 1) % corners.size()], last = (end + ring.size() - 1) % ring.size();
      ground.emplace_back(part.ground[r][corners[k]].x, part.ground[r][last].y);
    }
  }
  return out;
}

/// The level underside of what hangs above the ground.
void addUnderside(city::BuildingBuilder& builder, const Extrusion::Part& part, city::MaterialId material) {
  Triangulation cut = triangulate(part.polygon);
  if (cut.triangles.empty()) return;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  for (const glm::dvec2& p : cut.points) {
    positions.emplace_back(glm::dvec3(p, part.bottom));
    uvs.emplace_back(p);
  }
  for (size_t t = 0; t + 2 < cut.triangles.size(); t += 3) std::swap(cut.triangles[t + 1], cut.triangles[t + 2]);
  builder.beginPlane(city::PlaneKind::Floor, material, {0, 0, -1});
  builder.addTriangles(positions, uvs, cut.triangles, {0, 0, -1}, material);
}

}  // namespace

double roofRise(const Polygon& footprint, facade::RoofKind form, double pitch) {
  return facade::roofOver(footprint.rings, {}, {form, pitch, 0}).height;
}

city::BuildingGeometry extrude(const Extrusion& e, const facade::StyleInUse& style, std::string name,
                               facade::Derivation& made) {
  city::BuildingBuilder builder(std::move(name));
  std::vector<std::vector<glm::vec2>> footprint;
  for (const Extrusion::Part& whole : e.parts) {
    Extrusion::Part slim = merged(whole);
    // Merging moves walls by at most 3 cm, which may still make narrow ones cross: then every point is kept.
    const Extrusion::Part& part = isPlainlyValid(slim.polygon) ? slim : whole;
    for (const Ring& ring : part.polygon.rings) {
      std::vector<glm::vec2>& line = footprint.emplace_back();
      for (const glm::dvec2& p : ring) line.emplace_back(p);
    }
    facade::Lot lot;
    lot.rings = part.polygon.rings, lot.neighbours = part.neighbours;
    if (!(part.bottom > 0)) lot.ground = part.ground;
    lot.bottom = part.bottom, lot.foundation = part.bottom > 0 ? 0 : e.foundation;
    lot.roof = part.roof, lot.roofRise = part.roofHeight > 0 ? part.roofHeight : 0;
    lot.facts.height = part.height - part.bottom, lot.facts.year = e.year, lot.facts.seed = e.seed;
    lot.facts.use = e.use, lot.facts.material = e.material, lot.facts.roof = e.roof;
    facade::addHouse(builder, style, lot, made);
    if (part.bottom > 0) addUnderside(builder, part, style.looks[style.style->plainPaint].material);
  }
  builder.setFootprint(std::move(footprint));
  return builder.finish();
}

}  // namespace vicus::assets
