#include "facade/roof_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "city/random.hpp"
#include "facade/outline.hpp"
#include "facade/triangulate.hpp"

namespace vicus::facade {
namespace {

using city::BuildingBuilder;
using city::PlaneKind;
using glm::dvec2;
using glm::dvec3;

/// Triangles of a flat polygon in space; slivers that floats turn over are left out.
void addPolygon(BuildingBuilder& builder, std::span<const dvec3> polygon, dvec3 normal, dvec3 u,
                const PaintLook& look) {
  const dvec3 v = glm::cross(normal, u);
  std::vector<std::vector<dvec2>> plan(1);
  std::vector<glm::vec3> corners;
  std::vector<glm::vec2> uvs;
  for (const dvec3& p : polygon) {
    plan[0].emplace_back(glm::dot(p - polygon[0], u), glm::dot(p - polygon[0], v));
    corners.emplace_back(p);
    uvs.emplace_back(plan[0].back());
  }
  std::vector<uint32_t> triangles;
  const std::vector<uint32_t> all = triangulate(plan);
  for (size_t t = 0; t + 2 < all.size(); t += 3) {
    const glm::vec3 a = corners[all[t]], b = corners[all[t + 1]], c = corners[all[t + 2]];
    if (glm::dot(glm::cross(b - a, c - a), glm::vec3(normal)) > 1e-6f)
      triangles.insert(triangles.end(), {all[t], all[t + 1], all[t + 2]});
  }
  if (!triangles.empty()) builder.addTriangles(corners, uvs, triangles, glm::vec3(normal), look.material);
}

dvec3 newell(std::span<const dvec3> polygon) {
  dvec3 sum(0);
  for (size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

}  // namespace

void addRoofSlope(BuildingBuilder& builder, const RoofSurface& surface, double eaves, const PaintLook& covering,
                  std::vector<Slope>& slopes) {
  Slope slope{surface.ring, surface.edge, surface.polygon, {}};
  for (dvec3& p : slope.polygon) p.z += eaves;
  const dvec3 sum = newell(slope.polygon);
  if (!(glm::length(sum) > 1e-6)) return;
  slope.normal = glm::normalize(sum);
  // Courses run level.
  dvec3 u = glm::cross(dvec3(0, 0, 1), slope.normal);
  u = glm::length(u) > 1e-3 ? glm::normalize(u) : glm::normalize(slope.polygon[1] - slope.polygon[0]);
  builder.beginPlane(PlaneKind::Roof, covering.material, glm::vec3(slope.normal));
  addPolygon(builder, slope.polygon, slope.normal, u, covering);
  slopes.push_back(std::move(slope));
}

void addGable(BuildingBuilder& builder, const RoofSurface& surface, const WallFrame& frame, const WallDetail& detail,
              std::span<const PaintLook> looks, uint32_t plain) {
  std::vector<dvec3> polygon = surface.polygon;
  std::vector<dvec2> outline;
  for (dvec3& p : polygon) {
    p.z += frame.origin.z;
    outline.emplace_back(glm::dot(p - frame.origin, frame.along), p.z - frame.origin.z);
  }
  const dvec3 sum = newell(polygon);
  if (!(glm::length(sum) > 1e-6)) return;
  const PaintLook& look = looks[detail.fills.empty() ? plain : detail.fills[0].paint];
  builder.beginPlane(PlaneKind::Gable, look.material, glm::vec3(frame.normal()));
  addPolygon(builder, polygon, glm::normalize(sum), frame.along, look);
  for (Attachment a : detail.attachments) {
    const bool parapet = a.shape == Shape::Steps || a.shape == Shape::Bell;
    const Rect& r = a.rect;
    const dvec2 corners[] = {{r.left, r.bottom + 1e-3}, {r.right, r.bottom + 1e-3}, {r.right, r.top}, {r.left, r.top}};
    const bool within =
        std::all_of(std::begin(corners), std::end(corners), [&](dvec2 p) { return isInside(outline, p); });
    if (!within && !parapet) continue;
    if (a.shape == Shape::Opening) a.shape = Shape::Panel, a.depth = 0.02;
    addShape(builder, frame, a, looks, plain);
  }
}

void addFlatRoof(BuildingBuilder& builder, std::span<const Ring> rings, double z, double parapet,
                 const PaintLook& covering, const PaintLook& wall) {
  std::vector<std::vector<dvec2>> plan(rings.begin(), rings.end());
  std::vector<glm::vec3> corners;
  std::vector<glm::vec2> uvs;
  // Courses run along the longest edge.
  dvec2 u(1, 0);
  double longest = 0;
  for (size_t i = 0; i < rings[0].size(); ++i) {
    const dvec2 d = rings[0][(i + 1) % rings[0].size()] - rings[0][i];
    if (glm::length(d) > longest) longest = glm::length(d), u = d / longest;
  }
  for (const auto& ring : plan)
    for (const dvec2 p : ring) {
      corners.emplace_back(dvec3(p, z));
      uvs.emplace_back(glm::dot(p, u), glm::dot(p, dvec2(-u.y, u.x)));
    }
  builder.beginPlane(PlaneKind::Roof, covering.material, {0, 0, 1});
  builder.addTriangles(corners, uvs, triangulate(plan), {0, 0, 1}, covering.material);
  if (!(parapet > 0.01)) return;
  constexpr double kThick = 0.3;
  for (const Ring& ring : rings) {
    const std::vector<double> inward(ring.size(), -kThick);
    Ring inner;
    for (size_t i = 0; i < ring.size(); ++i) inner.push_back(movedCorner(ring, inward, i));
    const auto turned = [&](size_t i) {
      const size_t k = (i + 1) % ring.size();
      // Neither of the two triangles of its top may turn over, either.
      const auto half = [&](dvec2 a, dvec2 b, dvec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      };
      return !(glm::dot(ring[k] - ring[i], inner[k] - inner[i]) > 0 && half(ring[i], ring[k], inner[k]) > 1e-9 &&
               half(ring[i], inner[k], inner[i]) > 1e-9);
    };
    bool narrow = false;  // no room for a wall on both sides
    for (size_t i = 0; i < ring.size(); ++i) narrow = narrow || turned(i);
    if (narrow) continue;
    for (size_t i = 0; i < ring.size(); ++i) {
      const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = inner[(i + 1) % ring.size()], d = inner[i];
      const dvec2 along = glm::normalize(b - a);
      const auto at = [&](dvec2 p, double up) { return glm::vec3(dvec3(p, z + up)); };
      builder.beginPlane(PlaneKind::Other, wall.material, glm::vec3(along.y, -along.x, 0), false);
      builder.beginExternalGeometry(static_cast<float>(parapet));
      builder.addQuad(at(a, 0), at(b, 0), at(b, parapet), at(a, parapet), wall.material);
      builder.addQuad(at(a, parapet), at(b, parapet), at(c, parapet), at(d, parapet), wall.material);
      builder.addQuad(at(c, 0), at(d, 0), at(d, parapet), at(c, parapet), wall.material);
    }
  }
}

void addEaves(BuildingBuilder& builder, std::span<const Ring> rings, std::span<const std::vector<uint8_t>> party,
              const BuiltRoof& roof, double overhang, const PaintLook& covering, const PaintLook& board) {
  if (!(overhang > 0.02)) return;
  constexpr double kThick = 0.22;  // of the rafters' ends at the wall
  // The fall of the slope over each eave; none: no slope stands there.
  std::vector<std::vector<double>> fall, by;
  for (const Ring& ring : rings) fall.emplace_back(ring.size(), 0), by.emplace_back(ring.size(), 0);
  for (const Slope& s : roof.slopes) {
    const Ring& ring = rings[s.ring];
    const dvec3 a(ring[s.edge], roof.eaves);
    const bool atEave =
        std::any_of(s.polygon.begin(), s.polygon.end(), [&](dvec3 p) { return glm::length(p - a) < 1e-6; });
    if (!atEave || party[s.ring][s.edge] || !(s.normal.z > 0.05)) continue;
    const double tangent = std::sqrt(std::max(0.0, 1 - s.normal.z * s.normal.z)) / s.normal.z;
    by[s.ring][s.edge] = overhang, fall[s.ring][s.edge] = overhang * std::min(tangent, 1.0);
  }
  for (size_t r = 0; r < rings.size(); ++r) {
    const Ring& ring = rings[r];
    const size_t n = ring.size();
    for (size_t e = 0; e < n; ++e) {
      if (!(by[r][e] > 0)) continue;
      const size_t k = (e + 1) % n, before = (e + n - 1) % n;
      const dvec2 a = ring[e], b = ring[k];
      const double length = glm::length(b - a);
      if (!(length > 1e-3)) continue;
      const dvec2 along = (b - a) / length, out(along.y, -along.x);
      // Mitred with the next eave, but square where a sharp corner would draw the mitre out of the slope's line.
      const auto corner = [&](size_t i) {
        const dvec2 mitred = movedCorner(ring, by[r], i);
        const bool inLine = std::abs(glm::dot(mitred - ring[i], out) - overhang) < 1e-6;
        return inLine ? mitred : ring[i] + out * overhang;
      };
      const dvec2 c = corner(k), d = corner(e);
      if (!(glm::dot(b - a, c - d) > 0.1 * length * length)) continue;
      const double top = roof.eaves, rim = top - fall[r][e], low = rim - kThick;
      const auto at = [&](dvec2 p, double z) { return glm::vec3(dvec3(p, z)); };
      builder.beginPlane(PlaneKind::Other, covering.material, glm::vec3(along.y, -along.x, 0), false);
      builder.beginExternalGeometry(static_cast<float>(overhang));
      builder.addQuad(at(d, rim), at(c, rim), at(b, top), at(a, top), covering.material);
      builder.addQuad(at(a, low), at(b, low), at(c, rim), at(d, rim), board.material);
      // Where the next wall has no eave the end shows.
      const auto end = [&](glm::vec3 p, glm::vec3 q, glm::vec3 s, glm::vec3 u) {
        const glm::vec3 corners[] = {p, q, s};
        builder.addConvex(corners, u, {0, 0, 1}, board.material);
      };
      if (by[r][before] == 0) end(at(a, low), at(d, rim), at(a, top), {along.y, -along.x, 0});
      if (by[r][k] == 0) end(at(b, low), at(b, top), at(c, rim), {along.y, -along.x, 0});
    }
  }
}

void addChimney(BuildingBuilder& builder, const BuiltRoof& roof, const ChimneySize& size, const PaintLook& look,
                uint32_t seed) {
  if (!(size.width > 0.05 && size.depth > 0.05 && size.height > 0.05) || size.width > 10 || size.depth > 10 ||
      size.height > 20)
    return;
  // The longest ridge: an edge of a slope with both ends at the top.
  const double top = roof.eaves + roof.shape.height;
  dvec2 from(0), to(0);
  double longest = -1;
  for (const Slope& s : roof.slopes)
    for (size_t i = 0; i < s.polygon.size(); ++i) {
      const dvec3 a = s.polygon[i], b = s.polygon[(i + 1) % s.polygon.size()];
      if (std::abs(a.z - top) > 1e-3 || std::abs(b.z - top) > 1e-3) continue;
      if (glm::length(dvec2(b - a)) > longest) longest = glm::length(dvec2(b - a)), from = a, to = b;
    }
  if (longest < 2 * size.width) return;
  city::Random random(seed);
  if (random.uniform() < 0.5) std::swap(from, to);
  const dvec2 along = glm::normalize(to - from);
  const dvec2 middle = from + along * (size.width / 2 + 0.15 + random.uniform(0, 0.25) * (longest - 2 * size.width));
  const glm::vec3 x(along.x, along.y, 0), y(-along.y, along.x, 0);
  builder.beginPlane(PlaneKind::Other, look.material, {0, 0, 1}, false);
  builder.beginExternalGeometry(static_cast<float>(size.height));
  const float w = static_cast<float>(size.width / 2), d = static_cast<float>(size.depth / 2);
  builder.addBox(glm::vec3(dvec3(middle, top)), x, y, {0, 0, 1}, {-w, -d, -0.8f - d},
                 {w, d, static_cast<float>(size.height)}, look.material, 0x2f);
}

std::vector<PlacedDormer> dormerPlaces(const BuiltRoof& roof, std::span<const std::vector<Face>> faces,
                                       const DormerSize& size) {
  std::vector<PlacedDormer> out;
  if (!(size.width > 0.2 && size.height > 0.2 && size.spacing >= size.width)) return out;
  constexpr double kSetBack = 0.5;
  constexpr size_t kMost = 40;
  for (const Slope& s : roof.slopes) {
    if (s.ring > 0 || s.edge >= faces[0].size() || faces[0][s.edge] != Face::Front || !(s.normal.z > 0.2)) continue;
    const double tangent = std::sqrt(std::max(0.0, 1 - s.normal.z * s.normal.z)) / s.normal.z;
    const dvec3 a = s.polygon[0], b = s.polygon[1];
    if (tangent < 0.3 || std::abs(a.z - roof.eaves) > 1e-6 || std::abs(b.z - roof.eaves) > 1e-6) continue;
    const double length = glm::length(b - a);
    const dvec2 along = dvec2(b - a) / length, inward(-along.y, along.x);
    std::vector<dvec2> plan;
    for (const dvec3& p : s.polygon) plan.emplace_back(p);
    const double rise = size.height + size.width / 2 * 0.7, back = kSetBack + rise / tangent;
    const auto count = static_cast<int>(std::min(20.0, std::floor(length / size.spacing)));
    for (int i = 0; i < count && out.size() < kMost; ++i) {
      const dvec2 left = dvec2(a) + along * (length * (i + 0.5) / count - size.width / 2);
      const dvec2 corners[] = {left + inward * kSetBack, left + along * size.width + inward * kSetBack,
                               left + along * (size.width / 2) + inward * (back + 0.1),
                               left + inward * (kSetBack + size.height / tangent),
                               left + along * size.width + inward * (kSetBack + size.height / tangent)};
      if (std::all_of(std::begin(corners), std::end(corners), [&](dvec2 p) { return isInside(plan, p); }))
        out.push_back({dvec3(corners[0], roof.eaves + kSetBack * tangent), along, tangent});
    }
  }
  return out;
}

void addDormer(BuildingBuilder& builder, const PlacedDormer& place, const DormerSize& size, const WallDetail& detail,
               std::span<const PaintLook> looks, const PaintLook& covering, uint32_t plain) {
  WallFrame frame;
  frame.origin = place.origin, frame.along = dvec3(place.along, 0);
  frame.width = size.width, frame.height = size.height;
  const double w = size.width, h = size.height, ridge = h + w / 2 * 0.7;
  const auto behind = [&](double y) { return -y / place.tangent; };
  const PaintLook& wall = looks[detail.fills.empty() ? plain : detail.fills[0].paint];
  builder.beginPlane(PlaneKind::Other, wall.material, glm::vec3(frame.normal()), false);
  builder.beginExternalGeometry(static_cast<float>(size.height));
  builder.addQuad(frame.at(0, 0), frame.at(w, 0), frame.at(w, h), frame.at(0, h), wall.material);
  const auto triangle = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, dvec3 u) {
    const glm::vec3 corners[] = {a, b, c};
    builder.addConvex(corners, glm::vec3(u), {0, 0, 1}, wall.material);
  };
  triangle(frame.at(0, h), frame.at(w, h), frame.at(w / 2, ridge), frame.along);
  triangle(frame.at(0, h, behind(h)), frame.at(0, 0), frame.at(0, h), -frame.normal());
  triangle(frame.at(w, 0), frame.at(w, h, behind(h)), frame.at(w, h), frame.normal());
  // The roof hangs a hand's breadth over the face.
  constexpr double kOver = 0.12;
  builder.addQuad(frame.at(-kOver, h - 0.7 * kOver, kOver), frame.at(w / 2, ridge, kOver),
                  frame.at(w / 2, ridge, behind(ridge)), frame.at(-kOver, h - 0.7 * kOver, behind(h)),
                  covering.material);
  builder.addQuad(frame.at(w / 2, ridge, kOver), frame.at(w + kOver, h - 0.7 * kOver, kOver),
                  frame.at(w + kOver, h - 0.7 * kOver, behind(h)), frame.at(w / 2, ridge, behind(ridge)),
                  covering.material);
  for (Attachment a : detail.attachments) {
    if (a.shape == Shape::Opening) a.shape = Shape::Panel, a.depth = 0.02;
    addShape(builder, frame, a, looks, plain);
  }
}

}  // namespace vicus::facade
