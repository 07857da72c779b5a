#include "city/building_geometry.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "city/watertight.hpp"

namespace vicus::city {

BuildingBuilder::BuildingBuilder(std::string name) {
  geometry_.name = std::move(name);
}

void BuildingBuilder::beginLevel(float bottom, float top) {
  Level level;
  level.bottom = bottom, level.top = top;
  level.planes.first = static_cast<uint32_t>(geometry_.planes.size());
  geometry_.levels.push_back(level);
}

void BuildingBuilder::beginPlane(PlaneKind kind, MaterialId baseTexture, glm::vec3 outwardNormal, bool solid) {
  if (geometry_.levels.empty()) beginLevel(0, 0);
  Plane plane;
  plane.kind = kind, plane.solid = solid, plane.baseTexture = baseTexture, plane.normal = outwardNormal;
  plane.externalGeometry.first = static_cast<uint32_t>(geometry_.externalGeometry.size());
  plane.externalOpenings.first = static_cast<uint32_t>(geometry_.externalOpenings.size());
  geometry_.planes.push_back(plane);
  hasFlat_.push_back(false);
  ++geometry_.levels.back().planes.count;
  begin(Target::Cut);
}

void BuildingBuilder::begin(Target target) {
  if (geometry_.planes.empty()) beginPlane(PlaneKind::Other, 0, {0, 0, 1}, false);
  const auto plane = static_cast<uint32_t>(geometry_.planes.size() - 1);
  const uint32_t item = target == Target::Geometry  ? static_cast<uint32_t>(geometry_.externalGeometry.size() - 1)
                        : target == Target::Opening ? static_cast<uint32_t>(geometry_.externalOpenings.size() - 1)
                                                    : 0;
  pieces_.push_back({target, plane, item, {}});
}

void BuildingBuilder::beginCut() {
  begin(Target::Cut);
}

void BuildingBuilder::beginFlat() {
  begin(Target::Flat);
  hasFlat_.back() = true;
}

void BuildingBuilder::beginExternalGeometry(float depth) {
  assert(depth >= 0);
  if (geometry_.planes.empty()) beginPlane(PlaneKind::Other, 0, {0, 0, 1}, false);
  geometry_.externalGeometry.push_back({{}, depth});
  ++geometry_.planes.back().externalGeometry.count;
  begin(Target::Geometry);
}

void BuildingBuilder::beginExternalOpening(float depth) {
  assert(depth >= 0);
  if (geometry_.planes.empty()) beginPlane(PlaneKind::Other, 0, {0, 0, 1}, false);
  geometry_.externalOpenings.push_back({{}, depth});
  ++geometry_.planes.back().externalOpenings.count;
  begin(Target::Opening);
}

BuildingBuilder::Piece& BuildingBuilder::piece() {
  if (pieces_.empty()) begin(Target::Cut);
  return pieces_.back();
}

uint16_t BuildingBuilder::itemNumber() const {
  const Target target = pieces_.empty() ? Target::Cut : pieces_.back().target;
  if (target == Target::Cut || target == Target::Flat) return 0;
  const size_t number = geometry_.externalGeometry.size() + geometry_.externalOpenings.size();
  return static_cast<uint16_t>(number < 0xffff ? number : 0xffff);
}

void BuildingBuilder::addTriangles(std::span<const glm::vec3> positions, std::span<const glm::vec2> uvs,
                                   std::span<const uint32_t> triangles, glm::vec3 normal, MaterialId material) {
  assert(positions.size() == uvs.size());
  assert(triangles.size() % 3 == 0);
  Piece& target = piece();
  const auto base = static_cast<uint32_t>(geometry_.vertices.size());
  const uint32_t packedNormal = packNormal(normal);
  const uint16_t item = itemNumber();
  for (size_t i = 0; i < positions.size(); ++i) {
    geometry_.vertices.push_back({positions[i], uvs[i], packedNormal, material, item, 0});
    geometry_.bounds.extend(positions[i]);
  }
  for (const uint32_t index : triangles) target.indices.push_back(base + index);
}

void BuildingBuilder::addQuad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, MaterialId material, glm::vec2 uvA) {
  const float u = glm::length(b - a);
  const float v = glm::length(d - a);
  addQuad({a, b, c, d}, {uvA, uvA + glm::vec2(u, 0), uvA + glm::vec2(u, v), uvA + glm::vec2(0, v)}, material);
}

void BuildingBuilder::addQuad(const glm::vec3 (&corners)[4], const glm::vec2 (&uvs)[4], MaterialId material) {
  const glm::vec3 cross = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
  const float length = glm::length(cross);
  if (!(length > 1e-9f)) return;
  static constexpr uint32_t kTriangles[] = {0, 1, 2, 0, 2, 3};
  addTriangles(corners, uvs, kTriangles, cross / length, material);
}

