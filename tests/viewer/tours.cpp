#include "viewer/tours.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "assets/norvic/norvic.hpp"
#include "small_cities.hpp"
#include "viewer/distance_map.hpp"
#include "walking/surroundings.hpp"

namespace vicus::viewer {
namespace {

using city::City;
using city::Tour;
using std::numbers::pi;

double turnBetween(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * pi));
}

/// Every property that a walk on the ground promises, sampled ten times a second.
void expectWalkable(const City& city, const Tour& tour) {
  ASSERT_GE(tour.keys.size(), 2u) << tour.name;
  const double start = tour.keys.front().time, step = 0.1;
  city::ViewPose last = poseAt(tour, start);
  for (double t = 0; t <= durationOf(tour); t += step) {
    const city::ViewPose pose = poseAt(tour, start + t);
    const glm::dvec2 at(pose.eye);
    ASSERT_GT(walking::clearance(city, at, 2), 0.4) << tour.name << " at " << t << " s runs into a building";
    const double above = pose.eye.z - walking::groundAt(city, at);
    ASSERT_GT(above, 1.4) << tour.name << " at " << t << " s";
    ASSERT_LT(above, 2.0) << tour.name << " at " << t << " s";
    ASSERT_LT(glm::distance(pose.eye, last.eye), 5 * step) << tour.name << " jumps at " << t << " s";
    ASSERT_LT(turnBetween(pose.heading, last.heading), 2.5 * step) << tour.name << " turns its head too fast at " << t;
    last = pose;
  }
}

Tour lineTour(std::vector<Tour::Key> keys) {
  Tour tour;
  tour.keys = std::move(keys);
  return tour;
}

TEST(PoseAt, NoKeysGiveTheDefaultPose) {
  EXPECT_EQ(poseAt({}, 3).eye, glm::dvec3(0));
  EXPECT_EQ(durationOf({}), 0);
}

