// Straight skeleton as the trace of a shrinking polygon (Aichholzer et al. 1995). The events are found by looking at
// all of them after each one: footprints have tens of corners, for which that is faster than any queue. Events:
//
//   edge     a wavefront edge shrinks to nothing: its two corners become one
//   split    a reflex corner meets an edge: the loop becomes two, or two loops become one
//   spike    the two edges of a corner fold onto each other: a ridge as long as the shorter
//
// Events at one time (every symmetric house has them) come one after the other with no time between.
#include "facade/wavefront.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicus::facade {
namespace {

using glm::dvec2;
using glm::dvec3;

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

struct Edge {
  uint32_t ring, edge;
  dvec2 a, b;
  dvec2 along;    ///< unit
  dvec2 inward;   ///< unit
  double offset;  ///< inward · p on the line
  uint32_t nodeA, nodeB;
};

struct Corner {
  uint32_t left, right;  ///< edges that arrive and leave
  dvec2 birth, velocity;
  double since;
  uint32_t node;
  bool spike, reflex;

  dvec2 at(double time) const { return birth + (time - since) * velocity; }
};

using Loop = std::vector<Corner>;

/// A piece of the skeleton between the faces of two edges.
struct Arc {
  uint32_t from, to;  ///< nodes
};

class Wavefront {
 public:
  explicit Wavefront(std::span<const Ring> rings) {
    size_t corners = 0;
    dvec2 lo(1e300), hi(-1e300);
    for (const Ring& ring : rings)
      for (const dvec2 p : ring) lo = glm::min(lo, p), hi = glm::max(hi, p), ++corners;
    size_ = glm::length(hi - lo);
    near_ = 1e-7 * size_;
    for (uint32_t r = 0; r < rings.size(); ++r) {
      const Ring& ring = rings[r];
      const auto n = static_cast<uint32_t>(ring.size());
      const auto first = static_cast<uint32_t>(edges_.size());
      for (uint32_t i = 0; i < n; ++i) {
        nodes_.emplace_back(ring[i], 0);
        const dvec2 a = ring[i], b = ring[(i + 1) % n];
        const dvec2 along = glm::normalize(b - a), inward(-along.y, along.x);
        edges_.push_back({r, i, a, b, along, inward, glm::dot(inward, a), first + i, first + (i + 1) % n});
      }
      Loop loop;
      for (uint32_t i = 0; i < n; ++i) loop.push_back(corner(first + (i + n - 1) % n, first + i, ring[i], first + i));
      loops_.push_back(std::move(loop));
    }
    arcs_.resize(edges_.size());
    mostEvents_ = 20 * corners + 20;
  }

  std::optional<Skeleton> run() {
    for (size_t events = 0; !loops_.empty(); ++events) {
      if (events > mostEvents_) return std::nullopt;
      if (finishSmall()) continue;
      if (foldSpike()) continue;
      const Event next = nextEvent();
      if (!std::isfinite(next.time)) return std::nullopt;
      time_ = std::max(time_, next.time);
      next.split ? split(next) : collapse(next.loop, next.corner);
    }
    return faces();
  }

 private:
  struct Event {
    double time = std::numeric_limits<double>::infinity();
    bool split = false;
    size_t loop = 0, corner = 0;        ///< the edge that leaves the corner, or the reflex corner
    size_t hitLoop = 0, hitCorner = 0;  ///< the edge that is hit leaves this corner
  };

  Corner corner(uint32_t left, uint32_t right, dvec2 place, uint32_t node) const {
    Corner c{left, right, place, dvec2(0), time_, node, false, false};
    const Edge &l = edges_[left], &r = edges_[right];
    const double turn = cross(l.along, r.along), same = glm::dot(l.along, r.along);
    c.reflex = turn < -1e-12;
    if (std::abs(turn) < 1e-7) {
      c.spike = same < 0;
      c.velocity = r.inward;  // in line: both edges take the corner along
      c.reflex = false;
    } else {
      // inward · velocity = 1 for both.
      c.velocity = dvec2(r.inward.y - l.inward.y, l.inward.x - r.inward.x) / cross(l.inward, r.inward);
    }
    return c;
  }

