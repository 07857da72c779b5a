#include "assets/norvic/wall_kit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vicus::assets::norvic {

using city::BuildingBuilder;
using city::MaterialId;
using city::PlaneKind;
using glm::vec2;
using glm::vec3;

namespace {

constexpr float kSmall = 1e-4f;  // metres: what is narrower is nothing

/// A piece of wall between holes, in a strip of one height.
struct Piece {
  float v0, v1;
  float left0, right0, left1, right1;
};

/// Points along the foot or the top of a piece where neighbours above or below have corners.
std::vector<float> breaks(float from, float to, float v, const std::vector<Piece>& pieces) {
  std::vector<float> out{from};
  for (const Piece& p : pieces) {
    if (std::abs(p.v0 - v) < kSmall) out.push_back(p.left0), out.push_back(p.right0);
    if (std::abs(p.v1 - v) < kSmall) out.push_back(p.left1), out.push_back(p.right1);
  }
  std::erase_if(out, [&](float u) { return u < from - kSmall || u > to + kSmall; });
  out.push_back(to);
  std::sort(out.begin(), out.end());
  std::vector<float> distinct;
  for (const float u : out)
    if (distinct.empty() || u - distinct.back() > kSmall) distinct.push_back(u);
  if (distinct.size() > 1) distinct.back() = to;
  return distinct;
}

std::vector<Piece> piecesBetweenHoles(std::span<const WallBand> bands, std::span<const WallHole> holes) {
  std::vector<float> levels;
  for (const WallBand& b : bands) levels.insert(levels.end(), {b.v0, b.v1});
  for (const WallHole& h : holes) levels.insert(levels.end(), {h.v0, h.v1});
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end(), [](float a, float b) { return b - a < kSmall; }),
               levels.end());

  std::vector<Piece> pieces;
  for (size_t k = 1; k < levels.size(); ++k) {
    const float v0 = levels[k - 1], v1 = levels[k], middle = 0.5f * (v0 + v1);
    const auto band =
        std::find_if(bands.begin(), bands.end(), [&](const WallBand& b) { return b.v0 <= middle && middle <= b.v1; });
    if (band == bands.end()) continue;
    const auto edge = [&](float at, float foot, float top) {
      return foot + (top - foot) * std::clamp((at - band->v0) / (band->v1 - band->v0), 0.0f, 1.0f);
    };
    std::vector<WallHole> here;
    for (const WallHole& h : holes)
      if (h.v0 < middle && middle < h.v1) here.push_back(h);
    std::sort(here.begin(), here.end(), [](const WallHole& a, const WallHole& b) { return a.u0 < b.u0; });
    Piece open{v0, v1, edge(v0, band->left0, band->left1), 0, edge(v1, band->left0, band->left1), 0};
    for (const WallHole& h : here) {
      open.right0 = open.right1 = h.u0;
      pieces.push_back(open);
      open.left0 = open.left1 = h.u1;
    }
    open.right0 = edge(v0, band->right0, band->right1);
    open.right1 = edge(v1, band->right0, band->right1);
    pieces.push_back(open);
  }
  return pieces;
}

}  // namespace