TEST(PoseAt, OneKeyStandsStill) {
  const Tour tour = lineTour({{5, {1, 2, 3}, 0.5, 0.1}});
  for (const double t : {-100.0, 5.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(poseAt(tour, t).eye, glm::dvec3(1, 2, 3));
    EXPECT_EQ(poseAt(tour, t).heading, 0.5);
  }
}

TEST(PoseAt, PassesThroughItsKeys) {
  const Tour tour =
      lineTour({{0, {0, 0, 0}, 0, 0}, {1, {3, 1, 0}, 1, 0.2}, {4, {3, 9, 2}, 2, -0.3}, {5, {0, 0, 0}, 3, 0}});
  for (const Tour::Key& key : tour.keys) {
    const city::ViewPose pose = poseAt(tour, key.time);
    EXPECT_NEAR(glm::distance(pose.eye, key.position), 0, 1e-12);
    EXPECT_NEAR(turnBetween(pose.heading, key.heading), 0, 1e-12);
    EXPECT_NEAR(pose.pitch, key.pitch, 1e-12);
  }
}

TEST(PoseAt, EvenKeysOnALineKeepTheirSpeed) {
  std::vector<Tour::Key> keys;
  for (int k = 0; k < 6; ++k) keys.push_back({2.0 * k, {3.0 * k, 0, 0}, 0, 0});
  const Tour tour = lineTour(keys);
  for (double t = 0; t < 9.9; t += 0.1)
    EXPECT_NEAR(poseAt(tour, t + 0.1).eye.x - poseAt(tour, t).eye.x, 0.15, 1e-12) << t;
}

TEST(PoseAt, SpeedIsContinuousAtUnevenKeys) {
  const Tour tour =
      lineTour({{0, {0, 0, 0}, 0, 0}, {1, {2, 0, 0}, 0, 0}, {1.5, {3, 5, 0}, 0, 0}, {9, {0, 0, 4}, 0, 0}});
  const double h = 1e-5;
  for (const double t : {1.0, 1.5}) {
    const glm::dvec3 before = (poseAt(tour, t).eye - poseAt(tour, t - h).eye) / h;
    const glm::dvec3 after = (poseAt(tour, t + h).eye - poseAt(tour, t).eye) / h;
    EXPECT_LT(glm::distance(before, after), 1e-2) << t;
  }
}

TEST(PoseAt, HeadingTakesTheShorterArc) {
  // From 170 to −170 degrees it is 20 degrees through south, not 340 through north.
  const Tour tour = lineTour({{0, {}, glm::radians(170.0), 0}, {1, {}, glm::radians(-170.0), 0}});
  EXPECT_NEAR(turnBetween(poseAt(tour, 0.5).heading, pi), 0, 1e-12);
  // Whole turns in the keys' own numbers do not count.
  const Tour wound = lineTour({{0, {}, 0.1, 0}, {1, {}, 0.3 + 6 * pi, 0}});
  EXPECT_NEAR(turnBetween(poseAt(wound, 0.5).heading, 0.2), 0, 1e-9);
}

TEST(PoseAt, JumpingToursStayAtTheirKeys) {
  Tour tour = lineTour({{0, {0, 0, 0}, 0, 0}, {1, {100, 0, 0}, 1, 0}});
  tour.jumps = true;
  EXPECT_EQ(poseAt(tour, 0.999).eye.x, 0);
  EXPECT_EQ(poseAt(tour, 1).eye.x, 100);
  EXPECT_EQ(poseAt(tour, 77).eye.x, 100);
}

TEST(PoseAt, EqualTimesAreAJumpAndNeverNaN) {
  const Tour tour = lineTour({{0, {0, 0, 0}, 0, 0}, {1, {1, 0, 0}, 0, 0}, {1, {9, 0, 0}, 2, 0}, {2, {10, 0, 0}, 2, 0}});
  for (double t = -0.5; t < 2.5; t += 0.05) EXPECT_TRUE(std::isfinite(poseAt(tour, t).eye.x)) << t;
  EXPECT_NEAR(poseAt(tour, 0.5).eye.x, 0.5, 1e-12);
  EXPECT_NEAR(poseAt(tour, 1.5).eye.x, 9.5, 1e-12);
}

TEST(SpreadFrames, TenWarmUpThenEvenlyFromStartToEnd) {
  const Tour tour = lineTour({{2, {}, 0, 0}, {8, {}, 0, 0}});
  const std::vector<TourFrame> frames = spreadFrames(tour, 4);
  ASSERT_EQ(frames.size(), 14u);
  for (size_t k = 0; k < 10; ++k) EXPECT_TRUE(frames[k].warmUp && frames[k].time == 2);
  EXPECT_EQ(frames[10].time, 2);
  EXPECT_EQ(frames[11].time, 4);
  EXPECT_EQ(frames[13].time, 8);
  EXPECT_EQ(frames[13].dt, 2);
  EXPECT_FALSE(frames[10].warmUp);
}

TEST(SpreadFrames, OneAndNone) {
  const Tour tour = lineTour({{0, {}, 0, 0}, {6, {}, 0, 0}});
  ASSERT_EQ(spreadFrames(tour, 1).size(), 11u);
  EXPECT_EQ(spreadFrames(tour, 1).back().time, 0);
  EXPECT_EQ(spreadFrames(tour, 0).size(), 10u);
  EXPECT_EQ(spreadFrames({}, 3).size(), 13u);
}

TEST(MakeTours, EverySceneHasTheFour) {
  for (const City& city : {City{}, test::cityOf({{0, 0}}), test::gridTown()}) {
    const std::vector<Tour> tours = makeTours(city);
    ASSERT_EQ(tours.size(), 4u);
    for (size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(tours[k].name, kTourNames[k]);
      EXPECT_FALSE(tours[k].keys.empty());
      for (const Tour::Key& key : tours[k].keys)
        EXPECT_TRUE(std::isfinite(key.position.x + key.position.y + key.position.z + key.heading + key.pitch));
      for (size_t i = 1; i < tours[k].keys.size(); ++i) EXPECT_GT(tours[k].keys[i].time, tours[k].keys[i - 1].time);
    }
  }
}

TEST(MakeTours, StreetIsWalkableWithoutStreets) {
  const City town = test::gridTown();
  const std::vector<Tour> tours = makeTours(town);
  expectWalkable(town, tours[0]);
  // It goes somewhere: farther than across a block.
  const auto& keys = tours[0].keys;
  EXPECT_GT(durationOf(tours[0]), 40);
  EXPECT_GT(glm::distance(keys.front().position, keys.back().position), 50);
}

TEST(MakeTours, StreetKeepsToTheTown) {
  const City town = test::gridTown();
  const Tour street = makeTours(town)[0];
  size_t among = 0;
  for (const Tour::Key& key : street.keys) among += walking::clearance(town, glm::dvec2(key.position), 12) < 9.5;
  EXPECT_GT(among, street.keys.size() * 3 / 4);
}

TEST(MakeTours, StreetIsWalkableInOtherPlaces) {
  expectWalkable(City{}, makeTours({})[0]);
  const City one = test::cityOf({{1000, -500}}, 37, 0.6f);
  expectWalkable(one, makeTours(one)[0]);
  const City high = test::gridTown(6, 6, 8848);
  expectWalkable(high, makeTours(high)[0]);
}

TEST(MakeTours, StreetFollowsTheTerrain) {
  City city = test::gridTown();
  test::setTerrain(city, test::terrain(81, 5, [](double x, double y) { return 10 * std::sin(x / 30) + 0.1 * y; }));
  expectWalkable(city, makeTours(city)[0]);
}

TEST(MakeTours, StreetFollowsTheStreets) {
  City city = test::gridTown();
  city::StreetGraph graph;
  // A street between the first rows of houses, another between the next, joined at both ends; and one through houses.
  for (int k = 0; k <= 10; ++k) graph.nodes.push_back({{-10 + 12.0 * k, 8, 0}});
  for (int k = 0; k <= 10; ++k) graph.nodes.push_back({{-10 + 12.0 * k, 24, 0}});
  for (uint32_t k = 0; k < 10; ++k) graph.edges.push_back({k, k + 1, 4, city::StreetKind::Street, ""});
  for (uint32_t k = 11; k < 21; ++k) graph.edges.push_back({k, k + 1, 4, city::StreetKind::Lane, ""});
  graph.edges.push_back({0, 11, 4, city::StreetKind::Street, ""});
  graph.edges.push_back({5, 16, 4, city::StreetKind::HighStreet, ""});  // would cut through a house
  city.streets = graph;
  const Tour street = makeTours(city)[0];
  expectWalkable(city, street);
  EXPECT_GT(durationOf(street), 30);
  for (const Tour::Key& key : street.keys) {
    const double y = key.position.y, x = key.position.x;
    const bool onStreet = std::abs(y - 8) < 2.5 || std::abs(y - 24) < 2.5 || x < -6;
    EXPECT_TRUE(onStreet) << x << ", " << y;
  }
}

TEST(MakeTours, BrokenStreetsAreNoObstacle) {
  City city = test::gridTown(6, 4);
  city::StreetGraph graph;
  graph.nodes.push_back({{std::nan(""), 0, 0}});
  graph.nodes.push_back({{0, 8, 0}});
  graph.edges.push_back({0, 1, 4, city::StreetKind::Street, ""});
  graph.edges.push_back({1, 77, 4, city::StreetKind::Street, ""});
  graph.edges.push_back({1, 1, 4, city::StreetKind::Street, ""});
  city.streets = graph;
  expectWalkable(city, makeTours(city)[0]);
}

TEST(MakeTours, BridgesAreWalkedOnTheirDecks) {
  City city = test::gridTown(4, 2);
  // A river bed 6 m deep between x = 40 and x = 60.
  test::setTerrain(city, test::terrain(161, 2, [](double x, double) { return x > 40 && x < 60 ? -6.0 : 0.0; }));
  city::StreetGraph graph;
  for (const double x : {-10.0, 10.0, 36.0, 64.0, 90.0, 120.0}) graph.nodes.push_back({{x, 8, 0}});
  for (uint32_t k = 0; k < 5; ++k)
    graph.edges.push_back({k, k + 1, 4, k == 2 ? city::StreetKind::Bridge : city::StreetKind::Street, ""});
  city.streets = graph;
  const Tour street = makeTours(city)[0];
  bool crossed = false;
  for (const Tour::Key& key : street.keys) {
    EXPECT_NEAR(key.position.z, walking::kEyeHeight, 0.05) << key.position.x;
    crossed = crossed || std::abs(key.position.x - 50) < 2;
  }
  EXPECT_TRUE(crossed);
}

TEST(MakeTours, FlyoverClearsEverything) {
  City city = test::gridTown();
  test::setTerrain(city,
                   test::terrain(101, 10, [](double x, double y) { return std::hypot(x - 60, y) < 25 ? 300.0 : 0.0; }));
  const Tour flyover = makeTours(city)[1];
  for (double t = 0; t <= durationOf(flyover); t += 0.25) {
    const glm::dvec3 eye = poseAt(flyover, t).eye;
    EXPECT_GT(eye.z, walking::highestWithin(city, glm::dvec2(eye), 2) + 5) << t;
  }
}

TEST(MakeTours, TurnGoesRoundOnTheSpot) {
  const City town = test::gridTown();
  const Tour turn = makeTours(town)[2];
  EXPECT_GT(walking::clearance(town, glm::dvec2(turn.keys[0].position), 5), 1);
  double turned = 0;
  for (size_t k = 1; k < turn.keys.size(); ++k) {
    EXPECT_EQ(turn.keys[k].position, turn.keys[0].position);
    turned += std::remainder(turn.keys[k].heading - turn.keys[k - 1].heading, 2 * pi);
  }
  EXPECT_NEAR(turned, 2 * pi, 1e-9);
}

TEST(MakeTours, TeleportJumpsToPlacesOutdoors) {
  const City town = test::gridTown();
  const Tour teleport = makeTours(town)[3];
  EXPECT_TRUE(teleport.jumps);
  for (const Tour::Key& key : teleport.keys) {
    const glm::dvec2 at(key.position);
    EXPECT_TRUE(walking::clearance(town, at, 2) > 0.7 || key.position.z > 6)
        << at.x << ", " << at.y << ", " << key.position.z;
  }
}

TEST(MakeTours, TheSameCityGivesTheSameTours) {
  const std::vector<Tour> a = makeTours(test::gridTown()), b = makeTours(test::gridTown());
  ASSERT_EQ(a.size(), b.size());
  for (size_t t = 0; t < a.size(); ++t) {
    ASSERT_EQ(a[t].keys.size(), b[t].keys.size());
    for (size_t k = 0; k < a[t].keys.size(); ++k) {
      EXPECT_EQ(a[t].keys[k].position, b[t].keys[k].position);
      EXPECT_EQ(a[t].keys[k].heading, b[t].keys[k].heading);
    }
  }
}

TEST(MakeTours, TheSceneHasTheFirstWord) {
  City city = test::gridTown();
  Tour own = lineTour({{0, {1, 1, 50}, 0, 0}, {5, {2, 2, 50}, 0, 0}});
  own.name = "street";
  Tour further = own, empty;
  further.name = "procession";
  empty.name = "turn";
  city.tours = {own, further, empty};
  const std::vector<Tour> tours = makeTours(city);
  ASSERT_EQ(tours.size(), 5u);
  EXPECT_EQ(tours[0].keys.size(), 2u);
  EXPECT_EQ(tours[4].name, "procession");
  EXPECT_GT(tours[2].keys.size(), 2u) << "a tour without keys is made anew";
  EXPECT_EQ(findTour(tours, "procession"), &tours[4]);
  EXPECT_EQ(findTour(tours, "dance"), nullptr);
}

TEST(MakeTours, StreetsOfAWholeTownAreWalkable) {
  City norwich = assets::generateNorwich2001();
  norwich.tours.clear();
  const Tour street = makeTours(norwich)[0];
  expectWalkable(norwich, street);
  EXPECT_GT(durationOf(street), 100);
}

TEST(RandomView, IsFiniteEverywhereAndRepeats) {
  for (const City& city : {City{}, test::cityOf({{0, 0}}), test::gridTown()}) {
    city::Random a(7), b(7);
    for (int k = 0; k < 50; ++k) {
      const city::ViewPose pose = randomView(city, a), again = randomView(city, b);
      EXPECT_TRUE(std::isfinite(pose.eye.x + pose.eye.y + pose.eye.z + pose.heading + pose.pitch));
      EXPECT_EQ(pose.eye, again.eye);
      EXPECT_EQ(pose.heading, again.heading);
    }
  }
}

TEST(DistanceTransform, AgreesWithLookingAtEveryCell) {
  city::Random random(3);
  const glm::ivec2 size(23, 17);
  for (const uint32_t oneIn : {2u, 40u, 400u}) {
    std::vector<uint8_t> occupied(static_cast<size_t>(size.x * size.y));
    for (uint8_t& o : occupied) o = random.below(oneIn) == 0;
    const std::vector<float> distance = distanceTransform(occupied, size);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        double nearest = std::numeric_limits<double>::infinity();
        for (int v = 0; v < size.y; ++v)
          for (int u = 0; u < size.x; ++u)
            if (occupied[static_cast<size_t>(v * size.x + u)]) nearest = std::min(nearest, std::hypot(x - u, y - v));
        const double found = static_cast<double>(distance[static_cast<size_t>(y * size.x + x)]);
        if (std::isinf(nearest)) {
          EXPECT_TRUE(std::isinf(found));
        } else {
          EXPECT_NEAR(found, nearest, 1e-5);
        }
      }
  }
}

