/// The checkers find what they are for.
#include "terrain/mesh_check.hpp"

#include <gtest/gtest.h>

#include "tests/terrain/fields.hpp"

namespace vicus::terrain {
namespace {

/// A flat field of 3 × 3 samples and a mesh of its corners and centre.
struct Square {
  city::HeightField field;
  RoamMesh mesh;

  Square() {
    field.size = {3, 3};
    field.heights.assign(9, 0);
    for (const glm::ivec2 p :
         {glm::ivec2(0, 0), glm::ivec2(2, 0), glm::ivec2(2, 2), glm::ivec2(0, 2), glm::ivec2(1, 1)})
      mesh.vertices.push_back({p, 0});
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  }
};

TEST(MeshCheck, AcceptsASoundMesh) {
  const Square s;
  const MeshFaults faults = findFaults(s.field, s.mesh);
  EXPECT_EQ(faults.cracks + faults.flipped + faults.twisted, 0U);
  EXPECT_EQ(faults.coveredArea, 4);
  EXPECT_EQ(measureError(s.field, s.mesh).uncovered, 0U);
}

TEST(MeshCheck, FindsACrack) {
  Square s;
  s.mesh.triangles = {{0, 1, 2}, {2, 3, 4}, {3, 0, 4}};  // the centre lies on the first triangle's edge
  EXPECT_EQ(findFaults(s.field, s.mesh).cracks, 1U);
}

TEST(MeshCheck, FindsATriangleDrawnTwiceFlippedOrMissing) {
  Square s;
  s.mesh.triangles.push_back(s.mesh.triangles[0]);
  EXPECT_EQ(findFaults(s.field, s.mesh).cracks, 3U);
  s.mesh.triangles.pop_back();
  std::swap(s.mesh.triangles[0][0], s.mesh.triangles[0][1]);
  EXPECT_EQ(findFaults(s.field, s.mesh).flipped, 1U);
  s.mesh.triangles = {{1, 2, 4}, {2, 3, 4}};
  EXPECT_EQ(measureError(s.field, s.mesh).uncovered, 3U);
}

TEST(MeshCheck, MeasuresErrorsAndWrongVertices) {
  Square s;
  s.field.at(1, 0) = 0.5F;
  EXPECT_EQ(findFaults(s.field, s.mesh).twisted, 0U);
  EXPECT_DOUBLE_EQ(measureError(s.field, s.mesh).largestMetres, 0.5);
  s.field.at(1, 1) = 3;
  EXPECT_GT(findFaults(s.field, s.mesh).twisted, 0U);

  const city::ViewState view = city::makeView({{1, -10, 0}, 1.5707963, 0, 0}, 1, {100, 100});
  s.field.at(1, 1) = 0;
  EXPECT_NEAR(measureError(s.field, s.mesh, &view).largestPixels, 0.5 * city::pixelsPerUnitSlope(view) / 10, 1e-6);
  const city::ViewState away = city::makeView({{1, -10, 0}, -1.5707963, 0, 0}, 1, {100, 100});
  EXPECT_EQ(measureError(s.field, s.mesh, &away).largestPixels, 0);
}

}  // namespace
}  // namespace vicus::terrain
