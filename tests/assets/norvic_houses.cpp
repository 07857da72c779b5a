/// Every kind of house in every size is a sound building: closed, outward, with openings inside their walls.
#include "assets/norvic/houses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "assets/norvic/palette.hpp"
#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

using city::BuildingGeometry;
using city::Plane;
using city::PlaneKind;
using city::Range;
using glm::vec3;

const HouseCatalogue& catalogue() {
  static const HouseCatalogue houses = makeHouseCatalogue();
  return houses;
}

struct Triangle {
  vec3 a, b, c;
  vec3 cross() const { return glm::cross(b - a, c - a); }
};

std::vector<Triangle> trianglesOf(const BuildingGeometry& g, Range range) {
  std::vector<Triangle> out;
  for (uint32_t i = range.first; i < range.end(); i += 3)
    out.push_back({g.vertices[g.indices[i]].position, g.vertices[g.indices[i + 1]].position,
                   g.vertices[g.indices[i + 2]].position});
  return out;
}

double areaOf(const BuildingGeometry& g, Range range) {
  double sum = 0;
  for (const Triangle& t : trianglesOf(g, range)) sum += 0.5 * static_cast<double>(glm::length(t.cross()));
  return sum;
}

/// Distance along the ray to the triangle, infinite where it misses.
float hit(vec3 from, vec3 direction, const Triangle& t) {
  constexpr float kMiss = std::numeric_limits<float>::infinity();
  const vec3 e1 = t.b - t.a, e2 = t.c - t.a;
  const vec3 p = glm::cross(direction, e2);
  const float det = glm::dot(e1, p);
  if (std::abs(det) < 1e-12f) return kMiss;
  const vec3 s = from - t.a;
  const float u = glm::dot(s, p) / det;
  const vec3 q = glm::cross(s, e1);
  const float v = glm::dot(direction, q) / det;
  const float d = glm::dot(e2, q) / det;
  constexpr float kEdge = 1e-5f;
  return u < -kEdge || v < -kEdge || u + v > 1 + kEdge || d <= 0 ? kMiss : d;
}

/// Directions all round and above, none below the horizon: houses have no floor.
std::vector<vec3> directions(uint32_t seed, int count) {
  city::Random random(seed);
  std::vector<vec3> out;
  for (int i = 0; i < count; ++i) {
    const double angle = random.uniform(0, 6.283185307179586), up = random.uniform(0.0, 1.0);
    const double flat = std::sqrt(1 - up * up);
    out.emplace_back(flat * std::cos(angle), flat * std::sin(angle), up);
  }
  return out;
}

TEST(NorvicHouses, SixteenKindsWithAtMostEightVariants) {
  std::set<std::string> kinds;
  for (int k = 0; k < kHouseKinds; ++k) {
    const size_t variants = catalogue().byKind[static_cast<size_t>(k)].size();
    EXPECT_GE(variants, 1u);
    EXPECT_LE(variants, 8u) << nameOf(static_cast<HouseKind>(k));
    kinds.insert(std::string(nameOf(static_cast<HouseKind>(k))));
  }
  EXPECT_EQ(kinds.size(), static_cast<size_t>(kHouseKinds));
}

TEST(NorvicHouses, NumbersAreFiniteAndMaterialsExist) {
  const size_t materials = paletteMaterials().size();
  for (const BuildingGeometry& g : catalogue().geometry) {
    for (const city::Vertex& v : g.vertices) {
      ASSERT_TRUE(std::isfinite(v.position.x + v.position.y + v.position.z + v.uv.x + v.uv.y)) << g.name;
      ASSERT_LT(v.material, materials) << g.name;
    }
    for (const uint32_t index : g.indices) ASSERT_LT(index, g.vertices.size()) << g.name;
    EXPECT_GT(g.height, 3) << g.name;
    EXPECT_LT(g.height, 20) << g.name;
    EXPECT_LE(g.bounds.min.z, -1.4f) << g.name << ": its foundation is too shallow";
    EXPECT_LT(g.fullDetailTriangles(), 620u) << g.name;
  }
}