TEST(DistanceTransform, EmptyAndSingle) {
  EXPECT_TRUE(distanceTransform({}, {0, 0}).empty());
  EXPECT_EQ(distanceTransform({1}, {1, 1}), std::vector<float>{0});
  EXPECT_TRUE(std::isinf(distanceTransform({0}, {1, 1})[0]));
}

TEST(RidgeWay, KeepsClearAndFindsNoneWhereAllIsBuilt) {
  const City town = test::gridTown();
  const DistanceMap map = distanceToFootprints(town, walking::densestPoint(town), 80, 1);
  const std::vector<glm::dvec2> way = ridgeWay(map, 1.2);
  ASSERT_GT(way.size(), 50u);
  for (const glm::dvec2& p : way) EXPECT_GT(walking::clearance(town, p, 3), 0.4);
  DistanceMap full = map;
  std::fill(full.distance.begin(), full.distance.end(), 0.f);
  EXPECT_TRUE(ridgeWay(full, 1.2).empty());
}

TEST(Clearance, SignedDistanceToATurnedHouse) {
  // 8 × 10 m, turned by a right angle: 10 across, 8 deep.
  const City city = test::cityOf({{100, 50}}, 0, static_cast<float>(pi / 2));
  EXPECT_NEAR(walking::clearance(city, {100, 50}, 20), -4, 1e-5);
  EXPECT_NEAR(walking::clearance(city, {108, 50}, 20), 3, 1e-5);
  EXPECT_NEAR(walking::clearance(city, {100, 59}, 20), 5, 1e-5);
  EXPECT_EQ(walking::clearance(city, {300, 50}, 20), 20);
  EXPECT_EQ(walking::clearance({}, {0, 0}, 20), 20);
}

