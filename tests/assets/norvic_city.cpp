/// The generated cities: what they promise about houses, streets, water, tours and counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "assets/norvic/norvic.hpp"
#include "city/random.hpp"

namespace vicus::assets {
namespace {

using city::City;
using city::Instance;
using glm::dvec2;
using glm::dvec3;

/// A house's ground floor on the plan.
struct Ground {
  std::array<dvec2, 4> corners;  ///< counter-clockwise: front left, front right, back right, back left
  dvec2 along, into;             ///< unit, along the front and away from the street
  double z = 0;

  bool contains(dvec2 p, double margin = 0) const {
    const dvec2 q = p - corners[0];
    const double u = glm::dot(q, along), v = glm::dot(q, into);
    const double width = glm::length(corners[1] - corners[0]), depth = glm::length(corners[3] - corners[0]);
    return u > -margin && u < width + margin && v > -margin && v < depth + margin;
  }
};

Ground groundOf(const City& city, const Instance& house) {
  const auto& ring = city.buildingTypes[house.geometry].footprint.at(0);
  const double c = std::cos(static_cast<double>(house.heading)), s = std::sin(static_cast<double>(house.heading));
  Ground g;
  for (size_t i = 0; i < 4; ++i) {
    const dvec2 p(ring[i]);
    g.corners[i] = dvec2(house.position) + dvec2(c * p.x - s * p.y, s * p.x + c * p.y);
  }
  g.along = {c, s}, g.into = {-s, c};
  g.z = house.position.z;
  return g;
}

/// True where the two share an inner point: no side of either separates them.
bool overlap(const Ground& a, const Ground& b) {
  for (const Ground* g : {&a, &b})
    for (const dvec2 axis : {g->along, g->into}) {
      double a0 = 1e300, a1 = -1e300, b0 = 1e300, b1 = -1e300;
      for (size_t i = 0; i < 4; ++i) {
        a0 = std::min(a0, glm::dot(a.corners[i], axis)), a1 = std::max(a1, glm::dot(a.corners[i], axis));
        b0 = std::min(b0, glm::dot(b.corners[i], axis)), b1 = std::max(b1, glm::dot(b.corners[i], axis));
      }
      if (a1 <= b0 + 1e-6 || b1 <= a0 + 1e-6) return false;
    }
  return true;
}

double distanceToLine(dvec2 p, dvec2 a, dvec2 b) {
  const dvec2 ab = b - a;
  const double square = glm::dot(ab, ab);
  const double t = square > 0 ? glm::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : 0;
  return glm::length(p - a - ab * t);
}

/// Houses by the cells of 32 m that they touch.
class HouseMap {
 public:
  explicit HouseMap(const City& city) {
    for (const Instance& i : city.buildings.instances) {
      grounds.push_back(groundOf(city, i));
      dvec2 min(1e300), max(-1e300);
      for (const dvec2 c : grounds.back().corners) min = glm::min(min, c), max = glm::max(max, c);
      for (int y = cell(min.y); y <= cell(max.y); ++y)
        for (int x = cell(min.x); x <= cell(max.x); ++x)
          cells_[{x, y}].push_back(static_cast<uint32_t>(grounds.size() - 1));
    }
  }
  /// Houses that may be within a few metres of p.
  std::set<uint32_t> near(dvec2 p, double margin) const {
    std::set<uint32_t> out;
    for (int y = cell(p.y - margin); y <= cell(p.y + margin); ++y)
      for (int x = cell(p.x - margin); x <= cell(p.x + margin); ++x)
        if (const auto it = cells_.find({x, y}); it != cells_.end()) out.insert(it->second.begin(), it->second.end());
    return out;
  }
  bool covers(dvec2 p, double margin = 0) const {
    for (const uint32_t i : near(p, margin + 1))
      if (grounds[i].contains(p, margin)) return true;
    return false;
  }
  const std::map<std::pair<int, int>, std::vector<uint32_t>>& cells() const { return cells_; }

