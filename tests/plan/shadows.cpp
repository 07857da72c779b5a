#include "plan/shadows.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "city/random.hpp"
#include "plan/planner.hpp"
#include "plan/shadow_stability.hpp"

namespace vicus::plan {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

city::City town(double side = 600) {
  city::City city;
  city::BuildingGeometry house;
  house.bounds = {{-6, -5, 0}, {6, 5, 9}};
  city.buildingTypes = {house};
  city::Random random(3);
  city::CityParts parts;
  for (int i = 0; i < 300; ++i)
    parts.buildings.emplace_back().position = {random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2),
                                               0};
  city::finishCity(city, std::move(parts));
  city.environment.sunAzimuth = 200 * kDegree;
  city.environment.sunElevation = 30 * kDegree;
  return city;
}

city::Knobs knobs() {
  city::Knobs k;
  k.declare(planKnobs());
  k.set("shadows.cascades", 4);
  return k;
}

city::FramePlan planAt(const city::City& city, const Planner& planner, const glm::dvec3& eye, PlannerState& state) {
  return planner.plan(city, city::makeView({eye, 0, 0, 0}, 1, {64, 64}), 0, state);
}

TEST(Shadows, EachSquareHoldsAllThatIsNear) {
  const city::City city = town();
  const Planner planner(city, knobs());
  PlannerState state;
  city::Random random(1);
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 eye(random.uniform(-300, 300), random.uniform(-300, 300), random.uniform(1, 60));
    const city::FramePlan plan = planAt(city, planner, eye, state);
    ASSERT_EQ(plan.shadows.size(), 4u);
    for (const auto& cascade : plan.shadows) {
      if (!cascade) continue;
      const city::ShadowView& v = cascade->view;
      const double margin = 4 * v.halfExtent / 1024;  // two texels
      const glm::dvec3 fromCentre = v.lightFromWorld * (eye - v.centre);
      EXPECT_LE(std::abs(fromCentre.x) + v.reach + margin, v.halfExtent * (1 + 1e-9));
      EXPECT_LE(std::abs(fromCentre.y) + v.reach + margin, v.halfExtent * (1 + 1e-9));
    }
  }
}

TEST(Shadows, SquaresMoveByWholeTexels) {
  const city::City city = town();
  const Planner planner(city, knobs());
  PlannerState state;
  std::vector<glm::dvec3> last(4, glm::dvec3(NAN));
  int moves = 0;
  for (double x = -100; x < 100; x += 0.7) {
    const city::FramePlan plan = planAt(city, planner, {x, 0.3 * x, 2}, state);
    for (size_t k = 0; k < plan.shadows.size(); ++k) {
      if (!plan.shadows[k]) continue;
      const city::ShadowView& v = plan.shadows[k]->view;
      if (!std::isnan(last[k].x) && v.centre != last[k]) {
        const glm::dvec3 moved = v.lightFromWorld * (v.centre - last[k]) / (2 * v.halfExtent / 1024);
        EXPECT_NEAR(moved.x, std::round(moved.x), 1e-6);
        EXPECT_NEAR(moved.y, std::round(moved.y), 1e-6);
        ++moves;
      }
      last[k] = v.centre;
    }
  }
  EXPECT_GT(moves, 20);
  EXPECT_LT(moves, 150) << "most of the 286 frames redraw nothing";
}

TEST(Shadows, WhatStandsBeforeTheSunIsInThePlanWhereverTheEyeLooks) {
  const city::City city = town();
  const Planner planner(city, knobs());
  city::Random random(2);
  size_t checked = 0;
  for (int k = 0; k < 200; ++k) {
    const glm::dvec3 eye(random.uniform(-250, 250), random.uniform(-250, 250), 2);
    PlannerState state;
    const city::FramePlan plan = planAt(city, planner, eye, state);
    for (const auto& cascade : plan.shadows) {
      if (!cascade) continue;
      // A ray from a place in reach towards the sun: each house whose box it meets must be planned.
      const glm::dvec3 toSun = glm::transpose(cascade->view.lightFromWorld)[2];
      const glm::dvec3 from = eye + glm::dvec3(random.uniform(-0.5, 0.5) * cascade->view.reach,
                                               random.uniform(-0.5, 0.5) * cascade->view.reach, -1);
      for (uint32_t i = 0; i < city.buildings.size(); ++i) {
        const city::Aabbf& box = city.buildings.bounds[i];
        const glm::dvec3 a = (glm::dvec3(box.min) - from) / toSun, b = (glm::dvec3(box.max) - from) / toSun;
        const glm::dvec3 lo = glm::min(a, b), hi = glm::max(a, b);
        if (std::max({lo.x, lo.y, lo.z, 0.0}) > std::min({hi.x, hi.y, hi.z})) continue;
        ++checked;
        EXPECT_TRUE(std::any_of(cascade->buildings.drawn.begin(), cascade->buildings.drawn.end(),
                                [&](const city::Range& r) { return i >= r.first && i < r.end(); }));
      }
    }
  }
  EXPECT_GT(checked, 50u);
}

