#include "viewer/tours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>

#include "viewer/distance_map.hpp"
#include "walking/surroundings.hpp"

namespace vicus::viewer {
namespace {

using city::City;
using city::Tour;
using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWalkingSpeed = 1.8;  ///< m/s: a brisk visitor
/// Seeds of what is left to chance in the tours, so that they never change with anything else.
constexpr uint32_t kTeleportSeed = 2001;

/// The angle nearest to `reference` that is the same direction as `angle`.
double nearestTurn(double angle, double reference) {
  return reference + std::remainder(angle - reference, 2 * pi);
}

// ---- Sampling ----

/// Value and slopes of a cubic Hermite piece at s in 0 … 1; slopes are for each unit of s.
template <typename T>
T hermite(const T& a, const T& slopeA, const T& b, const T& slopeB, double s) {
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a + (s3 - 2 * s2 + s) * slopeA + (3 * s2 - 2 * s3) * b + (s3 - s2) * slopeB;
}

/// Slope at the middle one of three points: the parabola's through them, each side weighted by the other's duration.
template <typename T>
T slopeThrough(const T& before, double dtBefore, const T& at, const T& after, double dtAfter) {
  return ((at - before) * (dtAfter / dtBefore) + (after - at) * (dtBefore / dtAfter)) / (dtBefore + dtAfter);
}

/// Interpolates one field of the keys on the piece from key i to i + 1; `field(k)` gives it near its neighbours'.
template <typename Field>
auto onPiece(const Tour& tour, size_t i, double s, const Field& field) {
  const auto time = [&](size_t k) { return tour.keys[k].time; };
  const double dt = time(i + 1) - time(i);
  const auto a = field(i), b = field(i + 1);
  // At the ends, and beside a jump in the times, the piece goes straight.
  auto slopeA = (b - a) / dt, slopeB = slopeA;
  if (i > 0 && time(i) > time(i - 1)) slopeA = slopeThrough(field(i - 1), time(i) - time(i - 1), a, b, dt);
  if (i + 2 < tour.keys.size() && time(i + 2) > time(i + 1))
    slopeB = slopeThrough(a, dt, b, field(i + 2), time(i + 2) - time(i + 1));
  return hermite(a, slopeA * dt, b, slopeB * dt, s);
}

// ---- Ways on the ground ----

/// A point of a way. On a bridge the deck counts, elsewhere the ground.
struct WayPoint {
  glm::dvec2 at{0};
  double deck = -kInfinity;  ///< metres above the city's origin; −infinity where there is none
};

double lengthOf(const std::vector<WayPoint>& way) {
  double length = 0;
  for (size_t i = 1; i < way.size(); ++i) length += glm::distance(way[i - 1].at, way[i].at);
  return length;
}

/// Points at equal distances of about `spacing` metres along the way, its ends included.
std::vector<WayPoint> resample(const std::vector<WayPoint>& way, double spacing) {
  const double length = lengthOf(way);
  if (way.size() < 2 || !(length > 0)) return way;
  const auto pieces = static_cast<size_t>(std::max(1.0, std::round(length / spacing)));
  std::vector<WayPoint> out{way.front()};
  double passed = 0;
  size_t corner = 1;
  for (size_t k = 1; k < pieces; ++k) {
    const double target = length * static_cast<double>(k) / static_cast<double>(pieces);
    double piece = glm::distance(way[corner - 1].at, way[corner].at);
    while (corner + 1 < way.size() && passed + piece < target) {
      passed += piece;
      ++corner;
      piece = glm::distance(way[corner - 1].at, way[corner].at);
    }
    const double t = piece > 0 ? std::clamp((target - passed) / piece, 0.0, 1.0) : 0;
    const WayPoint &a = way[corner - 1], &b = way[corner];
    WayPoint p;
    p.at = glm::mix(a.at, b.at, t);
    if (std::isfinite(a.deck) && std::isfinite(b.deck)) p.deck = glm::mix(a.deck, b.deck, t);
    out.push_back(p);
  }
  out.push_back(way.back());
  return out;
}

/// Draws the way tight like a thread, a little at a time, without ever bringing a point nearer than `keepClear` metres
/// to a wall (or nearer than it is, where it starts nearer). Corners become round.
void relax(const City& city, std::vector<WayPoint>& way, int rounds, double keepClear) {
  std::vector<double> room(way.size());
  for (size_t i = 0; i < way.size(); ++i) room[i] = walking::clearance(city, way[i].at, keepClear);
  for (int round = 0; round < rounds; ++round)
    for (size_t i = 1; i + 1 < way.size(); ++i) {
      const glm::dvec2 tight = 0.5 * way[i].at + 0.25 * (way[i - 1].at + way[i + 1].at);
      const double there = walking::clearance(city, tight, keepClear);
      if (there < room[i]) continue;
      way[i].at = tight, room[i] = there;
    }
}

/// A walk along the way: eye height above ground or deck, looking where the way leads.
std::vector<Tour::Key> walkAlong(const City& city, std::vector<WayPoint> way) {
  constexpr double kSpacing = 1.5;    // metres between keys: the spline between two strays by millimetres
  constexpr double kKeepClear = 1.2;  // metres from walls: arm's length
  constexpr double kLookAhead = 9;    // metres: about where a walker looks
  constexpr int kRelaxing = 30;       // rounds: corners of some 4 m radius
  constexpr double kTurnRadius = 3;   // metres of way over which headings are averaged
  way = resample(way, kSpacing);
  relax(city, way, kRelaxing, kKeepClear);
  way = resample(way, kSpacing);
  if (way.size() < 2) return {};

  const double spacing = lengthOf(way) / static_cast<double>(way.size() - 1);
  std::vector<Tour::Key> keys(way.size());
  for (size_t i = 0; i < way.size(); ++i) {
    keys[i].time = static_cast<double>(i) * spacing / kWalkingSpeed;
    keys[i].position =
        glm::dvec3(way[i].at, std::max(walking::groundAt(city, way[i].at), way[i].deck) + walking::kEyeHeight);
  }

  // Look at the point ahead; near the end keep looking the same way.
  const auto ahead = static_cast<size_t>(std::max(1.0, kLookAhead / spacing));
  std::vector<double> headings(way.size(), 0), pitches(way.size(), 0);
  for (size_t i = 0; i < way.size(); ++i) {
    const size_t from = i + ahead < way.size() ? i : (way.size() > ahead ? way.size() - 1 - ahead : 0);
    const glm::dvec3 to = keys[std::min(from + ahead, way.size() - 1)].position - keys[from].position;
    const double distance = glm::length(glm::dvec2(to));
    headings[i] = distance > 0 ? std::atan2(to.y, to.x) : 0;
    // Half of the slope: looking up a hill without losing the street.
    pitches[i] = distance > 0 ? 0.5 * std::atan(to.z / distance) : 0;
    if (i > 0) headings[i] = nearestTurn(headings[i], headings[i - 1]);
  }
  const auto radius = static_cast<size_t>(std::max(1.0, kTurnRadius / spacing));
  for (size_t i = 0; i < way.size(); ++i) {
    const size_t first = i > radius ? i - radius : 0, last = std::min(i + radius, way.size() - 1);
    double heading = 0, pitch = 0;
    for (size_t k = first; k <= last; ++k) heading += headings[k], pitch += pitches[k];
    keys[i].heading = heading / static_cast<double>(last - first + 1);
    keys[i].pitch = pitch / static_cast<double>(last - first + 1);
  }
  // A way mostly ends at a wall or in the open: stop where the last of it still lies ahead.
  if (keys.size() > 4 * ahead) keys.resize(keys.size() - ahead);
  return keys;
}

// ---- Streets ----

double pricePerMetre(city::StreetKind kind) {
  // A visitor prefers the streets that a town shows first.
  switch (kind) {
    case city::StreetKind::HighStreet:
      return 0.7;
    case city::StreetKind::Street:
      return 1;
    case city::StreetKind::Bridge:
      return 0.8;
    case city::StreetKind::Lane:
      return 1.1;
    case city::StreetKind::Road:
      return 1.5;
  }
  return 1;
}

/// Streets about the middle of a town as one walks them: for each node its usable edges.
struct StreetMap {
  const city::StreetGraph& graph;
  std::vector<std::vector<uint32_t>> edgesOf;

