#include "assets/norvic/tours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace vicus::assets::norvic {
namespace {

using city::City;
using city::StreetGraph;
using city::Tour;
using glm::dvec2;
using glm::dvec3;

constexpr double kEyeHeight = 1.65;

/// The graph with its edges by node.
struct Ways {
  const StreetGraph& graph;
  std::vector<std::vector<uint32_t>> edgesOf;

  explicit Ways(const StreetGraph& g) : graph(g), edgesOf(g.nodes.size()) {
    for (uint32_t e = 0; e < g.edges.size(); ++e)
      edgesOf[g.edges[e].a].push_back(e), edgesOf[g.edges[e].b].push_back(e);
  }

  uint32_t nearest(dvec2 p) const {
    uint32_t best = 0;
    double distance = std::numeric_limits<double>::infinity();
    for (uint32_t n = 0; n < graph.nodes.size(); ++n) {
      const double d = glm::length(dvec2(graph.nodes[n].position) - p);
      if (d < distance && !edgesOf[n].empty()) distance = d, best = n;
    }
    return best;
  }

  /// Nodes of the shortest way, which keeps to broad streets where it costs little; empty where there is none.
  std::vector<uint32_t> way(uint32_t from, uint32_t to) const {
    std::vector<double> cost(graph.nodes.size(), std::numeric_limits<double>::infinity());
    std::vector<uint32_t> before(graph.nodes.size(), city::kNone);
    using Entry = std::pair<double, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    cost[from] = 0;
    open.push({0, from});
    while (!open.empty()) {
      const auto [c, n] = open.top();
      open.pop();
      if (c > cost[n]) continue;
      if (n == to) break;
      for (const uint32_t e : edgesOf[n]) {
        const StreetGraph::Edge& edge = graph.edges[e];
        const uint32_t m = edge.a == n ? edge.b : edge.a;
        const double narrow = edge.kind == city::StreetKind::Lane ? 1.5 : 1.0;
        const double step = glm::length(graph.nodes[m].position - graph.nodes[n].position) * narrow;
        if (c + step < cost[m]) cost[m] = c + step, before[m] = n, open.push({c + step, m});
      }
    }
    if (!std::isfinite(cost[to])) return {};
    std::vector<uint32_t> nodes{to};
    while (nodes.back() != from) nodes.push_back(before[nodes.back()]);
    std::reverse(nodes.begin(), nodes.end());
    return nodes;
  }
};

double turnBetween(double from, double to) {
  return std::remainder(to - from, 6.283185307179586);
}

/// Height to stand at: the ground, or a bridge's deck above it.
double standAt(const City& city, const dvec3& onStreet) {
  const double ground = city.terrain->heightAt(onStreet.x, onStreet.y).value_or(onStreet.z);
  return std::max(ground, onStreet.z);
}

Tour streetTour(const City& city, const Ways& ways, const TourStops& stops) {
  Tour tour;
  tour.name = "street";
  std::vector<dvec3> line;
  for (size_t i = 1; i < stops.walk.size(); ++i) {
    for (const uint32_t n : ways.way(ways.nearest(stops.walk[i - 1]), ways.nearest(stops.walk[i]))) {
      const dvec3 p = ways.graph.nodes[n].position;
      if (line.empty() || glm::length(dvec2(p - line.back())) > 0.1) line.push_back(p);
    }
  }
  if (line.size() < 2) return tour;

  // A point each metre, on the ground or the deck.
  std::vector<dvec3> metres;
  for (size_t i = 1; i < line.size(); ++i) {
    const double length = glm::length(dvec2(line[i] - line[i - 1]));
    const int steps = std::max(1, static_cast<int>(std::lround(length)));
    // Only between two nodes that stand above the ground is there a bridge.
    const auto above = [&](const dvec3& p) { return p.z - city.terrain->heightAt(p.x, p.y).value_or(p.z) > 0.5; };
    const bool deck = above(line[i - 1]) || above(line[i]);
    for (int k = 0; k < steps; ++k) {
      dvec3 p = glm::mix(line[i - 1], line[i], static_cast<double>(k) / steps);
      p.z = deck ? standAt(city, p) : city.terrain->heightAt(p.x, p.y).value_or(p.z);
      metres.push_back(p);
    }
  }
  // Round the corners: twice the mean over a few metres.
  const auto smooth = [](std::vector<dvec3>& points, int reach) {
    const std::vector<dvec3> in = points;
    for (int i = 0; i < static_cast<int>(in.size()); ++i) {
      const int room = std::min({reach, i, static_cast<int>(in.size()) - 1 - i});
      dvec3 sum(0);
      for (int k = i - room; k <= i + room; ++k) sum += in[static_cast<size_t>(k)];
      points[static_cast<size_t>(i)] = sum / static_cast<double>(2 * room + 1);
    }
  };
  smooth(metres, 3);
  smooth(metres, 3);
  for (dvec3& p : metres) p.z = std::max(p.z, city.terrain->heightAt(p.x, p.y).value_or(p.z));

  // Two minutes, at a pace between a stroll and a brisk ride.
  const double length = static_cast<double>(metres.size());
  const double seconds = std::clamp(120.0, length / 9.0, std::max(length / 9.0, length / 1.2));
  std::vector<double> headings(metres.size());
  for (size_t i = 0; i < metres.size(); ++i) {
    const dvec3& ahead = metres[std::min(i + 12, metres.size() - 1)];
    const dvec2 d(ahead - metres[i]);
    headings[i] = glm::length(d) > 0.5 ? std::atan2(d.y, d.x) : headings[i > 0 ? i - 1 : 0];
    if (i > 0) headings[i] = headings[i - 1] + turnBetween(headings[i - 1], headings[i]);
  }
  std::vector<double> smoothed = headings;
  constexpr int kLook = 7;
  for (int i = 0; i < static_cast<int>(headings.size()); ++i) {
    double sum = 0;
    int count = 0;
    for (int k = std::max(0, i - kLook); k <= std::min(static_cast<int>(headings.size()) - 1, i + kLook); ++k, ++count)
      sum += headings[static_cast<size_t>(k)];
    smoothed[static_cast<size_t>(i)] = sum / count;
  }
  for (size_t i = 0; i < metres.size(); i += 2) {
    Tour::Key key;
    key.time = seconds * static_cast<double>(i) / length;
    key.position = metres[i] + dvec3(0, 0, kEyeHeight);
    key.heading = smoothed[i];
    key.pitch = 0.04;
    tour.keys.push_back(key);
  }
  return tour;
}

Tour flyover(const City& city, const TourStops& stops) {
  Tour tour;
  tour.name = "flyover";
  constexpr int kKeys = 96;
  constexpr double kSeconds = 90;
  const double ground = city.terrain->heightAt(stops.centre.x, stops.centre.y).value_or(0);
  for (int i = 0; i <= kKeys; ++i) {
    const double turn = 6.283185307179586 * i / kKeys;
    const double away = stops.radius * (0.95 + 0.2 * std::cos(2 * turn));
    Tour::Key key;
    key.time = kSeconds * i / kKeys;
    key.position = dvec3(stops.centre + away * dvec2(std::cos(turn - 2.2), std::sin(turn - 2.2)),
                         ground + 160 - 40 * std::cos(turn));
    key.heading = turn - 2.2 + 3.141592653589793 + 0.25 * std::sin(turn);
    key.pitch = -0.30;
    tour.keys.push_back(key);
  }
  return tour;
}

Tour turn(const City& city, const TourStops& stops) {
  Tour tour;
  tour.name = "turn";
  const double ground = city.terrain->heightAt(stops.square.x, stops.square.y).value_or(0);
  constexpr int kKeys = 48;
  for (int i = 0; i <= kKeys; ++i)
    tour.keys.push_back(
        {30.0 * i / kKeys, dvec3(stops.square, ground + kEyeHeight), 6.283185307179586 * i / kKeys, 0.05});
  return tour;
}

Tour teleport(const City& city, const Ways& ways, const TourStops& stops) {
  Tour tour;
  tour.name = "teleport";
  tour.jumps = true;
  double time = 0;
  for (const Sight& s : stops.sights) {
    // From the street node whose distance suits best.
    double best = std::numeric_limits<double>::infinity();
    dvec3 from(s.place, 0);
    for (uint32_t n = 0; n < ways.graph.nodes.size(); ++n) {
      const double off = std::abs(glm::length(dvec2(ways.graph.nodes[n].position) - s.place) - s.distance);
      if (off < best && !ways.edgesOf[n].empty()) best = off, from = ways.graph.nodes[n].position;
    }
    const dvec2 to = s.place - dvec2(from);
    const double eye = standAt(city, from) + kEyeHeight;
    const double target = city.terrain->heightAt(s.place.x, s.place.y).value_or(eye) + s.height;
    tour.keys.push_back({time,
                         {from.x, from.y, eye},
                         std::atan2(to.y, to.x),
                         std::clamp(std::atan2(target - eye, std::max(1.0, glm::length(to))), -0.4, 0.5)});
    time += 3;
  }
  // The last sight stays for its time too.
  if (!tour.keys.empty()) {
    Tour::Key last = tour.keys.back();
    last.time = time;
    tour.keys.push_back(last);
  }
  return tour;
}

}  // namespace

std::vector<Tour> makeTours(const City& city, const TourStops& stops) {
  const Ways ways(*city.streets);
  std::vector<Tour> tours{streetTour(city, ways, stops), flyover(city, stops), turn(city, stops),
                          teleport(city, ways, stops)};
  std::erase_if(tours, [](const Tour& t) { return t.keys.size() < 2; });
  return tours;
}

}  // namespace vicus::assets::norvic
