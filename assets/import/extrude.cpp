#include "assets/import/extrude.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "facade/hip_roof.hpp"

namespace vicus::assets {
namespace {

using city::BuildingBuilder;
using city::PlaneKind;

/// Points nearer to a wall's line than this are no corners of it: metres.
constexpr double kInLine = 0.03;

/// A footprint whose corners all matter, with what stands against its edges.
Extrusion::Part merged(const Extrusion::Part& part) {
  Extrusion::Part out = part;
  out.polygon = {}, out.shared.clear();
  for (size_t r = 0; r < part.polygon.rings.size(); ++r) {
    const Ring& ring = part.polygon.rings[r];
    Ring& kept = out.polygon.rings.emplace_back();
    std::vector<uint8_t>& shared = out.shared.emplace_back();
    for (const uint32_t i : cornersOf(ring, part.shared[r], kInLine)) {
      kept.push_back(ring[i]);
      shared.push_back(part.shared[r][i]);
    }
  }
  return out;
}

glm::vec3 at(glm::dvec2 p, double z) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(z)};
}

glm::vec2 uv(double u, double v) {
  return {static_cast<float>(u), static_cast<float>(v)};
}

/// The wall over the edge a → b, seen from the right of it.
void addWall(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part, glm::dvec2 a, glm::dvec2 b,
             bool shared) {
  const double length = glm::length(b - a);
  if (!(length > 0)) return;
  const glm::dvec2 along = (b - a) / length;
  const double storeyed = part.height - part.bottom, foot = part.bottom > 0 ? part.bottom : -e.foundation;
  const int bays = shared || storeyed < kSmallestFacadeHeight ? 0 : baysIn(length);
  const Finish finish = bays > 0 ? e.style.facade : e.style.plain;
  builder.beginPlane(PlaneKind::Wall, id(finish), at({along.y, -along.x}, 0));
  if (bays > 0) {
    const double storeys = storeysIn(storeyed);
    builder.addQuad({at(a, part.bottom), at(b, part.bottom), at(b, part.height), at(a, part.height)},
                    {uv(0, 0), uv(bays, 0), uv(bays, storeys), uv(0, storeys)}, id(finish));
    if (foot < part.bottom)
      builder.addQuad(at(a, foot), at(b, foot), at(b, part.bottom), at(a, part.bottom), id(e.style.plain));
  } else {
    builder.addQuad(at(a, foot), at(b, foot), at(b, part.height), at(a, part.height), id(finish));
  }
  builder.addOccluder(
      {glm::vec2(at(a, 0)), glm::vec2(at(b, 0)), static_cast<float>(foot), static_cast<float>(part.height)});
}

/// One slope of a roof: the polygon stands on its first edge, the eave.
void addSlope(BuildingBuilder& builder, std::initializer_list<glm::dvec3> polygon, Finish finish) {
  std::vector<glm::vec3> corners;
  for (const glm::dvec3& p : polygon) corners.emplace_back(p);
  const std::vector<glm::dvec3> exact(polygon);
  glm::dvec3 normal(0);
  for (size_t i = 2; i < exact.size(); ++i) normal += glm::cross(exact[i - 1] - exact[0], exact[i] - exact[0]);
  if (!(glm::length(normal) > 0)) return;
  normal = glm::normalize(normal);
  const glm::dvec3 u = glm::normalize(exact[1] - exact[0]);
  builder.beginPlane(PlaneKind::Roof, id(finish), glm::vec3(normal));
  builder.addConvex(corners, glm::vec3(u), glm::vec3(glm::cross(normal, u)), id(finish));
}

double rise(double run, double pitch) {
  return std::min(kHighestRoof, run * std::tan(pitch));
}

/// The level underside of what hangs above the ground.
void addUnderside(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  Triangulation cut = triangulate(part.polygon);
  if (cut.triangles.empty()) return;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  for (const glm::dvec2& p : cut.points) positions.push_back(at(p, part.bottom)), uvs.push_back(uv(p.x, p.y));
  for (size_t t = 0; t + 2 < cut.triangles.size(); t += 3) std::swap(cut.triangles[t + 1], cut.triangles[t + 2]);
  builder.beginPlane(PlaneKind::Floor, id(e.style.plain), {0, 0, -1});
  builder.addTriangles(positions, uvs, cut.triangles, {0, 0, -1}, id(e.style.plain));
}

