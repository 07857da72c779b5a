#include "culling/cull_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "box_city.hpp"
#include "culling/cull_map_stability.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"

namespace vicus::culling {
namespace {

constexpr double kPi = std::numbers::pi;

/// A house 10 m wide and 6 m deep, its walls occluders from `foot` up.
city::BuildingGeometry house(float height, float foot = 0) {
  city::BuildingGeometry g = test::boxBuilding({10, 6, height});
  g.bounds.min.z = foot;
  for (city::OccluderLine& line : g.occluders) line.bottom = foot;
  return g;
}

/// A street scene: what is added keeps its number in `hidden`'s answers.
struct Scene {
  city::City city;
  city::CityParts parts;

  uint32_t add(const city::BuildingGeometry& type, glm::dvec3 corner) {
    city.buildingTypes.push_back(type);
    city::Instance& instance = parts.buildings.emplace_back();
    instance.position = corner;
    instance.geometry = instance.seed = static_cast<uint32_t>(city.buildingTypes.size() - 1);
    return instance.seed;
  }

  void finish() { EXPECT_EQ(city::finishCity(city, parts), 0u); }

  city::FramePlan everything(const city::ViewState& view) const {
    city::FramePlan plan;
    plan.view = view;
    for (auto [set, out] : {std::pair{&city.buildings, &plan.buildings}, {&city.trees, &plan.trees}}) {
      if (set->empty()) continue;
      out->drawn = {{0, static_cast<uint32_t>(set->size())}};
      out->drawnCount = out->inFrustumCount = set->size();
    }
    for (uint32_t i = 0; i < city.monuments.size(); ++i) plan.monuments.push_back(i);
    for (uint32_t i = 0; i < city.tiles.size(); ++i)
      if (!city.tiles[i].bounds.empty()) plan.tiles.push_back(i);
    return plan;
  }