  std::vector<Ground> grounds;

 private:
  static int cell(double v) { return static_cast<int>(std::floor(v / 32)); }
  std::map<std::pair<int, int>, std::vector<uint32_t>> cells_;
};

const City& norvic() {
  static const City city = generateNorvic({});
  return city;
}
const HouseMap& norvicHouses() {
  static const HouseMap map(norvic());
  return map;
}

uint32_t hashOf(const City& city) {
  uint32_t h = 0;
  const auto mix = [&h](double v) { h = city::hash32(h, static_cast<uint32_t>(static_cast<int64_t>(v * 4096))); };
  for (const auto* set : {&city.buildings, &city.trees})
    for (const Instance& i : set->instances) {
      mix(i.position.x), mix(i.position.y), mix(i.position.z), mix(static_cast<double>(i.heading));
      h = city::hash32(h, i.geometry ^ i.seed);
    }
  for (const float z : city.terrain->heights) mix(static_cast<double>(z));
  for (const city::Ground g : city.groundCover->kinds) h = h * 31 + static_cast<uint32_t>(g);
  for (const auto& n : city.streets->nodes) mix(n.position.x), mix(n.position.z);
  for (const city::Monument& m : city.monuments) mix(m.position.x), mix(m.position.z);
  for (const city::Tour& t : city.tours)
    for (const auto& k : t.keys) mix(k.position.y), mix(k.heading);
  return h;
}

void expectNoOverlap(const City& city, const HouseMap& map) {
  int tested = 0;
  for (const auto& [cell, houses] : map.cells())
    for (size_t i = 0; i < houses.size(); ++i)
      for (size_t j = i + 1; j < houses.size(); ++j, ++tested)
        ASSERT_FALSE(overlap(map.grounds[houses[i]], map.grounds[houses[j]]))
            << city.name << ": houses " << houses[i] << " and " << houses[j] << " overlap at "
            << map.grounds[houses[i]].corners[0].x << ", " << map.grounds[houses[i]].corners[0].y;
  EXPECT_GT(tested, 100);
}

void expectOnGround(const City& city, const HouseMap& map) {
  for (const Ground& g : map.grounds)
    for (size_t i = 0; i < 4; ++i) {
      const double ground = city.terrain->heightAt(g.corners[i].x, g.corners[i].y).value();
      // The front's door is never sunk; the foundation reaches the ground everywhere.
      ASSERT_LE(ground, g.z + (i < 2 ? 0.02 : 1.6)) << (i < 2 ? "a sunk front" : "a buried back");
      ASSERT_GT(ground, g.z - 1.45) << "a gap under a wall";
    }
}

void expectOutOfStreets(const City& city, const HouseMap& map) {
  for (const auto& e : city.streets->edges) {
    const dvec2 a(city.streets->nodes[e.a].position), b(city.streets->nodes[e.b].position);
    const int steps = static_cast<int>(glm::length(b - a)) + 1;
    for (int k = 0; k <= steps; ++k) {
      const dvec2 p = glm::mix(a, b, static_cast<double>(k) / steps);
      for (const uint32_t h : map.near(p, 6)) {
        const Ground& g = map.grounds[h];
        for (size_t i = 0; i < 4; ++i)
          ASSERT_GE(distanceToLine(p, g.corners[i], g.corners[(i + 1) % 4]), 0.5 * static_cast<double>(e.width) - 1e-3)
              << "a house in " << e.name << " at " << p.x << ", " << p.y;
        ASSERT_FALSE(g.contains(p));
      }
    }
  }
}

void expectConnected(const City& city) {
  const city::StreetGraph& graph = *city.streets;
  std::vector<std::vector<uint32_t>> next(graph.nodes.size());
  for (const auto& e : graph.edges) next[e.a].push_back(e.b), next[e.b].push_back(e.a);
  std::vector<bool> seen(graph.nodes.size(), false);
  std::vector<uint32_t> open{0};
  seen[0] = true;
  size_t reached = 0;
  while (!open.empty()) {
    const uint32_t n = open.back();
    open.pop_back(), ++reached;
    for (const uint32_t m : next[n])
      if (!seen[m]) seen[m] = true, open.push_back(m);
  }
  EXPECT_EQ(reached, graph.nodes.size()) << city.name << ": streets that cannot be reached";
}

TEST(Norvic, IsTheTownAsDesigned) {
  const City& city = norvic();
  EXPECT_EQ(city.terrain->size, glm::ivec2(401));
  EXPECT_DOUBLE_EQ(city.terrain->spacing.x, 5.12);
  EXPECT_DOUBLE_EQ(city.terrain->spacing.y, 5.12);
  EXPECT_GE(city.buildings.size(), 2500u);
  EXPECT_LE(city.buildings.size(), 4500u);
  std::map<std::string, int> monuments;
  for (const city::Monument& m : city.monuments) ++monuments[m.name];
  EXPECT_EQ(monuments["castle"], 1);
  EXPECT_EQ(monuments["cathedral"], 1);
  EXPECT_GE(monuments["parish church"], 6);
  EXPECT_GE(monuments["bridge"], 2);
  EXPECT_GE(monuments["gate"], 5);
  EXPECT_GE(monuments["town wall"], 20);
  EXPECT_EQ(monuments["market cross"], 1);
  EXPECT_GE(city.trees.size(), 2000u);
  EXPECT_GE(city.treeTypes.size(), 3u);
  for (const city::MeshGeometry& tree : city.treeTypes) EXPECT_LT(tree.mesh.triangleCount(), 120u) << tree.name;
  for (const char* tour : {"street", "flyover", "turn", "teleport"})
    EXPECT_TRUE(std::any_of(city.tours.begin(), city.tours.end(), [&](const auto& t) { return t.name == tour; }))
        << tour;
}

TEST(Norvic, HousesAreInstancesOfSharedKinds) {
  std::map<uint32_t, int> uses;
  std::set<std::string> kinds;
  for (const Instance& i : norvic().buildings.instances) {
    ++uses[i.geometry];
    const std::string& name = norvic().buildingTypes[i.geometry].name;
    kinds.insert(name.substr(0, name.find('/')));
  }
  EXPECT_GE(kinds.size(), 12u);
  size_t shared = 0;
  for (const auto& [geometry, count] : uses)
    if (count > 1) shared += static_cast<size_t>(count);
  EXPECT_GE(static_cast<double>(shared), 0.9 * static_cast<double>(norvic().buildings.size()));
}

TEST(Norvic, SameSeedSameTownAndAnotherSeedAnother) {
  const uint32_t first = hashOf(norvic());
  EXPECT_EQ(hashOf(generateNorvic({})), first);
  EXPECT_NE(hashOf(generateNorvic({0, 2})), first);
}

TEST(Norvic, NoTwoHousesOverlap) {
  expectNoOverlap(norvic(), norvicHouses());
}
TEST(Norvic, HousesStandOnTheGround) {
  expectOnGround(norvic(), norvicHouses());
}
TEST(Norvic, NoHouseStandsInAStreet) {
  expectOutOfStreets(norvic(), norvicHouses());
}
TEST(Norvic, EveryStreetCanBeReached) {
  expectConnected(norvic());
}

TEST(Norvic, FrontsFaceAStreetNearby) {
  const City& city = norvic();
  for (const Ground& g : norvicHouses().grounds) {
    const dvec2 door = 0.5 * (g.corners[0] + g.corners[1]);
    bool found = false;
    for (const auto& e : city.streets->edges) {
      const dvec2 a(city.streets->nodes[e.a].position), b(city.streets->nodes[e.b].position);
      const double reach = 0.5 * static_cast<double>(e.width) + 3;
      if (distanceToLine(door, a, b) > reach) continue;
      // The street lies before the front, and runs along it.
      const dvec2 along = glm::normalize(b - a);
      found = std::abs(glm::dot(along, g.along)) > 0.9 &&
              distanceToLine(door - g.into * 1.0, a, b) < distanceToLine(door, a, b);
      if (found) break;
    }
    ASSERT_TRUE(found) << "a house at " << door.x << ", " << door.y << " with no street before it";
  }
}

TEST(Norvic, NoHouseStandsInWater) {
  for (const city::WaterBody& water : norvic().water)
    for (size_t t = 0; t < water.indices.size(); t += 3) {
      const dvec2 p[3] = {water.points[water.indices[t]], water.points[water.indices[t + 1]],
                          water.points[water.indices[t + 2]]};
      const double area = (p[1] - p[0]).x * (p[2] - p[0]).y - (p[1] - p[0]).y * (p[2] - p[0]).x;
      ASSERT_GT(area, 0) << "a triangle of water is clockwise";
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; i + j <= 8; ++j)
          ASSERT_FALSE(norvicHouses().covers(p[0] + (p[1] - p[0]) * (i / 8.0) + (p[2] - p[0]) * (j / 8.0)));
    }
}

TEST(Norvic, TheRiverHasABedAndBanks) {
  const City& city = norvic();
  ASSERT_EQ(city.water.size(), 1u);
  const city::WaterBody& river = city.water[0];
  for (size_t i = 0; i + 1 < river.points.size(); i += 2) {
    const dvec2 middle = 0.5 * (river.points[i] + river.points[i + 1]);
    EXPECT_LT(city.terrain->heightAt(middle.x, middle.y).value(), river.level - 1);
    for (const dvec2 edge : {river.points[i], river.points[i + 1]})
      EXPECT_GT(city.terrain->heightAt(edge.x, edge.y).value(), river.level) << "water hangs over its bank";
  }
}

TEST(Norvic, MonumentsAndTreesStandClearOfHouses) {
  const City& city = norvic();
  for (const city::Monument& m : city.monuments) {
    const auto& mesh = city.meshes[m.mesh].mesh;
    const double c = std::cos(static_cast<double>(m.heading)), s = std::sin(static_cast<double>(m.heading));
    const auto place = [&](uint32_t index) {
      const dvec3 p(mesh.vertices[index].position);
      return dvec2(m.position) + dvec2(c * p.x - s * p.y, s * p.x + c * p.y);
    };
    for (size_t t = 0; t < mesh.indices.size(); ++t) {
      const dvec2 a = place(mesh.indices[t]), b = place(mesh.indices[t - t % 3 + (t + 1) % 3]);
      const int steps = static_cast<int>(glm::length(b - a) / 2) + 1;
      for (int k = 0; k < steps; ++k)
        ASSERT_FALSE(norvicHouses().covers(glm::mix(a, b, static_cast<double>(k) / steps)))
            << m.name << " meets a house";
    }
  }
  for (const Instance& tree : city.trees.instances) ASSERT_FALSE(norvicHouses().covers(dvec2(tree.position), 0.5));
}

void expectGoodWalk(const City& city, const HouseMap& map) {
  const auto tour =
      std::find_if(city.tours.begin(), city.tours.end(), [](const auto& t) { return t.name == "street"; });
  ASSERT_NE(tour, city.tours.end()) << city.name;
  for (size_t i = 0; i < tour->keys.size(); ++i) {
    const city::Tour::Key& k = tour->keys[i];
    const double ground = city.terrain->heightAt(k.position.x, k.position.y).value();
    ASSERT_FALSE(map.covers(dvec2(k.position), 0.4)) << city.name << ": key " << i << " is in a house";
    EXPECT_GT(k.position.z, ground + 1.5);
    EXPECT_LT(k.position.z, ground + 8) << "on the ground or on a bridge";
    if (i == 0) continue;
    const city::Tour::Key& before = tour->keys[i - 1];
    ASSERT_GT(k.time, before.time);
    EXPECT_LT(glm::length(k.position - before.position) / (k.time - before.time), 10) << "metres a second";
    EXPECT_LT(std::abs(k.heading - before.heading), 0.5) << "a sudden turn at key " << i;
    EXPECT_LT(std::abs(k.position.z - before.position.z), 0.5) << "a step at key " << i;
  }
}

TEST(Norvic, TheWalkGoesAlongStreetsAndOverABridge) {
  const City& city = norvic();
  expectGoodWalk(city, norvicHouses());
  const city::Tour& walk = city.tours[0];
  EXPECT_GT(walk.keys.back().time, 90);
  EXPECT_LT(walk.keys.back().time, 160);
  bool overWater = false;
  for (const auto& k : walk.keys)
    overWater = overWater || city.terrain->heightAt(k.position.x, k.position.y).value() < city.water[0].level - 1;
  EXPECT_TRUE(overWater);
}

TEST(Norvic, TheFlightKeepsItsHeightAndTheTurnGoesAllRound) {
  const City& city = norvic();
  for (const city::Tour& tour : city.tours) {
    if (tour.name == "flyover")
      for (const auto& k : tour.keys) {
        const double above = k.position.z - city.terrain->heightAt(k.position.x, k.position.y).value();
        EXPECT_GT(above, 90);
        EXPECT_LT(above, 230);
      }
    if (tour.name == "turn") {
      EXPECT_NEAR(tour.keys.back().heading - tour.keys.front().heading, 6.283185, 1e-4);
      EXPECT_FALSE(norvicHouses().covers(dvec2(tour.keys.front().position), 2));
    }
    EXPECT_EQ(tour.jumps, tour.name == "teleport");
  }
}

TEST(Norvic, HasExactlyTheHousesAskedFor) {
  for (const uint32_t houses : {1u, 50u, 700u}) {
    const City city = generateNorvic({houses, 3});
    EXPECT_EQ(city.buildings.size(), houses);
    expectConnected(city);
    if (houses == 50) {
      // A hamlet: at the market.
      city::Aabbf box;
      for (const city::Aabbf& b : city.buildings.bounds) box.extend(b);
      EXPECT_LT(glm::length(box.size()), 400);
    }
    if (houses == 700) expectGoodWalk(city, HouseMap(city));
  }
}

TEST(Norvic, GrowsByQuarters) {
  const City city = generateNorvic({8000, 1});
  EXPECT_EQ(city.buildings.size(), 8000u);
  const HouseMap map(city);
  expectNoOverlap(city, map);
  expectOnGround(city, map);
  expectOutOfStreets(city, map);
  expectConnected(city);
  expectGoodWalk(city, map);
  int markets = 0;
  for (const city::Monument& m : city.monuments) markets += m.name == "market cross";
  EXPECT_GE(markets, 5);
  EXPECT_GT(city.terrain->extent().x, norvic().terrain->extent().x * 1.2);
}

TEST(Norwich2001, HasThePublishedSize) {
  const City city = generateNorwich2001();
  EXPECT_EQ(city.buildings.size(), 800u);
  EXPECT_NEAR(static_cast<double>(fullDetailTriangles(city)), 222912, 0.02 * 222912);
  EXPECT_EQ(city.terrain->size, glm::ivec2(401));
  EXPECT_NEAR(city.terrain->extent().x, 2048, 1e-9);
  EXPECT_EQ(city.terrain->triangleCount(), 320000u);
  const HouseMap map(city);
  expectNoOverlap(city, map);
  expectOnGround(city, map);
  expectOutOfStreets(city, map);
  expectConnected(city);
  expectGoodWalk(city, map);
  EXPECT_EQ(city.grid.size, 16u);
}

}  // namespace
}  // namespace vicus::assets
