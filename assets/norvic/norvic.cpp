/// The town as designed is one walled quarter with a castle and a cathedral. A larger city surrounds it with market
/// towns on a loose triangular lattice, joined by roads; a smaller one is its market and the streets nearest to that.
#include "assets/norvic/norvic.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "assets/norvic/assembly.hpp"
#include "assets/norvic/ground.hpp"
#include "assets/norvic/monuments.hpp"
#include "assets/norvic/palette.hpp"
#include "assets/norvic/tours.hpp"
#include "assets/norvic/trees.hpp"
#include "assets/people/populate.hpp"
#include "assets/people/townspeople.hpp"
#include "city/random.hpp"

namespace vicus::assets {
namespace {

using namespace norvic;
using city::City;
using glm::dvec2;

constexpr double kTau = 6.283185307179586;
constexpr double kTownSide = 2048;      // metres
constexpr double kTownSpacing = 5.12;   // metres between heights
constexpr int kMostSamples = 2049;      // heights to a side
constexpr double kTownRadius = 640;     // metres
constexpr double kTownGround = 745;     // metres: with the ground before its walls
constexpr double kQuarterRadius = 285;  // metres
constexpr double kLattice = 690;        // metres between quarters
constexpr size_t kMostTrees = 200000;
constexpr int kMostCoverTexels = 4096;  // to a side: what a ground texture can hold

/// All that is decided before any quarter is laid out.
struct Layout {
  double side = kTownSide;
  std::vector<QuarterBrief> quarters;  ///< the walled town first
};

double spacingFor(double side) {
  const int samples = std::min(kMostSamples, static_cast<int>(std::lround(side / kTownSpacing)) + 1);
  return side / (samples - 1);
}

/// The town itself, without its roads out.
QuarterBrief townBrief(const Landscape& land, double radius, uint32_t seed) {
  QuarterBrief b;
  b.radius = radius;
  b.weight = kTownGround / kTownRadius * radius;
  b.centre = {0, land.riverAt(0) - std::max(0.44 * radius, land.dryDistance() + 85)};
  b.heading = 0.09;
  b.market = glm::mix(dvec2(44, 28), dvec2(92, 52), std::clamp((radius - 150) / 450, 0.0, 1.0));
  b.seed = city::hash32(seed, 0x70776eU);
  b.fieldSeed = city::hash32(seed, 0xf1e1dU);
  b.walled = radius >= 430;
  b.cathedral = radius >= 520;
  b.castle = radius >= 520;
  b.churches = std::clamp(static_cast<int>(radius / 62), 1, 10);
  b.bridges = radius >= 520 ? 3 : radius >= 300 ? 1 : 0;
  return b;
}

/// Roads from a lone town to the edges of its land.
void addRoadsToEdges(QuarterBrief& b, const Landscape& land, int roads) {
  const double half = 0.5 * land.side() - 2;
  city::Random random(city::hash32(b.seed, 5));
  for (int i = 0; i < roads; ++i) {
    for (int attempt = 0; attempt < 12; ++attempt) {
      const double angle = kTau * (i + 0.25 + random.uniform(-0.3, 0.3)) / roads;
      const dvec2 d(std::cos(angle), std::sin(angle));
      // Where the ray from the market meets the land's edge.
      double t = 1e9;
      for (int k = 0; k < 2; ++k)
        if (std::abs(d[k]) > 1e-9) t = std::min(t, ((d[k] > 0 ? half : -half) - b.centre[k]) / d[k]);
      const dvec2 place = b.centre + d * t;
      const bool sameSide = land.side(place) == land.side(b.centre);
      if (land.riverDistance(place) < land.dryDistance() + 50 || (!sameSide && b.bridges == 0)) continue;
      b.exits.push_back({place, static_cast<uint32_t>(i)});
      break;
    }
  }
}

Layout loneTown(double radius, uint32_t seed) {
  Layout out;
  const Landscape land(out.side, kTownSpacing, seed, true);
  QuarterBrief b = townBrief(land, radius, seed);
  b.min = dvec2(-0.5 * out.side), b.max = dvec2(0.5 * out.side);
  addRoadsToEdges(b, land, radius >= 430 ? 8 : 4);
  out.quarters.push_back(b);
  return out;
}

/// Tracks from the town into its fields, in the directions where no quarter's road leads.
void addTracks(QuarterBrief& b, const Landscape& land, uint32_t key) {
  constexpr int kDirections = 8;
  const std::vector<Exit> roads = b.exits;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = kTau * (i + 0.25) / kDirections;
    const dvec2 d(std::cos(angle), std::sin(angle));
    const bool led = std::any_of(roads.begin(), roads.end(), [&](const Exit& e) {
      return glm::dot(glm::normalize(e.place - b.centre), d) > std::cos(0.62 * kTau / kDirections);
    });
    if (led) continue;
    const dvec2 place = b.centre + d * (b.weight + 30);
    const dvec2 room = glm::min(place - b.min, b.max - place);
    if (std::min(room.x, room.y) < 15 || land.riverDistance(place) < land.dryDistance() + 40) continue;
    b.exits.push_back({place, key++});
  }
}

/// The walled town and `count` market towns about it.
Layout manyQuarters(uint32_t count, uint32_t seed) {
  Layout out;
  const Landscape sketch(kTownSide, kTownSpacing, seed, true);  // its river is everywhere the same
  const QuarterBrief town = townBrief(sketch, kTownRadius, seed);

  // Places on the lattice, the nearest first.
  struct Place {
    dvec2 at;
    double order;
  };
  std::vector<Place> places;
  const double wanted = std::sqrt(static_cast<double>(count) + 10) * kLattice;
  const int reach = static_cast<int>(wanted / kLattice) + 4;
  for (int row = -reach; row <= reach; ++row)
    for (int column = -reach; column <= reach; ++column) {
      city::Random random(city::hash32(city::hash32(static_cast<uint32_t>(row), static_cast<uint32_t>(column)), seed));
      const double jitter = 0.13 * kLattice;
      const dvec2 p = kLattice * dvec2(column + 0.5 * (row & 1), row * 0.8660254) +
                      dvec2(random.uniform(-jitter, jitter), random.uniform(-jitter, jitter));
      if (glm::length(p - town.centre) < kTownGround + kQuarterRadius + 60) continue;
      // Room for a market between the river and the hills.
      if (std::abs(p.y - sketch.riverAt(p.x)) < 250) continue;
      places.push_back({p, std::max(std::abs(p.x), std::abs(p.y))});
    }
  std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.order < b.order; });
  places.resize(std::min<size_t>(places.size(), count));
  double half = 0.5 * kTownSide;
  for (const Place& p : places) half = std::max(half, p.order + 340);
  out.side = 2 * std::ceil(half / 64) * 64;

  out.quarters.push_back(town);
  for (size_t i = 0; i < places.size(); ++i) {
    city::Random random(city::hash32(seed, 100 + static_cast<uint32_t>(i)));
    QuarterBrief b;
    b.centre = places[i].at;
    b.radius = kQuarterRadius * random.uniform(0.9, 1.08);
    b.weight = kQuarterRadius;
    b.heading = random.uniform(0, kTau);
    b.market = dvec2(random.uniform(46, 70), random.uniform(28, 40));
    b.seed = random.bits();
    b.fieldSeed = town.fieldSeed;
    b.churches = random.uniform() < 0.35 ? 2 : 1;
    out.quarters.push_back(b);
  }

  // Neighbours and the roads between them, found through a grid of cells.
  const Landscape land(out.side, spacingFor(out.side), seed, true);
  PlanGrid grid(dvec2(-0.5 * out.side), dvec2(0.5 * out.side), kLattice);
  for (uint32_t i = 0; i < out.quarters.size(); ++i) grid.enter(i, out.quarters[i].centre, out.quarters[i].centre);
  uint32_t key = 0;
  for (uint32_t i = 0; i < out.quarters.size(); ++i) {
    QuarterBrief& a = out.quarters[i];
    const double range = 1.75 * kLattice + (i == 0 ? kTownGround : 0);
    const double ground = i == 0 ? kTownGround + 0.6 * kLattice : 0.85 * kLattice;
    a.min = glm::max(a.centre - ground, dvec2(-0.5 * out.side));
    a.max = glm::min(a.centre + ground, dvec2(0.5 * out.side));
    std::vector<uint32_t> near;
    grid.visit(a.centre - range, a.centre + range, [&](uint32_t j) {
      if (j != i) near.push_back(j);
      return true;
    });
    std::sort(near.begin(), near.end());
    for (const uint32_t j : near) {
      QuarterBrief& b = out.quarters[j];
      const double apart = glm::length(b.centre - a.centre);
      if (apart > range) continue;
      a.neighbours.push_back({b.centre, b.weight});
      if (i == 0) b.neighbours.push_back({a.centre, a.weight});
      if (i > j) continue;
      const double road = i == 0 ? kTownGround + 0.8 * kLattice : 1.3 * kLattice;
      if (apart > road) continue;
      const double fraction = 0.5 * (1 + (a.weight - b.weight) / apart);
      const dvec2 place = glm::mix(a.centre, b.centre, fraction);
      const bool sameSide = land.side(a.centre) == land.side(b.centre);
      if (land.riverDistance(place) < land.dryDistance() + 40) continue;
      // Over the river only from the town, which has bridges, and to its far side.
      if (i != 0 && !sameSide) continue;
      if (land.side(place) != land.side(b.centre)) continue;
      a.exits.push_back({place, key});
      b.exits.push_back({place, key});
      ++key;
    }
  }
  addTracks(out.quarters.front(), land, key);
  return out;
}