/// A piece of a roof that need not be convex; its first edge is the eave. Slivers that floats turn over are left out.
void addRoofPiece(BuildingBuilder& builder, const std::vector<glm::dvec3>& polygon, glm::dvec3 normal, Finish finish) {
  const glm::dvec3 u = glm::normalize(polygon[1] - polygon[0]), v = glm::cross(normal, u);
  Ring plan;  // in the piece's own plane
  for (const glm::dvec3& p : polygon) plan.emplace_back(glm::dot(p - polygon[0], u), glm::dot(p - polygon[0], v));
  std::vector<glm::vec3> corners;
  std::vector<glm::vec2> uvs;
  for (size_t i = 0; i < polygon.size(); ++i) {
    corners.emplace_back(polygon[i]);
    uvs.push_back(uv(plan[i].x, plan[i].y));
  }
  std::vector<uint32_t> triangles;
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    if (glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), glm::vec3(normal)) > 1e-6f)
      triangles.insert(triangles.end(), {a, b, c});
  };
  if (isConvex(plan)) {
    for (uint32_t i = 1; i + 1 < corners.size(); ++i) add(0, i, i + 1);
  } else {
    const Triangulation cut = triangulate({{plan}});
    // The piece's own corners again, so that neighbours share them to the bit.
    std::vector<uint32_t> cornerOf;
    for (const glm::dvec2& p : cut.points) {
      uint32_t nearest = 0;
      for (uint32_t i = 1; i < plan.size(); ++i)
        if (glm::length(plan[i] - p) < glm::length(plan[nearest] - p)) nearest = i;
      cornerOf.push_back(nearest);
    }
    for (size_t t = 0; t + 2 < cut.triangles.size(); t += 3)
      add(cornerOf[cut.triangles[t]], cornerOf[cut.triangles[t + 1]], cornerOf[cut.triangles[t + 2]]);
  }
  if (!triangles.empty()) builder.addTriangles(corners, uvs, triangles, glm::vec3(normal), id(finish));
}

/// A slope over every eave, meeting along the straight skeleton; gables where neighbours stand. False where the
/// footprint has no skeleton or is too wide.
bool addHipRoof(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  constexpr double kSteepest = 1e6;  // a stated height decides
  const bool stated = part.roofHeight > 0;
  const auto roof = facade::hipRoof(part.polygon.rings, part.shared, stated ? kSteepest : std::tan(e.pitch),
                                    stated ? part.roofHeight : kHighestRoof);
  if (!roof || roof->reach > kWidestSlope) return false;
  builder.beginLevel(static_cast<float>(part.height), static_cast<float>(part.height + roof->height));
  for (const facade::RoofPiece& piece : roof->pieces) {
    std::vector<glm::dvec3> polygon = piece.polygon;
    for (glm::dvec3& p : polygon) p.z += part.height;
    glm::dvec3 normal(0);
    for (size_t i = 2; i < polygon.size(); ++i)
      normal += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    if (!(glm::length(normal) > 1e-6)) continue;
    normal = glm::normalize(normal);
    const Finish finish = piece.gable ? e.style.plain : e.style.roof;
    builder.beginPlane(piece.gable ? PlaneKind::Gable : PlaneKind::Roof, id(finish), glm::vec3(normal));
    addRoofPiece(builder, polygon, normal, finish);
  }
  return true;
}

/// Two slopes that meet over the middle of two opposite edges, which become gables: those that neighbours stand against
/// (the ridges of a terrace run along the street), else the shorter pair.
///
///      3 ────────── 2
///      │ ╲          │        ridge from the middle of 3–0 to the middle of 1–2
///    m ├──────────── n       where 1–2 and 3–0 become gables
///      │            │
///      0 ────────── 1
struct GableFrame {
  glm::dvec2 p0, p1, p2, p3, n, m;
  double width = 0;
};

GableFrame gableFrame(const Ring& ring, const std::vector<uint8_t>& shared) {
  const auto length = [&](size_t i) { return glm::length(ring[(i + 1) % 4] - ring[i]); };
  const int against02 = shared.empty() ? 0 : shared[0] + shared[2],
            against13 = shared.empty() ? 0 : shared[1] + shared[3];
  const bool along0 = against02 != against13 ? against13 > against02 : length(0) + length(2) >= length(1) + length(3);
  const size_t s = along0 ? 0 : 1;
  GableFrame f{ring[s], ring[s + 1], ring[(s + 2) % 4], ring[(s + 3) % 4], {}, {}, 0};
  f.n = (f.p1 + f.p2) / 2.0, f.m = (f.p3 + f.p0) / 2.0;
  f.width = (length((s + 1) % 4) + length((s + 3) % 4)) / 2;
  return f;
}

