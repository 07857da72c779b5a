/// Routes, groups, and who is where; levels of detail.
#include "avatars/crowd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "avatars/impostor.hpp"
#include "avatars/lod.hpp"
#include "avatars/routes.hpp"
#include "city/random.hpp"

namespace vicus::avatars {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Square blocks of 40 m with streets of 8 m between: distance from the nearest block's wall.
double fromBlocks(dvec2 p) {
  const dvec2 within = p - 48.0 * glm::floor(p / 48.0);  // block from 4 to 44
  const dvec2 out = glm::max(dvec2(4) - within, within - dvec2(44));
  if (out.x <= 0 && out.y <= 0) return std::max(out.x, out.y);
  return std::min(glm::length(glm::max(out, dvec2(0))), 4.0);
}

Ground blocks() {
  return {fromBlocks, [](dvec2 p) { return std::optional<double>(0.05 * p.x); }};
}

/// The streets between six by six blocks.
city::StreetGraph streets() {
  city::StreetGraph g;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) g.nodes.push_back({dvec3(48.0 * x, 48.0 * y, 0)});
  for (uint32_t y = 0; y < 7; ++y)
    for (uint32_t x = 0; x < 7; ++x) {
      if (x < 6) g.edges.push_back({7 * y + x, 7 * y + x + 1, 8, city::StreetKind::Street, ""});
      if (y < 6) g.edges.push_back({7 * y + x, 7 * y + x + 7, 8, city::StreetKind::Street, ""});
    }
  return g;
}

city::People town(size_t groupPeople = 30) {
  city::People people;
  people.characters.resize(3);
  for (city::Character& c : people.characters) c.dresses.resize(4);
  people.routes = makeRoutes(streets(), blocks(), {.count = 24, .centre = dvec2(144)});
  std::vector<dvec2> candidates;
  for (int k = 0; k < 200; ++k) candidates.push_back({48.0 * (k % 7) + 2.9, 3.0 * k / 2});
  people.places = makeGroups(candidates, people.routes, blocks(), groupPeople, 5);
  people.count = 300;
  return people;
}

TEST(Routes, KeepToTheStreets) {
  const auto routes = makeRoutes(streets(), blocks(), {.count = 24, .centre = dvec2(144)});
  EXPECT_EQ(routes.size(), 24U);
  for (const city::WalkRoute& r : routes) {
    EXPECT_GE(r.length(), 120);
    for (const auto& p : r.points) {
      EXPECT_GE(fromBlocks(dvec2(p.position)), 0.45);
      EXPECT_LE(p.free, 3.0F);
      EXPECT_NEAR(p.position.z, 0.05 * p.position.x, 1e-9) << "on the ground";
    }
  }
}

TEST(Routes, EndWhereAStreetIsBlocked) {
  Ground ground = blocks();
  ground.clearance = [](dvec2 p) { return std::min(fromBlocks(p), std::abs(p.x - 130) - 2); };
  for (const city::WalkRoute& r : makeRoutes(streets(), ground, {.count = 24, .centre = dvec2(144)})) {
    const bool east = r.points[0].position.x > 130;
    for (const auto& p : r.points) EXPECT_EQ(p.position.x > 130, east);
  }
  EXPECT_TRUE(makeRoutes({}, ground, {}).empty());
}

TEST(Routes, AGridWhereThereAreNoStreets) {
  const city::StreetGraph grid = walkableGrid(blocks(), dvec2(144), 120, 2);
  for (const auto& n : grid.nodes) EXPECT_GE(fromBlocks(dvec2(n.position)), 1.2);
  EXPECT_GT(makeRoutes(grid, blocks(), {.count = 10, .centre = dvec2(144)}).size(), 5U);
}

TEST(Groups, StandTogetherOffTheWallsAndWays) {
  const city::People people = town();
  EXPECT_GE(people.places.size(), 10U);
  for (const city::StandingPlace& p : people.places) {
    EXPECT_GE(fromBlocks(dvec2(p.position)), kBodyRadius);
    size_t together = 0;
    for (const city::StandingPlace& q : people.places) {
      if (q.group == p.group) {
        ++together;
        EXPECT_LT(glm::distance(p.position, q.position), 2.1);
      }
      if (q.group != p.group) {
        EXPECT_GT(glm::distance(p.position, q.position), 2);
      }
    }
    EXPECT_GE(together, 2U);
  }
}