  StreetMap(const City& city, const city::StreetGraph& streets, glm::dvec2 middle, double reach)
      : graph(streets), edgesOf(streets.nodes.size()) {
    for (uint32_t e = 0; e < graph.edges.size(); ++e) {
      const auto& edge = graph.edges[e];
      if (edge.a >= graph.nodes.size() || edge.b >= graph.nodes.size() || edge.a == edge.b) continue;
      // Not only far ones: a place that is not finite is none, either.
      if (!(glm::distance(place(edge.a), middle) < reach && glm::distance(place(edge.b), middle) < reach)) continue;
      if (!open(city, edge)) continue;
      edgesOf[edge.a].push_back(e);
      edgesOf[edge.b].push_back(e);
    }
  }

  glm::dvec2 place(uint32_t node) const { return glm::dvec2(graph.nodes[node].position); }
  uint32_t otherEnd(uint32_t edge, uint32_t node) const {
    return graph.edges[edge].a == node ? graph.edges[edge].b : graph.edges[edge].a;
  }

 private:
  /// No building stands in it: a metre-wide way is free along its middle.
  bool open(const City& city, const city::StreetGraph::Edge& edge) const {
    const glm::dvec2 a = place(edge.a), b = place(edge.b);
    const double length = glm::distance(a, b);
    const int steps = 1 + static_cast<int>(length);
    for (int s = 0; s <= steps; ++s)
      if (walking::clearance(city, glm::mix(a, b, static_cast<double>(s) / steps), 1) < 0.5) return false;
    return true;
  }
};

struct StreetWays {
  std::vector<double> cost;        ///< of the cheapest way; infinity where not reached
  std::vector<uint32_t> edgeBack;  ///< towards the start
};

StreetWays cheapestFrom(const StreetMap& map, uint32_t start, double reach) {
  StreetWays out;
  out.cost.assign(map.edgesOf.size(), kInfinity);
  out.edgeBack.assign(map.edgesOf.size(), city::kNone);
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  out.cost[start] = 0;
  open.emplace(0, start);
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (cost > out.cost[node]) continue;
    for (const uint32_t e : map.edgesOf[node]) {
      const uint32_t next = map.otherEnd(e, node);
      const double reached =
          cost + glm::distance(map.place(node), map.place(next)) * pricePerMetre(map.graph.edges[e].kind);
      if (reached >= out.cost[next] || reached > reach) continue;
      out.cost[next] = reached, out.edgeBack[next] = e;
      open.emplace(reached, next);
    }
  }
  return out;
}

/// The reached node that lies farthest, as the crow flies, from a place.
uint32_t farthestNode(const StreetMap& map, const StreetWays& ways, glm::dvec2 from) {
  uint32_t best = 0;
  double distance = -1;
  for (uint32_t n = 0; n < ways.cost.size(); ++n)
    if (std::isfinite(ways.cost[n]) && glm::distance(map.place(n), from) > distance)
      distance = glm::distance(map.place(n), from), best = n;
  return best;
}

/// Nodes from `to` back to the start of `ways`, with the edges between them.
void follow(const StreetMap& map, const StreetWays& ways, uint32_t to, std::vector<uint32_t>& nodes,
            std::vector<uint32_t>& edges) {
  nodes.push_back(to);
  while (ways.edgeBack[to] != city::kNone) {
    edges.push_back(ways.edgeBack[to]);
    to = map.otherEnd(edges.back(), to);
    nodes.push_back(to);
  }
}

/// From one end of the town's middle through the middle to the other end.
std::vector<WayPoint> streetWay(const City& city, const city::StreetGraph& streets) {
  constexpr double kReach = 420;  // metres (priced) from the middle to either end: some ten minutes in all
  constexpr size_t kCandidates = 40;
  const glm::dvec2 middle = walking::densestPoint(city);
  const StreetMap map(city, streets, middle, 2 * kReach);
  // The crossing nearest to the middle from which one gets somewhere.
  std::vector<uint32_t> candidates;
  for (uint32_t n = 0; n < map.edgesOf.size(); ++n)
    if (!map.edgesOf[n].empty()) candidates.push_back(n);
  std::stable_sort(candidates.begin(), candidates.end(), [&](uint32_t a, uint32_t b) {
    return glm::distance(map.place(a), middle) < glm::distance(map.place(b), middle);
  });
  if (candidates.empty()) return {};
  if (candidates.size() > kCandidates) candidates.resize(kCandidates);
  const auto leadsFar = [&](uint32_t n) {
    const StreetWays ways = cheapestFrom(map, n, kReach);
    return glm::distance(map.place(farthestNode(map, ways, map.place(n))), map.place(n)) > 0.4 * kReach;
  };
  const auto found = std::find_if(candidates.begin(), candidates.end(), leadsFar);
  const uint32_t centre = found == candidates.end() ? candidates.front() : *found;

  const StreetWays ways = cheapestFrom(map, centre, kReach);
  const uint32_t from = farthestNode(map, ways, map.place(centre));
  const uint32_t to = farthestNode(map, ways, map.place(from));
  std::vector<uint32_t> nodes, edges, onwardNodes, onwardEdges;
  follow(map, ways, from, nodes, edges);
  follow(map, ways, to, onwardNodes, onwardEdges);
  // Where both ways leave the centre by the same streets, the walk turns off where they part and never turns back.
  while (!edges.empty() && !onwardEdges.empty() && edges.back() == onwardEdges.back()) {
    edges.pop_back(), onwardEdges.pop_back();
    nodes.pop_back(), onwardNodes.pop_back();
  }
  nodes.insert(nodes.end(), std::next(onwardNodes.rbegin()), onwardNodes.rend());
  edges.insert(edges.end(), onwardEdges.rbegin(), onwardEdges.rend());

  std::vector<WayPoint> way;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const bool bridge = (i > 0 && streets.edges[edges[i - 1]].kind == city::StreetKind::Bridge) ||
                        (i < edges.size() && streets.edges[edges[i]].kind == city::StreetKind::Bridge);
    way.push_back({map.place(nodes[i]), bridge ? streets.nodes[nodes[i]].position.z : -kInfinity});
  }
  return way;
}