void addGableRoof(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  const auto [p0, p1, p2, p3, n, m, width] = gableFrame(part.polygon.rings[0], part.shared[0]);
  const double ridge = part.height + (part.roofHeight > 0 ? part.roofHeight : rise(width / 2, e.pitch));
  const glm::dvec3 n3(n, ridge), m3(m, ridge);
  builder.beginLevel(static_cast<float>(part.height), static_cast<float>(ridge));
  const auto side = [&](glm::dvec2 a, glm::dvec2 b, glm::dvec3 overB, glm::dvec3 overA) {
    const glm::dvec3 a3(a, part.height), b3(b, part.height);
    // Flat where eave and ridge are parallel, else two triangles.
    const glm::dvec2 eave = glm::normalize(b - a), top = glm::normalize(glm::dvec2(overB - overA));
    if (std::abs(eave.x * top.y - eave.y * top.x) < 1e-3) {
      addSlope(builder, {a3, b3, overB, overA}, e.style.roof);
    } else {
      addSlope(builder, {a3, b3, overB}, e.style.roof);
      addSlope(builder, {a3, overB, overA}, e.style.roof);
    }
  };
  side(p0, p1, n3, m3);
  side(p2, p3, m3, n3);
  const auto end = [&](glm::dvec2 a, glm::dvec2 b, glm::dvec3 top) {
    const glm::dvec2 along = glm::normalize(b - a);
    builder.beginPlane(PlaneKind::Gable, id(e.style.plain), at({along.y, -along.x}, 0));
    const glm::vec3 corners[] = {at(a, part.height), at(b, part.height), glm::vec3(top)};
    builder.addConvex(corners, at(along, 0), {0, 0, 1}, id(e.style.plain));
  };
  end(p1, p2, n3);
  end(p3, p0, m3);
}

/// One slope that falls to the longest edge; the walls under its other sides reach up to it.
void addSlopeRoof(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  const auto [p0, p1, p2, p3, n, m, width] = gableFrame(part.polygon.rings[0], {});
  const double low = part.height, high = low + (part.roofHeight > 0 ? part.roofHeight : rise(width, e.pitch / 2));
  builder.beginLevel(static_cast<float>(low), static_cast<float>(high));
  const glm::dvec3 a(p0, low), b(p1, low), c(p2, high), d(p3, high);
  addSlope(builder, {a, b, c}, e.style.roof);
  addSlope(builder, {a, c, d}, e.style.roof);
  const auto upright = [&](std::initializer_list<glm::vec3> corners, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 along = glm::normalize(to - from);
    builder.beginPlane(PlaneKind::Gable, id(e.style.plain), at({along.y, -along.x}, 0));
    builder.addConvex(std::vector<glm::vec3>(corners), at(along, 0), {0, 0, 1}, id(e.style.plain));
  };
  upright({at(p1, low), at(p2, low), at(p2, high)}, p1, p2);
  upright({at(p2, low), at(p3, low), at(p3, high), at(p2, high)}, p2, p3);
  upright({at(p3, low), at(p0, low), at(p3, high)}, p3, p0);
}

/// Metres from the middle to the nearest line through an edge.
double runToMiddle(const Ring& ring, glm::dvec2 middle) {
  double run = INFINITY;
  for (size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i], d = glm::normalize(ring[(i + 1) % ring.size()] - a);
    run = std::min(run, std::abs(d.x * (middle.y - a.y) - d.y * (middle.x - a.x)));
  }
  return run;
}

/// Slopes from every eave to one point over the middle; the steepest has the pitch asked for.
void addPyramidRoof(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  const Ring& ring = part.polygon.rings[0];
  const glm::dvec2 middle = centroid(part.polygon);
  const double top = part.height + (part.roofHeight > 0 ? part.roofHeight : rise(runToMiddle(ring, middle), e.pitch));
  builder.beginLevel(static_cast<float>(part.height), static_cast<float>(top));
  for (size_t i = 0; i < ring.size(); ++i)
    addSlope(builder,
             {glm::dvec3(ring[i], part.height), glm::dvec3(ring[(i + 1) % ring.size()], part.height),
              glm::dvec3(middle, top)},
             e.style.roof);
}

/// A level surface at the eaves; texture along the longest edge.
bool addFlatRoof(BuildingBuilder& builder, const Extrusion& e, const Extrusion::Part& part) {
  const Polygon& polygon = part.polygon;
  const Triangulation cut = triangulate(polygon);
  if (cut.triangles.empty()) return false;
  const Ring& outer = polygon.rings[0];
  glm::dvec2 u(1, 0);
  double longest = 0;
  for (size_t i = 0; i < outer.size(); ++i) {
    const glm::dvec2 d = outer[(i + 1) % outer.size()] - outer[i];
    if (glm::length(d) > longest) longest = glm::length(d), u = d / longest;
  }
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  for (const glm::dvec2& p : cut.points) {
    positions.push_back(at(p, part.height));
    uvs.push_back(uv(glm::dot(p, u), u.x * p.y - u.y * p.x));
  }
  builder.beginLevel(static_cast<float>(part.height), static_cast<float>(part.height));
  builder.beginPlane(PlaneKind::Roof, id(e.style.roof), {0, 0, 1});
  builder.addTriangles(positions, uvs, cut.triangles, {0, 0, 1}, id(e.style.roof));
  return true;
}

}  // namespace

