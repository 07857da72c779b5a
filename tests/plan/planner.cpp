#include "plan/planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "city/random.hpp"
#include "culling/exact_visibility.hpp"
#include "plan/ground_weights.hpp"

namespace vicus::plan {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

city::MeshGeometry meshOf(std::string name, city::Aabbf bounds) {
  city::MeshGeometry mesh;
  mesh.name = std::move(name);
  mesh.bounds = bounds;
  return mesh;
}

/// What a small town is made of.
struct Ingredients {
  uint32_t buildings = 300, trees = 200, monuments = 3;
  bool terrain = true;
  double side = 1000;
};

city::City makeTown(const Ingredients& with) {
  city::City town;
  city::Random random(1);
  const auto place = [&] {
    return glm::dvec3(random.uniform(-with.side / 2, with.side / 2), random.uniform(-with.side / 2, with.side / 2), 0);
  };
  city::BuildingGeometry house;
  house.bounds = {{-6, -5, 0}, {6, 5, 9}};
  town.buildingTypes = {house};
  town.treeTypes = {meshOf("oak", {{-3, -3, 0}, {3, 3, 12}})};
  town.meshes = {meshOf("church", {{-10, -30, 0}, {10, 30, 50}})};
  city::CityParts parts;
  for (uint32_t i = 0; i < with.buildings; ++i) parts.buildings.emplace_back().position = place();
  for (uint32_t i = 0; i < with.trees; ++i) parts.trees.emplace_back().position = place();
  for (uint32_t i = 0; i < with.monuments; ++i) town.monuments.emplace_back().position = place();
  if (with.terrain) {
    city::HeightField field;
    field.size = {33, 33};
    field.origin = glm::dvec2(-with.side / 2);
    field.spacing = glm::dvec2(with.side / 32);
    field.heights.assign(33 * 33, 0.0F);
    town.terrain = field;
  }
  EXPECT_EQ(city::finishCity(town, std::move(parts)), 0u);
  return town;
}

city::Knobs knobs(bool culling = true) {
  city::Knobs all;
  all.declare(planKnobs());
  EXPECT_EQ(all.set("frustum_culling", culling ? 1 : 0), "");
  EXPECT_EQ(all.set("cull_map", 1), "");
  return all;
}

city::ViewState viewAt(double x, double y, double heading) {
  return city::makeView({{x, y, 1.7}, heading, 0, 0}, 1, {1280, 720});
}

const FeatureReport& feature(const Planner& planner, std::string_view name) {
  const auto& all = planner.features();
  const auto it = std::find_if(all.begin(), all.end(), [&](const FeatureReport& f) { return f.name == name; });
  if (it == all.end()) throw std::runtime_error("no feature " + std::string(name));
  return *it;
}

void expectCoversOnce(const city::SetPlan& plan, size_t size) {
  std::vector<int> seen(size, 0);
  uint64_t drawn = 0;
  for (const city::Range& run : plan.drawn)
    for (uint32_t i = run.first; i < run.end(); ++i) ++seen.at(i), ++drawn;
  for (const city::DroppedRange& run : plan.dropped)
    for (uint32_t i = run.range.first; i < run.range.end(); ++i) ++seen.at(i);
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
  EXPECT_EQ(plan.drawnCount, drawn);
}

/// All that a plan decides, without the times it took.
std::string decisions(const city::FramePlan& plan) {
  std::string text;
  const auto add = [&](auto... values) { ((text += std::to_string(values) + " "), ...); };
  for (const city::SetPlan* set : {&plan.buildings, &plan.trees}) {
    for (const city::Range& run : set->drawn) add(run.first, run.count);
    text += "| ";
    for (const city::DroppedRange& run : set->dropped) add(run.range.first, run.range.count);
    add(set->drawnCount, set->inFrustumCount);
    text += "\n";
  }
  for (const uint32_t m : plan.monuments) add(m);
  text += "\n";
  for (const uint32_t t : plan.tiles) add(t);
  const city::PlanCounts& c = plan.counts;
  text += "\n";
  add(c.tiles, c.tilesDrawn, c.instances, c.instancesInFrustum, c.instancesOccluded, c.instancesDrawn, c.treesDrawn,
      c.boxTests);
  for (const city::StageTime& stage : plan.stages) text += std::string(stage.name) + ",";
  return text;
}

TEST(Planner, makesOnlyTheStepsThatTheSceneNeeds) {
  EXPECT_THAT(Planner(makeTown({}), knobs()).steps(),
              ElementsAre("frustum tiles", "frustum buildings", "frustum trees", "frustum monuments", "roam"));
  EXPECT_THAT(Planner(makeTown({.trees = 0}), knobs()).steps(),
              ElementsAre("frustum tiles", "frustum buildings", "frustum monuments", "roam"));
  EXPECT_THAT(Planner(makeTown({.monuments = 0}), knobs()).steps(),
              ElementsAre("frustum tiles", "frustum buildings", "frustum trees", "roam"));
  EXPECT_THAT(Planner(makeTown({.buildings = 0, .trees = 0, .monuments = 0}), knobs()).steps(),
              ElementsAre("frustum tiles", "roam"));
  EXPECT_THAT(Planner(makeTown({.buildings = 0, .trees = 0, .terrain = false}), knobs()).steps(),
              ElementsAre("frustum monuments"));
  EXPECT_THAT(Planner(makeTown({.buildings = 0, .trees = 0, .monuments = 0, .terrain = false}), knobs()).steps(),
              IsEmpty());
  EXPECT_THAT(Planner(city::City{}, knobs()).steps(), IsEmpty());
}

TEST(Planner, stagesAreTheStepsInTheirOrder) {
  const city::City town = makeTown({});
  const Planner planner(town, knobs());
  PlannerState state;
  const city::FramePlan plan = planner.plan(town, viewAt(0, 0, 1), 0.016, state);
  std::vector<std::string> names;
  for (const city::StageTime& stage : plan.stages) {
    names.emplace_back(stage.name);
    EXPECT_GE(stage.milliseconds, 0);
  }
  EXPECT_EQ(names, planner.steps());
}

TEST(Planner, offDrawsEverything) {
  const city::City town = makeTown({});
  const Planner planner(town, knobs(false));
  EXPECT_THAT(planner.steps(), ElementsAre("all tiles", "all buildings", "all trees", "all monuments", "roam"));
  PlannerState state;
  const city::FramePlan plan = planner.plan(town, viewAt(0, 0, 1), 0.016, state);
  EXPECT_THAT(plan.buildings.drawn, ElementsAre(city::Range{0, 300}));
  EXPECT_THAT(plan.trees.drawn, ElementsAre(city::Range{0, 200}));
  EXPECT_THAT(plan.buildings.dropped, IsEmpty());
  EXPECT_THAT(plan.monuments, ElementsAre(0u, 1u, 2u));
  EXPECT_EQ(plan.counts.instances, 303u);
  EXPECT_EQ(plan.counts.instancesInFrustum, 303u);
  EXPECT_EQ(plan.counts.instancesDrawn, 303u);
  EXPECT_EQ(plan.counts.treesDrawn, 200u);
  EXPECT_EQ(plan.counts.tilesDrawn, plan.counts.tiles);
  EXPECT_EQ(plan.counts.boxTests, 0u);
}

TEST(Planner, drawnAndDroppedCoverEachSetOnceAndTheCountsAreTheirs) {
  const city::City town = makeTown({.buildings = 2000, .trees = 1000, .monuments = 20});
  const Planner planner(town, knobs());
  city::Random random(5);
  PlannerState state;
  for (int k = 0; k < 100; ++k) {
    const city::ViewState view =
        viewAt(random.uniform(-600, 600), random.uniform(-600, 600), random.uniform(0, 2 * kPi));
    const city::FramePlan plan = planner.plan(town, view, 0.016, state);
    EXPECT_EQ(plan.view.eye, view.eye);
    expectCoversOnce(plan.buildings, town.buildings.size());
    expectCoversOnce(plan.trees, town.trees.size());
    EXPECT_TRUE(std::is_sorted(plan.monuments.begin(), plan.monuments.end()));
    EXPECT_TRUE(std::is_sorted(plan.tiles.begin(), plan.tiles.end()));
    EXPECT_EQ(plan.counts.tilesDrawn, plan.tiles.size());
    EXPECT_LE(plan.counts.tilesDrawn, plan.counts.tiles);
    EXPECT_EQ(plan.counts.instances, 2020u);
    EXPECT_EQ(plan.counts.instancesDrawn, plan.buildings.drawnCount + plan.monuments.size());
    EXPECT_EQ(plan.counts.instancesInFrustum, plan.counts.instancesDrawn);
    EXPECT_EQ(plan.counts.instancesOccluded, 0u);
    EXPECT_EQ(plan.counts.treesDrawn, plan.trees.drawnCount);
    EXPECT_GE(plan.counts.boxTests, 20u + 3u) << "every monument and each hierarchy's root at least";
  }
}

TEST(Planner, nothingVisibleIsMissing) {
  const city::City town = makeTown({.buildings = 1000, .trees = 500, .monuments = 20});
  const Planner planner(town, knobs());
  city::Random random(6);
  PlannerState state;
  for (int k = 0; k < 50; ++k) {
    const city::ViewState view =
        viewAt(random.uniform(-600, 600), random.uniform(-600, 600), random.uniform(0, 2 * kPi));
    const city::FramePlan plan = planner.plan(town, view, 0.016, state);
    const auto visible = [&](const city::Aabbf& box) {
      return culling::isSurfaceInClipSpace(city::clipFromEyeRelative(view), view.eye, box);
    };
    for (const auto& [set, drawn] : {std::pair{&town.buildings, &plan.buildings}, std::pair{&town.trees, &plan.trees}})
      for (const city::DroppedRange& run : drawn->dropped)
        for (uint32_t i = run.range.first; i < run.range.end(); ++i) ASSERT_FALSE(visible(set->bounds[i]));
    for (uint32_t i = 0; i < town.monuments.size(); ++i)
      if (!std::binary_search(plan.monuments.begin(), plan.monuments.end(), i)) {
        ASSERT_FALSE(visible(town.monuments[i].bounds));
      }
    for (uint32_t t = 0; t < town.tiles.size(); ++t)
      if (!std::binary_search(plan.tiles.begin(), plan.tiles.end(), t)) {
        ASSERT_FALSE(visible(town.tiles[t].bounds));
      }
  }
}

TEST(Planner, everyDrawnInstanceStandsOnADrawnTile) {
  const city::City town = makeTown({.buildings = 1000, .trees = 500});
  const Planner planner(town, knobs());
  PlannerState state;
  for (int k = 0; k < 20; ++k) {
    const city::FramePlan plan = planner.plan(town, viewAt(20 * k, -10 * k, k), 0.016, state);
    for (const city::Range& run : plan.buildings.drawn)
      for (uint32_t i = run.first; i < run.end(); ++i) {
        const glm::dvec3& p = town.buildings.instances[i].position;
        EXPECT_TRUE(std::binary_search(plan.tiles.begin(), plan.tiles.end(), town.grid.tileAt(p.x, p.y)));
      }
  }
}

TEST(Planner, theSameArgumentsGiveTheSamePlanWhateverCameBefore) {
  const city::City town = makeTown({.buildings = 2000});
  const Planner planner(town, knobs()), again(town, knobs());
  const city::ViewState view = viewAt(10, 20, 0.5);
  PlannerState fresh, used, other;
  for (int k = 0; k < 10; ++k) planner.plan(town, viewAt(50 * k, 0, k), 0.016, used);
  const std::string expected = decisions(planner.plan(town, view, 0.016, fresh));
  EXPECT_EQ(decisions(planner.plan(town, view, 0.016, used)), expected);
  EXPECT_EQ(decisions(planner.plan(town, view, 1e6, used)), expected);
  EXPECT_EQ(decisions(again.plan(town, view, 0.016, other)), expected);
}

TEST(Planner, theCitysPlaceInItsReferenceSystemChangesNothing) {
  city::City town = makeTown({});
  const Planner planner(town, knobs());
  PlannerState state;
  const std::string here = decisions(planner.plan(town, viewAt(0, 0, 1), 0.016, state));
  town.origin = {1e7, 5e6, 300};
  const Planner there(town, knobs());
  EXPECT_EQ(decisions(there.plan(town, viewAt(0, 0, 1), 0.016, state)), here);
}

TEST(Planner, anEyeThatIsNotANumberDrawsEverything) {
  const city::City town = makeTown({});
  const Planner planner(town, knobs());
  PlannerState state;
  city::ViewState view = viewAt(0, 0, 1);
  view.eye.x = std::nan("");
  const city::FramePlan plan = planner.plan(town, view, 0.016, state);
  EXPECT_EQ(plan.counts.instancesDrawn, plan.counts.instances);
  EXPECT_EQ(plan.counts.tilesDrawn, plan.counts.tiles);
}

TEST(Planner, anEmptyCityGivesAnEmptyPlan) {
  const city::City nothing;
  for (const bool culling : {true, false}) {
    const Planner planner(nothing, knobs(culling));
    PlannerState state;
    const city::FramePlan plan = planner.plan(nothing, viewAt(0, 0, 0), 0.016, state);
    EXPECT_THAT(plan.buildings.drawn, IsEmpty());
    EXPECT_THAT(plan.tiles, IsEmpty());
    EXPECT_EQ(plan.counts.instances, 0u);
  }
}

TEST(Planner, survivesBeingMoved) {
  const city::City town = makeTown({});
  Planner first(town, knobs());
  Planner second(std::move(first));
  PlannerState state;
  EXPECT_EQ(second.plan(town, viewAt(0, 0, 1), 0.016, state).counts.instances, 303u);
}

TEST(Features, sayWhatIsOnAndWhy) {
  const Planner full(makeTown({.buildings = 1, .trees = 0, .monuments = 2}), knobs());
  EXPECT_TRUE(feature(full, "frustum_culling").on);
  EXPECT_TRUE(feature(full, "frustum_culling").technique);
  EXPECT_THAT(feature(full, "frustum_culling").why, testing::MatchesRegex("[0-9]+ of 256 tiles hold something"));
  EXPECT_TRUE(feature(full, "terrain").on);
  EXPECT_FALSE(feature(full, "terrain").technique);
  EXPECT_EQ(feature(full, "terrain").why, "33 × 33 heights");
  EXPECT_EQ(feature(full, "buildings").why, "1 building");
  EXPECT_FALSE(feature(full, "trees").on);
  EXPECT_EQ(feature(full, "trees").why, "no trees");
  EXPECT_EQ(feature(full, "monuments").why, "2 monuments");
  EXPECT_EQ(feature(full, "water").why, "no bodies of water");
  EXPECT_EQ(feature(full, "streets").why, "no streets");
}

TEST(Features, sayWhyAThingIsOff) {
  EXPECT_EQ(feature(Planner(makeTown({}), knobs(false)), "frustum_culling").why, "knob");
  EXPECT_FALSE(feature(Planner(makeTown({}), knobs(false)), "frustum_culling").on);
  EXPECT_EQ(feature(Planner(city::City{}, knobs()), "frustum_culling").why, "nothing stands in the scene");
  EXPECT_EQ(feature(Planner(makeTown({.terrain = false}), knobs()), "terrain").why, "no height field");
}

city::City makeWalledTown() {
  city::City town;
  city::BuildingGeometry house;
  house.bounds = {{-6, -5, 0}, {6, 5, 9}};
  const glm::vec2 corners[] = {{-6, -5}, {6, -5}, {6, 5}, {-6, 5}};
  for (size_t k = 0; k < 4; ++k) house.occluders.push_back({corners[k], corners[(k + 1) % 4], 0, 9});
  town.buildingTypes = {house};
  town.meshes = {meshOf("chapel", {{-4, -4, 0}, {4, 4, 6}})};
  city::CityParts parts;
  for (int row = 0; row < 10; ++row)
    for (int column = 0; column < 10; ++column)
      parts.buildings.emplace_back().position = glm::dvec3(12 * column, 20 * row, 0);
  town.monuments.emplace_back().position = {60, 210, 0};
  EXPECT_EQ(city::finishCity(town, std::move(parts)), 0u);
  return town;
}

TEST(Planner, leavesOutWhatTheFrontRowHides) {
  const city::City town = makeWalledTown();
  const Planner planner(town, knobs());
  EXPECT_EQ(planner.steps().back(), "cull map");
  EXPECT_TRUE(feature(planner, "cull_map").on);
  EXPECT_EQ(feature(planner, "cull_map").why, "400 walls may hide what is behind");
  PlannerState state;
  const city::FramePlan plan = planner.plan(town, viewAt(50, -15, kPi / 2), 0, state);
  expectCoversOnce(plan.buildings, 100);
  EXPECT_TRUE(plan.monuments.empty());
  EXPECT_LE(plan.counts.instancesDrawn, 10u);
  EXPECT_GT(plan.counts.instancesInFrustum, 50u);
  EXPECT_EQ(plan.counts.instancesOccluded, plan.counts.instancesInFrustum - plan.counts.instancesDrawn);
  EXPECT_GT(plan.counts.horizonTests, 0u);
  EXPECT_GT(plan.counts.occluders, 0u);
}

TEST(Planner, withoutFrustumCullingTheCullMapWorksAllRound) {
  const city::City town = makeWalledTown();
  const Planner planner(town, knobs(false));
  PlannerState state;
  const city::FramePlan plan = planner.plan(town, viewAt(50, -15, kPi / 2 + kPi), 0, state);
  EXPECT_EQ(plan.counts.instancesInFrustum, 101u);
  EXPECT_LE(plan.counts.instancesDrawn, 12u) << "also behind the viewer";
}

TEST(Planner, cullMapIsOffWhereItDoesNotPay) {
  city::Knobs off = knobs();
  EXPECT_EQ(off.set("cull_map", 0), "");
  EXPECT_EQ(feature(Planner(makeWalledTown(), off), "cull_map").why, "knob");
  EXPECT_EQ(feature(Planner(makeTown({.buildings = 14}), knobs()), "cull_map").why, "14 buildings");
  EXPECT_EQ(feature(Planner(makeTown({}), knobs()), "cull_map").why, "no wall stands in the ground");
}

TEST(PlanKnobs, areDeclaredWithAllTheirWords) {
  for (const city::Knob& knob : planKnobs()) {
    EXPECT_GE(knob.value, knob.min) << knob.name;
    EXPECT_LE(knob.value, knob.max) << knob.name;
    for (const std::string_view text : {knob.name, knob.unit, knob.meaning, knob.tooSmall, knob.tooLarge})
      EXPECT_FALSE(text.empty()) << knob.name;
  }
}

/// A town on hills 20 m high.
city::City makeHillTown() {
  city::City town = makeTown({});
  for (int row = 0; row < town.terrain->size.y; ++row)
    for (int column = 0; column < town.terrain->size.x; ++column)
      town.terrain->at(column, row) = static_cast<float>(10 * std::sin(column * 0.9) * std::cos(row * 0.7));
  town.terrain->updateRange();
  return town;
}

TEST(PlannerGround, FollowsEachViewByItself) {
  const city::City town = makeHillTown();
  const Planner planner(town, knobs());
  PlannerState eye, other;
  const city::FramePlan first = planner.plan(town, viewAt(0, 0, 1), 0.016, eye);
  const city::FramePlan elsewhere = planner.plan(town, viewAt(300, 300, 4), 0.016, other);
  ASSERT_TRUE(first.roam && elsewhere.roam);
  EXPECT_NE(first.roam->mesh, elsewhere.roam->mesh);
  EXPECT_EQ(first.roam->pixelError, 2);
  EXPECT_LT(first.roam->triangleCount, town.terrain->triangleCount());
  // The same view again changes nothing; another one goes on from there.
  const city::FramePlan again = planner.plan(town, viewAt(0, 0, 1), 0.016, eye);
  EXPECT_EQ(again.roam->mesh, first.roam->mesh);
  EXPECT_EQ(again.roam->revision, first.roam->revision + 1);
  EXPECT_THAT(again.roam->changedTriangles, IsEmpty());
  EXPECT_FALSE(planner.plan(town, viewAt(300, 300, 4), 0.016, eye).roam->changedTriangles.empty());
}

TEST(PlannerGround, IsAtFullDetailWithoutTheTechniqueAndNotThereWithoutTerrain) {
  const city::City town = makeHillTown(), plain = makeTown({.terrain = false});
  city::Knobs off = knobs();
  EXPECT_EQ(off.set("roam", 0), "");
  PlannerState state;
  EXPECT_FALSE(Planner(town, off).plan(town, viewAt(0, 0, 1), 0.016, state).roam);
  EXPECT_EQ(feature(Planner(town, off), "roam").why, "knob");
  EXPECT_FALSE(Planner(plain, knobs()).plan(plain, viewAt(0, 0, 1), 0.016, state).roam);
  EXPECT_FALSE(state.ground);
  EXPECT_EQ(feature(Planner(plain, knobs()), "roam").why, "no height field");
  EXPECT_TRUE(feature(Planner(town, knobs()), "roam").on);
}

TEST(PlannerGround, WeighsErrorsUnderThingsAndAlongTheBorder) {
  const city::City town = makeHillTown();
  const std::vector<float> weights = groundWeights(town);
  const city::HeightField& field = *town.terrain;
  ASSERT_EQ(weights.size(), field.heights.size());
  const auto at = [&](int column, int row) { return weights[static_cast<size_t>(row * field.size.x + column)]; };
  EXPECT_EQ(at(0, 7), kWeightOfBorder);
  EXPECT_EQ(at(32, 32), kWeightOfBorder);
  for (const city::Instance& i : town.buildings.instances) {
    const glm::ivec2 cell((glm::dvec2(i.position) - field.origin) / field.spacing);
    for (const glm::ivec2 corner : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)})
      EXPECT_GE(at(cell.x + corner.x, cell.y + corner.y), kWeightUnderThings);
  }
  EXPECT_THAT(groundWeights(makeTown({.terrain = false})), IsEmpty());
}

}  // namespace
}  // namespace vicus::plan