TEST(People, TheFirstOfManyAreTheSame) {
  const city::People people = town();
  const auto few = peopleOf(people, 50), many = peopleOf(people, 500);
  ASSERT_EQ(few.size(), 50U);
  ASSERT_EQ(many.size(), 500U);
  for (size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].start, many[i].start);
    EXPECT_EQ(few[i].route, many[i].route);
    EXPECT_EQ(few[i].dress, many[i].dress);
  }
  EXPECT_TRUE(peopleOf({}, 10).empty());
  city::People standing = people;
  standing.routes.clear();
  EXPECT_EQ(peopleOf(standing, 1000).size(), people.places.size()) << "no more than there are places";
}

TEST(Crowd, WalksOffTheWallsOnTheGround) {
  const city::People people = town();
  const auto persons = peopleOf(people, 300);
  city::HeightField field;
  field.size = {2, 2}, field.origin = {-1000, -1000}, field.spacing = dvec2(4000);
  field.heights = {-50, 150, -50, 150};
  field.updateRange();
  for (int k = 0; k < 200; ++k)
    for (const Place& p : placesAt(people, persons, &field, 1.7 * k)) {
      ASSERT_GE(fromBlocks(dvec2(p.position)), kBodyRadius - 0.05) << p.position.x << " " << p.position.y;
      ASSERT_NEAR(p.position.z, 0.05 * p.position.x, 1e-6);
    }
}

TEST(Crowd, NobodyJumps) {
  const city::People people = town();
  const auto persons = peopleOf(people, 300);
  constexpr double kStep = 1.0 / 60;
  double fastest = 0;
  for (int k = 0; k < 100; ++k) {
    const auto a = placesAt(people, persons, nullptr, 3.1 * k), b = placesAt(people, persons, nullptr, 3.1 * k + kStep);
    for (size_t i = 0; i < a.size(); ++i)
      fastest = std::max(fastest, glm::distance(dvec2(a[i].position), dvec2(b[i].position)) / kStep);
  }
  EXPECT_LT(fastest, 1.5 + kFastestAside);
}

TEST(Crowd, MakesWay) {
  // How many are nearer to another than their shoulders are wide: with making way, and on their bare lanes.
  const city::People people = town();
  const auto persons = peopleOf(people, 300);
  size_t touching = 0, pairs = 0;
  for (int k = 0; k < 60; ++k) {
    const auto at = placesAt(people, persons, nullptr, 7.3 * k);
    for (size_t i = 0; i < at.size(); ++i)
      for (size_t j = i + 1; j < at.size(); ++j) {
        const double d = glm::distance(dvec2(at[i].position), dvec2(at[j].position));
        touching += d < 0.35, pairs += d < 3;
      }
  }
  EXPECT_LT(static_cast<double>(touching), 0.05 * static_cast<double>(pairs));
}

TEST(Crowd, NobodyIsFartherFromTheMiddleOfHisWayThanIsSaid) {
  const city::People people = town();
  const auto persons = peopleOf(people, 300);
  double most = 0;
  for (int k = 0; k < 200; ++k) {
    const Crowd crowd = crowdAt(people, persons, 2.3 * k);
    for (uint32_t i = 0; i < persons.size(); ++i) {
      const Place place = placeOf(crowd, people, persons, nullptr, i);
      const double away = glm::distance(dvec2(place.position), dvec2(crowd.walkers[i].middle));
      ASSERT_LE(away, reachOf(crowd, persons, i)) << i << " at " << 2.3 * k;
      most = std::max(most, away / std::max(reachOf(crowd, persons, i), 1e-9));
    }
  }
  EXPECT_GT(most, 0.5) << "and what is said is not idle";
}

TEST(Crowd, TwoWhoMeetKeepRight) {
  city::People people;
  people.characters.emplace_back();
  for (const int way : {1, -1}) {
    city::WalkRoute r;
    for (int k = 0; k < 40; ++k) r.points.push_back({{way * (2.0 * k - 40), 0, 0}, 2, false});
    people.routes.push_back(r);
    city::Person p;
    p.route = way > 0 ? 0 : 1, p.speed = 1, p.side = 0, p.start = 10;
    people.placed.push_back(p);
  }
  double nearest = 100;
  for (int k = 0; k < 400; ++k) {
    const auto at = placesAt(people, people.placed, nullptr, 0.1 * k);
    if (std::abs(at[0].position.x) > 15) continue;
    nearest = std::min(nearest, glm::distance(dvec2(at[0].position), dvec2(at[1].position)));
    EXPECT_LE(at[0].position.y, 1e-9) << "his right is south";
    EXPECT_GE(at[1].position.y, -1e-9);
  }
  EXPECT_GE(nearest, 0.9 * kPassing);
}

