/// The monuments are made with the same walls, openings and roofs as houses, then kept as plain meshes.
#include "assets/norvic/monuments.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "assets/norvic/palette.hpp"
#include "assets/norvic/wall_kit.hpp"

namespace vicus::assets::norvic {
namespace {

using city::BuildingBuilder;
using city::MaterialId;
using city::PlaneKind;
using glm::dvec2;
using glm::dvec3;
using glm::vec2;
using glm::vec3;

constexpr float kFoundation = -2.5f;  // metres: monuments are long, the ground under them slopes

/// Full detail of a building as a mesh that nothing slides on, `lift` metres higher in its frame.
city::MeshGeometry asMesh(BuildingBuilder& builder, std::string name, float lift = 0) {
  const city::BuildingGeometry g = builder.finish();
  city::MeshGeometry out;
  out.name = std::move(name);
  std::vector<uint32_t> place(g.vertices.size(), city::kNone);  // the flat surfaces' vertices are left out
  for (uint32_t i = 0; i < g.fullDetail.count; ++i) {
    uint32_t& at = place[g.indices[i]];
    if (at == city::kNone) {
      at = static_cast<uint32_t>(out.mesh.vertices.size());
      city::Vertex v = g.vertices[g.indices[i]];
      v.item = 0, v.slide = 0;
      v.position.z += lift;
      out.mesh.vertices.push_back(v);
      out.bounds.extend(v.position);
    }
    out.mesh.indices.push_back(at);
  }
  return out;
}

/// Window bays of a long wall.
struct Bays {
  int count = 0;
  float width = 1, sill = 1, head = 3;
};

/// A wall from u0 to u1 with evenly spaced tall windows, each with a surround and bars.
void addBayWall(BuildingBuilder& b, const WallFrame& frame, float u0, float u1, float v0, float v1, const Bays& bays,
                MaterialId wall, MaterialId dressing) {
  b.beginPlane(PlaneKind::Wall, wall, frame.normal());
  std::vector<WallHole> holes;
  for (int i = 0; i < bays.count; ++i) {
    const float centre = u0 + (u1 - u0) * (static_cast<float>(i) + 0.5f) / static_cast<float>(bays.count);
    holes.push_back({centre - 0.5f * bays.width, centre + 0.5f * bays.width, bays.sill, bays.head});
  }
  const WallBand band{v0, v1, u0, u1, u0, u1};
  addWall(b, frame, {&band, 1}, holes, wall);
  for (const WallHole& h : holes) {
    addOpening(b, frame, h, 0.45f, kLeadGlass, dressing, 0.08f);
    addSurround(b, frame, h, 0.22f, 0.08f, dressing, true);
    // Stone bars: one for each metre and a half of width.
    const int bars = static_cast<int>(bays.width / 1.3f);
    for (int k = 1; k <= bars; ++k) {
      const float u = h.u0 + (h.u1 - h.u0) * static_cast<float>(k) / static_cast<float>(bars + 1);
      b.addBox(frame.at(0, 0, -0.35f), frame.u, -frame.normal(), {0, 0, 1}, {u - 0.07f, -0.2f, h.v0},
               {u + 0.07f, 0, h.v1}, dressing, 1 | 2 | 4);
    }
  }
}

/// The four frames of a box's walls, u = 0 in the middle of each: front (−y), right, back, left.
struct BoxFrames {
  WallFrame front, right, back, left;
};
BoxFrames framesOf(vec2 min, vec2 max) {
  const vec2 c = 0.5f * (min + max);
  return {{{c.x, min.y, 0}, {1, 0, 0}},
          {{max.x, c.y, 0}, {0, 1, 0}},
          {{c.x, max.y, 0}, {-1, 0, 0}},
          {{min.x, c.y, 0}, {0, -1, 0}}};
}

/// Merlons along a wall's top from u0 to u1, `thick` metres deep behind its face.
void addMerlons(BuildingBuilder& b, const WallFrame& frame, float u0, float u1, float top, float thick,
                MaterialId material, float width = 1.1f, float height = 0.9f) {
  const int count = std::max(1, static_cast<int>((u1 - u0 + 0.8f) / (2 * width - 0.2f)));
  const float pitch = (u1 - u0) / static_cast<float>(count);
  for (int i = 0; i < count; ++i) {
    const float c = u0 + pitch * (static_cast<float>(i) + 0.5f);
    b.addBox(frame.origin, frame.u, -frame.normal(), {0, 0, 1}, {c - 0.5f * width, 0, top},
             {c + 0.5f * width, thick, top + height}, material, 0x2f);
  }
}

/// A square tower with a flat top and battlements.
void addTower(BuildingBuilder& b, vec2 min, vec2 max, float top, const Bays& windows, MaterialId wall,
              MaterialId dressing) {
  const BoxFrames f = framesOf(min, max);
  const vec2 half = 0.5f * (max - min);
  for (const auto& [frame, h] : {std::pair{f.front, half.x}, {f.right, half.y}, {f.back, half.x}, {f.left, half.y}}) {
    addBayWall(b, frame, -h, h, kFoundation, top, windows, wall, dressing);
    b.beginPlane(PlaneKind::Other, wall, frame.normal(), false);
    addMerlons(b, frame, -h, h, top, 0.5f, wall);
  }
  b.beginPlane(PlaneKind::Roof, kLead, {0, 0, 1});
  addQuadFacing(b, {min.x, min.y, top}, {max.x, min.y, top}, {max.x, max.y, top}, {min.x, max.y, top}, {0, 0, 1},
                kLead);
}

/// A body with walls of bays and a gable roof along x; its ends are gables.
struct Body {
  vec2 min{0}, max{0};
  float eaves = 6;
  float slope = 1.1f;
  Bays bays;
  Bays endWindow;  ///< of the gable ends
  MaterialId wall = kAshlar, dressing = kAshlar, roof = kLead;
  bool west = true, east = true;  ///< which ends have a wall
  float foot = kFoundation;
  bool sides = true;
};

void addBody(BuildingBuilder& b, const Body& body, bool alongX = true) {
  const BoxFrames f = framesOf(body.min, body.max);
  const vec2 half = 0.5f * (body.max - body.min);
  const float length = alongX ? half.x : half.y, span = alongX ? half.y : half.x;
  const WallFrame sides[2] = {alongX ? f.front : f.right, alongX ? f.back : f.left};
  const WallFrame ends[2] = {alongX ? f.left : f.front, alongX ? f.right : f.back};
  if (body.sides)
    for (const WallFrame& side : sides)
      addBayWall(b, side, -length, length, body.foot, body.eaves, body.bays, body.wall, body.dressing);
  for (int e = 0; e < 2; ++e) {
    if (!(e == 0 ? body.west : body.east)) continue;
    b.beginPlane(PlaneKind::Gable, body.wall, ends[e].normal());
    const WallBand bands[] = {{body.foot, body.eaves, -span, span, -span, span},
                              {body.eaves, body.eaves + span * body.slope, -span, span, 0, 0}};
    std::vector<WallHole> holes;
    if (body.endWindow.count > 0)
      holes.push_back(
          {-0.5f * body.endWindow.width, 0.5f * body.endWindow.width, body.endWindow.sill, body.endWindow.head});
    addWall(b, ends[e], bands, holes, body.wall);
    for (const WallHole& h : holes) {
      addOpening(b, ends[e], h, 0.45f, kLeadGlass, body.dressing, 0.1f);
      addSurround(b, ends[e], h, 0.3f, 0.1f, body.dressing, true);
    }
  }
  RoofShape r;
  r.centre = vec3(0.5f * (body.min + body.max), body.eaves);
  r.ridge = alongX ? vec3(1, 0, 0) : vec3(0, 1, 0);
  r.halfLength = length, r.halfSpan = span;
  r.slope = body.slope;
  r.overhang = 0.3f, r.verge = 0.15f, r.thickness = 0.2f;
  r.covering = body.roof, r.edge = body.dressing;
  addGableRoof(b, r);
}

/// A pyramid over a square or an octagon.
void addSpire(BuildingBuilder& b, vec2 centre, float radius, float bottom, float top, int sides, MaterialId material) {
  const float turn = 6.2831853f / static_cast<float>(sides);
  for (int i = 0; i < sides; ++i) {
    const float a = turn * (static_cast<float>(i) - 0.5f), c = turn * (static_cast<float>(i) + 0.5f);
    const vec3 p(centre + radius * vec2(std::cos(a), std::sin(a)), bottom);
    const vec3 q(centre + radius * vec2(std::cos(c), std::sin(c)), bottom);
    const vec3 tip(centre, top);
    const vec3 out(std::cos(0.5f * (a + c)), std::sin(0.5f * (a + c)), 0.2f);
    b.beginPlane(PlaneKind::Roof, material, glm::normalize(out));
    addTriangleFacing(b, p, q, tip, out, material);
  }
}

void addBox(BuildingBuilder& b, vec3 min, vec3 max, MaterialId material, unsigned faces = 0x3f) {
  b.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, min, max, material, faces);
}

/// A door with its surround in the middle of a wall that is already there: the leaf stands before it.
void addPortal(BuildingBuilder& b, const WallFrame& frame, float centre, float width, float height,
               MaterialId dressing) {
  b.beginPlane(PlaneKind::Other, dressing, frame.normal(), false);
  const WallHole h{centre - 0.5f * width, centre + 0.5f * width, -1.0f, height};
  addBar(b, frame, {h.u0 - 0.5f, h.u0, h.v0, h.v1 + 0.5f}, 0.5f, dressing, kEnds | kAbove);
  addBar(b, frame, {h.u1, h.u1 + 0.5f, h.v0, h.v1 + 0.5f}, 0.5f, dressing, kEnds | kAbove);
  addBar(b, frame, {h.u0, h.u1, h.v1, h.v1 + 0.5f}, 0.5f, dressing, kBelow | kAbove);
  addBar(b, frame, h, 0.1f, kDoor, 0);
  // A small gable over it.
  addTriangleFacing(b, frame.at(h.u0 - 0.5f, h.v1 + 0.5f, 0.5f), frame.at(h.u1 + 0.5f, h.v1 + 0.5f, 0.5f),
                    frame.at(centre, h.v1 + 0.5f + 0.7f * width, 0.5f), frame.normal(), dressing);
}

// --- churches --------------------------------------------------------------------------------------------------------

city::MeshGeometry makeChurch(int variant) {
  BuildingBuilder b("church");
  const MaterialId wall = variant == 1 ? kRubble : kFlint;
  const MaterialId roof = variant == 2 ? kSlate : kLead;
  Body nave;
  nave.min = {-8, -4.5f}, nave.max = {9, 4.5f};
  nave.eaves = 7, nave.slope = 0.9f;
  nave.bays = {4, 1.6f, 2.2f, 5.8f};
  nave.wall = wall, nave.roof = roof;
  addBody(b, nave);
  Body chancel = nave;
  chancel.min = {9, -3.2f}, chancel.max = {17, 3.2f};
  chancel.eaves = 5;
  chancel.bays = {2, 1.2f, 1.8f, 4.2f};
  chancel.endWindow = {1, 2.6f, 1.8f, 5.0f};
  chancel.west = false;
  addBody(b, chancel);
  const vec2 towerMin(-13.6f, -2.9f), towerMax(-7.8f, 2.9f);
  const float top = variant == 0 ? 19.0f : variant == 1 ? 15.0f : 17.0f;
  addTower(b, towerMin, towerMax, top, {1, 1.3f, top - 4.2f, top - 1.4f}, wall, kAshlar);
  if (variant > 0)
    addSpire(b, {-10.7f, 0}, 3.2f, top, top + (variant == 1 ? 12.0f : 5.5f), variant == 1 ? 8 : 4,
             variant == 1 ? kLead : kTile);
  // Buttresses at the nave, and a porch on the south side.
  b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, 1}, false);
  for (const float side : {-1.0f, 1.0f})
    for (int i = 0; i <= 4; ++i) {
      const float x = -8 + 17.0f * static_cast<float>(i) / 4;
      const float y0 = side < 0 ? -5.4f : 4.5f;
      addBox(b, {x - 0.35f, y0, kFoundation}, {x + 0.35f, y0 + 0.9f, 5.4f}, kAshlar, 0x2f);
    }
  Body porch;
  porch.min = {-5.4f, -7.6f}, porch.max = {-2.2f, -4.4f};
  porch.eaves = 2.9f, porch.slope = 1.1f;
  porch.wall = wall, porch.roof = roof;
  porch.east = false;
  addBody(b, porch, false);
  addPortal(b, {{-3.8f, -7.6f, 0}, {1, 0, 0}}, 0, 1.6f, 2.3f, kAshlar);
  return asMesh(b, "parish church " + std::to_string(variant + 1));
}