/// Where there are no streets: along the middles of what lies between the houses.
std::vector<WayPoint> ridgeStreet(const City& city) {
  constexpr double kHalfWindow = 300;  // metres: a quarter of an hour's walk across
  constexpr double kMargin = 30;       // metres about the outermost houses
  constexpr double kCell = 1;          // metres
  constexpr double kKeepClear = 1.5;   // metres on the map, whose walls are up to 0.7 m off: half a narrow lane
  if (city.buildings.empty()) return {};
  const glm::dvec2 middle = walking::densestPoint(city);
  // Small scenes get a window that fits them, so that the walk stays among what there is.
  const city::Aabbf& all = city.buildings.nodes[0].bounds;
  const glm::dvec2 min(glm::vec2(all.min)), max(glm::vec2(all.max));
  const glm::dvec2 from = glm::max(middle - kHalfWindow, min - kMargin),
                   to = glm::min(middle + kHalfWindow, max + kMargin);
  const double halfSide = 0.5 * std::max(to.x - from.x, to.y - from.y);
  const DistanceMap map = distanceToFootprints(city, 0.5 * (from + to), halfSide, kCell);
  std::vector<WayPoint> way;
  for (const glm::dvec2& p : ridgeWay(map, kKeepClear)) way.push_back({p, -kInfinity});
  return way;
}