TEST(NorvicHouses, CutSurfacesAndOpeningsFillTheFlatSurface) {
  for (const BuildingGeometry& g : catalogue().geometry)
    for (const Plane& plane : g.planes) {
      double openings = 0;
      for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i) {
        // The pane is parallel to its wall; the reveals are square to it.
        for (const Triangle& t : trianglesOf(g, g.externalOpenings[i].indices)) {
          const vec3 cross = t.cross();
          if (glm::dot(glm::normalize(cross), plane.normal) > 0.99f)
            openings += 0.5 * static_cast<double>(glm::length(cross));
        }
      }
      const double flat = areaOf(g, plane.flat);
      EXPECT_NEAR(areaOf(g, plane.cut) + openings, flat, 1e-3 + 1e-4 * flat) << g.name;
    }
}

TEST(NorvicHouses, OpeningsGoInAndGeometrySticksOut) {
  int openings = 0, geometry = 0;
  for (const BuildingGeometry& g : catalogue().geometry)
    for (const Plane& plane : g.planes) {
      if (plane.flat.count == 0) continue;
      const vec3 onWall = g.vertices[g.indices[plane.flat.first]].position;
      const auto reach = [&](Range range) {
        glm::vec2 r(1e9f, -1e9f);
        for (uint32_t i = range.first; i < range.end(); ++i) {
          const float out = glm::dot(g.vertices[g.indices[i]].position - onWall, plane.normal);
          r = {std::min(r.x, out), std::max(r.y, out)};
        }
        return r;
      };
      for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i, ++openings) {
        const auto& opening = g.externalOpenings[i];
        EXPECT_GE(opening.depth, 0.08f) << g.name;
        EXPECT_LE(opening.depth, 0.25f) << g.name;
        EXPECT_NEAR(reach(opening.indices).x, -opening.depth, 1e-4f) << g.name;
        EXPECT_LE(reach(opening.indices).y, 0.09f) << g.name;
      }
      for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i, ++geometry) {
        const auto& item = g.externalGeometry[i];
        EXPECT_GT(item.depth, 0) << g.name;
        EXPECT_NEAR(reach(item.indices).y, item.depth, 1e-4f) << g.name;
        EXPECT_GE(reach(item.indices).x, -1e-4f) << g.name;
      }
    }
  EXPECT_GT(openings, 400);
  EXPECT_GT(geometry, 600);
}

TEST(NorvicHouses, FlatTrianglesFaceTheirPlanesWay) {
  for (const BuildingGeometry& g : catalogue().geometry)
    for (const Plane& plane : g.planes) {
      if (plane.kind == PlaneKind::Other) continue;
      for (const Range range : {plane.cut, plane.flat})
        for (const Triangle& t : trianglesOf(g, range))
          ASSERT_GT(glm::dot(glm::normalize(t.cross()), plane.normal), 0.999f) << g.name;
    }
}

/// Seen from within, no way leads out between walls and roof: at full detail and with flat surfaces.
TEST(NorvicHouses, AreClosedAboveTheGround) {
  for (const BuildingGeometry& g : catalogue().geometry) {
    std::vector<Triangle> detailed = trianglesOf(g, g.fullDetail), flat;
    for (const Plane& plane : g.planes)
      for (const Triangle& t : trianglesOf(g, plane.flat)) flat.push_back(t);
    const vec3 from(0.13f, 0.07f, 1.3f);
    for (const vec3 direction : directions(7, 300))
      for (const auto* surfaces : {&detailed, &flat}) {
        bool met = false;
        for (const Triangle& t : *surfaces) met = met || std::isfinite(hit(from, direction, t));
        ASSERT_TRUE(met) << g.name << (surfaces == &flat ? ", flat" : ", full detail") << ": a gap towards ("
                         << direction.x << ", " << direction.y << ", " << direction.z << ")";
      }
  }
}

