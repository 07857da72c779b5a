#include "city/height_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "city/random.hpp"

namespace vicus::city {
namespace {

constexpr float kHole = std::numeric_limits<float>::quiet_NaN();

HeightField randomField(glm::ivec2 size, glm::dvec2 spacing = {5, 4}, glm::dvec2 origin = {-30, 100}) {
  HeightField field;
  field.size = size, field.spacing = spacing, field.origin = origin;
  Random random(1);
  for (int i = 0; i < size.x * size.y; ++i) field.heights.push_back(static_cast<float>(random.uniform(0, 50)));
  field.updateRange();
  return field;
}

glm::dvec2 positionOf(const HeightField& field, double column, double row) {
  return field.origin + field.spacing * glm::dvec2(column, row);
}

TEST(HeightField, samplesAreMetExactly) {
  const HeightField field = randomField({9, 7});
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 9; ++column) {
      const glm::dvec2 p = positionOf(field, column, row);
      ASSERT_TRUE(field.heightAt(p.x, p.y));
      EXPECT_NEAR(*field.heightAt(p.x, p.y), static_cast<double>(field.at(column, row)), 1e-9);
    }
}

TEST(HeightField, isContinuousAcrossDiagonalsAndCellEdges) {
  const HeightField field = randomField({17, 17});
  Random random(2);
  constexpr double kStep = 1e-7;
  double largest = 0;
  for (int k = 0; k < 20'000; ++k) {
    // Points on an edge of a cell or on one of its diagonals, and their neighbours to all sides.
    const double column = random.below(15), row = random.below(15), t = random.uniform();
    const glm::dvec2 places[] = {
        {column + t, row}, {column, row + t}, {column + t, row + t}, {column + t, row + 1 - t}};
    const glm::dvec2 p = positionOf(field, places[k % 4].x, places[k % 4].y);
    for (const glm::dvec2 d : {glm::dvec2(kStep, 0), {-kStep, 0}, {0, kStep}, {0, -kStep}})
      largest = std::max(largest, std::abs(*field.heightAt(p.x, p.y) - *field.heightAt(p.x + d.x, p.y + d.y)));
  }
  // The steepest slope is 50 m in 4 m.
  EXPECT_LE(largest, 50.0 / 4 * kStep * 1.5);
}

TEST(HeightField, diagonalsAlternateAsInTheFinestMesh) {
  HeightField field;
  field.size = {3, 2};
  field.heights = {0, 1, 0,   // south
                   0, 0, 0};  // north
  // Cell (0, 0): diagonal from south-west to north-east, so its middle is the mean of those corners.
  EXPECT_EQ(*field.heightAt(0.5, 0.5), 0);
  // Cell (1, 0): from north-west to south-east.
  EXPECT_EQ(*field.heightAt(1.5, 0.5), 0);
  field.heights = {1, 0, 0, 0, 0, 0};
  EXPECT_EQ(*field.heightAt(0.5, 0.5), 0.5);
  field.heights = {0, 0, 1, 0, 0, 0};
  EXPECT_EQ(*field.heightAt(1.5, 0.5), 0.5);
}

TEST(HeightField, outsideIsTheNearestEdge) {
  const HeightField field = randomField({5, 5});
  const glm::dvec2 end = positionOf(field, 4, 4);
  EXPECT_NEAR(*field.heightAt(-1e9, -1e9), static_cast<double>(field.at(0, 0)), 1e-9);
  EXPECT_NEAR(*field.heightAt(1e300, 1e300), static_cast<double>(field.at(4, 4)), 1e-9);
  EXPECT_NEAR(*field.heightAt(end.x + 100, end.y), static_cast<double>(field.at(4, 4)), 1e-9);
}

TEST(HeightField, onlyTrianglesAtAHoleHaveNothing) {
  HeightField field = randomField({3, 3}, {1, 1}, {0, 0});
  field.at(0, 0) = kHole;  // a corner of the triangles of cell (0, 0) on both sides of its diagonal
  EXPECT_FALSE(field.heightAt(0.6, 0.2));
  EXPECT_FALSE(field.heightAt(0.2, 0.6));
  EXPECT_TRUE(field.heightAt(1.2, 0.6));
  EXPECT_EQ(field.triangleCount(), 6u);
  EXPECT_EQ(field.normalAt(0.5, 0.5), glm::dvec3(0, 0, 1));

  field = randomField({3, 3}, {1, 1}, {0, 0});
  field.at(1, 0) = kHole;  // off the diagonal of cell (0, 0) and of cell (1, 0)
  EXPECT_FALSE(field.heightAt(0.6, 0.2));
  EXPECT_TRUE(field.heightAt(0.2, 0.6)) << "the triangle on the other side of the diagonal has all its corners";
  EXPECT_EQ(field.triangleCount(), 6u);
}

TEST(HeightField, positionsThatAreNotFiniteHaveNothing) {
  const HeightField field = randomField({3, 3});
  for (const double bad : {std::nan(""), static_cast<double>(INFINITY), -static_cast<double>(INFINITY)}) {
    EXPECT_FALSE(field.heightAt(bad, 0));
    EXPECT_FALSE(field.heightAt(0, bad));
    EXPECT_EQ(field.normalAt(bad, 0), glm::dvec3(0, 0, 1));
  }
}

TEST(HeightField, fieldsWithoutACellHaveNothing) {
  for (const glm::ivec2 size : {glm::ivec2(0), {1, 1}, {1, 9}, {9, 1}}) {
    const HeightField field = randomField(size);
    EXPECT_TRUE(field.empty());
    EXPECT_FALSE(field.heightAt(0, 0));
    EXPECT_EQ(field.triangleCount(), 0u);
    EXPECT_TRUE(field.bounds().empty());
  }
}

TEST(HeightField, theSmallestFieldHasTwoTriangles) {
  EXPECT_EQ(randomField({2, 2}).triangleCount(), 2u);
  EXPECT_EQ(randomField({401, 401}).triangleCount(), 320'000u);
}

TEST(HeightField, normalsAreThoseOfThePlane) {
  HeightField field = randomField({5, 5}, {2, 3}, {0, 0});
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      field.at(column, row) = static_cast<float>(0.5 * 2 * column - 0.25 * 3 * row);
  const glm::dvec3 expected = glm::normalize(glm::dvec3(-0.5, 0.25, 1));
  Random random(3);
  for (int k = 0; k < 100; ++k)
    EXPECT_LT(glm::distance(field.normalAt(random.uniform(0, 8), random.uniform(0, 12)), expected), 1e-12);
}

TEST(HeightField, rangeIsThatOfTheSamplesThatHaveData) {
  HeightField field = randomField({2, 2});
  field.heights = {kHole, 3, -7, 5};
  field.updateRange();
  EXPECT_EQ(field.minHeight, -7);
  EXPECT_EQ(field.maxHeight, 5);
  field.heights = {kHole, kHole, kHole, kHole};
  field.updateRange();
  EXPECT_EQ(field.minHeight, 0);
  EXPECT_EQ(field.maxHeight, 0);
}

TEST(HeightField, boundsHoldTheSurface) {
  const HeightField field = randomField({9, 9});
  const Aabb bounds = field.bounds();
  Random random(4);
  for (int k = 0; k < 1000; ++k) {
    const glm::dvec2 p = positionOf(field, random.uniform(0, 8), random.uniform(0, 8));
    EXPECT_TRUE(bounds.contains({p.x, p.y, *field.heightAt(p.x, p.y)}));
  }
}

}  // namespace
}  // namespace vicus::city
