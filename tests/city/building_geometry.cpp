#include "city/building_geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace vicus::city {
namespace {

/// A wall 4 m wide and 3 m high that faces south, with a window: a frame that sticks out and a pane that goes in.
BuildingGeometry wallWithWindow() {
  BuildingBuilder builder("wall");
  builder.beginLevel(0, 3);
  builder.beginPlane(PlaneKind::Wall, 1, {0, -1, 0});
  // Around the opening: left, right, below, above.
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {0, 0, 3}, 1);
  builder.addQuad({3, 0, 0}, {4, 0, 0}, {4, 0, 3}, {3, 0, 3}, 1);
  builder.addQuad({1, 0, 0}, {3, 0, 0}, {3, 0, 1}, {1, 0, 1}, 1);
  builder.addQuad({1, 0, 2}, {3, 0, 2}, {3, 0, 3}, {1, 0, 3}, 1);
  builder.beginFlat();
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 1);
  builder.beginExternalGeometry(0.05F);
  builder.addQuad({1, -0.05F, 0.9F}, {3, -0.05F, 0.9F}, {3, -0.05F, 1}, {1, -0.05F, 1}, 2);
  builder.beginExternalOpening(0.2F);
  builder.addQuad({1, 0.2F, 1}, {3, 0.2F, 1}, {3, 0.2F, 2}, {1, 0.2F, 2}, 3);
  builder.beginLevel(3, 5);
  builder.beginPlane(PlaneKind::Roof, 4, {0, 0, 1}, false);
  builder.addQuad({0, 0, 3}, {4, 0, 3}, {4, 4, 3}, {0, 4, 3}, 4);
  return builder.finish();
}

bool within(Range inner, Range outer) {
  return inner.first >= outer.first && inner.end() <= outer.end();
}

TEST(BuildingBuilder, fullDetailIsOneRunAndTheFlatSurfacesThatDifferFollow) {
  const BuildingGeometry g = wallWithWindow();
  // Four pieces of wall, sill, pane, roof; the hole's corners split the pieces beside it, two of theirs the roof.
  EXPECT_EQ(g.fullDetailTriangles(), 7u * 2 + 4 + 2);
  EXPECT_EQ(g.fullDetail, (Range{0, 20 * 3}));
  EXPECT_EQ(g.indices.size(), 22u * 3);
  ASSERT_EQ(g.planes.size(), 2u);
  EXPECT_EQ(g.planes[0].cut, (Range{0, 12 * 3}));
  EXPECT_EQ(g.planes[0].flat, (Range{20 * 3, 6}));
  EXPECT_EQ(g.planes[1].flat, g.planes[1].cut) << "a plane without openings is flat already";
}

TEST(BuildingBuilder, rangesLieWithinTheirParents) {
  const BuildingGeometry g = wallWithWindow();
  ASSERT_EQ(g.levels.size(), 2u);
  EXPECT_EQ(g.levels[0].planes, (Range{0, 1}));
  EXPECT_EQ(g.levels[1].planes, (Range{1, 1}));
  EXPECT_EQ(g.planes[0].externalGeometry, (Range{0, 1}));
  EXPECT_EQ(g.planes[0].externalOpenings, (Range{0, 1}));
  EXPECT_EQ(g.planes[1].externalGeometry.count, 0u);
  EXPECT_TRUE(within(g.externalGeometry[0].indices, g.fullDetail));
  EXPECT_TRUE(within(g.externalOpenings[0].indices, g.fullDetail));
  EXPECT_EQ(g.externalGeometry[0].depth, 0.05F);
  EXPECT_EQ(g.externalOpenings[0].depth, 0.2F);
  for (const uint32_t i : g.indices) ASSERT_LT(i, g.vertices.size());
}

TEST(BuildingBuilder, boundsHoldEveryVertex) {
  const BuildingGeometry g = wallWithWindow();
  for (const Vertex& v : g.vertices) EXPECT_TRUE(g.bounds.contains(v.position));
  EXPECT_EQ(g.bounds, (Aabbf{{0, -0.05F, 0}, {4, 4, 3}}));
  EXPECT_EQ(g.height, 3);
}

TEST(BuildingBuilder, verticesKnowTheirItemAndWhichWayItSlides) {
  const BuildingGeometry g = wallWithWindow();
  const auto vertexAt = [&](Range range) { return g.vertices[g.indices[range.first]]; };
  const Vertex wall = vertexAt(g.planes[0].cut), sill = vertexAt(g.externalGeometry[0].indices),
               pane = vertexAt(g.externalOpenings[0].indices);
  EXPECT_EQ(wall.item, 0);
  EXPECT_EQ(unpackSlide(wall.slide).depth, 0);
  EXPECT_EQ(sill.item, 1);
  EXPECT_NEAR(unpackSlide(sill.slide).depth, 0.05, 1e-4);
  EXPECT_EQ(pane.item, 2);
  EXPECT_NEAR(unpackSlide(pane.slide).depth, -0.2, 1e-4);
  EXPECT_LT(glm::distance(unpackSlide(pane.slide).axis, glm::vec3(0, -1, 0)), 1e-6F) << "out of the wall";
  EXPECT_EQ(pane.material, 3);
}

