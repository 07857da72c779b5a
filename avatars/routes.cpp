#include "avatars/routes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "city/random.hpp"

namespace vicus::avatars {

using city::StreetGraph;
using city::WalkRoute;
using glm::dvec2;
using glm::dvec3;

namespace {

constexpr double kStep = 2;          // metres between a route's points
constexpr double kLeastRoom = 0.45;  // metres about the middle of a street that people walk

struct Adjacency {
  std::vector<std::vector<uint32_t>> edges;  // of each node
};

Adjacency adjacencyOf(const StreetGraph& streets) {
  Adjacency out{std::vector<std::vector<uint32_t>>(streets.nodes.size())};
  for (uint32_t e = 0; e < streets.edges.size(); ++e) {
    const auto [a, b] = std::pair{streets.edges[e].a, streets.edges[e].b};
    if (a >= streets.nodes.size() || b >= streets.nodes.size() || a == b) continue;
    out.edges[a].push_back(e), out.edges[b].push_back(e);
  }
  return out;
}

/// A point of a way one way, with what its street is like.
struct WayPoint {
  dvec3 position;
  double half;  // of the street's width
  bool deck;
};

/// From an edge on, mostly straight ahead, until the way is long enough or ends.
std::vector<WayPoint> wander(const StreetGraph& streets, const Adjacency& adjacency, uint32_t edge, double length,
                             city::Random& random) {
  std::vector<WayPoint> way;
  const auto add = [&](uint32_t node, const StreetGraph::Edge& e) {
    way.push_back(
        {streets.nodes[node].position, 0.5 * static_cast<double>(e.width), e.kind == city::StreetKind::Bridge});
  };
  const bool forward = random.below(2) == 0;
  uint32_t before = forward ? streets.edges[edge].a : streets.edges[edge].b;
  uint32_t here = forward ? streets.edges[edge].b : streets.edges[edge].a;
  add(before, streets.edges[edge]), add(here, streets.edges[edge]);
  double gone = glm::distance(way[0].position, way[1].position);
  while (gone < length && way.size() < 1000) {
    const dvec2 ahead = dvec2(streets.nodes[here].position - streets.nodes[before].position);
    double best = -2;
    uint32_t chosen = city::kNone;
    for (const uint32_t e : adjacency.edges[here]) {
      const uint32_t next = streets.edges[e].a ^ streets.edges[e].b ^ here;
      if (next == before) continue;
      const dvec2 there = dvec2(streets.nodes[next].position - streets.nodes[here].position);
      const double lengths = glm::length(ahead) * glm::length(there);
      if (!(lengths > 0)) continue;
      const double liking = glm::dot(ahead, there) / lengths + random.uniform(0, 0.9);
      if (liking > best) best = liking, chosen = e;
    }
    if (chosen == city::kNone) break;
    const uint32_t next = streets.edges[chosen].a ^ streets.edges[chosen].b ^ here;
    before = here, here = next;
    add(here, streets.edges[chosen]);
    gone += glm::distance(way[way.size() - 2].position, way.back().position);
  }
  return way;
}

/// Cuts corners twice (Chaikin 1974), ends stay.
std::vector<WayPoint> rounded(std::vector<WayPoint> way) {
  for (int round = 0; round < 2 && way.size() > 2; ++round) {
    std::vector<WayPoint> out{way.front()};
    for (size_t k = 0; k + 1 < way.size(); ++k) {
      const double half = std::min(way[k].half, way[k + 1].half);
      const bool deck = way[k].deck && way[k + 1].deck;
      if (k > 0) out.push_back({glm::mix(way[k].position, way[k + 1].position, 0.25), half, deck});
      if (k + 2 < way.size()) out.push_back({glm::mix(way[k].position, way[k + 1].position, 0.75), half, deck});
    }
    out.push_back(way.back());
    way = std::move(out);
  }
  return way;
}

/// The way at steps of kStep; it ends where the street is blocked.
std::vector<WayPoint> stepped(const std::vector<WayPoint>& way, const Ground& ground) {
  std::vector<WayPoint> out;
  double into = 0;
  for (size_t k = 0; k + 1 < way.size(); ++k) {
    const double length = glm::distance(dvec2(way[k].position), dvec2(way[k + 1].position));
    for (; into < length; into += kStep) {
      WayPoint p{glm::mix(way[k].position, way[k + 1].position, into / length), way[k].half, way[k].deck};
      const dvec2 at(p.position);
      if (!(ground.clearance(at) >= kLeastRoom)) return out;
      if (!p.deck) {
        const std::optional<double> height = ground.height(at);
        if (!height) return out;
        p.position.z = *height;
      }
      out.push_back(p);
    }
    into -= length;
  }
  return out;
}

/// How far one may go to the right of a point without coming near a wall or leaving the street.
double freeTo(dvec2 right, const WayPoint& p, const Ground& ground) {
  constexpr double kTry = 0.4;
  const double most = std::clamp(p.half - kBodyRadius, 0.2, 3.0);
  double free = 0;
  for (double d = kTry; d <= most + 1e-9; d += kTry) {
    const dvec2 at = dvec2(p.position) + d * right;
    if (!(ground.clearance(at) >= kBodyRadius + 0.1)) break;
    if (!p.deck && !ground.height(at)) break;
    free = d;
  }
  return free;
}

std::optional<WalkRoute> closed(const std::vector<WayPoint>& way, const Ground& ground) {
  if (way.size() < 4) return std::nullopt;
  WalkRoute route;
  const size_t n = way.size();
  for (size_t k = 0; k < 2 * n - 2; ++k) {
    const bool out = k < n;
    const size_t i = out ? k : 2 * n - 2 - k;
    const dvec2 along =
        dvec2(way[std::min(i + 1, n - 1)].position - way[i > 0 ? i - 1 : 0].position) * (out ? 1.0 : -1.0);
    const double length = glm::length(along);
    const dvec2 right = length > 0 ? dvec2(along.y, -along.x) / length : dvec2(0);
    // At both ends one turns on the spot in the middle.
    const double ease = std::min(1.0, static_cast<double>(std::min(i, n - 1 - i)) / 2);
    route.points.push_back({way[i].position, static_cast<float>(ease * freeTo(right, way[i], ground)), way[i].deck});
  }
  double length = 0;
  for (size_t k = 0; k < route.points.size(); ++k)
    length +=
        glm::distance(dvec2(route.points[k].position), dvec2(route.points[(k + 1) % route.points.size()].position));
  route.step = length / static_cast<double>(route.points.size());
  return route;
}

}  // namespace

std::vector<WalkRoute> makeRoutes(const StreetGraph& streets, const Ground& ground, const RouteOptions& options) {
  std::vector<WalkRoute> routes;
  if (streets.edges.empty()) return routes;
  const Adjacency adjacency = adjacencyOf(streets);
  // Edges by how far they are from the centre: sums of their weights, to draw from.
  std::vector<double> sums;
  double sum = 0;
  for (const StreetGraph::Edge& e : streets.edges) {
    const bool good = e.a < streets.nodes.size() && e.b < streets.nodes.size() && e.a != e.b;
    if (good) {
      const dvec2 a(streets.nodes[e.a].position), b(streets.nodes[e.b].position);
      const double weight =
          glm::distance(a, b) * std::exp(-glm::distance(0.5 * (a + b), options.centre) / options.spread);
      if (std::isfinite(weight)) sum += weight;
    }
    sums.push_back(sum);
  }
  if (!(sum > 0)) return routes;
  for (size_t attempt = 0; attempt < 4 * options.count && routes.size() < options.count; ++attempt) {
    city::Random random(city::hash32(options.seed, static_cast<uint32_t>(attempt)));
    const auto drawn = std::upper_bound(sums.begin(), sums.end(), random.uniform(0, sum));
    const auto edge = static_cast<uint32_t>(std::min<std::ptrdiff_t>(drawn - sums.begin(), std::ssize(sums) - 1));
    const double length = random.uniform(options.shortest, options.longest);
    const auto way = stepped(rounded(wander(streets, adjacency, edge, length, random)), ground);
    if (static_cast<double>(way.size()) * kStep < options.shortest) continue;
    if (auto route = closed(way, ground)) routes.push_back(std::move(*route));
  }
  return routes;
}

StreetGraph walkableGrid(const Ground& ground, dvec2 centre, double halfSide, double cell) {
  StreetGraph graph;
  const int size = std::clamp(static_cast<int>(2 * halfSide / cell), 1, 400);
  std::vector<uint32_t> nodeOf(static_cast<size_t>(size) * static_cast<size_t>(size), city::kNone);
  std::vector<double> room;
  const auto index = [&](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x);
  };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const dvec2 p = centre - halfSide + cell * (dvec2(x, y) + 0.5);
      const double clear = ground.clearance(p);
      if (!(clear >= 1.2)) continue;
      const std::optional<double> height = ground.height(p);
      if (!height) continue;
      nodeOf[index(x, y)] = static_cast<uint32_t>(graph.nodes.size());
      graph.nodes.push_back({dvec3(p, *height)});
      room.push_back(clear);
    }
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const uint32_t a = nodeOf[index(x, y)];
      if (a == city::kNone) continue;
      for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}, std::pair{-1, 1}}) {
        if (x + dx < 0 || x + dx >= size || y + dy >= size) continue;
        const uint32_t b = nodeOf[index(x + dx, y + dy)];
        if (b == city::kNone) continue;
        graph.edges.push_back(
            {a, b, static_cast<float>(std::min(2 * std::min(room[a], room[b]), 6.0)), city::StreetKind::Lane, ""});
      }
    }
  return graph;
}