void addWall(BuildingBuilder& builder, const WallFrame& frame, std::span<const WallBand> bands,
             std::span<const WallHole> holes, MaterialId material) {
  const std::vector<Piece> pieces = piecesBetweenHoles(bands, holes);
  std::vector<vec3> positions;
  std::vector<vec2> uvs;
  std::vector<uint32_t> triangles;
  const auto point = [&](float u, float v) {
    positions.push_back(frame.at(u, v));
    uvs.emplace_back(u, v);
    return static_cast<uint32_t>(positions.size() - 1);
  };
  for (const Piece& p : pieces) {
    const std::vector<float> foot = breaks(p.left0, p.right0, p.v0, pieces);
    const std::vector<float> top = breaks(p.left1, p.right1, p.v1, pieces);
    if (foot.size() < 2 && top.size() < 2) continue;
    std::vector<uint32_t> below, above;
    for (const float u : foot) below.push_back(point(u, p.v0));
    for (const float u : top) above.push_back(point(u, p.v1));
    // Zip the two chains together, each time advancing the one that lags.
    size_t i = 0, j = 0;
    while (i + 1 < below.size() || j + 1 < above.size()) {
      const bool advanceFoot = j + 1 >= above.size() || (i + 1 < below.size() && foot[i + 1] <= top[j + 1]);
      if (advanceFoot) {
        triangles.insert(triangles.end(), {below[i], below[i + 1], above[j]});
        ++i;
      } else {
        triangles.insert(triangles.end(), {below[i], above[j + 1], above[j]});
        ++j;
      }
    }
  }
  builder.beginCut();
  builder.addTriangles(positions, uvs, triangles, frame.normal(), material);
  if (holes.empty()) return;

  builder.beginFlat();
  for (const WallBand& b : bands) {
    const vec2 corners[] = {{b.left0, b.v0}, {b.right0, b.v0}, {b.right1, b.v1}, {b.left1, b.v1}};
    positions.clear(), uvs.clear();
    for (const vec2 c : corners) positions.push_back(frame.at(c.x, c.y)), uvs.push_back(c);
    static constexpr uint32_t kQuad[] = {0, 1, 2, 0, 2, 3};
    const bool pointed = b.right1 - b.left1 < kSmall;
    builder.addTriangles(positions, uvs, std::span(kQuad, pointed ? 3 : 6), frame.normal(), material);
  }
}

void addOpening(BuildingBuilder& builder, const WallFrame& f, const WallHole& h, float depth, MaterialId pane,
                MaterialId reveal, float front) {
  builder.beginExternalOpening(depth);
  const float back = -depth;
  builder.addQuad(f.at(h.u0, h.v0, front), f.at(h.u0, h.v0, back), f.at(h.u0, h.v1, back), f.at(h.u0, h.v1, front),
                  reveal);
  builder.addQuad(f.at(h.u1, h.v0, back), f.at(h.u1, h.v0, front), f.at(h.u1, h.v1, front), f.at(h.u1, h.v1, back),
                  reveal);
  builder.addQuad(f.at(h.u0, h.v1, back), f.at(h.u1, h.v1, back), f.at(h.u1, h.v1, front), f.at(h.u0, h.v1, front),
                  reveal);
  builder.addQuad(f.at(h.u0, h.v0, front), f.at(h.u1, h.v0, front), f.at(h.u1, h.v0, back), f.at(h.u0, h.v0, back),
                  reveal);
  builder.addQuad(f.at(h.u0, h.v0, back), f.at(h.u1, h.v0, back), f.at(h.u1, h.v1, back), f.at(h.u0, h.v1, back), pane);
}

void addBar(BuildingBuilder& builder, const WallFrame& f, const WallHole& area, float depth, MaterialId material,
            unsigned sides) {
  constexpr unsigned kFront = 4;
  builder.addBox(f.origin, f.u, -f.normal(), {0, 0, 1}, {area.u0, -depth, area.v0}, {area.u1, 0, area.v1}, material,
                 kFront | sides);
}

void addBrace(BuildingBuilder& builder, const WallFrame& f, vec2 from, vec2 to, float width, float depth,
              MaterialId material) {
  const vec2 along = glm::normalize(to - from);
  const vec3 x = f.u * along.x + vec3(0, 0, along.y);
  const vec3 z = f.u * -along.y + vec3(0, 0, along.x);
  constexpr unsigned kFrontAndLongSides = 4 | 16 | 32;
  builder.addBox(f.at(from.x, from.y), x, -f.normal(), z, {0, -depth, -0.5f * width},
                 {glm::length(to - from), 0, 0.5f * width}, material, kFrontAndLongSides);
}