Landscape landOf(const Layout& layout, uint32_t seed) {
  Landscape land(layout.side, spacingFor(layout.side), seed, true);
  const QuarterBrief& town = layout.quarters.front();
  land.addLevelGround(town.centre, 0.6 * glm::length(town.market), 60);
  const TownDesign design = designTown(town, land);
  if (town.cathedral) land.addLevelGround(design.close.centre, 92, 70);
  if (town.castle) land.setMound(design.castle, kMoundTop, kMoundFoot, kMoundRise);
  return land;
}

/// Lays out all quarters on all cores. Each depends on its own brief alone, so their order does not matter.
std::vector<QuarterPlan> planAll(const Layout& layout, const Landscape& land, const HouseCatalogue& houses,
                                 const Progress& progress) {
  std::vector<QuarterPlan> plans(layout.quarters.size());
  std::atomic<size_t> next{0}, done{0};
  const auto work = [&] {
    for (size_t i = next++; i < plans.size(); i = next++) {
      plans[i] = planQuarter(layout.quarters[i], land, houses);
      ++done;
    }
  };
  std::vector<std::jthread> workers;
  const size_t helpers = std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()) - 1, plans.size() - 1);
  for (size_t t = 0; t < helpers; ++t) workers.emplace_back(work);
  // This thread works too, and says how far all are.
  for (size_t i = next++; i < plans.size(); i = next++) {
    plans[i] = planQuarter(layout.quarters[i], land, houses);
    ++done;
    if (progress) progress("laying out quarters", static_cast<double>(done) / static_cast<double>(plans.size()));
  }
  workers.clear();
  return plans;
}

