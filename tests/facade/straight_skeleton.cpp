#include "facade/straight_skeleton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "city/random.hpp"
#include "facade/hip_roof.hpp"

namespace vicus::facade {
namespace {

using glm::dvec2;
using glm::dvec3;

Skeleton quick(const std::vector<Ring>& rings) {
  const auto s = straightSkeletonBy(SkeletonWay::Wavefront, rings);
  EXPECT_TRUE(s.has_value());
  return s.value_or(Skeleton{});
}

/// A star-shaped polygon of `corners` random radii: concave, simple, counter-clockwise.
Ring randomStar(city::Random& random, int corners, double radius) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.uniform(0.1, 0.9)) / corners;
    ring.push_back(random.uniform(0.35, 1) * radius * dvec2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

/// Right angles only, as houses with wings: a staircase between two sides.
Ring randomWings(city::Random& random, int steps) {
  Ring ring{{0, 0}};
  double x = 0;
  std::vector<dvec2> top;
  for (int i = 0; i < steps; ++i) {
    const double width = std::round(random.uniform(3, 9)), height = std::round(random.uniform(4, 12));
    top.push_back({x, height});
    x += width;
    top.push_back({x, height});
  }
  ring.push_back({x, 0});
  for (size_t i = top.size(); i-- > 0;)
    if (glm::length(top[i] - ring.back()) > 0.5) ring.push_back(top[i]);
  // Corners in line, where two steps are of one height, say nothing.
  Ring out;
  for (size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[(i + ring.size() - 1) % ring.size()], b = ring[i], c = ring[(i + 1) % ring.size()];
    if (std::abs((b - a).x * (c - b).y - (b - a).y * (c - b).x) > 1e-9) out.push_back(b);
  }
  return out;
}

TEST(StraightSkeleton, OfASquareIsItsDiagonals) {
  const Skeleton s = quick({{{0, 0}, {8, 0}, {8, 8}, {0, 8}}});
  ASSERT_EQ(s.faces.size(), 4u);
  EXPECT_NEAR(s.reach, 4, 1e-9);
  for (const SkeletonFace& f : s.faces) {
    ASSERT_EQ(f.polygon.size(), 3u);
    EXPECT_NEAR(glm::length(f.polygon[2] - dvec3(4, 4, 4)), 0, 1e-9);
  }
}

TEST(StraightSkeleton, OfARectangleHasARidge) {
  const Skeleton s = quick({{{0, 0}, {10, 0}, {10, 6}, {0, 6}}});
  EXPECT_EQ(s.faces[0].polygon.size(), 4u);
  EXPECT_EQ(s.faces[1].polygon.size(), 3u);
  EXPECT_NEAR(glm::length(s.faces[1].polygon[2] - dvec3(7, 3, 3)), 0, 1e-9);
  EXPECT_NEAR(glm::length(s.faces[3].polygon[2] - dvec3(3, 3, 3)), 0, 1e-9);
}

TEST(StraightSkeleton, OfAnLAndATAndAUAndAPlus) {
  const std::vector<std::vector<Ring>> shapes{
      {{{0, 0}, {12, 0}, {12, 5}, {6, 5}, {6, 14}, {0, 14}}},
      {{{0, 0}, {15, 0}, {15, 5}, {10, 5}, {10, 12}, {5, 12}, {5, 5}, {0, 5}}},
      {{{0, 0}, {15, 0}, {15, 12}, {10, 12}, {10, 5}, {5, 5}, {5, 12}, {0, 12}}},
      {{{4, 0}, {8, 0}, {8, 4}, {12, 4}, {12, 8}, {8, 8}, {8, 12}, {4, 12}, {4, 8}, {0, 8}, {0, 4}, {4, 4}}}};
  for (const auto& shape : shapes) EXPECT_EQ(quick(shape).faces.size(), shape[0].size());
}

TEST(StraightSkeleton, OfACourtyardHouse) {
  const Skeleton s = quick({{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{6, 6}, {6, 14}, {14, 14}, {14, 6}}});
  EXPECT_EQ(s.faces.size(), 8u);
  EXPECT_NEAR(s.reach, 3, 1e-9);
}

TEST(StraightSkeleton, BothWaysAgreeOnRandomShapes) {
  city::Random random(7);
  int quickFailures = 0;
  for (int i = 0; i < 400; ++i) {
    const std::vector<Ring> rings{i % 2 ? randomStar(random, 3 + i % 17, 12) : randomWings(random, 1 + i % 6)};
    const auto a = straightSkeletonBy(SkeletonWay::Wavefront, rings);
    const auto b = straightSkeletonBy(SkeletonWay::Exact, rings);
    ASSERT_TRUE(b.has_value()) << "shape " << i;
    quickFailures += !a;
    if (a) {
      EXPECT_NEAR(a->reach, b->reach, 1e-5) << "shape " << i;
    }
  }
  EXPECT_LE(quickFailures, 4) << "of 400";
}

TEST(StraightSkeleton, FarAndTinyAndHuge) {
  for (const double scale : {1e-2, 1.0, 1e4})
    for (const double away : {0.0, 1e5}) {
      Ring ring{{0, 0}, {12, 0}, {12, 5}, {6, 5}, {6, 14}, {0, 14}};
      for (dvec2& p : ring) p = scale * p + dvec2(away, -away);
      const auto s = straightSkeleton(std::vector<Ring>{ring});
      ASSERT_TRUE(s.has_value()) << scale << " at " << away;
      EXPECT_NEAR(s->reach / scale, 3, 1e-3);
    }
}

TEST(StraightSkeleton, NonsenseGivesNothing) {
  EXPECT_FALSE(straightSkeleton({}));
  EXPECT_FALSE(straightSkeleton(std::vector<Ring>{{{0, 0}, {1, 0}}}));
  EXPECT_FALSE(straightSkeleton(std::vector<Ring>{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}));  // crosses itself
  EXPECT_FALSE(straightSkeleton(std::vector<Ring>{{{0, 0}, {NAN, 4}, {4, 0}}}));
}

/// Volume under the pieces, by the divergence over their projections.
double areaOnPlan(const HipRoof& roof) {
  double sum = 0;
  for (const RoofPiece& piece : roof.pieces)
    for (size_t i = 1; i + 1 < piece.polygon.size(); ++i) {
      const dvec3 a = piece.polygon[i] - piece.polygon[0], b = piece.polygon[i + 1] - piece.polygon[0];
      sum += (a.x * b.y - a.y * b.x) / 2;
    }
  return sum;
}

TEST(HipRoof, GablesStandWhereNeighboursDo) {
  const std::vector<Ring> rings{{{0, 0}, {10, 0}, {10, 6}, {0, 6}}};
  const auto roof = hipRoof(rings, std::vector<std::vector<uint8_t>>{{0, 1, 0, 0}}, 0.5, 100);
  ASSERT_TRUE(roof);
  EXPECT_NEAR(roof->height, 1.5, 1e-9);
  EXPECT_TRUE(roof->pieces[1].gable);
  EXPECT_FALSE(roof->pieces[3].gable);
  EXPECT_NEAR(glm::length(roof->pieces[1].polygon[2] - dvec3(10, 3, 1.5)), 0, 1e-9);
  EXPECT_NEAR(areaOnPlan(*roof), 60, 1e-6);
}

TEST(HipRoof, PiecesStayFlatAndCoverThePlan) {
  city::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Ring> rings{i % 2 ? randomStar(random, 4 + i % 9, 10) : randomWings(random, 1 + i % 5)};
    const std::vector<std::vector<uint8_t>> gables{std::vector<uint8_t>(rings[0].size(), 1)};
    const auto roof = hipRoof(rings, gables, 0.6, 4.5);
    ASSERT_TRUE(roof) << i;
    EXPECT_LE(roof->height, 4.5 + 1e-9);
    double whole = 0;
    for (size_t k = 0; k < rings[0].size(); ++k) {
      const dvec2 a = rings[0][k], b = rings[0][(k + 1) % rings[0].size()];
      whole += (a.x * b.y - a.y * b.x) / 2;
    }
    EXPECT_NEAR(areaOnPlan(*roof), whole, 1e-5 * whole) << i;
    for (const RoofPiece& piece : roof->pieces) {
      dvec3 normal(0);
      for (size_t k = 1; k + 1 < piece.polygon.size(); ++k)
        normal += glm::cross(piece.polygon[k] - piece.polygon[0], piece.polygon[k + 1] - piece.polygon[0]);
      if (!(glm::length(normal) > 1e-9)) continue;
      normal = glm::normalize(normal);
      for (const dvec3& p : piece.polygon)
        EXPECT_NEAR(glm::dot(normal, p - piece.polygon[0]), 0, 1e-5) << i << ", edge " << piece.edge;
    }
  }
}

}  // namespace
}  // namespace vicus::facade