void BuildingBuilder::addConvex(std::span<const glm::vec3> corners, glm::vec3 uAxis, glm::vec3 vAxis,
                                MaterialId material) {
  if (corners.size() < 3) return;
  // Newell's normal: right for any planar polygon, whatever corner is nearly straight.
  glm::vec3 normal(0);
  for (size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
  const float length = glm::length(normal);
  if (!(length > 1e-9f)) return;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> triangles;
  for (const glm::vec3& corner : corners)
    uvs.emplace_back(glm::dot(corner - corners[0], uAxis), glm::dot(corner - corners[0], vAxis));
  for (uint32_t i = 2; i < corners.size(); ++i) triangles.insert(triangles.end(), {0, i - 1, i});
  addTriangles(corners, uvs, triangles, normal / length, material);
}

void BuildingBuilder::addBox(glm::vec3 origin, glm::vec3 x, glm::vec3 y, glm::vec3 z, glm::vec3 min, glm::vec3 max,
                             MaterialId material, unsigned faces) {
  const auto corner = [&](int i) {
    return origin + x * (i & 1 ? max.x : min.x) + y * (i & 2 ? max.y : min.y) + z * (i & 4 ? max.z : min.z);
  };
  // Each face's corners counter-clockwise from outside, u to the right and v up where the face is a wall.
  static constexpr int kFaces[6][4] = {{2, 0, 4, 6}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {3, 2, 6, 7}, {2, 3, 1, 0}, {4, 5, 7, 6}};
  for (int f = 0; f < 6; ++f)
    if (faces & 1u << f)
      addQuad(corner(kFaces[f][0]), corner(kFaces[f][1]), corner(kFaces[f][2]), corner(kFaces[f][3]), material);
}

void BuildingBuilder::addOccluder(const OccluderLine& line) {
  geometry_.occluders.push_back(line);
}

void BuildingBuilder::setFootprint(std::vector<std::vector<glm::vec2>> rings) {
  geometry_.footprint = std::move(rings);
}

namespace {

/// Tells each vertex of an item how far it lies out of its wall's surface: what house LOD slides.
void setSlides(BuildingGeometry& g) {
  constexpr float kOnTheWall = 1e-4f;  // metres: rounding
  for (const Plane& plane : g.planes) {
    const uint32_t wallSlide = packSlide(plane.normal, 0);
    for (const Range& surface : {plane.cut, plane.flat})
      for (uint32_t i = surface.first; i < surface.end(); ++i) g.vertices[g.indices[i]].slide = wallSlide;
    if (plane.externalGeometry.count == 0 && plane.externalOpenings.count == 0) continue;
    const Range& surface = plane.flat.count > 0 ? plane.flat : plane.cut;
    if (surface.count == 0) continue;  // items without a wall stay where they are
    const float level = glm::dot(g.vertices[g.indices[surface.first]].position, plane.normal);
    const auto set = [&](const ExternalItem& item, float low, float high) {
      for (uint32_t i = item.indices.first; i < item.indices.end(); ++i) {
        Vertex& v = g.vertices[g.indices[i]];
        const float out = std::clamp(glm::dot(v.position, plane.normal) - level, low, high);
        v.slide = packSlide(plane.normal, std::abs(out) > kOnTheWall ? out : 0);
      }
    };
    for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i)
      set(g.externalGeometry[i], 0, g.externalGeometry[i].depth);
    // An opening's reveals may come out as far as the frame about it.
    for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
      set(g.externalOpenings[i], -g.externalOpenings[i].depth, g.externalOpenings[i].depth);
  }
}

}  // namespace

BuildingGeometry BuildingBuilder::finish() {
  BuildingGeometry& g = geometry_;
  // Walls, roofs and what goes into them hide together what is behind; what sticks out only stands before them.
  std::vector<std::vector<uint32_t>*> closed;
  for (Piece& p : pieces_)
    if (p.target == Target::Cut || p.target == Target::Opening) closed.push_back(&p.indices);
  makeWatertight(g.vertices, closed);
  const auto append = [&g](Range& range, const Piece& p) {
    if (range.count == 0) range.first = static_cast<uint32_t>(g.indices.size());
    g.indices.insert(g.indices.end(), p.indices.begin(), p.indices.end());
    range.count = static_cast<uint32_t>(g.indices.size()) - range.first;
  };
  // Pieces come plane by plane, so those of one plane are one run of pieces_.
  std::vector<size_t> firstPiece(g.planes.size() + 1, pieces_.size());
  for (size_t k = pieces_.size(); k-- > 0;) firstPiece[pieces_[k].plane] = k;
  for (size_t i = g.planes.size(); i-- > 0;) firstPiece[i] = std::min(firstPiece[i], firstPiece[i + 1]);
  const auto appendAll = [&](uint32_t plane, Target target, const auto& rangeOf) {
    for (size_t k = firstPiece[plane]; k < firstPiece[plane + 1]; ++k)
      if (pieces_[k].target == target) append(rangeOf(pieces_[k]), pieces_[k]);
  };
  // Full detail, so that each plane's cut surface and items lie together.
  for (uint32_t i = 0; i < g.planes.size(); ++i) {
    appendAll(i, Target::Cut, [&](const Piece&) -> Range& { return g.planes[i].cut; });
    appendAll(i, Target::Geometry, [&](const Piece& p) -> Range& { return g.externalGeometry[p.item].indices; });
    appendAll(i, Target::Opening, [&](const Piece& p) -> Range& { return g.externalOpenings[p.item].indices; });
  }
  g.fullDetail = {0, static_cast<uint32_t>(g.indices.size())};
  // Then the flat surfaces that differ.
  for (uint32_t i = 0; i < g.planes.size(); ++i) {
    if (!hasFlat_[i]) g.planes[i].flat = g.planes[i].cut;
    appendAll(i, Target::Flat, [&](const Piece&) -> Range& { return g.planes[i].flat; });
  }
  setSlides(g);
  g.height = g.bounds.empty() ? 0 : g.bounds.max.z;
  pieces_.clear();
  hasFlat_.clear();
  return std::exchange(geometry_, {});
}

}  // namespace vicus::city