std::vector<city::StandingPlace> makeGroups(std::span<const dvec2> candidates, std::span<const WalkRoute> routes,
                                            const Ground& ground, size_t people, uint32_t seed) {
  constexpr double kApart = 5, kOffRoutes = 1.3;
  std::vector<uint32_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return city::hash32(seed, a) < city::hash32(seed, b); });
  std::vector<dvec2> centres;
  std::vector<city::StandingPlace> places;
  for (const uint32_t c : order) {
    if (places.size() >= people) break;
    const dvec2 centre = candidates[c];
    const auto near = [&](const dvec2& other) { return glm::distance(other, centre) < kApart; };
    if (std::any_of(centres.begin(), centres.end(), near) || !(ground.clearance(centre) >= 1.6)) continue;
    bool inTheWay = false;
    for (const WalkRoute& r : routes)
      for (const WalkRoute::Point& p : r.points) inTheWay |= glm::distance(dvec2(p.position), centre) < kOffRoutes;
    if (inTheWay) continue;
    city::Random random(city::hash32(seed, 1000 + c));
    const uint32_t size = 2 + random.below(4);
    const double radius = 0.42 + 0.1 * size, first = random.uniform(0, 2 * std::numbers::pi);
    std::vector<city::StandingPlace> group;
    for (uint32_t k = 0; k < size; ++k) {
      const double angle = first + (k + random.uniform(-0.18, 0.18)) * 2 * std::numbers::pi / size;
      const dvec2 at = centre + radius * dvec2(std::cos(angle), std::sin(angle));
      const std::optional<double> height = ground.height(at);
      if (!height || !(ground.clearance(at) >= kBodyRadius)) continue;
      group.push_back({dvec3(at, *height), static_cast<float>(angle + std::numbers::pi + random.uniform(-0.25, 0.25)),
                       static_cast<uint32_t>(centres.size())});
    }
    if (group.size() < 2) continue;
    places.insert(places.end(), group.begin(), group.end());
    centres.push_back(centre);
  }
  return places;
}

}  // namespace vicus::avatars