// --- cathedral -------------------------------------------------------------------------------------------------------

city::MeshGeometry makeCathedral() {
  BuildingBuilder b("cathedral");
  constexpr float kAisle = 8.5f, kNave = 6.2f, kWest = -64, kEast = 52, kCrossing = 8;
  // Nave and choir: the high walls stand above the aisles' roofs.
  Body high;
  high.min = {kWest, -kNave}, high.max = {kEast, kNave};
  high.eaves = 21, high.slope = 1.25f, high.foot = 12;
  high.bays = {15, 2.6f, 14.2f, 19.6f};
  high.sides = true;
  high.west = high.east = false;
  addBody(b, high);
  const BoxFrames ends = framesOf(high.min, high.max);
  for (const WallFrame& end : {ends.left, ends.right}) {
    b.beginPlane(PlaneKind::Gable, kAshlar, end.normal());
    const WallBand bands[] = {{kFoundation, 21, -kNave, kNave, -kNave, kNave},
                              {21, 21 + kNave * 1.25f, -kNave, kNave, 0, 0}};
    const WallHole window{-3.6f, 3.6f, 7.5f, 18.5f};
    addWall(b, end, bands, {&window, 1}, kAshlar);
    addOpening(b, end, window, 0.6f, kLeadGlass, kAshlar, 0.15f);
    addSurround(b, end, window, 0.4f, 0.15f, kAshlar, true);
    for (int k = 1; k < 5; ++k)
      b.addBox(end.at(0, 0, -0.4f), end.u, -end.normal(), {0, 0, 1},
               {-3.6f + 1.44f * static_cast<float>(k) - 0.1f, -0.25f, 7.5f},
               {-3.6f + 1.44f * static_cast<float>(k) + 0.1f, 0, 18.5f}, kAshlar, 1 | 2 | 4);
  }
  // Aisles with lean-to roofs, their buttresses with pinnacles, and flying arches to the high wall.
  const float aisleWall = kNave + kAisle;
  for (const float side : {-1.0f, 1.0f}) {
    const WallFrame wall =
        side < 0 ? WallFrame{{0, -aisleWall, 0}, {1, 0, 0}} : WallFrame{{0, aisleWall, 0}, {-1, 0, 0}};
    addBayWall(b, wall, side < 0 ? kWest : -kEast, side < 0 ? kEast : -kWest, kFoundation, 10, {15, 2.8f, 3.2f, 8.6f},
               kAshlar, kAshlar);
    const vec3 up = glm::normalize(vec3(0, side * 0.35f, 1));
    b.beginPlane(PlaneKind::Roof, kLead, up);
    addQuadFacing(b, {kWest, side * (aisleWall + 0.3f), 10}, {kEast, side * (aisleWall + 0.3f), 10},
                  {kEast, side * kNave, 13}, {kWest, side * kNave, 13}, up, kLead);
    for (const float x : {kWest, kEast}) {
      const WallFrame end = x < 0 ? WallFrame{{x, 0, 0}, {0, -1, 0}} : WallFrame{{x, 0, 0}, {0, 1, 0}};
      const float inner = (x < 0 ? -side : side) * kNave, outer = (x < 0 ? -side : side) * aisleWall;
      const bool rising = inner > outer;
      b.beginPlane(PlaneKind::Wall, kAshlar, end.normal());
      const float l = std::min(inner, outer), r = std::max(inner, outer);
      const WallBand bands[] = {{kFoundation, 10, l, r, l, r},
                                {10, 13, l, r, rising ? r - 0.01f : l, rising ? r : l + 0.01f}};
      addWall(b, end, bands, {}, kAshlar);
    }
    b.beginPlane(PlaneKind::Other, kAshlar, {0, side, 0}, false);
    for (int i = 0; i <= 15; ++i) {
      const float x = kWest + (kEast - kWest) * static_cast<float>(i) / 15;
      if (std::abs(x) < kCrossing + 1) continue;
      const float y0 = side < 0 ? -aisleWall - 1.6f : aisleWall;
      addBox(b, {x - 0.55f, y0, kFoundation}, {x + 0.55f, y0 + 1.6f, 12.5f}, kAshlar, 0x2f);
      addSpire(b, {x, y0 + 0.8f}, 0.75f, 12.5f, 16, 4, kAshlar);
      // The flying arch: a sloping bar.
      b.beginPlane(PlaneKind::Other, kAshlar, {0, side, 0}, false);
      const vec3 low(x, side * (aisleWall + 0.6f), 11.5f), highEnd(x, side * kNave, 18);
      const vec3 along = glm::normalize(highEnd - low), across(1, 0, 0);
      b.addBox(low, side < 0 ? across : -across, along,
               side < 0 ? glm::cross(across, along) : glm::cross(-across, along), {-0.3f, 0, -0.45f},
               {0.3f, glm::length(highEnd - low), 0.45f}, kAshlar, 1 | 2 | 16 | 32);
    }
  }
  // Transepts.
  Body transept;
  transept.min = {-kCrossing, -27}, transept.max = {kCrossing, 27};
  transept.eaves = 21, transept.slope = 1.0f;
  transept.bays = {4, 2.4f, 9, 18};
  transept.endWindow = {1, 6.5f, 7, 18.5f};
  addBody(b, transept, false);
  addPortal(b, {{0, -27, 0}, {1, 0, 0}}, 0, 2.6f, 3.6f, kAshlar);
  // Crossing tower and spire.
  addTower(b, {-kCrossing + 0.8f, -kNave - 0.9f}, {kCrossing - 0.8f, kNave + 0.9f}, 44, {2, 2.2f, 33, 42}, kAshlar,
           kAshlar);
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f})
      addSpire(b, {x * (kCrossing - 1.6f), y * (kNave + 0.1f)}, 1.1f, 44, 52, 8, kAshlar);
  addSpire(b, {0, 0}, kNave + 0.2f, 44, 96, 8, kLead);
  // West towers, and the great door between them.
  for (const float side : {-1.0f, 1.0f}) {
    const float y0 = side < 0 ? -aisleWall - 0.5f : kNave - 0.5f;
    addTower(b, {kWest - 2.5f, y0}, {kWest + 7, y0 + kAisle + 1}, 34, {1, 2.6f, 25, 32}, kAshlar, kAshlar);
    addSpire(b, {kWest + 2.25f, y0 + 0.5f * (kAisle + 1)}, 4.6f, 34, 46, 4, kLead);
  }
  addPortal(b, {{kWest, 0, 0}, {0, -1, 0}}, 0, 4.2f, 5.2f, kAshlar);
  return asMesh(b, "cathedral");
}