/// A straight walk of 60 m for scenes with no building and no street, through the middle of what there is.
std::vector<WayPoint> openWay(const City& city) {
  const glm::dvec2 middle = walking::densestPoint(city);
  return {{middle - glm::dvec2(30, 0), -kInfinity}, {middle + glm::dvec2(30, 0), -kInfinity}};
}

Tour makeStreet(const City& city) {
  Tour tour;
  tour.name = "street";
  constexpr double kShortest = 20;  // metres: less is not a walk
  std::vector<WayPoint> way;
  if (city.streets) way = streetWay(city, *city.streets);
  if (lengthOf(way) < kShortest) way = ridgeStreet(city);
  if (lengthOf(way) < kShortest) way = openWay(city);
  tour.keys = walkAlong(city, std::move(way));
  return tour;
}

// ---- From the air, on the spot, anywhere ----

/// Pitch that looks from `eye` at a point.
double pitchTo(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 to = target - eye;
  return std::atan2(to.z, glm::length(glm::dvec2(to)));
}

Tour makeFlyover(const City& city) {
  constexpr double kLargestRadius = 800, kSmallestRadius = 60;  // metres
  constexpr int kKeys = 64;
  constexpr double kSeconds = 90;
  Tour tour;
  tour.name = "flyover";
  const glm::dvec2 middle = walking::densestPoint(city);
  const glm::dvec3 size = city.extent.empty() ? glm::dvec3(0) : city.extent.size();
  const double radius = std::clamp(0.55 * std::max(size.x, size.y), kSmallestRadius, kLargestRadius);
  const double lowest = 0.03 * radius + 15, highest = 0.18 * radius + 10;

  // A loop of one and a half turns: in from the south-west, over the middle, round it and out high to the north.
  std::vector<glm::dvec2> plan;
  std::vector<double> above;
  for (int k = 0; k < kKeys; ++k) {
    const double t = static_cast<double>(k) / (kKeys - 1);
    const double angle = -0.75 * pi + 2.6 * pi * t * t * (3 - 2 * t);
    const double out = radius * (0.22 + 0.78 * std::abs(std::cos(pi * t)));
    plan.push_back(middle + out * glm::dvec2(std::cos(angle), std::sin(angle)));
    above.push_back(glm::mix(lowest, highest, std::cos(pi * t) * std::cos(pi * t)));
  }
  // Heights over what lies below, then raised so that no stretch climbs or falls more steeply than a glider would: the
  // flight rises before what it must clear.
  constexpr double kSteepest = 0.6;  // metres of height for each metre of way
  const double look = std::max(0.08 * radius, 15.0);
  std::vector<double> height(plan.size());
  for (size_t k = 0; k < plan.size(); ++k) height[k] = walking::highestWithin(city, plan[k], look) + above[k];
  for (size_t k = 1; k < plan.size(); ++k)
    height[k] = std::max(height[k], height[k - 1] - kSteepest * glm::distance(plan[k], plan[k - 1]));
  for (size_t k = plan.size() - 1; k > 0; --k)
    height[k - 1] = std::max(height[k - 1], height[k] - kSteepest * glm::distance(plan[k], plan[k - 1]));
  for (size_t k = 0; k < plan.size(); ++k) {
    Tour::Key key;
    key.time = kSeconds * static_cast<double>(k) / (kKeys - 1);
    key.position = glm::dvec3(plan[k], height[k]);
    tour.keys.push_back(key);
  }
  const glm::dvec3 target(middle, walking::groundAt(city, middle));
  double last = 0;
  for (Tour::Key& key : tour.keys) {
    const glm::dvec3 to = target - key.position;
    last = nearestTurn(std::atan2(to.y, to.x), last);
    key.heading = last;
    key.pitch = std::max(pitchTo(key.position, target), -1.2);
  }
  return tour;
}

