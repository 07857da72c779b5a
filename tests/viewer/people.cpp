// People as planned and drawn: what the bound promises holds, nothing is remembered that shows, nobody who can be seen
// is missing; and strips of their walks to look at.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "assets/people/populate.hpp"
#include "assets/people/read_bvh.hpp"
#include "assets/people/read_character.hpp"
#include "assets/people/townspeople.hpp"
#include "avatars/cycle.hpp"
#include "avatars/routes.hpp"
#include "city/random.hpp"
#include "small_cities.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/item_buffers.hpp"
#include "viewer/pictures.hpp"

namespace vicus::viewer {
namespace {

namespace people = assets::people;
using glm::dvec2;
using glm::dvec3;

/// A town of twelve by eight houses with a street between each two rows and people in them.
city::City peopledTown(uint32_t count) {
  city::City city = test::gridTown();
  test::setTerrain(city, test::terrain(41, 10, [](double x, double y) { return -0.02 * x - 0.01 * y - 2; }));
  people::Population population;
  population.count = count;
  population.characters = people::makeTownspeople(people::Period::Medieval);
  city::Diagnostics diagnostics;
  people::populate(city, std::move(population), "town", diagnostics);
  return city;
}

city::Knobs knobsWith(std::initializer_list<std::pair<const char*, double>> settings) {
  city::Knobs knobs;
  for (const auto list : {plan::planKnobs(), scenegraph::sceneKnobs(), viewerKnobs()}) knobs.declare(list);
  knobs.set("textures.budget_mb", 1);
  for (const auto& [name, value] : settings) EXPECT_EQ(knobs.set(name, value), "");
  return knobs;
}

city::ViewState viewFrom(const dvec3& eye, double heading, double time, glm::ivec2 size = {320, 180}) {
  city::ViewState view = city::makeView({eye, heading, -0.03, 0}, 1, size);
  view.time = time;
  return view;
}

/// Where a drawn person's joints are, in his character's frame.
std::vector<glm::vec3> jointsOf(const city::City& city, const city::FramePlan& plan, const city::AvatarDraw& a) {
  const city::Character& body = city.people.characters[a.character];
  std::vector<glm::vec3> out;
  for (size_t j = 0; j < body.jointFromSkin.size(); ++j) {
    const glm::vec4 rest = glm::inverse(body.jointFromSkin[j])[3];
    const auto& rows = plan.avatars.matrices[a.firstMatrix + j];
    out.push_back({glm::dot(rows[0], rest), glm::dot(rows[1], rest), glm::dot(rows[2], rest)});
  }
  return out;
}

TEST(People, TheStatedErrorHoldsAtEachRate) {
  const city::City city = peopledTown(200);
  ASSERT_FALSE(city.people.empty());
  // Meshes alone, so that the joints of both plans can be compared.
  const plan::Planner full(city, knobsWith({{"avatar_lod", 0}, {"cull_map", 0}}));
  double before = 1e9;
  for (const double rate : {4.0, 15.0, 60.0}) {
    const plan::Planner held(city,
                             knobsWith({{"avatar_lod.rate", rate}, {"avatar_lod.pixel_error", 0.05}, {"cull_map", 0}}));
    plan::PlannerState fullState, heldState;
    double largest = 0, stated = 0;
    size_t compared = 0;
    uint64_t made = 0, shown = 0;
    for (int frame = 0; frame < 40; ++frame) {
      const city::ViewState view = viewFrom({-10, 8, 1.7}, 0.2, frame / 30.0);
      const city::FramePlan a = full.plan(city, view, 1.0 / 30, fullState),
                            b = held.plan(city, view, 1.0 / 30, heldState);
      ASSERT_EQ(a.avatars.drawn.size(), b.avatars.drawn.size());
      const double slope = city::pixelsPerUnitSlope(view);
      for (size_t i = 0; i < a.avatars.drawn.size(); ++i) {
        const city::AvatarDraw &x = a.avatars.drawn[i], &y = b.avatars.drawn[i];
        if (y.level == city::kAvatarMeshLevels) continue;
        const auto p = jointsOf(city, a, x), q = jointsOf(city, b, y);
        const double distance = std::max(0.3, glm::distance(x.position, view.eye));
        for (size_t j = 0; j < p.size(); ++j, ++compared)
          largest = std::max(largest, static_cast<double>(glm::distance(p[j], q[j]) * x.scale) * slope / distance);
      }
      stated = std::max(stated, b.avatars.pixelError);
      made += b.avatars.posesMade, shown += b.avatars.drawn.size();
    }
    EXPECT_GT(compared, 1000U);
    EXPECT_LE(largest, 1.1 * stated) << rate;
    EXPECT_LT(largest, before) << "more often, less error";
    before = largest;
    std::cout << "rate " << rate << ": largest joint error " << largest << " px, stated " << stated
              << " px, poses made " << made << " of " << shown << "\n";
  }
}

TEST(People, WhatAViewRemembersShowsNowhere) {
  const city::City city = peopledTown(150);
  const plan::Planner planner(city, knobsWith({}));
  plan::PlannerState remembering;
  for (const double time : {0.0, 0.01, 0.02, 0.35, 0.36, 90'000.0, 1.0}) {
    const city::ViewState view = viewFrom({-10, 8, 1.7}, 0.2, time);
    plan::PlannerState fresh;
    const city::FramePlan a = planner.plan(city, view, 0, remembering), b = planner.plan(city, view, 0, fresh);
    EXPECT_EQ(a.avatars.matrices, b.avatars.matrices) << time;
    ASSERT_EQ(a.avatars.drawn.size(), b.avatars.drawn.size());
    EXPECT_LE(a.avatars.posesMade, b.avatars.posesMade);
  }
}

/// Whoever stands hidden may throw a shadow that is not.
TEST(People, ShadowsLieWithinTheBoundsThatAreCulled) {
  city::City city = peopledTown(50);
  city.environment.sunAzimuth = 0.7, city.environment.sunElevation = 0.4;
  const plan::Planner planner(city, knobsWith({{"frustum_culling", 0}, {"cull_map", 0}}));
  plan::PlannerState state;
  const city::FramePlan plan = planner.plan(city, viewFrom({-10, 8, 1.7}, 0.2, 3), 0, state);
  ASSERT_EQ(plan.avatars.drawn.size(), 50U);
  const double reach = std::min(1.6 / std::tan(0.4), 3.0);
  const glm::dvec2 away(-std::sin(0.7), -std::cos(0.7)), aside(away.y, -away.x);
  for (const city::AvatarDraw& draw : plan.avatars.drawn)
    for (const double side : {-0.32, 0.32}) {
      const double scale = static_cast<double>(draw.scale);
      const glm::dvec2 end = glm::dvec2(draw.position) + (scale * reach + 0.32) * away + side * aside;
      const city::Aabbf& box = draw.bounds;
      EXPECT_TRUE(end.x >= static_cast<double>(box.min.x) && end.x <= static_cast<double>(box.max.x) &&
                  end.y >= static_cast<double>(box.min.y) && end.y <= static_cast<double>(box.max.y));
    }
}

TEST(People, TheSwitchAndTheNumber) {
  const city::City city = peopledTown(100);
  const city::ViewState view = viewFrom({-10, 8, 200}, 0.2, 3);
  const auto drawn = [&](std::initializer_list<std::pair<const char*, double>> settings) {
    plan::PlannerState state;
    const plan::Planner planner(city, knobsWith(settings));
    return planner.plan(city, view, 0, state).avatars.drawn.size();
  };
  EXPECT_EQ(drawn({{"frustum_culling", 0}}), 100U);
  EXPECT_EQ(drawn({{"frustum_culling", 0}, {"avatars.number", 1000}}), 1000U);
  EXPECT_EQ(drawn({{"frustum_culling", 0}, {"avatars.shown", 0}}), 0U);
  const plan::Planner off(city, knobsWith({{"avatars.shown", 0}}));
  EXPECT_THAT(off.steps(), testing::Not(testing::Contains(testing::HasSubstr("avatar"))));
}

class DrawnPeople : public testing::Test {
 protected:
  void SetUp() override {
    std::string error;
    context_ = makeOffscreenContext(error);
    if (!context_) GTEST_SKIP() << "no offscreen GL: " << error;
  }
  std::unique_ptr<GlContext> context_;
};

TEST_F(DrawnPeople, NobodyWhoCanBeSeenIsMissing) {
  const city::City city = peopledTown(400);
  const city::Knobs knobs = knobsWith({{"roam", 0}, {"avatar_lod", 0}});
  city::Diagnostics diagnostics;
  scenegraph::Scene scene(city, knobs, diagnostics);
  Renderer renderer(*context_, scene, 1);
  const plan::Planner culled(city, knobs),
      everything(city, knobsWith({{"roam", 0}, {"avatar_lod", 0}, {"frustum_culling", 0}, {"cull_map", 0}}));
  plan::PlannerState a, b;
  size_t hidden = 0, persons = 0;
  city::Random random(4);
  for (int k = 0; k < 40; ++k) {
    const double x = random.uniform(-80, 80), y = random.uniform(-60, 60);
    const city::ViewState view =
        viewFrom({x, y, city.terrain->heightAt(x, y).value_or(0) + 1.7}, random.uniform(0, 6.28), 10.0 * k);
    const city::FramePlan plan = culled.plan(city, view, 0, a), full = everything.plan(city, view, 0, b);
    const ItemBuffer all = renderer.drawItems(full);
    const ItemCheck check = checkItems(city, plan, all, renderer.drawItems(plan));
    EXPECT_EQ(check.lostPixels, 0U) << k;
    EXPECT_EQ(check.differingPixels, 0U) << k;
    hidden += full.avatars.drawn.size() - plan.avatars.drawn.size();
    for (const uint32_t id : all.ids) persons += id != city::kItemOther && id >= city.itemOfPerson(0);
  }
  EXPECT_GT(hidden, 5000U);
  EXPECT_GT(persons, 500U) << "pixels that show people";
  EXPECT_THAT(renderer.problems(), testing::IsEmpty());
}

/// A row of one character on level ground, one step of the clip after another.
city::City strip(const city::Character& body, city::Role role, int poses) {
  city::City city;
  city.name = "strip";
  city.people.characters = {body};
  const city::Clip& clip = body.clips[static_cast<size_t>(role)];
  for (int k = 0; k < poses; ++k) {
    city::Person p;
    p.role = role, p.start = clip.duration * k / poses, p.position = {0.95 * (k - 0.5 * (poses - 1)), 0, 0};
    p.heading = -0.9F, p.dress = static_cast<uint32_t>(k % 2);
    city.people.placed.push_back(p);
  }
  city.people.count = static_cast<uint32_t>(poses);
  city.extent = {{-20, -20, 0}, {20, 20, 2}};
  city::finishCity(city, {});
  return city;
}

// In full: ./test --full writes the strips to $VICUS_STRIPS and tells how far feet slide.
TEST_F(DrawnPeople, DISABLED_PeopleStripsInFull) {
  const char* named = std::getenv("VICUS_STRIPS");
  const std::filesystem::path folder = named ? named : testing::TempDir() + "/strips";
  std::filesystem::create_directories(folder);
  const char* shared = std::getenv("VICUS_DATA");
  const std::string data = shared ? shared : "../shared/data";
  city::Diagnostics diagnostics;
  std::vector<std::pair<std::string, city::Character>> bodies;
  for (const city::Character& c : people::makeTownspeople(people::Period::Medieval)) bodies.emplace_back(c.name, c);
  for (const city::Character& c : people::makeTownspeople(people::Period::Modern))
    bodies.emplace_back("modern " + c.name, c);
  for (const char* name : {"kaykit_Knight", "kaykit_Rogue_Hooded", "Fox"})
    if (auto read = people::readCharacter(data + "/characters/" + name + ".glb", diagnostics))
      bodies.emplace_back(name, std::move(read->body));
  const size_t own = bodies.size();
  for (const char* name : {"131_01", "131_02", "131_03"})
    if (const auto motion = people::readBvh(data + "/mocap/" + name + ".bvh", {}, diagnostics))
      for (size_t k = 0; k < own; ++k) {
        city::Character c = bodies[k].second;
        if (k % 4 != 0 && bodies[k].first.find("kaykit") == std::string::npos) continue;
        if (people::useMotion(c, motion->skeleton, motion->clip, name, diagnostics))
          bodies.emplace_back(bodies[k].first + " " + name, std::move(c));
      }
  for (const auto& [name, body] : bodies)
    for (const city::Role role : {city::Role::Walk, city::Role::Talk}) {
      if (role == city::Role::Talk && name.find("131") != std::string::npos) continue;
      const city::Role shown = role == city::Role::Walk && body.carries ? city::Role::Carry : role;
      const city::City city = strip(body, shown, 10);
      city::Knobs knobs = knobsWith({{"avatar_lod", 0}});
      city::Diagnostics none;
      scenegraph::Scene scene(city, knobs, none);
      Renderer renderer(*context_, scene, 4);
      const plan::Planner planner(city, knobs);
      plan::PlannerState state;
      city::ViewState view = city::makeView({{0, -9, 1.3}, std::acos(-1.0) / 2, -0.03, 0}, 0.3, {1600, 420});
      renderer.draw(planner.plan(city, view, 0, state));
      std::string file = name + (role == city::Role::Walk ? " walk.png" : " talk.png");
      std::replace(file.begin(), file.end(), ' ', '-');
      EXPECT_EQ(writePng((folder / file).string(), renderer.readPicture()), "");
      EXPECT_THAT(renderer.problems(), testing::IsEmpty());
      if (role != city::Role::Walk) continue;
      const city::Clip& clip = body.clips[static_cast<size_t>(shown)];
      const avatars::FootContact contact = avatars::footContact(body.skeleton, clip);
      std::cout << name << ": stride " << clip.stride << " m in " << clip.duration << " s, slip " << 1000 * contact.slip
                << " mm a step, feet at most " << 1000 * contact.highest << " mm over and " << 1000 * contact.lowest
                << " mm under the ground\n";
    }
  for (const city::Diagnostic& d : diagnostics.messages) std::cout << city::describe(d) << "\n";
}

}  // namespace
}  // namespace vicus::viewer