// --- castle ----------------------------------------------------------------------------------------------------------

/// The keep on the mound, its ring wall, and the causeway that climbs to it from +x. Drawn about the mound's top, then
/// lifted so that z = 0 is its foot.
city::MeshGeometry makeCastle() {
  BuildingBuilder b("castle");
  constexpr float kHalf = 12.5f, kTop = 23;
  addTower(b, {-kHalf, -kHalf}, {kHalf, kHalf}, kTop, {3, 1.1f, 12, 15}, kAshlar, kAshlar);
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f}) {
      const vec2 c(x * (kHalf - 1.2f), y * (kHalf - 1.2f));
      addTower(b, c - 2.6f, c + 2.6f, kTop + 4.5f, {}, kAshlar, kAshlar);
    }
  // Flat buttresses between the bays.
  b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, 1}, false);
  const BoxFrames f = framesOf({-kHalf, -kHalf}, {kHalf, kHalf});
  for (const WallFrame& frame : {f.front, f.right, f.back, f.left})
    for (const float u : {-4.1f, 4.1f})
      addBar(b, frame, {u - 0.7f, u + 0.7f, kFoundation, kTop - 1}, 0.35f, kAshlar, kEnds | kAbove);
  // A forebuilding with the stair to the first floor.
  Body fore;
  fore.min = {kHalf, -9}, fore.max = {kHalf + 5.5f, 3};
  fore.eaves = 9, fore.slope = 0.7f;
  fore.bays = {2, 0.8f, 5, 7};
  addBody(b, fore, false);
  addPortal(b, {{kHalf + 5.5f, 0, 0}, {0, 1, 0}}, -6, 2.2f, 3, kAshlar);
  // Ring wall with a gap where the causeway comes up.
  constexpr int kSides = 24;
  constexpr float kRadius = 30, kThick = 1.4f, kHeight = 6;
  const auto point = [](int i, float radius) {
    const float a = 6.2831853f * (static_cast<float>(i) + 0.5f) / kSides;
    return vec2(radius * std::cos(a), radius * std::sin(a));
  };
  for (int i = 0; i < kSides - 1; ++i) {
    const vec2 a = point(i, kRadius), c = point(i + 1, kRadius);
    const vec2 ai = point(i, kRadius - kThick), ci = point(i + 1, kRadius - kThick);
    const float length = glm::length(c - a);
    const WallFrame outer{vec3(0.5f * (a + c), 0), vec3(glm::normalize(c - a), 0)};
    const WallFrame inner{vec3(0.5f * (ai + ci), 0), vec3(glm::normalize(ai - ci), 0)};
    addBayWall(b, outer, -0.5f * length, 0.5f * length, kFoundation - 3, kHeight, {}, kRubble, kAshlar);
    addBayWall(b, inner, -0.5f * glm::length(ci - ai), 0.5f * glm::length(ci - ai), kFoundation, kHeight, {}, kRubble,
               kAshlar);
    b.beginPlane(PlaneKind::Other, kRubble, {0, 0, 1}, false);
    addQuadFacing(b, vec3(a, kHeight), vec3(c, kHeight), vec3(ci, kHeight), vec3(ai, kHeight), {0, 0, 1}, kRubble);
    addMerlons(b, outer, -0.5f * length, 0.5f * length, kHeight, 0.5f, kRubble);
  }
  // Gate towers at the gap's sides.
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * 5.4f;
    addTower(b, {kRadius - 3.5f, y - 2.2f}, {kRadius + 1.5f, y + 2.2f}, 10, {1, 0.4f, 5, 6.6f}, kAshlar, kAshlar);
  }
  b.beginPlane(PlaneKind::Other, kAshlar, {1, 0, 0}, false);
  addBox(b, {kRadius - 2.5f, -3.2f, 5}, {kRadius + 0.5f, 3.2f, 8.5f}, kAshlar);
  // The causeway: a stone ramp on the mound's slope, over the ditch.
  const float foot = static_cast<float>(kMoundFoot) + 15, rise = static_cast<float>(kMoundRise);
  b.beginPlane(PlaneKind::Other, kRubble, {0, 0, 1}, false);
  const auto deck = [&](float x) { return 0.15f - rise * std::clamp((x - kRadius) / (foot - kRadius), 0.0f, 1.0f); };
  constexpr int kSteps = 10;
  for (int i = 0; i < kSteps; ++i) {
    const float x0 = glm::mix(kRadius - 3, foot, static_cast<float>(i) / kSteps);
    const float x1 = glm::mix(kRadius - 3, foot, static_cast<float>(i + 1) / kSteps);
    addQuadFacing(b, {x0, -2.6f, deck(x0)}, {x1, -2.6f, deck(x1)}, {x1, 2.6f, deck(x1)}, {x0, 2.6f, deck(x0)},
                  {0, 0, 1}, kCobbles);
    for (const float side : {-1.0f, 1.0f})
      for (const float face : {2.6f, 3.1f}) {
        const float y = side * face;
        const vec3 out(0, face > 3 ? side : -side, 0);
        const float drop = face > 3 ? 9.0f : 0.0f;
        addQuadFacing(b, {x0, y, deck(x0) - drop}, {x1, y, deck(x1) - drop}, {x1, y, deck(x1) + 0.95f},
                      {x0, y, deck(x0) + 0.95f}, out, kRubble);
        if (face > 3)
          addQuadFacing(b, {x0, side * 2.6f, deck(x0) + 0.95f}, {x1, side * 2.6f, deck(x1) + 0.95f},
                        {x1, y, deck(x1) + 0.95f}, {x0, y, deck(x0) + 0.95f}, {0, 0, 1}, kRubble);
      }
  }
  return asMesh(b, "castle", rise);
}