TEST(Lod, RatesFallWithTheDistance) {
  const LodSettings lod;
  EXPECT_EQ(poseRate(lod, 5), 60);
  EXPECT_EQ(poseRate(lod, 11), 30);
  EXPECT_EQ(poseRate(lod, 80), 7.5);
  EXPECT_EQ(poseRate(lod, 1e6), 1);
  EXPECT_NEAR(poseTime(lod, 10, 0, 1.234), 1.2, 1e-12);
  EXPECT_EQ(poseTime({.on = false}, 10, 0, 1.234), 1.234);
  city::Random random(1);
  for (int k = 0; k < 1000; ++k) {
    const double time = random.uniform(0, 1000), rate = random.uniform(1, 100),
                 at = poseTime(lod, rate, random.uniform(), time);
    EXPECT_LE(at, time);
    EXPECT_GE(at, time - 1.0001 / rate);
  }
}

TEST(Lod, CoarserMeshesAreMeasured) {
  city::AvatarMesh full, flat;
  full.vertices.resize(4);
  full.vertices[1].position = {1, 0, 0}, full.vertices[2].position = {0, 1, 0},
  full.vertices[3].position = {0.2F, 0.2F, 0.3F};
  full.indices = {0, 1, 2, 0, 1, 3};
  flat.vertices = full.vertices, flat.indices = {0, 1, 2};
  EXPECT_NEAR(meshDistance(full, full), 0, 1e-6);
  EXPECT_NEAR(meshDistance(full, flat), 0.3, 1e-6);
  const LevelErrors errors{{0, 0.01, 0.03, 0.2}, 2};
  EXPECT_EQ(levelFor({}, errors, 1000), 0);
  EXPECT_EQ(levelFor({}, errors, 50), 1);
  EXPECT_EQ(levelFor({}, errors, 10), 2);
  EXPECT_EQ(levelFor({}, errors, 4), city::kAvatarMeshLevels);
  EXPECT_EQ(levelFor({.on = false}, errors, 4), 0);
}

TEST(Impostor, ShowsTheBodyFromEachSide) {
  // A plate of a metre and a half that faces +x: wide from the front and the back, a line from the sides.
  city::Character c;
  c.skeleton.joints.push_back({"root", city::kNone, {}});
  c.jointFromSkin.emplace_back(1);
  c.levels[0].vertices.resize(4);
  const glm::vec3 corners[] = {{0, -0.4F, 0}, {0, 0.4F, 0}, {0, 0.4F, 1.5F}, {0, -0.4F, 1.5F}};
  for (size_t k = 0; k < 4; ++k) c.levels[0].vertices[k].position = corners[k], c.levels[0].vertices[k].colour[3] = 2;
  c.levels[0].indices = {0, 1, 2, 0, 2, 3};
  c.bounds = {{-0.4F, -0.4F, 0}, {0.4F, 0.4F, 1.5F}};
  const Impostor picture = makeImpostor(c);
  ASSERT_EQ(picture.rgba.size(), 4U * static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height));
  for (int k = 0; k < kImpostorDirections; ++k) {
    size_t covered = 0;
    for (int y = 0; y < kImpostorHeight; ++y)
      for (int x = 0; x < kImpostorWidth; ++x) {
        const uint8_t alpha = picture.rgba[4 * static_cast<size_t>(y * picture.width + k * kImpostorWidth + x) + 3];
        covered += alpha > 0;
        EXPECT_TRUE(alpha == 0 || alpha == 3 * 28);
      }
    const double share = static_cast<double>(covered) / (kImpostorWidth * kImpostorHeight);
    const double seen = std::abs(std::cos(k * std::acos(-1.0) / 4));
    EXPECT_NEAR(share, seen, 0.05) << k;
  }
}

}  // namespace
}  // namespace vicus::avatars