RoofForm roofFormOf(const Polygon& footprint) {
  const Ring& ring = footprint.rings.at(0);
  if (footprint.rings.size() != 1 || ring.size() != 4 || !isConvex(ring)) return RoofForm::Hip;
  for (size_t i = 0; i < 4; ++i) {
    const glm::dvec2 in = glm::normalize(ring[(i + 1) % 4] - ring[i]);
    const glm::dvec2 out = glm::normalize(ring[(i + 2) % 4] - ring[(i + 1) % 4]);
    if (std::abs(glm::dot(in, out)) > 0.5) return RoofForm::Hip;  // further than 30° from a right angle
  }
  return RoofForm::Gable;
}

RoofForm roofFormOf(const Polygon& footprint, RoofForm stated) {
  const RoofForm usual = roofFormOf(footprint);
  switch (stated) {
    case RoofForm::Unknown:
      return usual;
    case RoofForm::Flat:
      return RoofForm::Flat;
    case RoofForm::Pyramid:
      return footprint.rings.size() == 1 && isConvex(footprint.rings[0]) ? RoofForm::Pyramid : usual;
    case RoofForm::Hip:
      return RoofForm::Hip;
    default:
      return usual == RoofForm::Gable ? stated : usual;
  }
}

double roofRise(const Polygon& footprint, RoofForm form, double pitch) {
  const Ring& ring = footprint.rings.at(0);
  switch (form) {
    case RoofForm::Gable:
      return rise(gableFrame(ring, {}).width / 2, pitch);
    case RoofForm::Hip: {
      const auto skeleton = facade::straightSkeleton(footprint.rings);
      return skeleton && skeleton->reach <= kWidestSlope ? rise(skeleton->reach, pitch) : 0;
    }
    case RoofForm::Slope:
      return rise(gableFrame(ring, {}).width, pitch / 2);
    case RoofForm::Pyramid:
      return rise(runToMiddle(ring, centroid(footprint)), pitch);
    default:
      return 0;
  }
}

std::optional<city::BuildingGeometry> extrude(const Extrusion& e, std::string name) {
  BuildingBuilder builder(std::move(name));
  std::vector<Extrusion::Part> parts;
  std::vector<std::vector<glm::vec2>> footprint;
  for (const Extrusion::Part& part : e.parts) {
    Extrusion::Part slim = merged(part);
    // Merging moves walls by at most 3 cm, which may still make narrow ones cross: then every point is kept.
    parts.push_back(isPlainlyValid(slim.polygon) ? std::move(slim) : part);
    for (const Ring& ring : parts.back().polygon.rings) {
      std::vector<glm::vec2>& line = footprint.emplace_back();
      for (const glm::dvec2& p : ring) line.emplace_back(p);
    }
  }
  double eaves = -e.foundation;
  for (const Extrusion::Part& part : parts) eaves = std::max(eaves, part.height);
  builder.beginLevel(static_cast<float>(-e.foundation), static_cast<float>(eaves));
  for (const Extrusion::Part& part : parts) {
    for (size_t r = 0; r < part.polygon.rings.size(); ++r) {
      const Ring& ring = part.polygon.rings[r];
      for (size_t i = 0; i < ring.size(); ++i)
        addWall(builder, e, part, ring[i], ring[(i + 1) % ring.size()], part.shared[r][i] != 0);
    }
    if (part.bottom > 0) addUnderside(builder, e, part);
  }
  for (const Extrusion::Part& part : parts) {
    switch (roofFormOf(part.polygon, part.roof)) {
      case RoofForm::Gable:
        addGableRoof(builder, e, part);
        break;
      case RoofForm::Hip:
        if (!addHipRoof(builder, e, part) && !addFlatRoof(builder, e, part)) return std::nullopt;
        break;
      case RoofForm::Slope:
        addSlopeRoof(builder, e, part);
        break;
      case RoofForm::Pyramid:
        addPyramidRoof(builder, e, part);
        break;
      default:
        if (!addFlatRoof(builder, e, part)) return std::nullopt;
        break;
    }
  }
  builder.setFootprint(std::move(footprint));
  return builder.finish();
}

}  // namespace vicus::assets
