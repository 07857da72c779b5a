#include "report/configurations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::report {
namespace {

using ::testing::ElementsAre;

constexpr city::Knob kKnobs[] = {
    {"hide", 1, 0, 1, "on/off", "", "", ""},
    {"bend", 1, 0, 1, "on/off", "", "", ""},
    {"bend.error", 2, 0.5, 16, "pixels", "", "", ""},
};
constexpr double kSweep[] = {0.5, 1, 2, 4, 8, 16};

const plan::Technique kTechniques[] = {
    {.name = "hide", .switchKnob = "hide", .visibility = true},
    {.name = "bend",
     .switchKnob = "bend",
     .sweptKnob = "bend.error",
     .sweep = kSweep,
     .geometricErrorPixels = [](const city::FramePlan&) { return 1.0; }},
    {.name = "unknown here", .switchKnob = "elsewhere"},
};

city::Knobs someKnobs() {
  city::Knobs knobs;
  knobs.declare(kKnobs);
  return knobs;
}

TEST(Configurations, EachAloneAllAndAllButEach) {
  std::vector<std::string> found;
  for (const Configuration& c : configurations(someKnobs(), kTechniques))
    found.push_back(c.name + (c.knobs.on("hide") ? " hide" : "") + (c.knobs.on("bend") ? " bend" : ""));
  // The limit is in full detail: what displaces anything is off.
  EXPECT_THAT(found, ElementsAre("all_off", "only_hide hide", "only_bend bend", "all_on hide bend",
                                 "all_on_less_hide bend", "all_on_less_bend hide", "visibility hide", "limit hide"));
}

TEST(Configurations, WhatIsOffIsMeasuredAloneAndIsNotInAll) {
  city::Knobs knobs = someKnobs();
  knobs.set("hide", 0);
  std::vector<std::string> found;
  for (const Configuration& c : configurations(knobs, kTechniques))
    found.push_back(c.name + (c.knobs.on("hide") ? " hide" : "") + (c.knobs.on("bend") ? " bend" : ""));
  EXPECT_THAT(found, ElementsAre("all_off", "only_hide hide", "only_bend bend", "all_on bend", "all_on_less_bend",
                                 "visibility", "limit"));
  // Its own curve turns it on.
  knobs.set("bend", 0);
  for (const SweepPoint& p : sweepOf(kTechniques[1], knobs, kTechniques, 3)) {
    EXPECT_TRUE(p.configuration.knobs.on("bend"));
    EXPECT_FALSE(p.configuration.knobs.on("hide"));
  }
}

TEST(Configurations, OtherKnobsStay) {
  city::Knobs knobs = someKnobs();
  knobs.set("bend.error", 7);
  for (const Configuration& c : configurations(knobs, kTechniques)) EXPECT_EQ(c.knobs["bend.error"], 7);
}

std::vector<double> valuesOf(const std::vector<SweepPoint>& sweep) {
  std::vector<double> values;
  for (const SweepPoint& p : sweep) values.push_back(p.value);
  return values;
}

TEST(SweepOf, EndsAndDefaultFirst) {
  const auto sweep = sweepOf(kTechniques[1], someKnobs(), kTechniques, 3);
  EXPECT_THAT(valuesOf(sweep), ElementsAre(0.5, 2, 16));
  EXPECT_FALSE(sweep[0].isDefault);
  EXPECT_TRUE(sweep[1].isDefault);
  EXPECT_EQ(sweep[2].configuration.knobs["bend.error"], 16);
  EXPECT_TRUE(sweep[2].configuration.knobs.on("hide"));
  EXPECT_THAT(valuesOf(sweepOf(kTechniques[1], someKnobs(), kTechniques, 9)), ElementsAre(0.5, 1, 2, 4, 8, 16));
}

TEST(SweepOf, NothingToTurn) {
  EXPECT_TRUE(sweepOf(kTechniques[0], someKnobs(), kTechniques, 3).empty());
  EXPECT_TRUE(sweepOf(kTechniques[1], city::Knobs(), kTechniques, 3).empty());
  EXPECT_TRUE(sweepOf(kTechniques[1], someKnobs(), kTechniques, 0).empty());
}

TEST(Techniques, EverySwitchOfATechniqueIsRegistered) {
  // Techniques are switches without a part's name: "frustum_culling", but not "viewer.vsync".
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  knobs.declare(scenegraph::sceneKnobs());
  knobs.declare(viewer::viewerKnobs());
  for (const city::Knob& knob : knobs.declared()) {
    if (!knob.isSwitch() || knob.name.find('.') != std::string_view::npos) continue;
    bool known = false;
    for (const plan::Technique& t : plan::techniques()) known = known || t.switchKnob == knob.name;
    EXPECT_TRUE(known) << knob.name << " is missing in plan/techniques.cpp";
  }
  for (const plan::Technique& t : plan::techniques())
    for (const std::string_view knob : {t.switchKnob, t.sweptKnob})
      if (!knob.empty()) {
        EXPECT_TRUE(knobs.has(knob)) << knob;
      }
}

TEST(Techniques, SweepsStayWithinTheirKnobs) {
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  knobs.declare(scenegraph::sceneKnobs());
  knobs.declare(viewer::viewerKnobs());
  for (const plan::Technique& t : plan::techniques())
    for (const double value : t.sweep) EXPECT_EQ(knobs.set(t.sweptKnob, value), "") << t.name;
}

}  // namespace
}  // namespace vicus::report