TEST(BuildingBuilder, theOrderOfItemsAndSurfaceDoesNotChangeTheLayout) {
  BuildingBuilder builder("mixed");
  builder.beginPlane(PlaneKind::Wall, 0, {0, -1, 0});
  builder.beginExternalGeometry(0.1F);
  builder.addQuad({0, -0.1F, 0}, {1, -0.1F, 0}, {1, -0.1F, 1}, {0, -0.1F, 1}, 0);
  builder.beginCut();
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, 0);
  builder.beginExternalGeometry(0.2F);
  builder.addQuad({0, -0.2F, 0}, {1, -0.2F, 0}, {1, -0.2F, 1}, {0, -0.2F, 1}, 0);
  builder.beginCut();
  builder.addQuad({1, 0, 0}, {2, 0, 0}, {2, 0, 1}, {1, 0, 1}, 0);
  const BuildingGeometry g = builder.finish();
  EXPECT_EQ(g.planes[0].cut, (Range{0, 12})) << "both pieces of the surface, one run";
  EXPECT_EQ(g.externalGeometry[0].indices, (Range{12, 6}));
  EXPECT_EQ(g.externalGeometry[1].indices, (Range{18, 6}));
  EXPECT_EQ(g.fullDetail, (Range{0, 24}));
}

TEST(BuildingBuilder, trianglesWithoutALevelOrPlaneGetThem) {
  BuildingBuilder builder("bare");
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0);
  const BuildingGeometry g = builder.finish();
  EXPECT_EQ(g.levels.size(), 1u);
  EXPECT_EQ(g.planes.size(), 1u);
  EXPECT_EQ(g.fullDetailTriangles(), 2u);
}

TEST(BuildingBuilder, degenerateQuadsAndPolygonsAreDropped) {
  BuildingBuilder builder("thin");
  builder.beginPlane(PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}, 0);
  const std::vector<glm::vec3> line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  builder.addConvex(line, {1, 0, 0}, {0, 0, 1}, 0);
  builder.addConvex(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}}, {1, 0, 0}, {0, 0, 1}, 0);
  const BuildingGeometry g = builder.finish();
  EXPECT_EQ(g.fullDetailTriangles(), 0u);
  EXPECT_TRUE(g.bounds.empty());
  EXPECT_EQ(g.height, 0);
}

TEST(BuildingBuilder, finishLeavesTheBuilderReadyForTheNext) {
  BuildingBuilder builder("first");
  builder.addQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0);
  EXPECT_EQ(builder.finish().vertices.size(), 4u);
  const BuildingGeometry nothing = builder.finish();
  EXPECT_TRUE(nothing.vertices.empty());
  EXPECT_TRUE(nothing.planes.empty());
}

TEST(BuildingBuilder, aBoxIsClosedAndItsFacesLookOutward) {
  BuildingBuilder builder("box");
  builder.beginPlane(PlaneKind::Other, 0, {0, 0, 1});
  builder.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {2, 3, 4}, 0);
  const BuildingGeometry g = builder.finish();
  ASSERT_EQ(g.indices.size(), 36u);
  double volume = 0;
  const glm::vec3 centre(1, 1.5F, 2);
  for (size_t t = 0; t < g.indices.size(); t += 3) {
    std::array<glm::vec3, 3> p;
    for (size_t k = 0; k < 3; ++k) p[k] = g.vertices[g.indices[t + k]].position;
    const glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    EXPECT_GT(glm::dot(normal, p[0] - centre), 0);
    EXPECT_GT(glm::dot(normal, unpackNormal(g.vertices[g.indices[t]].normal)), 0);
    volume += static_cast<double>(glm::dot(p[0], glm::cross(p[1], p[2]))) / 6;
  }
  EXPECT_NEAR(volume, 24, 1e-5);
}

TEST(BuildingBuilder, aBoxCanLeaveOutFaces) {
  BuildingBuilder builder("open box");
  builder.beginPlane(PlaneKind::Other, 0, {0, 0, 1});
  builder.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 1, 1}, 0, 0x20);
  const BuildingGeometry g = builder.finish();
  ASSERT_EQ(g.indices.size(), 6u);
  EXPECT_LT(glm::distance(unpackNormal(g.vertices[0].normal), glm::vec3(0, 0, 1)), 1e-6F) << "the top alone";
}

TEST(BuildingBuilder, quadsHaveUvInMetres) {
  BuildingBuilder builder("uv");
  builder.beginPlane(PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0, {10, 20});
  const BuildingGeometry g = builder.finish();
  EXPECT_EQ(g.vertices[0].uv, glm::vec2(10, 20));
  EXPECT_EQ(g.vertices[2].uv, glm::vec2(14, 23));
}

}  // namespace
}  // namespace vicus::city
