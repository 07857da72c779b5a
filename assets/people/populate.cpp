#include "assets/people/populate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "avatars/routes.hpp"
#include "city/random.hpp"
#include "walking/surroundings.hpp"

namespace vicus::assets::people {
namespace {

using glm::dvec2;

constexpr double kReach = 2.5;      // metres about a point in which walls are looked for
constexpr double kTrunk = 0.4;      // metres about the middle of a tree
constexpr double kSmallThing = 12;  // metres: monuments up to this size are walked round, larger ones (walls, bridges)
                                    // are where the streets know their way
constexpr double kMarket = 260;     // metres about the densest place in which groups stand
constexpr double kGridHalf = 200, kGridCell = 2;  // metres: what is looked over where there are no streets

avatars::Ground groundOf(const city::City& city) {
  std::vector<city::Aabbf> things;
  for (const city::Monument& m : city.monuments)
    if (!m.bounds.empty() && std::max(m.bounds.size().x, m.bounds.size().y) < static_cast<float>(kSmallThing))
      things.push_back(m.bounds);
  avatars::Ground ground;
  ground.clearance = [&city, things](dvec2 p) {
    double nearest = walking::clearance(city, p, kReach);
    for (const uint32_t t : walking::instancesWithin(city.trees, p, kReach))
      nearest = std::min(nearest, glm::distance(dvec2(city.trees.instances[t].position), p) - kTrunk);
    for (const city::Aabbf& box : things) {
      const dvec2 out = glm::max(glm::max(dvec2(box.min) - p, p - dvec2(box.max)), dvec2(0));
      nearest = std::min(nearest, glm::length(out));
    }
    return nearest;
  };
  double highestWater = -1e300;
  for (const city::WaterBody& w : city.water) highestWater = std::max(highestWater, w.level);
  ground.height = [&city, highestWater](dvec2 p) -> std::optional<double> {
    if (city.terrain && !city.terrain->empty() && !city.terrain->heightAt(p.x, p.y)) return std::nullopt;
    const double dry = walking::dryGroundAt(city, p);
    if (dry < highestWater && walking::groundAt(city, p) > dry + 0.05) return std::nullopt;
    return dry;
  };
  return ground;
}

/// Places where people may stand together: paved ground, else beside the streets.
std::vector<dvec2> candidatesOf(const city::City& city, dvec2 centre) {
  std::vector<dvec2> out;
  if (city.groundCover && city.groundCover->size.x > 0) {
    const city::GroundCover& cover = *city.groundCover;
    const glm::ivec2 from(glm::clamp((centre - kMarket - cover.origin) / cover.spacing, dvec2(0), dvec2(cover.size)));
    const glm::ivec2 to(glm::clamp((centre + kMarket - cover.origin) / cover.spacing, dvec2(0), dvec2(cover.size)));
    const int stride = std::max(1, static_cast<int>(2 / cover.spacing));
    for (int y = from.y; y < to.y; y += stride)
      for (int x = from.x; x < to.x; x += stride)
        if (cover.kinds[static_cast<size_t>(y) * static_cast<size_t>(cover.size.x) + static_cast<size_t>(x)] ==
            city::Ground::Paving)
          out.push_back(cover.origin + cover.spacing * (dvec2(x, y) + 0.5));
  }
  if (out.size() > 50 || !city.streets) return out;
  for (uint32_t n = 0; n < city.streets->nodes.size(); ++n) {
    const dvec2 node(city.streets->nodes[n].position);
    if (glm::distance(node, centre) > kMarket) continue;
    city::Random random(city::hash32(n, 99));
    for (int k = 0; k < 2; ++k) out.push_back(node + dvec2(random.uniform(-5, 5), random.uniform(-5, 5)));
  }
  return out;
}

}  // namespace

void populate(city::City& city, Population population, const std::string& file, city::Diagnostics& diagnostics) {
  city::People& people = city.people;
  people.characters = std::move(population.characters);
  people.count = population.count, people.seed = population.seed;
  if (people.count == 0 || people.characters.empty()) {
    people = {};
    return;
  }
  const avatars::Ground ground = groundOf(city);
  avatars::RouteOptions options;
  options.count = std::clamp<size_t>(people.count / 5, 12, 90);
  options.centre = walking::densestPoint(city);
  options.seed = population.seed;
  const bool streets = city.streets && !city.streets->edges.empty();
  const city::StreetGraph graph =
      streets ? *city.streets : avatars::walkableGrid(ground, options.centre, kGridHalf, kGridCell);
  people.routes = avatars::makeRoutes(graph, ground, options);
  if (!streets)
    diagnostics.warn(file, "avatars",
                     people.routes.empty() ? "there are no streets, and nowhere that one can walk: nobody walks"
                                           : "there are no streets: people walk where the buildings leave room");
  people.places = avatars::makeGroups(candidatesOf(city, options.centre), people.routes, ground,
                                      std::max<size_t>(people.count / 3, 6), population.seed);
  if (people.empty()) {
    diagnostics.warn(file, "avatars", "there is nowhere for people to be: the city has none");
    people = {};
  }
}

}  // namespace vicus::assets::people
