/// What a scene does not need does not exist: its step, feature, thread, memory, shader and pass.
#include "report/leaving_out.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/Program>
#include <ostream>
#include <set>

#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "tests/report/all_knobs.hpp"
#include "tests/viewer/small_cities.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::report {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The names of all programs in a graph.
class Programs : public osg::NodeVisitor {
 public:
  Programs() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0U); }
  void apply(osg::Node& node) override {
    const osg::StateSet* set = node.getStateSet();
    if (const auto* program =
            set ? dynamic_cast<const osg::Program*>(set->getAttribute(osg::StateAttribute::PROGRAM)) : nullptr)
      names.insert(program->getName());
    traverse(node);
  }
  std::set<std::string> names;
};

/// All that a scene is made of.
struct Made {
  std::vector<std::string> steps, features, passes;
  std::set<std::string> programs;
  uint64_t gpuBytes = 0, bytes = 0;
  size_t threads = 0;
};

size_t threadsOfThisProgram() {
  size_t count = 0;
  for ([[maybe_unused]] const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) ++count;
  return count;
}

Made make(const city::City& city) {
  Made made;
  const size_t threads = threadsOfThisProgram();
  const city::Knobs knobs = allKnobs();
  const plan::Planner planner(city, knobs);
  city::Diagnostics diagnostics;
  scenegraph::Scene scene(city, knobs, diagnostics);
  plan::PlannerState state;
  const city::ViewState view = city::makeView({{0, 0, 20}, 0, 0, 0}, 1, {64, 36});
  scene.apply(planner.plan(city, view, 0, state), scenegraph::Variant::Colour);
  made.threads = threadsOfThisProgram() - threads;
  made.steps = planner.steps();
  made.features = scene.featureNames();
  made.passes = scene.passNames();
  Programs programs;
  scene.root()->accept(programs);
  made.programs = std::move(programs.names);
  made.gpuBytes = scene.gpuBytes();
  const city::CityBytes bytes = city::memoryOf(city);
  made.bytes = bytes.geometry + bytes.instances + bytes.terrain + bytes.people;
  return made;
}

/// What a part of the program is called where it appears; empty: it has none of that.
struct Part {
  const char *name, *step, *pass, *program;
  bool counted;  ///< in memoryOf
};

void PrintTo(const Part& part, std::ostream* out) {
  *out << part.name;
}

const Part kParts[] = {
    {"terrain", "", "", "terrain", true},
    {"water", "", "water", "water", false},
    {"trees", "frustum trees", "", "", true},
    {"monuments", "frustum monuments", "", "monument", true},
    {"avatars", "avatar poses", "shadows", "avatar", true},
};

/// A town with houses alone; each part is then forced on.
class LeavingOut : public ::testing::TestWithParam<Part> {
 protected:
  const city::City town_ = test::gridTown(12, 8);
};

TEST_P(LeavingOut, WhatASceneLacksDoesNotExist) {
  const Part part = GetParam();
  const std::optional<city::City> forced = withPart(town_, part.name);
  ASSERT_TRUE(forced);
  EXPECT_FALSE(withPart(*forced, part.name)) << "it is there now";
  const Made without = make(town_), with = make(*forced);

  EXPECT_THAT(without.features, Not(Contains(part.name)));
  EXPECT_THAT(with.features, Contains(part.name));
  if (*part.step != 0) {
    EXPECT_THAT(without.steps, Not(Contains(part.step)));
    EXPECT_THAT(with.steps, Contains(part.step));
  }
  if (*part.pass != 0) {
    EXPECT_THAT(without.passes, Not(Contains(part.pass)));
    EXPECT_THAT(with.passes, Contains(part.pass));
  }
  if (*part.program != 0) {
    EXPECT_THAT(without.programs, Not(Contains(HasSubstr(part.program))));
    EXPECT_THAT(with.programs, Contains(HasSubstr(part.program)));
  }
  EXPECT_LT(without.gpuBytes, with.gpuBytes);
  if (part.counted) {
    EXPECT_LT(without.bytes, with.bytes);
  }
  EXPECT_EQ(without.threads, 0U) << "nothing here runs in the background";
}

INSTANTIATE_TEST_SUITE_P(Parts, LeavingOut, ::testing::ValuesIn(kParts),
                         [](const auto& part) { return std::string(part.param.name); });

TEST(LeavingOut, ASceneOfTerrainAloneHasNoBuildings) {
  city::City land;
  land.terrain = test::terrain(33, 10, [](double, double) { return 0.0; });
  city::finishCity(land, {});
  const Made without = make(land);
  EXPECT_THAT(without.features, Not(Contains("buildings")));
  EXPECT_THAT(without.steps, Not(Contains("frustum buildings")));
  EXPECT_THAT(without.steps, Not(Contains("cull map")));
  EXPECT_THAT(without.passes, Not(Contains("opaque")));
  EXPECT_THAT(without.programs, Not(Contains(HasSubstr("instance"))));
  const std::optional<city::City> forced = withPart(land, "buildings");
  ASSERT_TRUE(forced);
  const Made with = make(*forced);
  EXPECT_THAT(with.features, Contains("buildings"));
  EXPECT_THAT(with.passes, Contains("opaque"));
  EXPECT_LT(without.gpuBytes, with.gpuBytes);
}

TEST(LeavingOut, ATechniqueThatIsOffHasNoStep) {
  city::Knobs knobs = allKnobs();
  knobs.set("frustum_culling", 0);
  knobs.set("cull_map", 0);
  const plan::Planner planner(test::gridTown(12, 8), knobs);
  EXPECT_THAT(planner.steps(), Not(Contains(HasSubstr("frustum"))));
  EXPECT_THAT(planner.steps(), Not(Contains("cull map")));
}

TEST(LeavingOut, AFewHousesHaveNoCullMap) {
  const plan::Planner planner(test::gridTown(4, 2), allKnobs());
  EXPECT_THAT(planner.steps(), Not(Contains("cull map")));
}

TEST(WithPart, OtherNamesAndEmptyCities) {
  EXPECT_FALSE(withPart(test::gridTown(), "streets"));
  EXPECT_FALSE(withPart(test::gridTown(), "buildings"));
  city::City empty;
  city::finishCity(empty, {});
  for (const char* part : {"terrain", "water", "trees", "monuments", "buildings"})
    EXPECT_TRUE(withPart(empty, part)) << part;
}

}  // namespace
}  // namespace vicus::report