void addSurround(BuildingBuilder& builder, const WallFrame& f, const WallHole& h, float width, float depth,
                 MaterialId material, bool sill) {
  builder.beginExternalGeometry(depth);
  const float foot = sill ? h.v0 - width : h.v0;
  addBar(builder, f, {h.u0 - width, h.u0, foot, h.v1 + width}, depth, material, kLeft);
  addBar(builder, f, {h.u1, h.u1 + width, foot, h.v1 + width}, depth, material, kRight);
  addBar(builder, f, {h.u0, h.u1, h.v1, h.v1 + width}, depth, material, kAbove);
  if (!sill) return;
  builder.beginExternalGeometry(depth + 0.07f);
  addBar(builder, f, {h.u0 - width, h.u1 + width, h.v0 - width, h.v0}, depth + 0.07f, material, kAbove | kBelow);
}

void addQuadFacing(BuildingBuilder& builder, vec3 a, vec3 b, vec3 c, vec3 d, vec3 outward, MaterialId material) {
  const vec3 u = glm::normalize(b - a);
  const vec3 v = glm::normalize((d - a) - u * glm::dot(d - a, u));
  const auto uv = [&](vec3 p) { return vec2(glm::dot(p - a, u), glm::dot(p - a, v)); };
  const vec2 uvs[4] = {uv(a), uv(b), uv(c), uv(d)};
  if (glm::dot(glm::cross(c - a, d - b), outward) > 0)
    builder.addQuad({a, b, c, d}, uvs, material);
  else
    builder.addQuad({a, d, c, b}, {uvs[0], uvs[3], uvs[2], uvs[1]}, material);
}

void addTriangleFacing(BuildingBuilder& builder, vec3 a, vec3 b, vec3 c, vec3 outward, MaterialId material) {
  vec3 normal = glm::cross(b - a, c - a);
  const float length = glm::length(normal);
  if (!(length > 1e-9f)) return;
  normal /= length;
  const vec3 u = glm::normalize(b - a);
  const vec3 v = glm::normalize((c - a) - u * glm::dot(c - a, u));
  const bool front = glm::dot(normal, outward) > 0;
  const vec3 positions[] = {a, b, c};
  const vec2 uvs[] = {{0, 0}, {glm::length(b - a), 0}, {glm::dot(c - a, u), glm::dot(c - a, v)}};
  static constexpr uint32_t kFront[] = {0, 1, 2}, kBack[] = {0, 2, 1};
  builder.addTriangles(positions, uvs, front ? kFront : kBack, front ? normal : -normal, material);
}

void addGableRoof(BuildingBuilder& builder, const RoofShape& r) {
  const vec3 across(-r.ridge.y, r.ridge.x, 0);
  const float up = r.thicknessUp();
  const float span = r.halfSpan + r.overhang;
  const float eaves = -r.overhang * r.slope;
  const float length = r.halfLength + r.verge;
  const auto at = [&](float along, float side, float z) {
    return r.centre + r.ridge * along + across * side + vec3(0, 0, z);
  };
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 normal = glm::normalize(across * (side * r.slope) + vec3(0, 0, 1));
    builder.beginPlane(PlaneKind::Roof, r.covering, normal);
    addQuadFacing(builder, at(-length, side * span, eaves + up), at(length, side * span, eaves + up),
                  at(length, 0, r.rise() + up), at(-length, 0, r.rise() + up), normal, r.covering);
  }
  // The underside and the edges show the roof's thickness.
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 normal = glm::normalize(across * (side * r.slope) + vec3(0, 0, 1));
    builder.beginPlane(PlaneKind::Other, r.edge, -normal, false);
    addQuadFacing(builder, at(-length, side * span, eaves), at(length, side * span, eaves), at(length, 0, r.rise()),
                  at(-length, 0, r.rise()), -normal, r.edge);
    addQuadFacing(builder, at(-length, side * span, eaves), at(length, side * span, eaves),
                  at(length, side * span, eaves + up), at(-length, side * span, eaves + up), across * side, r.edge);
    for (const float end : {-1.0f, 1.0f})
      addQuadFacing(builder, at(end * length, side * span, eaves), at(end * length, 0, r.rise()),
                    at(end * length, 0, r.rise() + up), at(end * length, side * span, eaves + up), r.ridge * end,
                    r.edge);
  }
}