// --- bridge, gate, walls, cross --------------------------------------------------------------------------------------

/// Along x over the river; z = 0 is the water's level.
city::MeshGeometry makeBridge(const Landscape& land) {
  BuildingBuilder b("bridge");
  const auto half = static_cast<float>(bridgeHalfLength(land));
  const auto wet = static_cast<float>(land.riverHalfWidth() + 0.45 * land.bankWidth());
  constexpr float kHalfWidth = 3.3f, kParapet = 0.4f, kPier = 2.4f, kBase = -3.2f, kSpring = 0.3f;
  const auto deck = [&](float x) {
    return static_cast<float>(deckHeight(land, static_cast<double>(x)) - Landscape::kWaterLevel);
  };
  const int arches = std::max(3, static_cast<int>(wet / 5.8f)) | 1;
  const float span = (2 * wet - kPier * static_cast<float>(arches - 1)) / static_cast<float>(arches);
  // The soffit over an arch, the base elsewhere.
  struct Column {
    float x, soffit;
  };
  std::vector<Column> columns{{-half - 0.5f, kBase}, {-wet, kBase}};
  constexpr int kPieces = 10;
  for (int a = 0; a < arches; ++a) {
    const float x0 = -wet + static_cast<float>(a) * (span + kPier);
    const float crown = deck(x0 + 0.5f * span) - 0.55f;
    for (int k = 0; k <= kPieces; ++k) {
      const float t = -std::cos(3.14159265f * static_cast<float>(k) / kPieces);
      const float z =
          k == 0 || k == kPieces ? kSpring : kSpring + (crown - kSpring) * std::sqrt(std::max(0.0f, 1 - t * t));
      columns.push_back({x0 + 0.5f * span * (1 + t), z});
    }
    columns.push_back({x0 + span, kBase});
    if (a + 1 < arches) columns.push_back({x0 + span + kPier, kBase});
  }
  columns.push_back({half + 0.5f, kBase});
  const float outside = kHalfWidth + kParapet;
  for (const float side : {-1.0f, 1.0f}) {
    b.beginPlane(PlaneKind::Wall, kRubble, {0, side, 0});
    for (size_t i = 1; i < columns.size(); ++i) {
      const Column &l = columns[i - 1], &r = columns[i];
      if (r.x - l.x < 1e-4f) continue;
      const vec3 corners[4] = {{l.x, side * outside, l.soffit},
                               {r.x, side * outside, r.soffit},
                               {r.x, side * outside, deck(r.x) + 1.0f},
                               {l.x, side * outside, deck(l.x) + 1.0f}};
      const auto uv = [](vec3 p) { return vec2(p.x, p.z); };
      if (side < 0)
        b.addQuad(corners, {uv(corners[0]), uv(corners[1]), uv(corners[2]), uv(corners[3])}, kRubble);
      else
        b.addQuad({corners[0], corners[3], corners[2], corners[1]},
                  {uv(corners[0]), uv(corners[3]), uv(corners[2]), uv(corners[1])}, kRubble);
    }
    b.beginPlane(PlaneKind::Wall, kRubble, {0, -side, 0}, false);
    constexpr int kDeckPieces = 12;
    for (int i = 0; i < kDeckPieces; ++i) {
      const float x0 = glm::mix(-half - 0.5f, half + 0.5f, static_cast<float>(i) / kDeckPieces);
      const float x1 = glm::mix(-half - 0.5f, half + 0.5f, static_cast<float>(i + 1) / kDeckPieces);
      const float y = side * kHalfWidth;
      addQuadFacing(b, {x0, y, deck(x0)}, {x1, y, deck(x1)}, {x1, y, deck(x1) + 1}, {x0, y, deck(x0) + 1},
                    {0, -side, 0}, kRubble);
      addQuadFacing(b, {x0, y, deck(x0) + 1}, {x1, y, deck(x1) + 1}, {x1, side * outside, deck(x1) + 1},
                    {x0, side * outside, deck(x0) + 1}, {0, 0, 1}, kAshlar);
      if (side < 0)
        addQuadFacing(b, {x0, -kHalfWidth, deck(x0) + 0.02f}, {x1, -kHalfWidth, deck(x1) + 0.02f},
                      {x1, kHalfWidth, deck(x1) + 0.02f}, {x0, kHalfWidth, deck(x0) + 0.02f}, {0, 0, 1}, kCobbles);
    }
  }
  // Under the arches, and the piers' faces.
  b.beginPlane(PlaneKind::Other, kRubble, {0, 0, -1}, false);
  for (size_t i = 1; i < columns.size(); ++i) {
    const Column &l = columns[i - 1], &r = columns[i];
    const bool upright = r.x - l.x < 1e-4f;
    if (!upright && (l.soffit <= kBase || r.soffit <= kBase)) continue;
    const vec3 out = upright ? vec3(r.soffit > l.soffit ? 1 : -1, 0, 0) : vec3(0, 0, -1);
    addQuadFacing(b, {l.x, -outside, l.soffit}, {r.x, -outside, r.soffit}, {r.x, outside, r.soffit},
                  {l.x, outside, l.soffit}, out, kRubble);
  }
  // Cutwaters before and behind each pier.
  for (int a = 0; a + 1 < arches; ++a) {
    const float x0 = -wet + static_cast<float>(a + 1) * (span + kPier) - kPier, x1 = x0 + kPier;
    for (const float side : {-1.0f, 1.0f}) {
      const vec3 tip(0.5f * (x0 + x1), side * (outside + 1.6f), 0), l(x0, side * outside, 0), r(x1, side * outside, 0);
      const vec3 up(0, 0, 1.8f), down(0, 0, kBase);
      addQuadFacing(b, l + down, tip + down, tip + up, l + up, {-1, side, 0}, kAshlar);
      addQuadFacing(b, tip + down, r + down, r + up, tip + up, {1, side, 0}, kAshlar);
      addTriangleFacing(b, l + up, tip + up, r + up, {0, 0, 1}, kAshlar);
    }
  }
  return asMesh(b, "bridge");
}