Tour makeTurn(const City& city, const Tour& street) {
  constexpr int kKeys = 25;  // every 15 degrees
  constexpr double kSeconds = 24;
  Tour tour;
  tour.name = "turn";
  // Where the walk has the most room within ten metres: a market place or a crossing rather than a lane.
  glm::dvec3 place(walking::densestPoint(city), 0);
  place.z = walking::groundAt(city, glm::dvec2(place)) + walking::kEyeHeight;
  double room = -1;
  for (size_t k = 0; k < street.keys.size(); k += 4) {
    const double there = walking::clearance(city, glm::dvec2(street.keys[k].position), 10);
    if (there > room) room = there, place = street.keys[k].position;
  }
  for (int k = 0; k < kKeys; ++k) {
    const double t = static_cast<double>(k) / (kKeys - 1);
    tour.keys.push_back({kSeconds * t, place, 2 * pi * t, 0});
  }
  return tour;
}

/// A place outdoors to stand: on a street where there are streets, else near a building; nothing after 40 tries.
std::optional<WayPoint> placeOutdoors(const City& city, city::Random& random) {
  constexpr int kTries = 40;
  constexpr double kRoom = 0.8;  // metres
  const bool streets = city.streets && !city.streets->edges.empty();
  for (int attempt = 0; attempt < kTries; ++attempt) {
    WayPoint place;
    if (streets) {
      const city::StreetGraph& graph = *city.streets;
      const auto& edge = graph.edges[random.below(static_cast<uint32_t>(graph.edges.size()))];
      if (edge.a >= graph.nodes.size() || edge.b >= graph.nodes.size()) continue;
      const glm::dvec3 at = glm::mix(graph.nodes[edge.a].position, graph.nodes[edge.b].position, random.uniform());
      place.at = glm::dvec2(at);
      if (edge.kind == city::StreetKind::Bridge) place.deck = at.z;
    } else if (!city.buildings.empty()) {
      const uint32_t i = random.below(static_cast<uint32_t>(city.buildings.size()));
      const city::Aabbf& box = city.buildings.bounds[i];
      const double reach = 0.5 * glm::length(glm::dvec2(glm::vec2(box.max - box.min))) + random.uniform(1, 12);
      const double direction = random.uniform(0, 2 * pi);
      place.at = glm::dvec2(glm::vec2(box.centre())) + reach * glm::dvec2(std::cos(direction), std::sin(direction));
    } else {
      return std::nullopt;
    }
    if (walking::clearance(city, place.at, kRoom) >= kRoom) return place;
  }
  return std::nullopt;
}