size_t capacity(std::span<const QuarterPlan> plans) {
  return std::accumulate(plans.begin(), plans.end(), size_t{0},
                         [](size_t sum, const QuarterPlan& q) { return sum + q.plots.size(); });
}

/// Keeps exactly `houses` plots: all of the town's where that is not too many, and of every other quarter the same
/// share, those nearest to its market.
void keepPlots(std::vector<QuarterPlan>& plans, size_t houses) {
  plans[0].plots.resize(std::min(plans[0].plots.size(), houses));
  const size_t rest = houses - plans[0].plots.size();
  size_t total = capacity(std::span(plans).subspan(1)), given = 0, seen = 0;
  for (size_t i = 1; i < plans.size(); ++i) {
    // Shares are cut so that their sum is exact.
    seen += plans[i].plots.size();
    const auto upTo =
        static_cast<size_t>(static_cast<double>(rest) * static_cast<double>(seen) / static_cast<double>(total) + 0.5);
    const size_t share = std::min(upTo - given, plans[i].plots.size());
    plans[i].plots.resize(share);
    given += share;
  }
}

/// Thins the trees evenly where there are too many.
void thinTrees(std::vector<QuarterPlan>& plans) {
  const size_t total = std::accumulate(plans.begin(), plans.end(), size_t{0},
                                       [](size_t sum, const QuarterPlan& q) { return sum + q.trees.size(); });
  if (total <= kMostTrees) return;
  const double share = static_cast<double>(kMostTrees) / static_cast<double>(total);
  for (QuarterPlan& q : plans)
    std::erase_if(q.trees, [&](const TreeSpot& t) { return city::hash32(t.seed, 1) > share * 0.99 * 4294967295.0; });
}

TourStops stopsOf(const QuarterBrief& brief, const QuarterPlan& town, const Landscape& land) {
  TourStops stops;
  stops.centre = brief.centre;
  stops.radius = std::max(260.0, brief.radius);
  stops.square = brief.centre + town.market.axis * (0.28 * town.market.halfWidth) -
                 town.market.across() * (0.35 * town.market.halfDepth);
  stops.sights.push_back({brief.centre, 4, 0.8 * town.market.halfWidth});
  const auto corners = town.market.corners();
  // In by the western gate, along the market, past castle and cathedral, over the river.
  const dvec2 west = brief.centre - dvec2(0.36 * brief.radius, 0.0);
  stops.walk = {west, corners[0], corners[1]};
  const Spot* bridge = nullptr;
  for (const Spot& s : town.spots) {
    if (s.kind == SpotKind::Castle) {
      stops.sights.push_back({s.position, 22, kMoundFoot + 45});
    }
    if (s.kind == SpotKind::Cathedral) {
      const dvec2 axis(std::cos(s.heading), std::sin(s.heading));
      stops.sights.push_back({s.position, 26, 105});
      stops.walk.push_back(s.position - axis * 79.0);
    }
    if (s.kind == SpotKind::Church) stops.sights.push_back({s.position, 8, 28});
    if (s.kind == SpotKind::Bridge) {
      stops.sights.push_back({s.position, 2, 60});
      const dvec2 end = stops.walk.back();
      if (!bridge || glm::length(s.position - end) < glm::length(bridge->position - end)) bridge = &s;
    }
  }
  for (const Gate& g : town.gates) stops.sights.push_back({g.position, 5, 35});
  if (bridge) {
    const dvec2 across(std::cos(bridge->heading), std::sin(bridge->heading));
    const double side = land.side(brief.centre);
    stops.walk.push_back(bridge->position + across * (side * bridgeHalfLength(land)));
    stops.walk.push_back(bridge->position - across * (side * (bridgeHalfLength(land) + 60)));
  } else if (town.exitNodes.size() > 1) {
    stops.walk.push_back(glm::mix(brief.centre, town.nodes[town.exitNodes.front().second], 0.4));
  }
  return stops;
}

