// The graph without a GL context: what is made, what a plan costs.
#include "scenegraph/scene.hpp"

#include <gmock/gmock.h>

#include "small_city.hpp"

namespace vicus::scenegraph {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

city::Knobs knobs(bool ordering = true) {
  city::Knobs k;
  k.declare(sceneKnobs());
  k.set("textures.budget_mb", 1);
  k.set("ground.map_size", 64);
  k.set("state_ordering", ordering);
  return k;
}

TEST(Scene, HasOnlyWhatTheCityHas) {
  city::Diagnostics diagnostics;
  EXPECT_THAT(Scene(tests::smallCity(), knobs(), diagnostics).featureNames(),
              ElementsAre("buildings", "monuments", "trees", "terrain", "ground", "sky", "water"));

  tests::SmallCityOptions bare;
  bare.terrain = bare.trees = bare.monument = bare.water = false;
  const Scene houses(tests::smallCity(bare), knobs(), diagnostics);
  EXPECT_THAT(houses.featureNames(), ElementsAre("buildings", "ground", "sky"));
  EXPECT_THAT(houses.passNames(), ElementsAre("opaque", "ground", "sky")) << "nothing has holes, nothing is wet";
  EXPECT_THAT(houses.describeGraph(), Not(HasSubstr("terrain")));

  const Scene nothing(city::City(), knobs(), diagnostics);
  EXPECT_THAT(nothing.featureNames(), ElementsAre("ground", "sky"));
  EXPECT_LT(nothing.gpuBytes(), houses.gpuBytes());
}

TEST(Scene, EachContentLeftOutSavesItsMemory) {
  city::Diagnostics diagnostics;
  const uint64_t all = Scene(tests::smallCity(), knobs(), diagnostics).gpuBytes();
  for (bool tests::SmallCityOptions::*part : {&tests::SmallCityOptions::terrain, &tests::SmallCityOptions::trees,
                                              &tests::SmallCityOptions::monument, &tests::SmallCityOptions::water}) {
    tests::SmallCityOptions without;
    without.*part = false;
    EXPECT_LT(Scene(tests::smallCity(without), knobs(), diagnostics).gpuBytes(), all);
  }
}

TEST(Scene, CountsWhatAPlanCosts) {
  const city::City city = tests::smallCity();
  city::Diagnostics diagnostics;
  Scene scene(city, knobs(), diagnostics);
  city::FramePlan plan = tests::everything(city, {});
  scene.apply(plan, Variant::Colour);
  const DrawCounts all = scene.counts();
  EXPECT_EQ(all.terrainTriangles, city.terrain->triangleCount());
  uint64_t houses = 0;
  for (const city::Instance& i : city.buildings.instances)
    houses += city.buildingTypes[i.geometry].fullDetailTriangles();

  // Three houses fewer: so many commands and triangles fewer.
  plan.buildings.drawn = {{0, 5}, {8, static_cast<uint32_t>(city.buildings.size()) - 8}};
  scene.apply(plan, Variant::Colour);
  EXPECT_EQ(scene.counts().indirectCommands, all.indirectCommands - 3);
  plan.buildings.drawn.clear();
  scene.apply(plan, Variant::Colour);
  EXPECT_EQ(scene.counts().triangles, all.triangles - houses);
  plan.monuments.clear();
  scene.apply(plan, Variant::Colour);
  EXPECT_EQ(scene.counts().triangles, all.triangles - houses - city.meshes[0].mesh.triangleCount());
  plan.tiles.clear();
  scene.apply(plan, Variant::Colour);
  EXPECT_EQ(scene.counts().terrainTriangles, 0u);
}

TEST(Scene, WithoutOrderingEachPlaneIsADraw) {
  tests::SmallCityOptions options;
  options.terrain = options.trees = options.monument = options.water = false;
  const city::City city = tests::smallCity(options);
  uint64_t planes = 0;
  for (const city::Instance& i : city.buildings.instances) planes += city.buildingTypes[i.geometry].planes.size();
  city::Diagnostics diagnostics;
  Scene ordered(city, knobs(true), diagnostics), unordered(city, knobs(false), diagnostics);
  const city::FramePlan plan = tests::everything(city, {});
  ordered.apply(plan, Variant::Colour);
  unordered.apply(plan, Variant::Colour);
  // Sky and ground are one draw each; the houses stand on all sixteen groups of tiles.
  EXPECT_EQ(unordered.counts().drawCalls, planes + 2);
  EXPECT_EQ(unordered.counts().textureBinds, planes + ordered.counts().textureBinds);
  EXPECT_EQ(ordered.counts().drawCalls, 16u + 2);
  EXPECT_EQ(ordered.counts().triangles, unordered.counts().triangles);
}

TEST(Scene, DescribesItsGraphInNamesAndCounts) {
  city::Diagnostics diagnostics;
  const std::string graph = Scene(tests::smallCity(), knobs(), diagnostics).describeGraph();
  EXPECT_THAT(graph, HasSubstr("root (Group, 7 children)\n"));
  EXPECT_THAT(graph,
              HasSubstr("    buildings/tiles 4-7 x 4-7 (Group, 1 child)\n      opaque (ArenaDrawable, 9 instances)"));
  EXPECT_THAT(graph, HasSubstr("monuments/Tower (MatrixTransform, 1 child)\n      tower (Geometry, 12 triangles)"));
}

TEST(Scene, TexturesOverTheBudgetAreHalvedWithAWarning) {
  city::Diagnostics diagnostics;
  const Scene scene(tests::smallCity(), knobs(), diagnostics);
  ASSERT_EQ(diagnostics.messages.size(), 1u);
  EXPECT_THAT(diagnostics.messages[0].message, HasSubstr("over the budget of 1 MB (textures.budget_mb)"));
  EXPECT_EQ(diagnostics.messages[0].severity, city::Severity::Warning);
}

}  // namespace
}  // namespace vicus::scenegraph