city::ViewPose standAt(const City& city, const WayPoint& place, city::Random& random) {
  city::ViewPose pose;
  pose.eye = glm::dvec3(place.at, std::max(walking::groundAt(city, place.at), place.deck) + walking::kEyeHeight);
  pose.heading = random.uniform(-pi, pi);
  pose.pitch = random.uniform(-0.1, 0.2);
  return pose;
}

/// Above a place of the town, looking down at something between steeply and nearly level.
city::ViewPose hoverOver(const City& city, city::Random& random) {
  glm::dvec2 at = walking::densestPoint(city);
  if (!city.buildings.empty())
    at = glm::dvec2(city.buildings.instances[random.below(static_cast<uint32_t>(city.buildings.size()))].position);
  at += glm::dvec2(random.uniform(-60, 60), random.uniform(-60, 60));
  city::ViewPose pose;
  pose.eye = glm::dvec3(at, walking::highestWithin(city, at, 20) + random.uniform(10, 200));
  pose.heading = random.uniform(-pi, pi);
  pose.pitch = -random.uniform(0.1, 1.1);
  return pose;
}

city::ViewPose standSomewhere(const City& city, city::Random& random) {
  const auto place = placeOutdoors(city, random);
  return standAt(city, place ? *place : WayPoint{walking::densestPoint(city), -kInfinity}, random);
}