/// A street passes through it along x. z = 0 is the ground in the middle.
city::MeshGeometry makeGate() {
  BuildingBuilder b("gate");
  constexpr float kPassage = 3.5f, kTower = 5.4f, kHigh = 12.5f, kArch = 4.6f, kRoom = 9.6f;
  for (const float side : {-1.0f, 1.0f}) {
    const float y0 = side < 0 ? -kPassage - kTower : kPassage;
    addTower(b, {-3, y0}, {4, y0 + kTower}, kHigh, {1, 0.35f, 6, 7.8f}, kFlint, kAshlar);
    // Quoins on the towers' outer corners.
    b.beginPlane(PlaneKind::Other, kAshlar, {1, 0, 0}, false);
    for (const float y : {y0, y0 + kTower - 0.6f})
      addBox(b, {3.9f, y, kFoundation}, {4.05f, y + 0.6f, kHigh}, kAshlar, 0x2f);
  }
  for (const float x : {-2.0f, 3.0f}) {
    const WallFrame frame = x > 0 ? WallFrame{{x, 0, 0}, {0, 1, 0}} : WallFrame{{x, 0, 0}, {0, -1, 0}};
    b.beginPlane(PlaneKind::Wall, kFlint, frame.normal());
    // A stilted arch of straight pieces, and the room above it with a window.
    constexpr int kPieces = 8;
    for (int i = 0; i < kPieces; ++i) {
      const float u0 = kPassage * (2.0f * static_cast<float>(i) / kPieces - 1),
                  u1 = kPassage * (2.0f * static_cast<float>(i + 1) / kPieces - 1);
      const auto soffit = [&](float u) { return kArch - 1.4f * (u / kPassage) * (u / kPassage); };
      addQuadFacing(b, frame.at(u0, soffit(u0)), frame.at(u1, soffit(u1)), frame.at(u1, kArch + 0.6f),
                    frame.at(u0, kArch + 0.6f), frame.normal(), kAshlar);
    }
    addBayWall(b, frame, -kPassage, kPassage, kArch + 0.6f, kRoom, {2, 0.9f, 6.2f, 8.2f}, kFlint, kAshlar);
    b.beginPlane(PlaneKind::Other, kFlint, frame.normal(), false);
    addMerlons(b, frame, -kPassage, kPassage, kRoom, 0.5f, kFlint);
  }
  b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, -1}, false);
  constexpr int kPieces = 8;
  for (int i = 0; i < kPieces; ++i) {
    const float u0 = kPassage * (2.0f * static_cast<float>(i) / kPieces - 1),
                u1 = kPassage * (2.0f * static_cast<float>(i + 1) / kPieces - 1);
    const auto soffit = [&](float u) { return kArch - 1.4f * (u / kPassage) * (u / kPassage); };
    addQuadFacing(b, {-2, u0, soffit(u0)}, {3, u0, soffit(u0)}, {3, u1, soffit(u1)}, {-2, u1, soffit(u1)}, {0, 0, -1},
                  kAshlar);
  }
  addQuadFacing(b, {-2, -kPassage, kRoom}, {3, -kPassage, kRoom}, {3, kPassage, kRoom}, {-2, kPassage, kRoom},
                {0, 0, 1}, kLead);
  return asMesh(b, "gate");
}

