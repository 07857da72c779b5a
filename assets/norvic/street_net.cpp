#include "assets/norvic/street_net.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <queue>

namespace vicus::assets::norvic {

bool StreetNet::connected(uint32_t a, uint32_t b) const {
  return std::any_of(nodes_[a].edges.begin(), nodes_[a].edges.end(), [&](uint32_t e) { return other(e, a) == b; });
}

uint32_t StreetNet::addNode(glm::dvec2 p, bool fixed) {
  const auto index = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back({p, fixed, {}});
  grid_.enter(index, p, p);
  return index;
}

uint32_t StreetNet::nearest(glm::dvec2 p, double radius) const {
  uint32_t best = kNowhere;
  double bestDistance = radius;
  grid_.visit(p - radius, p + radius, [&](uint32_t n) {
    const double d = glm::length(nodes_[n].position - p);
    if (d < bestDistance || (d == bestDistance && n < best)) bestDistance = d, best = n;
    return true;
  });
  return best;
}

std::vector<uint32_t> StreetNet::add(std::span<const glm::dvec2> line, const StreetStyle& style, bool fixed) {
  const std::vector<glm::dvec2> points = resample(line, kStreetStep);
  const auto firstOwn = static_cast<uint32_t>(nodes_.size());
  std::vector<uint32_t> visited;
  for (const glm::dvec2 p : points) {
    uint32_t node = kNowhere;
    double best = kStreetStep;
    // Join what was there before this street; its own nodes only where it comes back to them.
    grid_.visit(p - kStreetStep, p + kStreetStep, [&](uint32_t n) {
      if (n + 4 > nodes_.size() && n >= firstOwn) return true;
      const double d = glm::length(nodes_[n].position - p);
      if (d < best) best = d, node = n;
      return true;
    });
    if (node == kNowhere) node = addNode(p, fixed);
    if (fixed) nodes_[node].fixed = true;
    if (!visited.empty() && visited.back() == node) continue;
    if (!visited.empty() && !connected(visited.back(), node)) {
      const auto edge = static_cast<uint32_t>(edges_.size());
      edges_.push_back({visited.back(), node, style});
      nodes_[visited.back()].edges.push_back(edge);
      nodes_[node].edges.push_back(edge);
    }
    visited.push_back(node);
  }
  return visited;
}

std::vector<double> StreetNet::distancesFrom(uint32_t from) const {
  std::vector<double> distance(nodes_.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[from] = 0;
  open.push({0, from});
  while (!open.empty()) {
    const auto [d, n] = open.top();
    open.pop();
    if (d > distance[n]) continue;
    for (const uint32_t e : nodes_[n].edges) {
      const uint32_t m = other(e, n);
      const double to = d + glm::length(nodes_[m].position - nodes_[n].position);
      if (to < distance[m]) distance[m] = to, open.push({to, m});
    }
  }
  return distance;
}

void StreetNet::removeEdge(uint32_t edge) {
  std::erase(nodes_[edges_[edge].a].edges, edge);
  std::erase(nodes_[edges_[edge].b].edges, edge);
  edges_[edge].a = edges_[edge].b = kNowhere;
}

void StreetNet::prune(uint32_t from) {
  const std::vector<double> distance = distancesFrom(from);
  for (uint32_t e = 0; e < edges_.size(); ++e)
    if (edges_[e].a != kNowhere && !std::isfinite(distance[edges_[e].a])) removeEdge(e);
  for (uint32_t n = 0; n < nodes_.size(); ++n) {
    uint32_t at = n;
    while (nodes_[at].edges.size() == 1 && !nodes_[at].fixed && at != from) {
      const uint32_t edge = nodes_[at].edges[0];
      const uint32_t next = other(edge, at);
      removeEdge(edge);
      at = next;
    }
  }
}

std::vector<StreetLine> StreetNet::finish() {
  const auto isEnd = [&](uint32_t n) {
    if (nodes_[n].edges.size() != 2 || nodes_[n].fixed) return true;
    const StreetStyle& s = edges_[nodes_[n].edges[0]].style;
    const StreetStyle& t = edges_[nodes_[n].edges[1]].style;
    return s.kind != t.kind || s.width != t.width || s.name != t.name;
  };
  // Rounds off the steps that joining and tracing left, before junctions are taken as fixed.
  std::vector<glm::dvec2> moved(nodes_.size());
  for (int pass = 0; pass < 4; ++pass) {
    for (uint32_t n = 0; n < nodes_.size(); ++n) {
      moved[n] = nodes_[n].position;
      if (nodes_[n].fixed || nodes_[n].edges.size() < 2) continue;
      glm::dvec2 sum(0);
      for (const uint32_t e : nodes_[n].edges) sum += nodes_[other(e, n)].position;
      const double weight = nodes_[n].edges.size() == 2 ? 0.5 : 0.2;
      moved[n] = glm::mix(moved[n], sum / static_cast<double>(nodes_[n].edges.size()), weight);
    }
    for (uint32_t n = 0; n < nodes_.size(); ++n) nodes_[n].position = moved[n];
  }

  std::vector<StreetLine> lines;
  std::vector<bool> used(edges_.size(), false);
  const auto follow = [&](uint32_t start, uint32_t firstEdge) {
    StreetLine line;
    line.style = edges_[firstEdge].style;
    line.from = start;
    std::vector<glm::dvec2> points{nodes_[start].position};
    uint32_t at = start, edge = firstEdge;
    for (;;) {
      used[edge] = true;
      at = other(edge, at);
      points.push_back(nodes_[at].position);
      if (isEnd(at) || at == start) break;
      edge = nodes_[at].edges[0] ^ nodes_[at].edges[1] ^ edge;
    }
    line.to = at;
    for (const uint32_t i : simplify(points, 0.45)) line.points.push_back(points[i]);
    lines.push_back(std::move(line));
  };
  for (uint32_t n = 0; n < nodes_.size(); ++n)
    if (isEnd(n))
      for (const uint32_t e : nodes_[n].edges)
        if (!used[e]) follow(n, e);
  // Rings without a junction.
  for (uint32_t e = 0; e < edges_.size(); ++e)
    if (!used[e] && edges_[e].a != kNowhere) follow(edges_[e].a, e);
  return lines;
}

}  // namespace vicus::assets::norvic