  /// Seeds of the buildings that are dropped for an eye at `eye`, sorted.
  std::vector<uint32_t> hidden(glm::dvec3 eye, double heading = kPi / 2) const {
    city::FramePlan plan = everything(city::makeView({eye, heading, 0, 0}, 1, {1280, 720}));
    cullOccluded(city, occludersOf(city), {8192, false}, plan);
    std::vector<uint32_t> out;
    for (const city::DroppedRange& run : plan.buildings.dropped) {
      EXPECT_EQ(run.reason, city::DropReason::Occluded);
      for (uint32_t i = run.range.first; i < run.range.end(); ++i) out.push_back(city.buildings.instances[i].seed);
    }
    std::sort(out.begin(), out.end());
    return out;
  }
};

using Seeds = std::vector<uint32_t>;
constexpr glm::dvec3 kEye(5, -10, 1.7);  // 10 m before the middle of a house at the origin

TEST(CullMap, aHouseHidesALowerOneBehindItAndNotAHigherOne) {
  Scene s;
  s.add(house(8), {0, 0, 0});
  const uint32_t low = s.add(house(8), {0, 20, 0});
  s.add(house(40), {0, 40, 0});
  s.finish();
  EXPECT_EQ(s.hidden(kEye), Seeds{low});
  EXPECT_EQ(s.hidden({5, -10, 7.9}), Seeds{low}) << "the eye just below the eaves";
}

TEST(CullMap, fromTheOtherSideTheHighHouseHidesBoth) {
  Scene s;
  const uint32_t front = s.add(house(8), {0, 0, 0}), middle = s.add(house(8), {0, 20, 0});
  s.add(house(40), {0, 40, 0});
  s.finish();
  EXPECT_EQ(s.hidden({5, 60, 1.7}), (Seeds{front, middle}));
}

TEST(CullMap, aHouseOnAHillBehindStaysVisible) {
  for (const bool hill : {false, true}) {
    Scene s;
    s.add(house(8, -1), {0, 0, 0});
    const uint32_t behind = s.add(house(6, -1), {0, 60, hill ? 40.0 : 0.0});
    city::HeightField field;
    field.origin = {-200, -200}, field.spacing = glm::dvec2(100), field.size = {5, 5};
    field.heights.assign(25, 0);
    if (hill)
      for (int column = 0; column < 5; ++column) field.at(column, 3) = field.at(column, 4) = 66.7f;
    field.updateRange();
    s.city.terrain = field;
    s.finish();
    // On the slope the front house stands in the ground from y = 0 on: at its own foot it rises by 2 m in 3.
    EXPECT_EQ(s.hidden(kEye), hill ? Seeds{} : Seeds{behind});
  }
}

TEST(CullMap, aWallWhoseFootHangsOverTheTerrainHidesNothing) {
  for (const float foot : {-1.0f, -0.1f}) {
    Scene s;
    s.add(house(8, foot), {0, 0, 0});
    const uint32_t behind = s.add(house(8, -1), {0, 60, 0});
    city::HeightField field;
    field.origin = {-200, -200}, field.spacing = glm::dvec2(4), field.size = {101, 101};
    field.heights.assign(101 * 101, 0);
    field.at(51, 50) = -0.5f;  // a hollow at (4, 0), under the front wall
    field.updateRange();
    s.city.terrain = field;
    s.finish();
    EXPECT_EQ(s.hidden(kEye), foot < -0.5f ? Seeds{behind} : Seeds{}) << foot;
  }
}

TEST(CullMap, anArchwayHidesNothing) {
  Scene s;
  city::BuildingGeometry arch = house(8);
  for (city::OccluderLine& line : arch.occluders) line.bottom = 3;
  s.add(arch, {0, 0, 0});
  s.add(house(8), {0, 40, 0});
  s.finish();
  EXPECT_EQ(s.hidden(kEye), Seeds{});
}

/// A ground floor 3 m high and a storey up to 8 m whose front stands out by `jut`, with or without a floor under it.
city::BuildingGeometry jettied(float jut, bool floor) {
  city::BuildingGeometry g = house(3);
  for (const city::OccluderLine& line : house(8).occluders) {
    city::OccluderLine upper = line;
    upper.bottom = 3;
    if (upper.a.y == 0) upper.a.y = -jut;
    if (upper.b.y == 0) upper.b.y = -jut;
    g.occluders.push_back(upper);
  }
  g.bounds = {{0, -jut, 0}, {10, 6, 8}};
  if (!floor) return g;
  city::Plane plane;
  plane.kind = city::PlaneKind::Floor, plane.normal = {0, 0, -1};
  plane.cut = {0, 6};
  const glm::vec3 corners[] = {{0, -jut, 3}, {0, 0, 3}, {10, 0, 3}, {10, -jut, 3}};
  for (const glm::vec3 p : corners) g.vertices.push_back({p});
  g.indices = {0, 1, 2, 0, 2, 3};
  g.planes = {plane};
  return g;
}

TEST(CullMap, storeysHideTogetherWhereNoGapIsBetweenThem) {
  const auto hiddenBehind = [](const city::BuildingGeometry& front, glm::dvec3 eye) {
    Scene s;
    s.add(front, {0, 0, 0});
    s.add(house(20), {0, 60, 0});
    s.finish();
    return s.hidden(eye).size();
  };
  EXPECT_EQ(hiddenBehind(house(3), kEye), 0u);
  EXPECT_EQ(hiddenBehind(jettied(0, false), kEye), 1u) << "one plane";
  EXPECT_EQ(hiddenBehind(jettied(0.5f, true), kEye), 1u) << "a jetty closed from below";
  EXPECT_EQ(hiddenBehind(jettied(0.5f, false), kEye), 0u) << "a jetty open from below";
  EXPECT_EQ(hiddenBehind(jettied(0.5f, true), {5, -0.3, 4}), 0u) << "the eye in the jetty";
}

/// A terrace of four houses with gaps between them, and a low house behind the second gap.
Scene terrace(double gap, uint32_t& behind) {
  Scene s;
  for (int k = 0; k < 4; ++k) s.add(house(9), {(10 + gap) * k, 0, 0});
  behind = s.add(house(4), {15 + gap, 80, 0});
  s.finish();
  return s;
}

TEST(CullMap, terracesFuse) {
  uint32_t behind = 0;
  const Scene touching = terrace(0, behind);
  EXPECT_EQ(touching.hidden({14, -12, 1.7}), Seeds{behind});
  const Scene apart = terrace(0.02, behind);
  EXPECT_EQ(apart.hidden({14, -12, 1.7}), Seeds{behind}) << "side walls close a slit that is seen from aside";
}

/// A house with a gable roof: eaves at 6 m along x, ridge at 9 m over its middle.
city::BuildingGeometry gabled() {
  city::BuildingBuilder b("gabled");
  b.beginLevel(0, 9);
  const glm::vec3 c[] = {{0, 0, 0}, {10, 0, 0}, {10, 6, 0}, {0, 6, 0}};
  const auto up = [](glm::vec3 p) { return p + glm::vec3(0, 0, 6); };
  const glm::vec3 m(0, 3, 9), n(10, 3, 9);
  for (size_t k = 0; k < 4; ++k) {
    const glm::vec3 p = c[k], q = c[(k + 1) % 4], along = glm::normalize(q - p);
    b.beginPlane(city::PlaneKind::Wall, 0, {along.y, -along.x, 0});
    b.addQuad(p, q, up(q), up(p), 0);
    b.addOccluder({glm::vec2(p), glm::vec2(q), 0, 6});
  }
  b.beginPlane(city::PlaneKind::Roof, 0, glm::normalize(glm::vec3(0, -3, 3)));
  b.addQuad(up(c[0]), up(c[1]), n, m, 0);
  b.beginPlane(city::PlaneKind::Roof, 0, glm::normalize(glm::vec3(0, 3, 3)));
  b.addQuad(up(c[2]), up(c[3]), m, n, 0);
  for (const bool east : {false, true}) {
    b.beginPlane(city::PlaneKind::Gable, 0, {east ? 1 : -1, 0, 0});
    const glm::vec3 triangle[] = {up(east ? c[1] : c[3]), up(east ? c[2] : c[0]), east ? n : m};
    b.addConvex(triangle, {0, east ? 1 : -1, 0}, {0, 0, 1}, 0);
  }
  return b.finish();
}

TEST(CullMap, aRoofHidesUpToItsRidge) {
  const auto hiddenBehind = [](float height) {
    Scene s;
    s.add(gabled(), {0, 0, 0});
    s.add(house(height), {0, 40, 0});
    s.finish();
    return s.hidden(glm::dvec3(5, -20, 1.7)).size();
  };
  // Seen over the eaves 4.3 m up at 20 m: 14.6 m at 60 m; over the ridge 7.3 m up at 23 m: 20.7 m.
  EXPECT_EQ(hiddenBehind(14), 1u);
  EXPECT_EQ(hiddenBehind(18), 1u) << "the roof";
  EXPECT_EQ(hiddenBehind(21), 0u);
}

TEST(CullMap, aGableHidesWithTheWallBelowIt) {
  // Over the wall one sees what is higher than 16.5 m, over the gable 26 m.
  for (const auto& [height, hidden] : {std::pair{15.0f, 1u}, {22.0f, 1u}, {28.0f, 0u}}) {
    Scene s;
    s.add(gabled(), {0, 0, 0});
    s.add(test::boxBuilding({1, 1, height}), {-40, 2.5, 0});
    s.finish();
    EXPECT_EQ(s.hidden(glm::dvec3(30, 3, 1.7), kPi).size(), hidden) << height;
  }
}

TEST(CullMap, whatSticksOutOfARoofDoesNotMakeAHouseHighAllOver) {
  // A low house behind a higher one, its chimney seen above it; with a tower before the chimney nothing is seen.
  city::BuildingBuilder b("chimney");
  b.beginLevel(0, 3);
  b.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  b.addQuad({0, 0, 0}, {10, 0, 0}, {10, 0, 3}, {0, 0, 3}, 0);
  b.addOccluder({{0, 0}, {10, 0}, 0, 3});
  b.beginPlane(city::PlaneKind::Roof, 0, {0, 0, 1});
  b.addQuad({0, 0, 3}, {10, 0, 3}, {10, 6, 3}, {0, 6, 3}, 0);
  b.beginPlane(city::PlaneKind::Other, 0, {0, -1, 0}, false);
  b.addQuad({9, 5, 3}, {9.5f, 5, 3}, {9.5f, 5, 16}, {9, 5, 16}, 0);
  const city::BuildingGeometry low = b.finish();
  for (const bool tower : {false, true}) {
    Scene s;
    s.add(house(8), {0, 0, 0});
    if (tower) s.add(test::boxBuilding({3, 6, 30}), {6, 0, 0});
    const uint32_t behind = s.add(low, {0, 10, 0});
    s.finish();
    const Seeds hidden = s.hidden(glm::dvec3(5, -20, 1.7));
    EXPECT_EQ(std::count(hidden.begin(), hidden.end(), behind), tower ? 1 : 0);
  }
}

TEST(CullMap, aTownWallHides) {
  Scene s;
  city::MeshGeometry wall{"wall", {}, {}};
  const glm::vec3 corners[] = {{-20, 0, -1}, {20, 0, -1}, {20, 0, 7}, {-20, 0, 6}};
  for (const glm::vec3 p : corners) wall.mesh.vertices.push_back({p}), wall.bounds.extend(p);
  wall.mesh.indices = {0, 1, 2, 0, 2, 3};
  s.city.meshes.push_back(wall);
  s.city.monuments.emplace_back().position = {5, 0, 0};
  const uint32_t behind = s.add(house(5, -1), {0, 20, 0});
  s.finish();
  EXPECT_EQ(s.hidden(kEye), Seeds{behind});
  EXPECT_EQ(s.hidden({5, 60, 1.7}), Seeds{}) << "its back is not drawn";
}

TEST(CullMap, aSlitSeenStraightThroughStaysOpen) {
  uint32_t behind = 0;
  const Scene apart = terrace(0.02, behind);
  EXPECT_EQ(apart.hidden({20.03, -12, 1.7}), Seeds{});
}

TEST(CullMap, noBuildingHidesItself) {
  Scene s;
  s.add(house(9), {0, 0, 0});
  s.finish();
  city::Random random(1);
  for (int k = 0; k < 200; ++k) EXPECT_EQ(s.hidden({random.uniform(-20, 30), random.uniform(-20, 30), 1.7}), Seeds{});
}

TEST(CullMap, treesMonumentsAndTilesAreHiddenToo) {
  Scene s;
  s.add(house(9), {0, 0, 0});
  city::MeshGeometry mesh;
  mesh.bounds = {{-1, -1, 0}, {1, 1, 6}};
  s.city.treeTypes = s.city.meshes = {mesh};
  for (const double y : {20.0, -20.0}) {
    s.parts.trees.emplace_back().position = {5, y, 0};
    s.city.monuments.emplace_back().position = {5, y - 2, 0};
  }
  s.finish();
  city::FramePlan plan = s.everything(city::makeView({{5, -10, 1.7}, kPi / 2, 0, 0}, 1, {1280, 720}));
  const size_t tiles = plan.tiles.size();
  cullOccluded(s.city, occludersOf(s.city), {8192, false}, plan);
  EXPECT_EQ(plan.trees.drawnCount, 1u);
  ASSERT_EQ(plan.monuments.size(), 1u);
  EXPECT_LT(s.city.monuments[plan.monuments[0]].position.y, 0);
  EXPECT_LT(plan.tiles.size(), tiles);
  EXPECT_TRUE(std::is_sorted(plan.tiles.begin(), plan.tiles.end()));
}

TEST(CullMap, saysWhyItIsOff) {
  Scene s;
  s.add(house(9), {0, 0, 0});
  s.finish();
  const Occluders occluders = occludersOf(s.city);
  const auto why = [&](glm::dvec3 eye) {
    city::ViewState view;
    view.eye = eye;
    city::FramePlan plan = s.everything(view);
    return cullOccluded(s.city, occluders, {}, plan).off;
  };
  EXPECT_EQ(why(kEye), "");
  EXPECT_EQ(why({0, 0, 9.01}), "the eye is above all roofs");
  EXPECT_EQ(why({0, 0, -1}), "the eye is below the ground");
  EXPECT_EQ(why({std::numeric_limits<double>::quiet_NaN(), 0, 1}), "the eye is nowhere");
  city::FramePlan plan;
  EXPECT_EQ(cullOccluded({}, occludersOf({}), {}, plan).off, "no walls that hide");
}

TEST(CullMap, boxCityLosesNothingAndKeepsLittle) {
  const test::BoxCity town = test::makeBoxCity(3000);
  const Occluders occluders = occludersOf(town.city);
  uint64_t visible = 0, drawn = 0;
  for (const city::ViewState& view : test::streetViews(town, {1280, 720}, 12)) {
    city::FramePlan plan;
    plan.view = view;
    cullInstances(town.city.buildings, boxTestFor(frustumOf(view), town.city.buildings.nodes[0].bounds),
                  plan.buildings);
    cullOccluded(town.city, occluders, {}, plan);
    const std::vector<bool> truth = test::visibleBoxes(town.city, view);
    uint64_t lost = 0;
    for (const city::DroppedRange& run : plan.buildings.dropped)
      for (uint32_t i = run.range.first; i < run.range.end(); ++i) lost += truth[i];
    EXPECT_EQ(lost, 0u);
    visible += static_cast<uint64_t>(std::count(truth.begin(), truth.end(), true)), drawn += plan.buildings.drawnCount;
  }
  EXPECT_LT(static_cast<double>(drawn), 1.6 * static_cast<double>(visible)) << "1.35 when this was written";
}

TEST(CullMap, sameArgumentsSamePlan) {
  const test::BoxCity town = test::makeBoxCity(1000);
  const Occluders occluders = occludersOf(town.city);
  const city::ViewState view = test::streetViews(town, {640, 360}, 1)[0];
  std::vector<uint32_t> first;
  for (int k = 0; k < 2; ++k) {
    city::FramePlan plan;
    plan.view = view;
    plan.buildings.drawn = {{0, 1000}};
    cullOccluded(town.city, occluders, {}, plan);
    std::vector<uint32_t> runs;
    for (const city::Range& run : plan.buildings.drawn) runs.insert(runs.end(), {run.first, run.count});
    if (k == 0) first = runs;
    EXPECT_EQ(runs, first);
  }
}

TEST(CullMapStability, everyRowIsWithinItsBound) {
  for (const city::StabilityRow& row : cullMapStability())
    EXPECT_TRUE(row.ok) << row.part << ", " << row.caseName << ": " << row.what << " is " << row.figure
                        << ", and may be " << row.bound << " at most";
}

}  // namespace
}  // namespace vicus::culling