/// A piece of the town wall that follows the ground; positions relative to `middle`. The town lies on its left.
city::MeshGeometry makeTownWall(std::span<const dvec2> line, dvec2 middle, double level,
                                const city::HeightField& terrain, bool tower) {
  BuildingBuilder b("town wall");
  constexpr float kThick = 1.7f, kWalk = 5.2f, kParapet = 6.3f, kDeep = 3;
  const std::vector<dvec2> points = resample(line, 7);
  const auto ground = [&](dvec2 p) { return static_cast<float>(terrain.heightAt(p.x, p.y).value_or(level) - level); };
  const auto normalAt = [&](size_t i) {
    const dvec2 t = glm::normalize(points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0]);
    return dvec2(t.y, -t.x);  // to the right: outward
  };
  for (size_t i = 1; i < points.size(); ++i) {
    const vec2 a(points[i - 1] - middle), c(points[i] - middle);
    const vec2 na(normalAt(i - 1)), nc(normalAt(i));
    const float ga = ground(points[i - 1]), gc = ground(points[i]);
    const vec3 out(0.5f * (na + nc), 0);
    const float length = glm::length(c - a);
    const auto at = [&](bool second, float side, float z) {
      return vec3((second ? c : a) + (second ? nc : na) * side, (second ? gc : ga) + z);
    };
    const auto face = [&](float side, float foot, float top, vec3 facing) {
      b.beginPlane(PlaneKind::Wall, kFlint, glm::normalize(facing));
      addQuadFacing(b, at(false, side, foot), at(true, side, foot), at(true, side, top), at(false, side, top), facing,
                    kFlint);
    };
    const float half = 0.5f * kThick;
    face(half, -kDeep, kParapet, out);
    face(-half, -kDeep, kWalk, -out);
    face(half - 0.45f, kWalk, kParapet, -out);
    b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, 1}, false);
    addQuadFacing(b, at(false, -half, kWalk), at(true, -half, kWalk), at(true, half - 0.45f, kWalk),
                  at(false, half - 0.45f, kWalk), {0, 0, 1}, kRubble);
    addQuadFacing(b, at(false, half - 0.45f, kParapet), at(true, half - 0.45f, kParapet), at(true, half, kParapet),
                  at(false, half, kParapet), {0, 0, 1}, kAshlar);
    // Merlons every two and a half metres or so.
    const int count = std::max(1, static_cast<int>(length / 2.4f));
    const vec2 t = glm::normalize(c - a);
    for (int k = 0; k < count; ++k) {
      const float s = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
      const vec2 p = glm::mix(a, c, s);
      b.addBox(vec3(p, glm::mix(ga, gc, s)), vec3(t, 0), vec3(-t.y, t.x, 0), {0, 0, 1},
               {-0.65f, -half, kParapet - 0.3f}, {0.65f, -half + 0.45f, kParapet + 0.8f}, kFlint, 0x2f);
    }
  }
  if (tower && points.size() > 2) {
    // Half an octagon out of the wall, higher than it.
    const size_t i = points.size() / 2;
    const vec2 p(points[i] - middle), n(normalAt(i)), t(-n.y, n.x);
    const float g = ground(points[i]), top = g + 9.5f;
    const vec2 plan[] = {p - t * 3.6f - n * 1.6f, p - t * 3.6f + n * 2.2f, p - t * 1.6f + n * 4.2f,
                         p + t * 1.6f + n * 4.2f, p + t * 3.6f + n * 2.2f, p + t * 3.6f - n * 1.6f};
    std::vector<vec3> roof;
    for (size_t k = 0; k < 6; ++k) {
      const vec2 q0 = plan[k], q1 = plan[(k + 1) % 6];
      const float side = glm::length(q1 - q0);
      const vec2 u = glm::normalize(q1 - q0);
      const WallFrame frame{vec3(0.5f * (q0 + q1), g), vec3(u, 0)};
      const bool slit = k >= 1 && k <= 3;
      addBayWall(b, frame, -0.5f * side, 0.5f * side, -4, 9.5f, slit ? Bays{1, 0.3f, 3.2f, 4.8f} : Bays{}, kFlint,
                 kAshlar);
      b.beginPlane(PlaneKind::Other, kFlint, frame.normal(), false);
      addMerlons(b, frame, -0.5f * side, 0.5f * side, 9.5f, 0.45f, kFlint, 1.0f, 0.85f);
      roof.push_back(vec3(q0, top));
    }
    b.beginPlane(PlaneKind::Roof, kLead, {0, 0, 1});
    b.addConvex(roof, vec3(t, 0), vec3(-t.y, t.x, 0), kLead);
  }
  return asMesh(b, "town wall");
}

