#include "city/knob.hpp"

#include <gtest/gtest.h>

namespace vicus::city {
namespace {

constexpr Knob kDeclared[] = {
    {"frustum_culling", 1, 0, 1, "on/off", "Leaves out what lies outside the picture.", "off", "on"},
    {"viewer.multisamples", 4, 1, 8, "samples", "Samples for each pixel.", "jagged", "slow"},
};

Knobs declared() {
  Knobs knobs;
  knobs.declare(kDeclared);
  return knobs;
}

TEST(Knobs, beginAtTheirDefaults) {
  const Knobs knobs = declared();
  EXPECT_TRUE(knobs.on("frustum_culling"));
  EXPECT_EQ(knobs["viewer.multisamples"], 4);
  EXPECT_TRUE(knobs.has("frustum_culling"));
  EXPECT_FALSE(knobs.has("frustum"));
  EXPECT_EQ(knobs.declared().size(), 2u);
}

TEST(Knobs, takeAssignments) {
  Knobs knobs = declared();
  EXPECT_EQ(knobs.set("frustum_culling=off"), "");
  EXPECT_FALSE(knobs.on("frustum_culling"));
  EXPECT_EQ(knobs.set("frustum_culling=1"), "");
  EXPECT_TRUE(knobs.on("frustum_culling"));
  EXPECT_EQ(knobs.set("viewer.multisamples=8"), "");
  EXPECT_EQ(knobs["viewer.multisamples"], 8);
}

TEST(Knobs, sayWhatIsWrong) {
  Knobs knobs = declared();
  EXPECT_EQ(knobs.set("frustum_cullin=on"), "unknown knob 'frustum_cullin'; did you mean 'frustum_culling'?");
  EXPECT_EQ(knobs.set("viewer.multisamples=on"), "'on' is not a number, in 'viewer.multisamples=on'");
  EXPECT_EQ(knobs.set("frustum_cullin=1"), "unknown knob 'frustum_cullin'; did you mean 'frustum_culling'?");
  EXPECT_EQ(knobs.set("viewer.multisample=2"),
            "unknown knob 'viewer.multisample'; did you mean 'viewer.multisamples'?");
  EXPECT_EQ(knobs.set("viewer.multisamples=9"), "knob 'viewer.multisamples' takes 1 to 8, not 9");
  EXPECT_EQ(knobs.set("viewer.multisamples=nan"), "knob 'viewer.multisamples' takes 1 to 8, not nan");
  EXPECT_EQ(knobs.set("frustum_culling=0.5"), "knob 'frustum_culling' is a switch: on or off, not 0.5");
  EXPECT_EQ(knobs.set("viewer.multisamples=4x"), "'4x' is not a number, in 'viewer.multisamples=4x'");
  EXPECT_EQ(knobs.set("viewer.multisamples="), "'' is not a number, in 'viewer.multisamples='");
  EXPECT_EQ(knobs.set("viewer.multisamples"), "'viewer.multisamples' is not name=value");
  EXPECT_EQ(Knobs().set("anything", 1), "unknown knob 'anything'");
}

TEST(Knobs, keepTheirValueWhenAnAssignmentFails) {
  Knobs knobs = declared();
  EXPECT_NE(knobs.set("viewer.multisamples=9"), "");
  EXPECT_EQ(knobs["viewer.multisamples"], 4);
}

}  // namespace
}  // namespace vicus::city
