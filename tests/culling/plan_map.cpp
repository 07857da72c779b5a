#include "culling/plan_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "box_city.hpp"
#include "culling/cull_map.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"

namespace vicus::culling {
namespace {

using glm::dvec2;
using glm::dvec3;

PlanMap mapBehind(const ShadowWall& wall, bool published = false) {
  PlanMap map(128, 1, 500, 1e-5, published);
  map.add(wall);
  map.finish(-100, 100);
  return map;
}

/// A wall 20 m long and 6 m above the eye, 10 m north of it.
const ShadowWall kWall{{10, 10, 6}, {-10, 10, 6}};

TEST(PlanMap, aShadowRisesWithDistanceAndReachesTheHorizon) {
  const PlanMap map = mapBehind(kWall);
  for (const double distance : {15.0, 50.0, 200.0, 450.0}) {
    const PlanBox box{{-1, distance}, {1, distance + 2}};
    const double height = 6 * distance / 10;
    EXPECT_TRUE(map.hides(box, 0.8 * height)) << distance;
    EXPECT_FALSE(map.hides(box, 1.01 * height)) << distance;
  }
}

TEST(PlanMap, whatIsBesideBeforeOrAcrossTheEdgeIsNotHidden) {
  const PlanMap map = mapBehind(kWall);
  EXPECT_FALSE(map.hides({{-1, 6}, {1, 8}}, -5)) << "before the wall";
  EXPECT_FALSE(map.hides({{-1, 9}, {1, 14}}, -5)) << "on it";
  EXPECT_FALSE(map.hides({{60, 50}, {62, 52}}, -5)) << "beside the shadow";
  EXPECT_FALSE(map.hides({{40, 50}, {60, 52}}, -5)) << "across its edge";
  EXPECT_FALSE(map.hides({{-1, -1}, {1, 1}}, -5)) << "around the eye";
  EXPECT_FALSE(map.hides({{-1, 5000}, {1, 5001}}, -5)) << "beyond the grids";
}

TEST(PlanMap, aWallLowerThanTheEyeThrowsASinkingShadow) {
  const PlanMap map = mapBehind({{10, 10, -1}, {-10, 10, -1}});
  EXPECT_TRUE(map.hides({{-1, 100}, {1, 102}}, -11));
  EXPECT_FALSE(map.hides({{-1, 100}, {1, 102}}, -9.9));
}

TEST(PlanMap, wallsThatShareACornerThrowOneShadow) {
  const ShadowWall right{{10, 10, 6}, {0, 10, 6}}, left{{0, 10, 6}, {-10, 10, 6}};
  PlanMap apart(128, 1, 500, 1e-5, false), joined(128, 1, 500, 1e-5, false);
  for (PlanMap* map : {&apart, &joined}) map->add(right), map->add(left);
  joined.addJoint(right, left);
  apart.finish(-100, 100), joined.finish(-100, 100);
  const PlanBox across{{-3, 60}, {3, 63}};
  EXPECT_FALSE(apart.hides(across, 10));
  EXPECT_TRUE(joined.hides(across, 10));
}

TEST(PlanMap, asPublishedOnlyTheCentreIsLookedUp) {
  const PlanMap map = mapBehind(kWall, true);
  const PlanBox across{{30, 50}, {60, 52}};
  EXPECT_TRUE(map.hides(across, 10)) << "half of it can be seen";
  EXPECT_FALSE(mapBehind(kWall).hides(across, 10));
}

TEST(PlanMap, wallsWithoutWidthThrowNothing) {
  EXPECT_FALSE(mapBehind({{0, 10, 6}, {0, 10, 6}}).hides({{0, 50}, {0, 50}}, -5));
  EXPECT_FALSE(mapBehind({{0, 20, 6}, {0, 10, 6}}).hides({{0, 50}, {0, 50}}, -5));
}

TEST(PlanMap, losesNothingOfTheTownOfBoxesAndHidesMostOfIt) {
  const test::BoxCity town = test::makeBoxCity(3000);
  const Occluders occluders = occludersOf(town.city);
  uint64_t wrong = 0, drawn = 0, inFrustum = 0;
  for (const city::ViewState& view : test::streetViews(town, {960, 540}, 6)) {
    city::FramePlan plan;
    plan.view = view;
    const city::InstanceSet& set = town.city.buildings;
    cullInstances(set, boxTestFor(frustumOf(view), set.nodes[0].bounds), plan.buildings);
    inFrustum += plan.buildings.drawnCount;
    CullMapOptions options;
    options.kind = CullMapKind::Plan;
    CullMapView shown;
    cullOccluded(town.city, occluders, options, plan, &shown);
    EXPECT_FALSE(shown.occluders.empty());
    EXPECT_EQ(shown.heights.size(), static_cast<size_t>(shown.cells) * shown.cells);
    drawn += plan.buildings.drawnCount;
    const std::vector<bool> truth = test::visibleBoxes(town.city, view);
    for (const city::DroppedRange& run : plan.buildings.dropped)
      for (uint32_t i = run.range.first; i < run.range.end(); ++i)
        wrong += run.reason == city::DropReason::Occluded && truth[i];
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_LT(drawn, inFrustum / 2);
}

}  // namespace
}  // namespace vicus::culling