/// Seen from outside, what is met first turns its front to the viewer.
TEST(NorvicHouses, TurnTheirFrontsOutward) {
  for (const BuildingGeometry& g : catalogue().geometry) {
    const std::vector<Triangle> surfaces = trianglesOf(g, g.fullDetail);
    const vec3 middle(0.1f, 0.2f, 0.4f * g.height);
    for (const vec3 direction : directions(11, 200)) {
      const vec3 from = middle + 60.0f * direction;
      float nearest = std::numeric_limits<float>::infinity();
      const Triangle* first = nullptr;
      for (const Triangle& t : surfaces)
        if (const float d = hit(from, -direction, t); d < nearest) nearest = d, first = &t;
      ASSERT_NE(first, nullptr) << g.name;
      EXPECT_LT(glm::dot(first->cross(), -direction), 0) << g.name << " shows a back";
    }
  }
}

TEST(NorvicHouses, WallsReachTheRoof) {
  // Directly above every corner of the footprint, a little within it, lies a roof that touches the wall's top.
  for (const HouseVariant& v : catalogue().variants) {
    const BuildingGeometry& g = catalogue().geometry[v.geometry];
    std::vector<Triangle> roof;
    float eaves = 0;
    for (const Plane& plane : g.planes)
      if (plane.kind == PlaneKind::Roof)
        for (const Triangle& t : trianglesOf(g, plane.flat)) roof.push_back(t);
    for (const city::OccluderLine& line : g.occluders) eaves = std::max(eaves, line.top);
    for (const float x : {-0.49f, 0.49f})
      for (const float y : {-0.49f, 0.49f}) {
        float above = std::numeric_limits<float>::infinity();
        const vec3 from(x * v.width, y * v.depth, 0.5f);
        for (const Triangle& t : roof) above = std::min(above, hit(from, {0, 0, 1}, t));
        ASSERT_TRUE(std::isfinite(above)) << g.name << " has a corner under the sky";
        const float top = from.z + above;
        EXPECT_GT(top, eaves) << g.name;
        EXPECT_LT(top, eaves + 2.0f) << g.name << ": its roof floats";
      }
  }
}

TEST(NorvicHouses, OccludersLieWithinDrawnSolidWalls) {
  for (const BuildingGeometry& g : catalogue().geometry) {
    ASSERT_GE(g.occluders.size(), 4u) << g.name;
    for (const city::OccluderLine& line : g.occluders) {
      EXPECT_GT(glm::length(line.b - line.a), 1) << g.name;
      // Half-way along and at four heights, a ray through the line from both sides meets the wall there.
      const glm::vec2 middle = glm::mix(line.a, line.b, 0.37f);
      const glm::vec2 along = glm::normalize(line.b - line.a);
      const vec3 out(along.y, -along.x, 0);
      for (const float t : {0.02f, 0.3f, 0.6f, 0.98f}) {
        const vec3 from = vec3(middle, glm::mix(line.bottom, line.top, t)) + 0.5f * out;
        bool met = false;
        for (const Plane& plane : g.planes) {
          if (!plane.solid || plane.kind != PlaneKind::Wall) continue;
          for (const Triangle& triangle : trianglesOf(g, plane.flat))
            met = met || std::abs(hit(from, -out, triangle) - 0.5f) < 1e-3f;
        }
        EXPECT_TRUE(met) << g.name << ": no wall at its occluder line";
      }
    }
  }
}

TEST(NorvicHouses, FootprintIsTheGroundFloor) {
  for (const HouseVariant& v : catalogue().variants) {
    const BuildingGeometry& g = catalogue().geometry[v.geometry];
    ASSERT_EQ(g.footprint.size(), 1u) << g.name;
    double area = 0;
    const auto& ring = g.footprint[0];
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      area += 0.5 * static_cast<double>(a.x * b.y - a.y * b.x);
    }
    EXPECT_NEAR(area, static_cast<double>(v.width * v.depth), 1e-3) << g.name;
  }
}

}  // namespace
}  // namespace vicus::assets::norvic