void addHipRoof(BuildingBuilder& builder, const RoofShape& r) {
  const vec3 across(-r.ridge.y, r.ridge.x, 0);
  const float up = r.thicknessUp();
  const float span = r.halfSpan + r.overhang, length = r.halfLength + r.overhang;
  const float eaves = -r.overhang * r.slope;
  const float top = r.rise() + up;
  const float ridgeEnd = std::max(0.0f, r.halfLength - r.halfSpan);
  const auto at = [&](float along, float side, float z) {
    return r.centre + r.ridge * along + across * side + vec3(0, 0, z);
  };
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 normal = glm::normalize(across * (side * r.slope) + vec3(0, 0, 1));
    builder.beginPlane(PlaneKind::Roof, r.covering, normal);
    if (ridgeEnd > kSmall)
      addQuadFacing(builder, at(-length, side * span, eaves + up), at(length, side * span, eaves + up),
                    at(ridgeEnd, 0, top), at(-ridgeEnd, 0, top), normal, r.covering);
    else
      addTriangleFacing(builder, at(-length, side * span, eaves + up), at(length, side * span, eaves + up),
                        at(0, 0, top), normal, r.covering);
  }
  for (const float end : {-1.0f, 1.0f}) {
    const vec3 normal = glm::normalize(r.ridge * (end * r.slope) + vec3(0, 0, 1));
    builder.beginPlane(PlaneKind::Roof, r.covering, normal);
    addTriangleFacing(builder, at(end * length, -span, eaves + up), at(end * length, span, eaves + up),
                      at(end * ridgeEnd, 0, top), normal, r.covering);
  }
  builder.beginPlane(PlaneKind::Other, r.edge, {0, 0, -1}, false);
  for (const float side : {-1.0f, 1.0f}) {
    const vec3 out = across * side;
    addQuadFacing(builder, at(-length, side * span, eaves), at(length, side * span, eaves),
                  at(length, side * span, eaves + up), at(-length, side * span, eaves + up), out, r.edge);
    addQuadFacing(builder, at(-length, side * span, eaves), at(length, side * span, eaves),
                  at(r.halfLength, side * r.halfSpan, 0), at(-r.halfLength, side * r.halfSpan, 0), {0, 0, -1}, r.edge);
  }
  for (const float end : {-1.0f, 1.0f}) {
    const vec3 out = r.ridge * end;
    addQuadFacing(builder, at(end * length, -span, eaves), at(end * length, span, eaves),
                  at(end * length, span, eaves + up), at(end * length, -span, eaves + up), out, r.edge);
    addQuadFacing(builder, at(end * length, -span, eaves), at(end * length, span, eaves),
                  at(end * r.halfLength, r.halfSpan, 0), at(end * r.halfLength, -r.halfSpan, 0), {0, 0, -1}, r.edge);
  }
}

void addChimney(BuildingBuilder& builder, vec2 centre, vec2 half, float bottom, float top, MaterialId material) {
  const vec3 origin(centre, 0);
  const vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const vec3 normals[4] = {-x, x, -y, y};
  const float cap = 0.18f;
  for (unsigned face = 0; face < 4; ++face) {
    builder.beginPlane(PlaneKind::Wall, material, normals[face]);
    builder.addBox(origin, x, y, z, {-half.x, -half.y, bottom}, {half.x, half.y, top - cap}, material, 1u << face);
  }
  builder.beginPlane(PlaneKind::Other, material, z, false);
  const float lip = 0.06f;
  builder.addBox(origin, x, y, z, {-half.x - lip, -half.y - lip, top - cap}, {half.x + lip, half.y + lip, top},
                 material);
}

}  // namespace vicus::assets::norvic