/// Some hundred people in the streets of the town as designed.
uint32_t peopleFor(size_t houses) {
  return static_cast<uint32_t>(std::clamp<size_t>(houses / 6, 12, 1000));
}

City assemble(const Layout& layout, const Landscape& land, HouseCatalogue houses, std::vector<QuarterPlan> plans,
              const Progress& progress) {
  const auto say = [&](std::string_view stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  thinTrees(plans);
  City out;
  out.name = "norvic";
  out.materials = paletteMaterials();
  out.treeTypes = makeTrees();
  say("raising the land", 0);
  out.terrain = land.heightField();
  out.water.push_back(land.water());
  say("painting the ground", 0);
  const double texel = std::max(1.0, land.side() / kMostCoverTexels);
  out.groundCover = paintGround(land, plans, texel, layout.quarters.front().fieldSeed);
  say("setting houses on the ground", 0);
  city::CityParts parts;
  parts.buildings.reserve(capacity(plans));
  for (const QuarterPlan& q : plans) {
    for (const Plot& p : q.plots) parts.buildings.push_back(standHouse(p, houses, *out.terrain));
    for (const TreeSpot& t : q.trees) parts.trees.push_back(standTree(t, *out.terrain));
  }
  out.buildingTypes = std::move(houses.geometry);
  out.streets = joinStreets(plans, land, *out.terrain);
  addMonuments(out, land, plans);
  setSummerAfternoon(out.environment);
  out.environment.hazeDistance = 9000;
  out.tours = makeTours(out, stopsOf(layout.quarters.front(), plans.front(), land));
  say("sorting into tiles", 0);
  city::finishCity(out, std::move(parts));
  say("people", 0);
  city::Diagnostics nothingToSay;  // it has streets and a market
  people::populate(out,
                   {peopleFor(out.buildings.size()), layout.quarters.front().seed,
                    people::makeTownspeople(people::Period::Medieval)},
                   out.name, nothingToSay);
  say("ready", 1);
  return out;
}

}  // namespace

City generateNorvic(const NorvicOptions& options, const Progress& progress) {
  HouseCatalogue houses = makeHouseCatalogue();
  const size_t wanted = std::min(options.houses, 1000000u);

  // As designed, or the smallest town that has room.
  double radius = wanted == 0
                      ? kTownRadius
                      : std::clamp(kTownRadius * std::sqrt(static_cast<double>(wanted) / 2200), 150.0, kTownRadius);
  for (; radius <= kTownRadius;
       radius = radius < kTownRadius ? std::min(kTownRadius, radius * 1.12) : 2 * kTownRadius) {
    const Layout layout = loneTown(radius, options.seed);
    const Landscape land = landOf(layout, options.seed);
    std::vector<QuarterPlan> plans = planAll(layout, land, houses, progress);
    if (capacity(plans) < wanted) continue;
    if (wanted > 0) keepPlots(plans, wanted);
    return assemble(layout, land, std::move(houses), std::move(plans), progress);
  }
  // Too many for one town: quarters about it, a few more each time they do not suffice.
  constexpr double kHousesOfTown = 3500, kHousesOfQuarter = 620;
  double count = std::max(5.0, std::ceil((static_cast<double>(wanted) - kHousesOfTown) / kHousesOfQuarter));
  for (;; count = std::ceil(count * 1.15)) {
    const Layout layout = manyQuarters(static_cast<uint32_t>(count), options.seed);
    const Landscape land = landOf(layout, options.seed);
    std::vector<QuarterPlan> plans = planAll(layout, land, houses, progress);
    if (capacity(plans) < wanted) continue;
    keepPlots(plans, wanted);
    return assemble(layout, land, std::move(houses), std::move(plans), progress);
  }
}

}  // namespace vicus::assets