Tour makeTeleport(const City& city) {
  constexpr int kStops = 24, kStopsForEachFlight = 3;
  Tour tour;
  tour.name = "teleport";
  tour.jumps = true;
  city::Random random(kTeleportSeed);
  for (int k = 0; k < kStops; ++k) {
    const bool air = k % kStopsForEachFlight == kStopsForEachFlight - 1;
    const city::ViewPose pose = air ? hoverOver(city, random) : standSomewhere(city, random);
    tour.keys.push_back({static_cast<double>(k), pose.eye, pose.heading, pose.pitch});
  }
  return tour;
}

}  // namespace

double durationOf(const Tour& tour) {
  if (tour.keys.empty()) return 0;
  return std::max(0.0, tour.keys.back().time - tour.keys.front().time);
}

city::ViewPose poseAt(const Tour& tour, double time) {
  city::ViewPose pose;
  if (tour.keys.empty()) return pose;
  if (!std::isfinite(time)) time = tour.keys.front().time;
  // The piece that holds the time: the last key at or before it.
  const auto after = std::upper_bound(tour.keys.begin(), tour.keys.end(), time,
                                      [](double t, const Tour::Key& key) { return t < key.time; });
  const size_t i = after == tour.keys.begin() ? 0 : static_cast<size_t>(after - tour.keys.begin()) - 1;
  const Tour::Key& key = tour.keys[i];
  pose.eye = key.position, pose.heading = key.heading, pose.pitch = key.pitch;
  if (tour.jumps || time <= key.time || i + 1 == tour.keys.size()) return pose;

  const double s = (time - key.time) / (tour.keys[i + 1].time - key.time);
  pose.eye = onPiece(tour, i, s, [&](size_t k) { return tour.keys[k].position; });
  // Angles of the neighbours as turns from this key's, each along the shorter arc from the one before.
  const auto headingOf = [&](size_t k) {
    if (k == i) return key.heading;
    if (k + 1 == i) return nearestTurn(tour.keys[k].heading, key.heading);
    const double next = nearestTurn(tour.keys[i + 1].heading, key.heading);
    return k == i + 1 ? next : nearestTurn(tour.keys[k].heading, next);
  };
  pose.heading = onPiece(tour, i, s, headingOf);
  pose.pitch = std::clamp(onPiece(tour, i, s, [&](size_t k) { return tour.keys[k].pitch; }), -pi / 2, pi / 2);
  return pose;
}

std::vector<TourFrame> spreadFrames(const Tour& tour, size_t frames) {
  const double start = tour.keys.empty() ? 0 : tour.keys.front().time;
  const double step = frames > 1 ? durationOf(tour) / static_cast<double>(frames - 1) : 0;
  std::vector<TourFrame> out(kWarmUpFrames, {start, 0, true});
  for (size_t k = 0; k < frames; ++k) out.push_back({start + step * static_cast<double>(k), k > 0 ? step : 0, false});
  return out;
}

std::vector<Tour> makeTours(const City& city) {
  std::vector<Tour> tours;
  const auto own = [&](std::string_view name) -> const Tour* {
    const Tour* found = findTour(city.tours, name);
    return found && !found->keys.empty() ? found : nullptr;
  };
  tours.push_back(own("street") ? *own("street") : makeStreet(city));
  tours.push_back(own("flyover") ? *own("flyover") : makeFlyover(city));
  tours.push_back(own("turn") ? *own("turn") : makeTurn(city, tours.front()));
  tours.push_back(own("teleport") ? *own("teleport") : makeTeleport(city));
  for (const Tour& tour : city.tours)
    if (!findTour(tours, tour.name) && !tour.keys.empty()) tours.push_back(tour);
  return tours;
}

const Tour* findTour(const std::vector<Tour>& tours, std::string_view name) {
  const auto it = std::find_if(tours.begin(), tours.end(), [&](const Tour& t) { return t.name == name; });
  return it == tours.end() ? nullptr : &*it;
}

city::ViewPose randomStreetView(const City& city, city::Random& random) {
  return standSomewhere(city, random);
}

city::ViewPose randomView(const City& city, city::Random& random) {
  return random.below(2) == 0 ? standSomewhere(city, random) : hoverOver(city, random);
}

}  // namespace vicus::viewer