/// An open hall on eight posts over steps, with a cross on its roof.
city::MeshGeometry makeMarketCross() {
  BuildingBuilder b("market cross");
  b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, 1}, false);
  constexpr int kSides = 8;
  const auto corner = [](int i, float radius) {
    const float a = 6.2831853f * (static_cast<float>(i) + 0.5f) / kSides;
    return vec2(radius * std::cos(a), radius * std::sin(a));
  };
  for (int step = 0; step < 3; ++step) {
    const float radius = 4.4f - 0.45f * static_cast<float>(step), top = 0.2f * static_cast<float>(step + 1);
    std::vector<vec3> ring;
    for (int i = 0; i < kSides; ++i) {
      const vec2 p = corner(i, radius), q = corner(i + 1, radius);
      addQuadFacing(b, vec3(p, step == 0 ? -1.2f : top - 0.2f), vec3(q, step == 0 ? -1.2f : top - 0.2f), vec3(q, top),
                    vec3(p, top), vec3(p + q, 0), kAshlar);
      ring.push_back(vec3(p, top));
    }
    b.addConvex(ring, {1, 0, 0}, {0, 1, 0}, kAshlar);
  }
  for (int i = 0; i < kSides; ++i) {
    const vec2 p = corner(i, 2.9f);
    addBox(b, {p.x - 0.17f, p.y - 0.17f, 0.6f}, {p.x + 0.17f, p.y + 0.17f, 3.6f}, kAshlar, 0xf);
  }
  std::vector<vec3> ceiling;
  for (int i = kSides; i-- > 0;) ceiling.push_back(vec3(corner(i, 3.5f), 3.6f));
  b.addConvex(ceiling, {1, 0, 0}, {0, 1, 0}, kOak);
  for (int i = 0; i < kSides; ++i) {
    const vec2 p = corner(i, 3.5f), q = corner(i + 1, 3.5f);
    addQuadFacing(b, vec3(p, 3.6f), vec3(q, 3.6f), vec3(q, 4.0f), vec3(p, 4.0f), vec3(p + q, 0), kOak);
  }
  addSpire(b, {0, 0}, 3.55f, 4.0f, 7.2f, kSides, kLead);
  b.beginPlane(PlaneKind::Other, kAshlar, {0, 0, 1}, false);
  addBox(b, {-0.1f, -0.1f, 7}, {0.1f, 0.1f, 9.2f}, kAshlar, 0x2f);
  addBox(b, {-0.55f, -0.1f, 8.3f}, {0.55f, 0.1f, 8.5f}, kAshlar);
  return asMesh(b, "market cross");
}

