/// A town of the size of the published walkthrough: 800 houses placed at random along a few streets, densely in the
/// middle and sparsely towards the edges, on 401 × 401 heights. It has no monuments, so that its building triangles are
/// those of its houses.
///
/// Based on: Willmott et al. 2001, §3.1.4 (800 buildings, 222 912 polygons, sparse and dense areas) and §4.1.1
/// (terrain).
#include <algorithm>
#include <cmath>
#include <span>

#include "assets/norvic/assembly.hpp"
#include "assets/norvic/ground.hpp"
#include "assets/norvic/norvic.hpp"
#include "assets/norvic/palette.hpp"
#include "assets/norvic/tours.hpp"
#include "assets/norvic/trees.hpp"
#include "city/random.hpp"

namespace vicus::assets {
namespace {

using namespace norvic;
using glm::dvec2;

constexpr uint32_t kHouses = 800;
constexpr double kTriangles = 222912;
constexpr double kSide = 2048, kSpacing = 5.12;  // metres
constexpr double kHalf = 0.5 * kSide;

/// Streets from edge to edge, and rings about the middle that join them.
std::vector<std::vector<dvec2>> drawStreets(city::Random& random) {
  std::vector<std::vector<dvec2>> lines;
  constexpr int kAcross = 4;
  for (int turned = 0; turned < 2; ++turned)
    for (int i = 0; i < kAcross; ++i) {
      const double offset = (i - 0.5 * (kAcross - 1)) * 310 + random.uniform(-50, 50);
      std::vector<dvec2> bends;
      for (int k = 0; k <= 8; ++k) {
        const double along = (k / 8.0 - 0.5) * (kSide - 8);
        const double across = offset * (0.75 + 0.25 * std::abs(along) / kHalf) + random.uniform(-38, 38);
        bends.push_back(turned ? dvec2(across, along) : dvec2(along, across));
      }
      lines.push_back(curveThrough(bends, kStreetStep));
    }
  for (const double radius : {170.0, 400.0}) {
    std::vector<dvec2> ring;
    for (int k = 0; k <= 96; ++k) {
      const double angle = 6.283185307179586 * k / 96;
      ring.push_back(radius * (1 + 0.08 * std::sin(3 * angle + radius)) * dvec2(std::cos(angle), std::sin(angle)));
    }
    lines.push_back(ring);
  }
  return lines;
}

/// Sets houses one after another at random places along the streets. Of a few chance kinds each takes the one that
/// keeps the triangles nearest to their due.
void placeHouses(QuarterPlan& plan, const HouseCatalogue& houses, city::Random& random) {
  struct Front {
    dvec2 a, b;
    double halfWidth;
  };
  std::vector<Front> fronts;
  SegmentGrid streets(dvec2(-kHalf), dvec2(kHalf));
  for (const StreetLine& line : plan.streets)
    for (size_t i = 1; i < line.points.size(); ++i) {
      const Front f{line.points[i - 1], line.points[i], 0.5 * line.style.width};
      streets.add({f.a, f.b, f.halfWidth});
      if (glm::length(f.b - f.a) > 12) fronts.push_back(f);
    }
  RectGrid occupied(dvec2(-kHalf), dvec2(kHalf));
  double triangles = 0;
  for (int attempt = 0; attempt < 400000 && plan.plots.size() < kHouses; ++attempt) {
    const Front& front = fronts[random.below(static_cast<uint32_t>(fronts.size()))];
    dvec2 a = front.a, b = front.b;
    if (random.below(2)) std::swap(a, b);
    const double length = glm::length(b - a);
    const dvec2 along = (b - a) / length, into(-along.y, along.x);
    const dvec2 place = glm::mix(a, b, random.uniform());
    const double crowd = std::exp(-glm::dot(place, place) / (420.0 * 420.0)) + 0.10;
    if (random.uniform() > crowd) continue;

    const double due = kTriangles * static_cast<double>(plan.plots.size() + 1) / kHouses;
    double best = 1e18;
    uint32_t chosen = 0;
    for (int k = 0; k < 5; ++k) {
      const uint32_t v = random.below(static_cast<uint32_t>(houses.variants.size()));
      const double off = std::abs(
          triangles + static_cast<double>(houses.geometry[houses.variants[v].geometry].fullDetailTriangles()) - due);
      if (off < best) best = off, chosen = v;
    }
    const HouseVariant& v = houses.variants[chosen];
    const double width = static_cast<double>(v.width), depth = static_cast<double>(v.depth);
    const dvec2 centre = place + into * (front.halfWidth + 0.5 + 0.5 * depth + random.uniform(0, 2));
    const PlanRect ground{centre, along, 0.5 * width, 0.5 * depth};
    PlanRect whole = ground;
    whole.centre -= into * (0.5 * static_cast<double>(v.frontReach));
    whole.halfDepth += 0.5 * static_cast<double>(v.frontReach);
    whole.halfWidth += static_cast<double>(v.sideReach);
    const dvec2 reach = glm::abs(centre);
    if (std::max(reach.x, reach.y) > kHalf - 25) continue;
    if (occupied.anyOverlap(whole, 0.3) || streets.anyTouches(ground)) continue;
    occupied.add(whole);
    Plot plot;
    plot.position = centre;
    plot.heading = static_cast<float>(std::atan2(along.y, along.x));
    plot.variant = chosen;
    plot.seed = random.bits();
    plan.plots.push_back(plot);
    plan.trodden.push_back(troddenAbout(ground));
    plan.gardens.push_back({centre + into * (0.5 * depth + 7), along, 0.5 * width + 1, 7});
    triangles += static_cast<double>(houses.geometry[v.geometry].fullDetailTriangles());
  }
  for (int attempt = 0; attempt < 1600; ++attempt) {
    const dvec2 p(random.uniform(-kHalf + 10, kHalf - 10), random.uniform(-kHalf + 10, kHalf - 10));
    if (occupied.anyContains(p, 3) || streets.anyNear(p, 1.5) || parcelAt(p, 1).toEdge > 12) continue;
    plan.trees.push_back({p, static_cast<uint8_t>(random.below(kTreeKinds)), random.bits()});
  }
}

}  // namespace

city::City generateNorwich2001(uint32_t seed, const Progress& progress) {
  const auto say = [&](std::string_view stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  city::Random random(city::hash32(seed, 2001));
  HouseCatalogue houses = makeHouseCatalogue();
  const Landscape land(kSide, kSpacing, seed, false);

  say("laying out streets", 0);
  QuarterPlan plan;
  plan.names = {"Street"};
  StreetNet net(dvec2(-kHalf), dvec2(kHalf));
  for (const std::vector<dvec2>& line : drawStreets(random)) {
    const std::vector<uint32_t> nodes = net.add(line, {city::StreetKind::Street, 6, 0});
    if (glm::length(line.front() - line.back()) > 100) net.fix(nodes.front()), net.fix(nodes.back());
  }
  net.prune(net.nearest({0, 0}, kHalf));
  plan.streets = net.finish();
  for (const StreetNet::Node& n : net.nodes()) plan.nodes.push_back(n.position);
  placeHouses(plan, houses, random);

  city::City out;
  out.name = "norwich-2001";
  out.materials = paletteMaterials();
  out.treeTypes = makeTrees();
  say("raising the land", 0.2);
  out.terrain = land.heightField();
  out.groundCover = paintGround(land, {&plan, 1}, 1, seed);
  city::CityParts parts;
  for (const Plot& p : plan.plots) parts.buildings.push_back(standHouse(p, houses, *out.terrain));
  for (const TreeSpot& t : plan.trees) parts.trees.push_back(standTree(t, *out.terrain));
  out.buildingTypes = std::move(houses.geometry);
  out.streets = joinStreets({&plan, 1}, land, *out.terrain);
  setSummerAfternoon(out.environment);
  out.environment.hazeDistance = 9000;

  // From the sparse west through the dense middle to the sparse north-east.
  TourStops stops;
  stops.walk = {{-430, -120}, {-160, 0}, {0, 170}, {170, 0}, {300, 150}};
  stops.square = dvec2(out.streets->nodes[0].position);
  stops.radius = 560;
  for (const dvec2 p : {dvec2(0, 0), dvec2(-150, 160), dvec2(160, 170), dvec2(-400, 0), dvec2(390, -90), dvec2(0, 480)})
    stops.sights.push_back({p, 5, 45});
  out.tours = makeTours(out, stops);
  say("sorting into tiles", 0.9);
  city::finishCity(out, std::move(parts));
  say("ready", 1);
  return out;
}

}  // namespace vicus::assets