  uint32_t nodeAt(dvec2 place) {
    for (size_t i = nodes_.size(); i-- > 0;)
      if (std::abs(nodes_[i].z - time_) <= near_ && glm::length(dvec2(nodes_[i]) - place) <= 4 * near_)
        return static_cast<uint32_t>(i);
    nodes_.emplace_back(place, time_);
    return static_cast<uint32_t>(nodes_.size() - 1);
  }

  void arc(uint32_t from, uint32_t to, uint32_t faceA, uint32_t faceB) {
    if (from == to || faceA == faceB) return;
    arcs_[faceA].push_back({from, to});
    arcs_[faceB].push_back({from, to});
  }
  void end(const Corner& c, uint32_t node) { arc(c.node, node, c.left, c.right); }

  /// Loops of one corner are gone; two corners lie on one ridge.
  bool finishSmall() {
    for (size_t l = 0; l < loops_.size(); ++l) {
      Loop& loop = loops_[l];
      if (loop.size() > 2) continue;
      if (loop.size() == 2) {
        uint32_t at[2];
        for (size_t i = 0; i < 2; ++i) end(loop[i], at[i] = nodeAt(loop[i].at(time_)));
        arc(at[0], at[1], loop[0].left, loop[0].right);
      }
      loops_.erase(loops_.begin() + static_cast<std::ptrdiff_t>(l));
      return true;
    }
    return false;
  }

  bool foldSpike() {
    for (Loop& loop : loops_) {
      const size_t n = loop.size();
      for (size_t i = 0; i < n; ++i) {
        if (!loop[i].spike) continue;
        const size_t before = (i + n - 1) % n, after = (i + 1) % n;
        const Corner tip = loop[i], p = loop[before], q = loop[after];
        const dvec2 atTip = tip.at(tip.since), atP = p.at(time_), atQ = q.at(time_);
        const double toP = glm::length(atP - atTip), toQ = glm::length(atQ - atTip);
        const bool takesP = toP <= toQ + near_, takesQ = toQ <= toP + near_;
        const dvec2 place = takesP ? atP : atQ;
        const uint32_t tipNode = nodeAt(atTip), node = nodeAt(place);
        end(tip, tipNode);
        arc(tipNode, node, tip.left, tip.right);
        if (takesP) end(p, node);
        if (takesQ) end(q, node);
        Loop rest;
        const uint32_t left = takesP ? p.left : tip.left, right = takesQ ? q.right : tip.right;
        rest.push_back(corner(left, right, place, node));
        for (size_t k = (takesQ ? after + 1 : after) % n, count = n - 1 - (takesP ? 1 : 0) - (takesQ ? 1 : 0);
             count > 0; k = (k + 1) % n, --count)
          rest.push_back(loop[k]);
        loop = std::move(rest);
        return true;
      }
    }
    return false;
  }

  /// When the edge from corner c to corner d has no length left; infinite where it does not shrink.
  double collapseTime(const Corner& c, const Corner& d) const {
    const dvec2 along = edges_[c.right].along;
    const double length = glm::dot(along, d.at(time_) - c.at(time_));
    const double growth = glm::dot(along, d.velocity - c.velocity);
    if (length <= near_ && growth <= 1e-12) return time_;
    if (growth >= -1e-12) return std::numeric_limits<double>::infinity();
    return time_ + std::max(-length / growth, 0.0);
  }

  /// When a reflex corner meets the edge from corner c to corner d; infinite where it passes beside it.
  double splitTime(const Corner& reflex, const Corner& c, const Corner& d) const {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const Edge& e = edges_[c.right];
    const double ahead = glm::dot(e.inward, reflex.at(time_)) - e.offset - time_;
    const double closing = 1 - glm::dot(e.inward, reflex.velocity);
    if (ahead < -near_ || closing <= 1e-12) return kNever;
    const double time = time_ + std::max(ahead / closing, 0.0);
    const dvec2 hit = reflex.at(time);
    if (glm::dot(e.along, hit - c.at(time)) < -near_ || glm::dot(e.along, d.at(time) - hit) < -near_) return kNever;
    return time;
  }

