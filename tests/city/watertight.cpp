#include "city/watertight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <tuple>

#include "city/building_geometry.hpp"

namespace vicus::city {
namespace {

using glm::vec3;

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> a, b;

  void quad(std::vector<uint32_t>& surface, vec3 p, vec3 q, vec3 r, vec3 s) {
    const auto first = static_cast<uint32_t>(vertices.size());
    for (const vec3 c : {p, q, r, s}) {
      Vertex v;
      v.position = c, v.uv = {c.x + c.y, c.z};
      v.normal = packNormal(glm::normalize(glm::cross(q - p, s - p)));
      vertices.push_back(v);
    }
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) surface.push_back(first + k);
  }
  size_t seal() {
    std::vector<uint32_t>* const surfaces[] = {&a, &b};
    return makeWatertight(vertices, surfaces);
  }
};

/// Edges without their opposite, by exact positions: what is open.
size_t openEdges(const std::vector<Vertex>& vertices, const std::vector<std::vector<uint32_t>>& surfaces) {
  using Key = std::array<float, 6>;
  std::map<Key, int> edges;
  for (const auto& surface : surfaces)
    for (size_t i = 0; i < surface.size(); i += 3)
      for (size_t k = 0; k < 3; ++k) {
        const vec3 p = vertices[surface[i + k]].position, q = vertices[surface[i + (k + 1) % 3]].position;
        ++edges[{p.x, p.y, p.z, q.x, q.y, q.z}];
        --edges[{q.x, q.y, q.z, p.x, p.y, p.z}];
      }
  size_t open = 0;
  for (const auto& [key, count] : edges) open += count > 0;
  return open;
}

double areaOf(const std::vector<Vertex>& vertices, const std::vector<uint32_t>& surface) {
  double area = 0;
  for (size_t i = 0; i < surface.size(); i += 3)
    area += 0.5 * static_cast<double>(
                      glm::length(glm::cross(vertices[surface[i + 1]].position - vertices[surface[i]].position,
                                             vertices[surface[i + 2]].position - vertices[surface[i]].position)));
  return area;
}

TEST(Watertight, aCornerOnANeighboursEdgeSplitsIt) {
  Mesh m;
  m.quad(m.a, {0, 0, 0}, {4, 0, 0}, {4, 0, 9}, {0, 0, 9});
  m.quad(m.b, {4, 0, 0}, {4, 5, 0}, {4, 5, 3}, {4, 0, 3});
  m.quad(m.b, {4, 0, 3}, {4, 5, 3}, {4, 5, 9}, {4, 0, 9});
  EXPECT_EQ(m.seal(), 1u);
  EXPECT_EQ(openEdges(m.vertices, {m.a, m.b}), 7u) << "the outline: bottom, top and far sides";
  EXPECT_NEAR(areaOf(m.vertices, m.a), 36, 1e-4);
  EXPECT_EQ(m.a.size(), 9u);
  const Vertex& added = m.vertices.back();
  EXPECT_EQ(added.position, vec3(4, 0, 3));
  EXPECT_FLOAT_EQ(added.uv.x, 4);
  EXPECT_FLOAT_EQ(added.uv.y, 3);
}

TEST(Watertight, cornersThatDifferByRoundingBecomeOne) {
  Mesh m;
  m.quad(m.a, {0, 0, 0}, {4, 0, 0}, {4, 0, 9}, {0, 0, 9});
  m.quad(m.b, {4.00002f, 1e-6f, 0}, {4, 5, 0}, {4, 5, 9}, {3.9999f, 0, 9});
  EXPECT_EQ(m.seal(), 0u);
  EXPECT_EQ(openEdges(m.vertices, {m.a, m.b}), 6u);
}

TEST(Watertight, whatIsFartherApartStays) {
  Mesh m;
  m.quad(m.a, {0, 0, 0}, {4, 0, 0}, {4, 0, 9}, {0, 0, 9});
  m.quad(m.b, {4.001f, 0, 0}, {4.001f, 5, 0}, {4.001f, 5, 3}, {4.001f, 0, 3});
  const std::vector<Vertex> before = m.vertices;
  EXPECT_EQ(m.seal(), 0u);
  EXPECT_EQ(m.vertices, before);
}

TEST(Watertight, severalCornersOnAllEdgesOfATriangle) {
  Mesh m;
  m.vertices.resize(3);
  m.vertices[0].position = {0, 0, 0}, m.vertices[1].position = {8, 0, 0}, m.vertices[2].position = {0, 8, 0};
  m.a = {0, 1, 2};
  for (float t = 1; t < 8; ++t) {
    m.quad(m.b, {t, 0, 0}, {t - 1, 0, 0}, {t - 1, 0, -2}, {t, 0, -2});
    m.quad(m.b, {0, t - 1, 0}, {0, t, 0}, {0, t, -2}, {0, t - 1, -2});
  }
  EXPECT_EQ(m.seal(), 14u);
  EXPECT_EQ(m.a.size() / 3, 15u);
  EXPECT_NEAR(areaOf(m.vertices, m.a), 32, 1e-4);
  for (size_t i = 0; i < m.a.size(); i += 3) {
    const vec3 normal = glm::cross(m.vertices[m.a[i + 1]].position - m.vertices[m.a[i]].position,
                                   m.vertices[m.a[i + 2]].position - m.vertices[m.a[i]].position);
    EXPECT_GT(normal.z, 0) << "turned over";
  }
}

TEST(Watertight, trianglesWithoutAreaGo) {
  Mesh m;
  m.quad(m.a, {0, 0, 0}, {1e-5f, 0, 0}, {1e-5f, 0, 1}, {0, 0, 1});
  EXPECT_EQ(m.seal(), 0u);
  EXPECT_TRUE(m.a.empty());
}

TEST(Watertight, nothingAndDegenerateInput) {
  Mesh m;
  EXPECT_EQ(m.seal(), 0u);
  m.quad(m.a, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_EQ(m.seal(), 0u);
  EXPECT_TRUE(m.a.empty());
}

TEST(Watertight, aBuildingsWallsShareTheirEdges) {
  BuildingBuilder builder("house");
  builder.beginLevel(0, 3);
  builder.beginPlane(PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 6}, {0, 0, 6}, 0);
  builder.beginPlane(PlaneKind::Wall, 0, {1, 0, 0});
  builder.addQuad({4, 0, -1}, {4, 5, -1}, {4, 5, 6}, {4, 0, 6}, 0);
  const BuildingGeometry g = builder.finish();
  EXPECT_EQ(g.fullDetailTriangles(), 5u);
  EXPECT_EQ(g.planes[1].cut.count, 9u);
  const std::vector<uint32_t> all(g.indices.begin(), g.indices.begin() + g.fullDetail.count);
  // Bottom, top and outer sides, and the metre below the first wall.
  EXPECT_EQ(openEdges(g.vertices, {all}), 7u);
}

}  // namespace
}  // namespace vicus::city
