#include <algorithm>
#include <cmath>
#include <map>

#include "assets/import/assembly.hpp"
#include "assets/norvic/palette.hpp"
#include "assets/norvic/trees.hpp"

namespace vicus::assets {
namespace {

using city::kNone;

/// Streets, trees and walls beyond the outermost building: metres.
constexpr double kMargin = 300;

/// What a step here needs to know of the city.
struct Place {
  Assembly& a;
  city::Aabb box;  ///< plan of what is shown, from the origin

  glm::dvec2 local(glm::dvec2 p) const { return p - glm::dvec2(a.city.origin); }
  bool inside(glm::dvec2 p) const {
    return p.x >= box.min.x && p.y >= box.min.y && p.x <= box.max.x && p.y <= box.max.y;
  }
  double ground(glm::dvec2 p) const { return a.city.terrain ? a.city.terrain->heightAt(p.x, p.y).value_or(0) : 0; }
};

void updateBounds(city::MeshGeometry& mesh) {
  for (const city::Vertex& v : mesh.mesh.vertices) mesh.bounds.extend(v.position);
}

void addMeshes(Place& place, Source& source) {
  if (source.meshes.empty()) return;
  Assembly& a = place.a;
  const std::vector<city::MaterialId> materials = addMaterials(a, source);
  for (PlacedMesh& m : source.meshes) {
    city::MeshGeometry geometry{m.id, std::move(m.mesh), {}};
    for (city::Vertex& v : geometry.mesh.vertices)
      v.material = v.material < materials.size() ? materials[v.material] : id(Finish::Ashlar);
    updateBounds(geometry);
    const glm::dvec2 p = place.local(glm::dvec2(m.position));
    city::Monument monument;
    monument.name = m.id;
    monument.mesh = static_cast<uint32_t>(a.city.meshes.size());
    monument.position = glm::dvec3(p, m.onGround ? place.ground(p) + m.position.z : m.position.z - a.city.origin.z);
    monument.heading = static_cast<float>(m.heading);
    if (!m.attributes.empty()) {
      monument.attributes = static_cast<uint32_t>(a.city.attributes.size());
      a.city.attributes.push_back(std::move(m.attributes));
    }
    a.city.meshes.push_back(std::move(geometry));
    a.city.monuments.push_back(std::move(monument));
  }
}

void addStreets(Place& place, const Source& source) {
  city::City& city = place.a.city;
  if (source.surroundings.streets.empty()) return;
  if (!city.streets) city.streets.emplace();
  city::StreetGraph& graph = *city.streets;
  std::map<std::pair<double, double>, uint32_t> nodes;
  const auto nodeAt = [&](glm::dvec2 p) {
    const glm::dvec2 q = snapped(p);
    const auto [found, isNew] = nodes.emplace(std::pair(q.x, q.y), static_cast<uint32_t>(graph.nodes.size()));
    if (isNew) graph.nodes.push_back({glm::dvec3(q, place.ground(q))});
    return found->second;
  };
  for (const StreetLine& street : source.surroundings.streets)
    for (size_t i = 0; i + 1 < street.points.size(); ++i) {
      const glm::dvec2 from = place.local(street.points[i]), to = place.local(street.points[i + 1]);
      if (!place.inside(from) || !place.inside(to) || glm::length(to - from) < 0.1) continue;
      // Nodes lie on the ground: long pieces get some between their ends.
      constexpr double kLongest = 25;
      const int pieces = std::clamp(static_cast<int>(std::ceil(glm::length(to - from) / kLongest)), 1, 1000);
      uint32_t last = nodeAt(from);
      for (int k = 1; k <= pieces; ++k) {
        const uint32_t next = nodeAt(k == pieces ? to : glm::mix(from, to, static_cast<double>(k) / pieces));
        if (next != last)
          graph.edges.push_back({last, next, static_cast<float>(street.width), street.kind, street.name});
        last = next;
      }
    }
  if (graph.edges.empty()) city.streets.reset();
}

/// A quadrilateral with its normal from its corners, uv in metres.
void addQuad(city::TriangleMesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, city::MaterialId material) {
  const glm::vec3 normal = glm::cross(b - a, d - a);
  if (!(glm::length(normal) > 1e-6f)) return;
  const auto base = static_cast<uint32_t>(mesh.vertices.size());
  const float u = glm::length(b - a), v = glm::length(d - a);
  const glm::vec3 corners[] = {a, b, c, d};
  const glm::vec2 uvs[] = {{0, 0}, {u, 0}, {u, v}, {0, v}};
  for (int k = 0; k < 4; ++k)
    mesh.vertices.push_back({corners[k], uvs[k], city::packNormal(glm::normalize(normal)), material, 0, 0});
  for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(base + i);
}

/// Free-standing walls that follow the ground: one mesh for each square of 256 m.
void addWalls(Place& place, const Source& source) {
  constexpr double kSquare = 256, kPiece = 4, kFoot = 0.4;
  std::map<std::pair<int, int>, city::TriangleMesh> meshes;
  for (const WallLine& wall : source.surroundings.walls)
    for (size_t i = 0; i + 1 < wall.points.size(); ++i) {
      const glm::dvec2 from = place.local(wall.points[i]), to = place.local(wall.points[i + 1]);
      const double length = glm::length(to - from);
      if (!place.inside(from) || !place.inside(to) || length < 0.05) continue;
      const glm::dvec2 side = glm::dvec2(-(to - from).y, (to - from).x) / length * (wall.thickness / 2);
      const int pieces = std::clamp(static_cast<int>(std::ceil(length / kPiece)), 1, 10000);
      for (int k = 0; k < pieces; ++k) {
        const glm::dvec2 p = glm::mix(from, to, static_cast<double>(k) / pieces),
                         q = glm::mix(from, to, static_cast<double>(k + 1) / pieces);
        const std::pair cell{static_cast<int>(std::floor(p.x / kSquare)), static_cast<int>(std::floor(p.y / kSquare))};
        const glm::dvec3 corner(cell.first * kSquare, cell.second * kSquare, 0);
        const double groundP = place.ground(p), groundQ = place.ground(q);
        const auto at = [&](glm::dvec2 r, double z) { return glm::vec3(glm::dvec3(r, z) - corner); };
        city::TriangleMesh& mesh = meshes[cell];
        const double lowP = groundP - kFoot, lowQ = groundQ - kFoot, highP = groundP + wall.height,
                     highQ = groundQ + wall.height;
        const city::MaterialId stone = id(Finish::Rubble);
        addQuad(mesh, at(p - side, lowP), at(q - side, lowQ), at(q - side, highQ), at(p - side, highP), stone);
        addQuad(mesh, at(q + side, lowQ), at(p + side, lowP), at(p + side, highP), at(q + side, highQ), stone);
        addQuad(mesh, at(p - side, highP), at(q - side, highQ), at(q + side, highQ), at(p + side, highP), stone);
        if (k == 0)
          addQuad(mesh, at(p + side, lowP), at(p - side, lowP), at(p - side, highP), at(p + side, highP), stone);
        if (k + 1 == pieces)
          addQuad(mesh, at(q - side, lowQ), at(q + side, lowQ), at(q + side, highQ), at(q - side, highQ), stone);
      }
    }
  city::City& city = place.a.city;
  for (auto& [cell, mesh] : meshes) {
    const std::string name = "walls " + std::to_string(cell.first) + " " + std::to_string(cell.second);
    city::MeshGeometry geometry{name, std::move(mesh), {}};
    updateBounds(geometry);
    city::Monument monument;
    monument.name = name;
    monument.mesh = static_cast<uint32_t>(city.meshes.size());
    monument.position = glm::dvec3(cell.first * kSquare, cell.second * kSquare, 0);
    city.meshes.push_back(std::move(geometry));
    city.monuments.push_back(std::move(monument));
  }
}

void addTrees(Place& place, const Source& source) {
  if (source.surroundings.trees.empty()) return;
  Assembly& a = place.a;
  if (a.city.treeTypes.empty()) {
    a.city.treeTypes = norvic::makeTrees();
    const std::vector<city::Material> palette = norvic::paletteMaterials();
    const size_t first = a.materials.size();
    a.materials.insert(a.materials.end(), palette.begin(), palette.end());
    for (city::MeshGeometry& tree : a.city.treeTypes)
      for (city::Vertex& v : tree.mesh.vertices) v.material = ownMaterial(first + v.material);
  }
  for (const TreePoint& tree : source.surroundings.trees) {
    const glm::dvec2 p = place.local(tree.position);
    if (!place.inside(p)) continue;
    const uint32_t seed = seedOf(std::to_string(p.x) + " " + std::to_string(p.y));
    const norvic::TreeKind kind = tree.needles        ? norvic::TreeKind::Poplar
                                  : tree.height < 2.5 ? norvic::TreeKind::Bush
                                  : tree.height < 7   ? norvic::TreeKind::Apple
                                                      : norvic::TreeKind::Oak;
    city::Instance instance;
    instance.position = glm::dvec3(p, place.ground(p));
    instance.heading = static_cast<float>(seed % 6283u) * 0.001f;
    instance.geometry = norvic::treeType(kind, seed / 6283u);
    instance.seed = seed;
    a.parts.trees.push_back(instance);
  }
}

bool insidePolygon(const Polygon& polygon, glm::dvec2 p) {
  bool inside = false;
  for (const Ring& ring : polygon.rings) inside = inside != insideRing(ring, p);
  return inside;
}

/// Ground higher than this above the sea's level is land, whatever a coarse coast line says: metres.
constexpr double kTide = 2;

/// Sinks the ground under water to a bed below its level, where it is not higher than `most` above that.
void digBed(city::HeightField& terrain, const Polygon& polygon, double level, double most) {
  constexpr double kDepth = 1.5;
  glm::dvec2 low(INFINITY), high(-INFINITY);
  for (const glm::dvec2& p : polygon.rings[0]) low = glm::min(low, p), high = glm::max(high, p);
  const glm::ivec2 first = glm::clamp(glm::ivec2(glm::floor((low - terrain.origin) / terrain.spacing)), glm::ivec2(0),
                                      terrain.size - 1),
                   last = glm::clamp(glm::ivec2(glm::ceil((high - terrain.origin) / terrain.spacing)), glm::ivec2(0),
                                     terrain.size - 1);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (insidePolygon(polygon, terrain.origin + terrain.spacing * glm::dvec2(x, y))) {
        float& h = terrain.at(x, y);
        if (h > static_cast<float>(level - kDepth) && h < static_cast<float>(level + most))
          h = static_cast<float>(level - kDepth);
      }
}

void addWaterBody(Place& place, const std::string& name, const Polygon& polygon, double level, double most) {
  const Triangulation cut = triangulate(polygon);
  if (cut.triangles.empty()) return;
  if (place.a.city.terrain) digBed(*place.a.city.terrain, polygon, level, most);
  place.a.city.water.push_back({name, level, cut.points, cut.triangles});
}

/// Lakes, basins and rivers: level, at the lower quarter of the heights along their banks.
void addWater(Place& place, const Source& source) {
  for (const WaterArea& water : source.surroundings.water)
    for (const Polygon& raw : water.parts) {
      Polygon local = raw;
      for (Ring& ring : local.rings)
        for (glm::dvec2& q : ring) q = place.local(q);
      for (const Polygon& polygon : cleanPolygon(local).polygons) {
        if (!std::any_of(polygon.rings[0].begin(), polygon.rings[0].end(),
                         [&](const glm::dvec2& q) { return place.inside(q); }))
          continue;
        std::vector<double> banks;
        for (const glm::dvec2& q : polygon.rings[0]) banks.push_back(place.ground(q));
        std::sort(banks.begin(), banks.end());
        // A basin smaller than the ground's grid cannot sink into it: it stands a hand above.
        const bool small = place.a.city.terrain &&
                           area(polygon) < 4 * place.a.city.terrain->spacing.x * place.a.city.terrain->spacing.y;
        addWaterBody(place, water.name, polygon, small ? banks.back() + 0.15 : banks[banks.size() / 4], INFINITY);
      }
    }
}

/// Coast lines joined end to start, closed ones with their first point again at the end.
std::vector<Ring> joinedCoasts(const Place& place, const Source& source) {
  std::map<std::pair<double, double>, size_t> startsAt;
  std::vector<Ring> lines;
  for (const auto& coast : source.surroundings.coast) {
    Ring& line = lines.emplace_back();
    for (const glm::dvec2& q : coast) line.push_back(snapped(place.local(q)));
    if (line.size() < 2) lines.pop_back();
  }
  for (size_t i = 0; i < lines.size(); ++i) startsAt.emplace(std::pair(lines[i][0].x, lines[i][0].y), i);
  std::vector<uint8_t> taken(lines.size(), 0), follows(lines.size(), 0);
  const auto next = [&](const Ring& line) {
    const auto found = startsAt.find({line.back().x, line.back().y});
    return found == startsAt.end() ? lines.size() : found->second;
  };
  for (const Ring& line : lines)
    if (const size_t n = next(line); n < lines.size()) follows[n] = 1;
  std::vector<Ring> out;
  for (const bool begins : {true, false})  // chains from their first line; what is left are rings
    for (size_t i = 0; i < lines.size(); ++i) {
      if (taken[i] || (begins && follows[i])) continue;
      taken[i] = 1;
      Ring chain = lines[i];
      for (size_t n = next(chain); n < lines.size() && !taken[n]; n = next(chain)) {
        taken[n] = 1;
        chain.insert(chain.end(), lines[n].begin() + 1, lines[n].end());
      }
      out.push_back(std::move(chain));
    }
  return out;
}

/// The sea: what lies on the right of the coast lines, at altitude 0, as far as the terrain reaches. A coast that ends
/// within the terrain goes on the way that it came, out of it; land that is higher than the sea stays above it all the
/// same.
void addSea(Place& place, const Source& source) {
  if (source.surroundings.coast.empty() || !place.a.city.terrain) return;
  city::HeightField& terrain = *place.a.city.terrain;
  const city::Aabb box = terrain.bounds();
  const glm::dvec2 low(box.min), high(box.max);
  const auto inside = [&](glm::dvec2 p) { return p.x > low.x && p.y > low.y && p.x < high.x && p.y < high.y; };
  const double beyond = glm::length(high - low);
  std::vector<Ring> lines{{low, {high.x, low.y}, high, {low.x, high.y}, low}};
  std::vector<glm::dvec2> seaward, landward;
  for (Ring& coast : joinedCoasts(place, source)) {
    for (size_t i = 0; i + 1 < coast.size(); ++i) {
      const glm::dvec2 along = coast[i + 1] - coast[i], middle = (coast[i] + coast[i + 1]) / 2.0;
      const double length = glm::length(along);
      if (!(length > 0)) continue;
      const glm::dvec2 right = glm::dvec2(along.y, -along.x) / length * 0.05;
      if (inside(middle)) seaward.push_back(middle + right), landward.push_back(middle - right);
    }
    if (const glm::dvec2 whole = coast.back() - coast.front(); glm::length(whole) > 1) {
      const glm::dvec2 way = glm::normalize(whole) * beyond;
      if (inside(coast.front())) coast.insert(coast.begin(), coast.front() - way);
      if (inside(coast.back())) coast.push_back(coast.back() + way);
    }
    lines.push_back(std::move(coast));
  }
  const double level = place.a.options.shift.z - place.a.city.origin.z;
  size_t unclear = 0;
  for (const Polygon& face : polygonise(lines)) {
    const auto holds = [&](glm::dvec2 p) { return insidePolygon(face, p); };
    glm::dvec2 faceLow(INFINITY), faceHigh(-INFINITY);
    for (const glm::dvec2& q : face.rings[0]) faceLow = glm::min(faceLow, q), faceHigh = glm::max(faceHigh, q);
    if (faceHigh.x <= low.x || faceHigh.y <= low.y || faceLow.x >= high.x || faceLow.y >= high.y) continue;
    if (!std::any_of(seaward.begin(), seaward.end(), holds)) continue;
    if (std::any_of(landward.begin(), landward.end(), holds)) {
      ++unclear;
      continue;
    }
    for (const Polygon& clean : cleanPolygon(face).polygons) addWaterBody(place, "sea", clean, level, kTide);
  }
  if (unclear > 0)
    place.a.diagnostics.warn(
        source.file, "coastline",
        counted(unclear, "piece of sea is", "pieces of sea are") + " left out: the coast lines about it do not close");
}

/// The plan that is shown: that of the buildings with a margin, else the terrain's.
city::Aabb shownPlan(const Assembly& a, city::Aabb box) {
  if (box.empty() && a.city.terrain) return a.city.terrain->bounds();
  if (box.empty()) return {glm::dvec3(-kMargin), glm::dvec3(kMargin)};
  box.min -= kMargin, box.max += kMargin;
  return box;
}

}  // namespace

void addWaters(Assembly& a, const std::vector<Source>& sources, const city::Aabb& box) {
  Place place{a, shownPlan(a, box)};
  for (const Source& s : sources) addSea(place, s);
  for (const Source& s : sources) addWater(place, s);
  if (a.city.terrain) a.city.terrain->updateRange();
}

void addSurroundings(Assembly& a, std::vector<Source>& sources, const city::Aabb& box) {
  Place place{a, shownPlan(a, box)};
  for (Source& s : sources) {
    addMeshes(place, s);
    addStreets(place, s);
    addWalls(place, s);
    addTrees(place, s);
  }
}

}  // namespace vicus::assets