TEST(Shadows, TheSameEyeGivesTheSamePlansWhateverWasBefore) {
  const city::City city = town();
  const Planner planner(city, knobs());
  PlannerState wandered, fresh;
  for (double x = -200; x < 200; x += 13) planAt(city, planner, {x, -x, 5}, wandered);
  const city::FramePlan a = planAt(city, planner, {12, 34, 5}, wandered), b = planAt(city, planner, {12, 34, 5}, fresh);
  ASSERT_EQ(a.shadows.size(), b.shadows.size());
  for (size_t k = 0; k < a.shadows.size(); ++k) {
    ASSERT_EQ(a.shadows[k] == nullptr, b.shadows[k] == nullptr);
    if (!a.shadows[k]) continue;
    EXPECT_EQ(a.shadows[k]->view.centre, b.shadows[k]->view.centre);
    EXPECT_EQ(a.shadows[k]->buildings.drawn, b.shadows[k]->buildings.drawn);
  }
  const city::FramePlan again = planAt(city, planner, {12.01, 34, 5}, wandered);
  EXPECT_EQ(again.shadows.back(), a.shadows.back()) << "a small step plans nothing anew";
}

TEST(Shadows, AreNotThereWhereNothingNeedsThem) {
  city::City city = town();
  const auto cascades = [&](const city::Knobs& k) {
    const Planner planner(city, k);
    const bool step = [&] {
      const std::vector<std::string> steps = planner.steps();
      return std::find(steps.begin(), steps.end(), "shadows") != steps.end();
    }();
    PlannerState state;
    const size_t count = planAt(city, planner, {0, 0, 2}, state).shadows.size();
    EXPECT_EQ(step, count > 0);
    EXPECT_EQ(cascadeCount(city, k), count);
    return count;
  };
  city::Knobs off = knobs();
  off.set("shadows.cascades", 0);
  EXPECT_EQ(cascades(off), 0u);
  EXPECT_EQ(cascades(knobs()), 4u);
  city.environment.sunElevation = -0.1;
  EXPECT_EQ(cascades(knobs()), 0u) << "the sun is down";
  city.environment.sunElevation = NAN;
  EXPECT_EQ(cascades(knobs()), 0u);
  city = city::City();
  city::finishCity(city, {});
  EXPECT_EQ(cascades(knobs()), 0u) << "nothing stands there";
}

TEST(Shadows, HighOverTheTownTheNearMapsAreLeftOut) {
  const city::City city = town();
  const Planner planner(city, knobs());
  PlannerState state;
  const city::FramePlan plan = planAt(city, planner, {0, 0, 200}, state);
  EXPECT_FALSE(plan.shadows[0]);
  EXPECT_TRUE(plan.shadows[3]);
}

TEST(Shadows, GroundThrowsThemOnlyWhereItIsSteeperThanTheSun) {
  city::City city = town();
  city::HeightField field;
  field.size = {65, 65}, field.origin = glm::dvec2(-320), field.spacing = glm::dvec2(10);
  for (int r = 0; r < 65; ++r)
    for (int c = 0; c < 65; ++c) field.heights.push_back(static_cast<float>(std::max(0, 20 - std::abs(c - 32)) * 3));
  field.updateRange();  // a ridge whose sides rise 17°
  city.terrain = field;
  const auto ground = [&] {
    const Planner planner(city, knobs());
    PlannerState state;
    return planAt(city, planner, {0, 0, 70}, state).shadows.back()->ground;
  };
  city.environment.sunElevation = 20 * kDegree;
  EXPECT_FALSE(ground());
  city.environment.sunElevation = 10 * kDegree;
  EXPECT_TRUE(ground());
}

TEST(Shadows, StabilityRowsHold) {
  for (const city::StabilityRow& row : shadowStability())
    EXPECT_TRUE(row.ok) << row.caseName << ": " << row.what << " " << row.figure << " > " << row.bound;
}

}  // namespace
}  // namespace vicus::plan