/// Booths under cloth, in rows north of the cross and west of it: the rest of the square stays open.
city::MeshGeometry makeStalls() {
  BuildingBuilder b("market stalls");
  constexpr vec2 kPlaces[] = {{-17, 6},  {-12.5f, 6.3f}, {-8, 5.9f},   {8, 6.2f}, {12.5f, 5.8f},
                              {17, 6},   {-15, 11},      {-10, 11.2f}, {11, 11},  {15.5f, 10.8f},
                              {-18, -1}, {-13, -1.4f},   {-16, -6}};
  for (size_t i = 0; i < std::size(kPlaces); ++i) {
    const vec2 c = kPlaces[i];
    const float turn = 0.12f * static_cast<float>(static_cast<int>(i * 7 % 5) - 2);
    const vec3 x(std::cos(turn), std::sin(turn), 0), y(-x.y, x.x, 0), z(0, 0, 1), o(c, 0);
    const MaterialId cloth = i % 3 == 0 ? kWoolRed : i % 3 == 1 ? kWoolStraw : kLimewash;
    const auto at = [&](float u, float v, float w) { return o + x * u + y * v + z * w; };
    b.beginPlane(PlaneKind::Other, kPlanks, z, false);
    // The table with its cloth, four posts, and a roof of cloth with a valance in front.
    b.addBox(o, x, y, z, {-1.4f, -0.7f, -0.4f}, {1.4f, 0.1f, 0.85f}, kPlanks, 0x2f);
    for (const float u : {-1.5f, 1.5f})
      for (const float v : {-1.0f, 0.9f})
        b.addBox(o, x, y, z, {u - 0.05f, v - 0.05f, -0.4f}, {u + 0.05f, v + 0.05f, v < 0 ? 2.05f : 2.5f}, kTimber, 0xf);
    const vec3 up = glm::normalize(z * 1.9f - y * 0.45f);
    for (const float side : {1.0f, -1.0f})
      addQuadFacing(b, at(-1.7f, -1.25f, 2.0f), at(1.7f, -1.25f, 2.0f), at(1.7f, 1.0f, 2.52f), at(-1.7f, 1.0f, 2.52f),
                    up * side, cloth);
    for (const float side : {1.0f, -1.0f})
      addQuadFacing(b, at(-1.7f, -1.25f, 1.72f), at(1.7f, -1.25f, 1.72f), at(1.7f, -1.25f, 2.0f),
                    at(-1.7f, -1.25f, 2.0f), y * -side, cloth);
    // Wares: baskets and bales.
    for (int k = 0; k < 3; ++k) {
      const float u = -0.9f + 0.85f * static_cast<float>(k);
      const MaterialId ware = (i + static_cast<size_t>(k)) % 3 == 0   ? kWoolStraw
                              : (i + static_cast<size_t>(k)) % 3 == 1 ? kThatch
                                                                      : kWoolRed;
      b.addBox(o, x, y, z, {u - 0.25f, -0.55f, 0.85f}, {u + 0.25f, -0.1f, 1.05f}, ware, 0x2f);
    }
  }
  return asMesh(b, "market stalls");
}

/// Adds meshes once and monuments often.
class Placer {
 public:
  Placer(city::City& city, const city::HeightField& terrain) : city_(city), terrain_(terrain) {}

  uint32_t mesh(city::MeshGeometry geometry) {
    city_.meshes.push_back(std::move(geometry));
    return static_cast<uint32_t>(city_.meshes.size() - 1);
  }
  void place(uint32_t mesh, std::string name, dvec3 position, double heading) {
    city_.monuments.push_back({std::move(name), mesh, position, static_cast<float>(heading), city::kNone, {}});
  }
  dvec3 onGround(dvec2 p) const { return {p, terrain_.heightAt(p.x, p.y).value_or(0)}; }

 private:
  city::City& city_;
  const city::HeightField& terrain_;
};

}  // namespace

void addMonuments(city::City& city, const Landscape& land, std::span<const QuarterPlan> quarters) {
  const city::HeightField& terrain = *city.terrain;
  Placer placer(city, terrain);
  const auto any = [&](SpotKind kind) {
    return std::any_of(quarters.begin(), quarters.end(), [&](const QuarterPlan& q) {
      return std::any_of(q.spots.begin(), q.spots.end(), [&](const Spot& s) { return s.kind == kind; });
    });
  };
  uint32_t churches[3] = {}, cathedral = 0, castle = 0, cross = 0, stalls = 0, bridge = 0, gate = 0;
  if (any(SpotKind::Church))
    for (int v = 0; v < 3; ++v) churches[v] = placer.mesh(makeChurch(v));
  if (any(SpotKind::Cathedral)) cathedral = placer.mesh(makeCathedral());
  if (any(SpotKind::Castle)) castle = placer.mesh(makeCastle());
  if (any(SpotKind::MarketCross)) cross = placer.mesh(makeMarketCross()), stalls = placer.mesh(makeStalls());
  if (any(SpotKind::Bridge)) bridge = placer.mesh(makeBridge(land));
  if (std::any_of(quarters.begin(), quarters.end(), [](const QuarterPlan& q) { return !q.gates.empty(); }))
    gate = placer.mesh(makeGate());

  for (const QuarterPlan& q : quarters) {
    for (const Spot& s : q.spots) switch (s.kind) {
        case SpotKind::Church:
          placer.place(churches[s.variant], "parish church", placer.onGround(s.position), s.heading);
          break;
        case SpotKind::Cathedral:
          placer.place(cathedral, "cathedral", placer.onGround(s.position), s.heading);
          break;
        case SpotKind::Castle:
          placer.place(castle, "castle", placer.onGround(s.position) - dvec3(0, 0, kMoundRise), s.heading);
          break;
        case SpotKind::MarketCross:
          placer.place(cross, "market cross", placer.onGround(s.position), s.heading);
          placer.place(stalls, "market stalls", placer.onGround(s.position), s.heading);
          break;
        case SpotKind::Bridge:
          placer.place(bridge, "bridge", dvec3(s.position, Landscape::kWaterLevel), s.heading);
          break;
      }
    for (const Gate& g : q.gates)
      placer.place(gate, "gate", placer.onGround(g.position), std::atan2(g.outward.y, g.outward.x));
    for (const std::vector<dvec2>& stretch : q.walls) {
      // Pieces of at most 90 m, each with its tower.
      const double length = lengthOf(stretch);
      const auto pieces = static_cast<size_t>(std::max(1.0, std::ceil(length / 90)));
      const std::vector<dvec2> fine = resample(stretch, 2);
      for (size_t k = 0; k < pieces; ++k) {
        const size_t from = k * (fine.size() - 1) / pieces, to = (k + 1) * (fine.size() - 1) / pieces;
        if (to <= from) continue;
        const std::span<const dvec2> piece = std::span(fine).subspan(from, to - from + 1);
        dvec3 middle = placer.onGround(piece[piece.size() / 2]);
        for (const dvec2 p : piece) middle.z = std::min(middle.z, placer.onGround(p).z);
        placer.place(placer.mesh(makeTownWall(piece, dvec2(middle), middle.z, terrain,
                                              length / static_cast<double>(pieces) > 30)),
                     "town wall", middle, 0);
      }
    }
  }
}

}  // namespace vicus::assets::norvic