  Event nextEvent() const {
    Event next;
    for (size_t l = 0; l < loops_.size(); ++l) {
      const Loop& loop = loops_[l];
      for (size_t i = 0; i < loop.size(); ++i)
        if (const double t = collapseTime(loop[i], loop[(i + 1) % loop.size()]); t < next.time)
          next = {t, false, l, i, 0, 0};
    }
    for (size_t l = 0; l < loops_.size(); ++l)
      for (size_t i = 0; i < loops_[l].size(); ++i) {
        const Corner& reflex = loops_[l][i];
        if (!reflex.reflex) continue;
        for (size_t h = 0; h < loops_.size(); ++h) {
          const Loop& other = loops_[h];
          for (size_t k = 0; k < other.size(); ++k) {
            const Corner &c = other[k], &d = other[(k + 1) % other.size()];
            if (c.right == reflex.left || c.right == reflex.right) continue;
            if (h == l && (k == i || (k + 1) % other.size() == i)) continue;
            // Where an edge shrinks away at the same time, that goes first.
            if (const double t = splitTime(reflex, c, d); t < next.time - near_) next = {t, true, l, i, h, k};
          }
        }
      }
    return next;
  }

  void collapse(size_t l, size_t i) {
    Loop& loop = loops_[l];
    const size_t j = (i + 1) % loop.size();
    const dvec2 place = 0.5 * (loop[i].at(time_) + loop[j].at(time_));
    const uint32_t node = nodeAt(place);
    end(loop[i], node);
    end(loop[j], node);
    const Corner merged = corner(loop[i].left, loop[j].right, place, node);
    loop[i] = merged;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(j));
  }

  void split(const Event& event) {
    const Corner reflex = loops_[event.loop][event.corner];
    const Loop& hit = loops_[event.hitLoop];
    const uint32_t edge = hit[event.hitCorner].right;
    const dvec2 place = reflex.at(time_);
    const uint32_t node = nodeAt(place);
    end(reflex, node);
    const Corner a = corner(reflex.left, edge, place, node), b = corner(edge, reflex.right, place, node);
    const auto pieceOf = [](const Loop& loop, size_t from, size_t to) {  // from … to, both in, going round
      Loop piece;
      for (size_t k = from;; k = (k + 1) % loop.size()) {
        piece.push_back(loop[k]);
        if (k == to) return piece;
      }
    };
    const size_t n = hit.size(), after = (event.hitCorner + 1) % n;
    if (event.loop == event.hitLoop) {
      Loop first = pieceOf(hit, after, (event.corner + n - 1) % n);
      Loop second = pieceOf(hit, (event.corner + 1) % n, event.hitCorner);
      first.push_back(a);
      second.push_back(b);
      loops_[event.loop] = std::move(first);
      loops_.push_back(std::move(second));
    } else {
      const Loop& own = loops_[event.loop];
      Loop joined = pieceOf(hit, after, event.hitCorner);
      joined.push_back(b);
      for (size_t k = 1; k < own.size(); ++k) joined.push_back(own[(event.corner + k) % own.size()]);
      joined.push_back(a);
      loops_[event.loop] = std::move(joined);
      loops_.erase(loops_.begin() + static_cast<std::ptrdiff_t>(event.hitLoop));
    }
  }

  /// Each face: from the edge's end along its arcs back to the edge's start.
  std::optional<Skeleton> faces() {
    Skeleton out;
    for (size_t e = 0; e < edges_.size(); ++e) {
      SkeletonFace face{edges_[e].ring, edges_[e].edge, {nodes_[edges_[e].nodeA], nodes_[edges_[e].nodeB]}};
      std::vector<Arc>& arcs = arcs_[e];
      for (uint32_t at = edges_[e].nodeB; at != edges_[e].nodeA;) {
        const auto next =
            std::find_if(arcs.begin(), arcs.end(), [&](const Arc& a) { return a.from == at || a.to == at; });
        if (next == arcs.end()) return std::nullopt;
        at = next->from == at ? next->to : next->from;
        arcs.erase(next);
        if (at != edges_[e].nodeA) face.polygon.push_back(nodes_[at]);
      }
      if (!arcs.empty()) return std::nullopt;
      for (const dvec3& p : face.polygon) out.reach = std::max(out.reach, p.z);
      out.faces.push_back(std::move(face));
    }
    return out;
  }

  std::vector<Edge> edges_;
  std::vector<dvec3> nodes_;
  std::vector<std::vector<Arc>> arcs_;  ///< of each edge's face
  std::vector<Loop> loops_;
  double time_ = 0, size_ = 0, near_ = 0;
  size_t mostEvents_ = 0;
};

}  // namespace

std::optional<Skeleton> skeletonByWavefront(std::span<const Ring> rings) {
  return Wavefront(rings).run();
}

}  // namespace vicus::facade