TEST(Clearance, HolesAreOutdoors) {
  City city;
  city::BuildingBuilder builder("court");
  builder.addBox({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-10, -10, 0}, {10, 10, 5}, 0);
  builder.setFootprint({{{-10, -10}, {10, -10}, {10, 10}, {-10, 10}}, {{-4, -4}, {-4, 4}, {4, 4}, {4, -4}}});
  city.buildingTypes = {builder.finish()};
  city::CityParts parts;
  parts.buildings.resize(1);
  city::finishCity(city, std::move(parts));
  EXPECT_NEAR(walking::clearance(city, {0, 0}, 9), 4, 1e-6);
  EXPECT_NEAR(walking::clearance(city, {7, 0}, 9), -3, 1e-6);
}

TEST(GroundAt, TerrainThenWaterThenBuildings) {
  City city = test::cityOf({{0, 0}}, 12);
  EXPECT_NEAR(walking::groundAt(city, {5, 5}), 12, 1e-9);
  EXPECT_NEAR(walking::groundAt(city, {50000, 5}), 12, 1e-9) << "far from all buildings the nearest one counts";
  EXPECT_EQ(walking::groundAt(city, {std::nan(""), 0}), 0);
  EXPECT_EQ(walking::groundAt({}, {3, 4}), 0);
  test::setTerrain(city, test::terrain(11, 10, [](double, double) { return 3.0; }));
  EXPECT_NEAR(walking::groundAt(city, {5, 5}), 3, 1e-9);
  city::WaterBody pond;
  pond.level = 4;
  pond.points = {{0, 0}, {20, 0}, {0, 20}};
  pond.indices = {0, 1, 2};
  city.water = {pond};
  EXPECT_NEAR(walking::groundAt(city, {5, 5}), 4, 1e-9);
  EXPECT_NEAR(walking::groundAt(city, {-5, -5}), 3, 1e-9);
}

}  // namespace
}  // namespace vicus::viewer
