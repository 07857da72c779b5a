/// Streets while they grow: short edges between nodes that are found by place, then the finished lines.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "assets/norvic/plan_geometry.hpp"
#include "city/city.hpp"

namespace vicus::assets::norvic {

constexpr double kStreetStep = 6;  ///< metres between nodes while streets grow

/// What a street is like along its whole length.
struct StreetStyle {
  city::StreetKind kind = city::StreetKind::Street;
  double width = 5;   ///< metres between the fronts
  uint32_t name = 0;  ///< of the caller's meaning
};

/// A finished line between two junctions, straight between its points.
struct StreetLine {
  uint32_t from = 0, to = 0;  ///< nodes of the net
  std::vector<glm::dvec2> points;
  StreetStyle style;
};

/// A growing net of streets. Invariant: whenever two streets come within `kStreetStep` of each other they share a node
/// there, so none crosses another unconnected.
class StreetNet {
 public:
  static constexpr uint32_t kNowhere = 0xffffffffU;
  struct Node {
    glm::dvec2 position{0};
    bool fixed = false;  ///< stays where it is when streets are smoothed
    std::vector<uint32_t> edges;
  };
  struct Edge {
    uint32_t a = 0, b = 0;
    StreetStyle style;
  };

  StreetNet(glm::dvec2 min, glm::dvec2 max) : grid_(min, max, 12) {}

  /// Adds a street along `line`. It joins every node that it comes near. Returns its nodes in order.
  std::vector<uint32_t> add(std::span<const glm::dvec2> line, const StreetStyle& style, bool fixed = false);
  /// Keeps a node where it is, and the street that ends at it.
  void fix(uint32_t node) { nodes_[node].fixed = true; }
  /// The nearest node within `radius`; kNowhere where there is none.
  uint32_t nearest(glm::dvec2 p, double radius) const;
  /// Calls visitor(node) for each node within `radius`.
  template <typename Visitor>
  void nodesWithin(glm::dvec2 p, double radius, const Visitor& visitor) const {
    grid_.visit(p - radius, p + radius, [&](uint32_t n) {
      if (glm::length(nodes_[n].position - p) <= radius) visitor(n);
      return true;
    });
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Edge>& edges() const { return edges_; }
  uint32_t other(uint32_t edge, uint32_t node) const { return edges_[edge].a ^ edges_[edge].b ^ node; }
  /// Metres along streets from `from` to every node; infinite where there is no way.
  std::vector<double> distancesFrom(uint32_t from) const;

  /// Forgets the streets that cannot be reached from `from`, and those that end nowhere unless their end is fixed.
  void prune(uint32_t from);
  /// Streets as smooth lines between junctions and fixed nodes. Moves nodes that are not fixed.
  std::vector<StreetLine> finish();

 private:
  bool connected(uint32_t a, uint32_t b) const;
  uint32_t addNode(glm::dvec2 p, bool fixed);
  void removeEdge(uint32_t edge);

  std::vector<Node> nodes_;
  std::vector<Edge> edges_;
  PlanGrid grid_;
};

}  // namespace vicus::assets::norvic
