#include "culling/cull_map.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::City;
using city::kNone;
using city::Range;
using glm::dvec2;
using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- What hides: chosen once ----------------------------------------------------------------------------------------

/// Walls lose this much of their height, so that rounding on the way to the screen never uncovers what they hide.
constexpr double kLessHigh = 0.01;
/// A wall counts as standing in the ground when its foot is this deep in it where the terrain was sampled.
constexpr double kInGround = 0.02;
constexpr double kSampleStep = 1;      ///< metres between samples of the terrain along a wall
constexpr double kSmallestWall = 0.1;  ///< metres long: shorter ones cover no column
constexpr float kLowestWall = 0.5f;    ///< metres above the building's ground: lower ones hide nothing of note
constexpr double kFarthestJut = 2;     ///< metres that a storey may stand out over the ground floor

/// Whether `upper` goes on above `lower` as high as `top`: in the same upright plane, over its whole length.
bool goesOnAbove(const city::OccluderLine& lower, float top, const city::OccluderLine& upper) {
  if (upper.bottom > top + 1e-3f || upper.top <= top) return false;
  const dvec2 a(lower.a), b(lower.b), along = b - a, dir = along / glm::length(along);
  const auto local = [&](glm::vec2 p) {
    const dvec2 d = dvec2(p) - a;
    return dvec2(glm::dot(d, dir), dir.x * d.y - dir.y * d.x);
  };
  const dvec2 from = local(upper.a), to = local(upper.b);
  if (std::abs(from.y) > kSamePoint || std::abs(to.y) > kSamePoint) return false;
  return from.x <= kSamePoint && to.x >= glm::length(along) - kSamePoint;
}

/// How far outside of `lower` the wall `upper` stands when it is that of a storey which juts out above it, its
/// underside closed by a floor from `reach` on (what stands out so far already); 0 where it is not. Behind such a front
/// the building is solid above the lower wall too.
double jutAbove(const city::BuildingGeometry& type, const city::OccluderLine& lower, float top, double reach,
                const city::OccluderLine& upper) {
  if (std::abs(upper.bottom - top) > 1e-3f || upper.top <= top) return 0;
  const dvec2 a(lower.a), b(lower.b), along = b - a, dir = along / glm::length(along);
  const auto local = [&](glm::vec2 p) {
    const dvec2 d = dvec2(p) - a;
    return dvec2(glm::dot(d, dir), dir.x * d.y - dir.y * d.x);
  };
  const dvec2 from = local(upper.a), to = local(upper.b);
  if (std::abs(from.y - to.y) > kSamePoint || from.y > -reach - kSamePoint || from.y < -kFarthestJut) return 0;
  if (from.x > kSamePoint || to.x < glm::length(along) - kSamePoint) return 0;
  // The floor between them is drawn, facing down, from one end to the other.
  for (const city::Plane& plane : type.planes) {
    if (plane.kind != city::PlaneKind::Floor || plane.normal.z > -0.99f || plane.cut.count == 0) continue;
    dvec2 lo(kInfinity), hi(-kInfinity);
    bool level = true;
    for (uint32_t i = plane.cut.first; i < plane.cut.end(); ++i) {
      const glm::vec3 p = type.vertices[type.indices[i]].position;
      level = level && std::abs(p.z - top) <= 1e-3f;
      lo = glm::min(lo, local(glm::vec2(p))), hi = glm::max(hi, local(glm::vec2(p)));
    }
    if (level && lo.x <= kSamePoint && hi.x >= glm::length(along) - kSamePoint && hi.y >= -reach - kSamePoint &&
        lo.y <= from.y + kSamePoint)
      return -from.y;
  }
  return 0;
}

std::vector<OccluderWall> wallsOf(const city::BuildingGeometry& type) {
  std::vector<OccluderWall> walls;
  for (const city::OccluderLine& line : type.occluders) {
    if (!(glm::distance(line.a, line.b) >= static_cast<float>(kSmallestWall)) || !(line.bottom <= 0)) continue;
    OccluderWall wall{dvec2(line.a), dvec2(line.b), line.bottom, line.top};
    // Storey upon storey, as often as one goes on above the others.
    for (bool grew = true; grew;) {
      grew = false;
      for (const city::OccluderLine& upper : type.occluders) {
        const double jut = jutAbove(type, line, wall.top, wall.reach, upper);
        if (jut > 0 || (wall.reach == 0 && goesOnAbove(line, wall.top, upper)))
          wall.top = upper.top, wall.reach = std::max(wall.reach, jut), grew = true;
      }
    }
    if (wall.top > kLowestWall) walls.push_back(wall);
  }
  for (uint32_t i = 0; i < walls.size(); ++i)
    for (uint32_t k = 0; k < walls.size(); ++k)
      if (i != k && walls[i].next == kNone && walls[k].previous == kNone &&
          glm::distance(walls[i].b, walls[k].a) <= kSamePoint) {
        walls[i].b = walls[k].a;
        walls[i].next = k, walls[k].previous = i;
      }
  return walls;
}

/// From a building's frame to the city's plan.
struct Placement {
  explicit Placement(const city::Instance& instance)
      : position(instance.position),
        cosine(std::cos(static_cast<double>(instance.heading))),
        sine(std::sin(static_cast<double>(instance.heading))) {}
  dvec2 operator()(dvec2 p) const {
    return {position.x + (cosine * p.x - sine * p.y), position.y + (sine * p.x + cosine * p.y)};
  }
  dvec3 position;
  double cosine, sine;
};

/// Whether the terrain is at or above the height `foot` all along a → b.
bool standsIn(const city::HeightField& terrain, dvec2 a, dvec2 b, double foot) {
  const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / kSampleStep)));
  for (int i = 0; i <= steps; ++i) {
    const dvec2 p = a + (b - a) * (static_cast<double>(i) / steps);
    const std::optional<double> ground = terrain.heightAt(p.x, p.y);
    if (!ground || *ground < foot + kInGround) return false;
  }
  return true;
}

// ---- The horizon ----------------------------------------------------------------------------------------------------

/// Directions on the plan fall into four faces, east, north, west and south, as on the sides of a cube around the eye.
/// Within a face a point has a depth (its distance along the face's axis) and a position u = sideways ÷ depth in −1 …
/// 1, growing counter-clockwise. A straight wall's 1 ÷ depth, and with it the slope of its top as the eye sees it
/// ((top − eye) ÷ depth), is linear in u: nothing in here needs an angle.
///
/// The depth of a point is the greater of |x| and |y|: the same number orders points in all faces.
constexpr int kFaces = 4;

/// A plan position relative to the eye, turned so that the face's axis is x.
dvec2 turned(dvec2 p, int face) {
  switch (face) {
    case 0:
      return p;
    case 1:
      return {p.y, -p.x};
    case 2:
      return -p;
    default:
      return {-p.y, p.x};
  }
}

/// A box on the plan relative to the eye, turned likewise.
struct PlanBox {
  dvec2 min, max;
};

PlanBox turned(const PlanBox& b, int face) {
  switch (face) {
    case 0:
      return b;
    case 1:
      return {{b.min.y, -b.max.x}, {b.max.y, -b.min.x}};
    case 2:
      return {-b.max, -b.min};
    default:
      return {{-b.max.y, b.min.x}, {-b.min.y, b.max.x}};
  }
}

double distanceToSegment2(dvec2 a, dvec2 b) {
  const dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0;
  const dvec2 nearest = a + t * along;
  return glm::dot(nearest, nearest);
}

double largerOf(dvec2 p) {
  return std::max(std::abs(p.x), std::abs(p.y));
}

class Horizon {
 public:
  /// Which ends of a wall no other wall of its chain goes on from.
  struct FreeEnds {
    bool first = false, last = false;
  };

  /// Columns that matter in a face, from `first` up to and without `end`.
  struct Active {
    int first = 0, end = 0;
  };

  Horizon(uint32_t columns, double sway) : perFace_(static_cast<int>(columns / kFaces)), sway_(sway) {
    slopes_.resize(static_cast<size_t>(perFace_) * kFaces);
  }

  void allRound() { active_.fill({0, perFace_}); }

  /// Only the directions counter-clockwise from `right` to `left`, less than half a turn.
  void between(dvec2 right, dvec2 left) {
    for (int face = 0; face < kFaces; ++face) {
      const dvec2 r = turned(right, face), l = turned(left, face);
      double from = -1, to = 1;
      // (1, u) is left of r where r.x · u − r.y ≥ 0, and right of l where l.y − l.x · u ≥ 0.
      const auto cut = [&](double a, double b) {  // a · u + b ≥ 0
        if (a > 0) from = std::max(from, -b / a);
        if (a < 0) to = std::min(to, -b / a);
        if (a == 0 && b < 0) to = -2;
      };
      cut(r.x, -r.y), cut(-l.x, l.y);
      if (from > to) continue;
      const int first = static_cast<int>(position(from)) - 1, last = static_cast<int>(position(to)) + 1;
      active_[static_cast<size_t>(face)] = {std::max(first, 0), std::min(last + 1, perFace_)};
    }
  }

  void clear() {
    for (int face = 0; face < kFaces; ++face)
      std::fill(row(face) + active_[static_cast<size_t>(face)].first,
                row(face) + active_[static_cast<size_t>(face)].end, -std::numeric_limits<float>::infinity());
  }

  /// Whether everything in the box, positions relative to the eye, lies below the horizon.
  bool hides(const PlanBox& box, double top) const {
    for (int face = 0; face < kFaces; ++face) {
      const Active active = active_[static_cast<size_t>(face)];
      if (active.first >= active.end) continue;
      const PlanBox b = turned(box, face);
      const double pad = kStray + sway_ * std::max(largerOf(b.min), largerOf(b.max));
      const double y0 = b.min.y - pad, y1 = b.max.y + pad, far = b.max.x + pad;
      const double sideways = y0 > 0 ? y0 : y1 < 0 ? -y1 : 0;  // the least |y|: nothing of this face is nearer
      if (far <= 0 || far < sideways) continue;
      const double near = std::max(b.min.x - pad, sideways);
      if (near <= kNearest) return false;
      const double from = std::max(y0 < 0 ? y0 / near : y0 / far, -1.0);
      const double to = std::min(y1 > 0 ? y1 / near : y1 / far, 1.0);
      const double slope = top > 0 ? top / near : top / far;
      const int first = std::max(static_cast<int>(position(from)), active.first);
      const int end = std::min(static_cast<int>(position(to)) + 1, active.end);
      if (!below(row(face), first, end, slope + 2 * sway_ * (1 + slope * slope) + kRounding * std::abs(slope)))
        return false;
    }
    return true;
  }

  /// Begins a chain of walls: the walls that follow touch each other.
  void beginChain() { column_ = -1; }

  /// The next wall of a chain, counter-clockwise from p to q relative to the eye, its top `top` above the eye; of it
  /// only what is not deeper than `limit`. The chain's free ends are drawn in by what the drawn ones may stray: between
  /// houses whose walls end in one line there may be a slit.
  void addWall(dvec2 p, dvec2 q, double top, double limit, FreeEnds free) {
    for (int face = firstFace(p), k = 0; k < kFaces; ++k, face = (face + 1) % kFaces) {
      const dvec2 a = turned(p, face), b = turned(q, face);
      // The part of a → b where |y| ≤ x; on the diagonals u is −1 or 1 exactly.
      const double a0 = a.y + a.x, b0 = b.y + b.x, a1 = a.x - a.y, b1 = b.x - b.y;
      double from = 0, to = 1;
      if (!clip(a0, b0, from, to) || !clip(a1, b1, from, to) || !(from < to)) {
        if (k > 0) return;
        continue;
      }
      double start = from, end = to;
      if (!clip(limit - a.x, limit - b.x, start, end) || !(start < end)) {
        beginChain();
        if (to == 1) return;
        continue;
      }
      if (start > from) beginChain();
      const auto at = [&](double t) { return t == 0 ? a : t == 1 ? b : a + t * (b - a); };
      const dvec2 s = at(start), e = at(end);
      if (!(s.x > 0) || !(e.x > 0)) return beginChain();
      const double u0 = start == from && from > 0 ? -1.0 : std::clamp(s.y / s.x, -1.0, 1.0);
      const double u1 = end == to && to < 1 ? 1.0 : std::clamp(e.y / e.x, -1.0, 1.0);
      double x0 = position(u0), x1 = position(u1), s0 = top / s.x, s1 = top / e.x;
      const double rise = x1 > x0 ? (s1 - s0) / (x1 - x0) : 0;
      const auto stray = [&](double depth) { return (kStray / depth + 2 * sway_) * (0.5 * perFace_); };
      if (free.first && start == 0) x0 += stray(s.x), s0 += rise * stray(s.x);
      if (free.last && end == 1) x1 -= stray(e.x), s1 -= rise * stray(e.x);
      if (x1 > x0 || !(free.first || free.last)) addPiece(face, x0, s0, x1, s1);
      if (end < to) beginChain();
      if (to == 1) return;
    }
  }

 private:
  static constexpr double kStray = 1e-3;     ///< metres by which what is drawn may stray: floats on their way
  static constexpr double kNearest = 0.01;   ///< metres: nearer boxes count as around the eye
  static constexpr double kRounding = 1e-6;  ///< relative: floats of the horizon, rounding of what is drawn

  float* row(int face) { return slopes_.data() + static_cast<ptrdiff_t>(face) * perFace_; }
  const float* row(int face) const { return slopes_.data() + static_cast<ptrdiff_t>(face) * perFace_; }

  /// In columns from the face's right edge: 0 … perFace.
  double position(double u) const { return (u + 1) * (0.5 * perFace_); }

  static int firstFace(dvec2 p) {
    for (int face = 0; face < kFaces; ++face) {
      const dvec2 t = turned(p, face);
      if (t.x > 0 && t.y >= -t.x && t.y < t.x) return face;
    }
    return 0;
  }

  /// Cuts [from, to] to where the linear function from va at 0 to vb at 1 is not negative.
  static bool clip(double va, double vb, double& from, double& to) {
    if (va < 0 && vb < 0) return false;
    if (va < 0) from = std::max(from, va / (va - vb));
    if (vb < 0) to = std::min(to, va / (va - vb));
    return true;
  }

  /// Whether the slope is below the horizon in all of the columns. Eight at a time without a branch between them, so
  /// that the compiler compares them at once.
  static bool below(const float* slopes, int first, int end, double slope) {
    float bound = static_cast<float>(slope);
    if (static_cast<double>(bound) < slope) bound = std::nextafter(bound, std::numeric_limits<float>::infinity());
    int i = first;
    for (; i + 8 <= end; i += 8) {
      int open = 0;
      for (int k = 0; k < 8; ++k) open += !(bound < slopes[i + k]);
      if (open > 0) return false;
    }
    for (; i < end; ++i)
      if (!(bound < slopes[i])) return false;
    return true;
  }

  /// A stretch from x0 to x1 (in columns of the face) whose slope goes from s0 to s1. Columns that the chain covers
  /// from edge to edge take the lowest slope that it has there.
  void addPiece(int face, double x0, double s0, double x1, double s1) {
    const Active active = active_[static_cast<size_t>(face)];
    if (x1 < active.first || x0 > active.end || active.first >= active.end) return beginChain();
    if (!(x1 > x0)) {
      if (column_ >= 0) lowest_ = std::min({lowest_, s0, s1});
      return;
    }
    if (column_ < 0 || face_ != face) {
      column_ = std::min(static_cast<int>(x0), perFace_ - 1);
      whole_ = x0 == static_cast<double>(column_);
      lowest_ = kInfinity;
      face_ = face;
    }
    const double slope = (s1 - s0) / (x1 - x0);
    double left = s0;
    if (column_ < active.first) {
      column_ = active.first, whole_ = x0 <= static_cast<double>(column_);
      lowest_ = kInfinity, left = s0 + (column_ - x0) * slope;
    }
    float* const out = row(face);
    while (column_ < active.end) {
      const double edge = column_ + 1;
      if (x1 < edge) {
        lowest_ = std::min({lowest_, left, s1});
        return;
      }
      const double right = x1 == edge ? s1 : s0 + (edge - x0) * slope;
      const auto value = static_cast<float>(std::min({lowest_, left, right}));
      if (whole_) out[column_] = std::max(out[column_], value);
      ++column_;
      whole_ = true, lowest_ = kInfinity, left = right;
      if (x1 == edge) return;
    }
    beginChain();
  }

  int perFace_;
  double sway_;  ///< radians by which what is drawn may stray
  std::array<Active, kFaces> active_{};
  std::vector<float> slopes_;
  // The chain's open column: whether all of it up to where the chain has come is covered, and how low.
  int face_ = 0, column_ = -1;
  bool whole_ = false;
  double lowest_ = kInfinity;
};

// ---- The walk -------------------------------------------------------------------------------------------------------

enum class Kind : uint8_t { BuildingNode, Building, TreeNode, Tree, Monument, Tile };

struct Entry {
  double distance;
  uint32_t index;
  Kind kind;
};

/// Nearest first; ties by kind and index, so that every run walks alike.
bool later(const Entry& a, const Entry& b) {
  if (a.distance != b.distance) return a.distance > b.distance;
  if (a.kind != b.kind) return a.kind > b.kind;
  return a.index > b.index;
}

/// A building whose walls join the horizon once the walk has come past them: what of them is not deeper than `distance`
/// less the recess.
struct Pending {
  double distance;
  uint32_t building;
  double farthest;  ///< after which all of them have joined
};

bool laterPending(const Pending& a, const Pending& b) {
  return a.distance != b.distance ? a.distance > b.distance : a.building > b.building;
}

/// The runs of a set that are still in the plan, and which of them were seen.
struct SetWalk {
  const city::InstanceSet& set;
  city::SetPlan& plan;
  std::vector<Range> seen;

  /// First drawn run that ends after `instance`.
  size_t runAt(uint32_t instance) const {
    return static_cast<size_t>(std::partition_point(plan.drawn.begin(), plan.drawn.end(),
                                                    [&](const Range& r) { return r.end() <= instance; }) -
                               plan.drawn.begin());
  }
  bool planned(Range run) const {
    const size_t k = runAt(run.first);
    return k < plan.drawn.size() && plan.drawn[k].first < run.end();
  }

  /// Leaves in the plan what was seen of what it held.
  void finish() {
    std::sort(seen.begin(), seen.end(), [](const Range& a, const Range& b) { return a.first < b.first; });
    std::vector<Range> drawn;
    std::vector<city::DroppedRange> dropped, hidden;
    uint64_t count = 0;
    size_t k = 0;
    for (const Range& run : plan.drawn) {
      uint32_t at = run.first;
      const auto hideUpTo = [&](uint32_t end) {
        if (end > at) hidden.push_back({{at, end - at}, city::DropReason::Occluded});
        at = std::max(at, end);
      };
      while (k < seen.size() && seen[k].first < run.end()) {
        const uint32_t first = std::max(seen[k].first, at), end = std::min(seen[k].end(), run.end());
        if (end > first) {
          hideUpTo(first);
          if (!drawn.empty() && drawn.back().end() == first)
            drawn.back().count += end - first;
          else
            drawn.push_back({first, end - first});
          count += end - first, at = end;
        }
        if (seen[k].end() > run.end()) break;
        ++k;
      }
      hideUpTo(run.end());
    }
    dropped.reserve(plan.dropped.size() + hidden.size());
    std::merge(plan.dropped.begin(), plan.dropped.end(), hidden.begin(), hidden.end(), std::back_inserter(dropped),
               [](const city::DroppedRange& a, const city::DroppedRange& b) { return a.range.first < b.range.first; });
    plan.drawn = std::move(drawn), plan.dropped = std::move(dropped), plan.drawnCount = count;
  }
};

class Walk {
 public:
  Walk(const City& city, const Occluders& occluders, Horizon& horizon, city::FramePlan& plan, CullMapStats& stats)
      : city_(city),
        occluders_(occluders),
        horizon_(horizon),
        plan_(plan),
        stats_(stats),
        eye_(plan.view.eye),
        clear_(clearanceOf(plan.view)),
        buildings_{city.buildings, plan.buildings, {}},
        trees_{city.trees, plan.trees, {}} {}

  void run() {
    if (!city_.buildings.nodes.empty()) offer(city_.buildings.nodes[0].bounds, 0, Kind::BuildingNode);
    if (!city_.trees.nodes.empty()) offer(city_.trees.nodes[0].bounds, 0, Kind::TreeNode);
    for (const uint32_t m : plan_.monuments) offer(city_.monuments[m].bounds, m, Kind::Monument);
    for (const uint32_t t : plan_.tiles) offer(city_.tiles[t].bounds, t, Kind::Tile);

    while (!open_.empty()) {
      std::pop_heap(open_.begin(), open_.end(), later);
      const Entry entry = open_.back();
      open_.pop_back();
      while (!pending_.empty() && pending_.front().distance <= entry.distance) addNextPending();
      if (stats_.boxTests >= kTrial && hiddenBoxes_ * kWorthwhile < stats_.boxTests) {
        stats_.gaveUp = true;
        see(entry);
        continue;
      }
      ++stats_.boxTests;
      if (hidden(boundsOf(entry))) {
        ++hiddenBoxes_;
        continue;
      }
      visit(entry);
    }
    buildings_.finish();
    trees_.finish();
    std::sort(monuments_.begin(), monuments_.end());
    std::sort(tiles_.begin(), tiles_.end());
    plan_.monuments = std::move(monuments_);
    plan_.tiles = std::move(tiles_);
  }

 private:
  /// After kTrial boxes the walk goes on only while one in kWorthwhile was hidden. Tuned on flights over the town of
  /// tests/bench/cull_map.cpp, where little is hidden and looking for it costs more than drawing it.
  static constexpr uint64_t kTrial = 1024, kWorthwhile = 8;

  /// Metres about the eye within which the near plane may cut a surface open.
  static double clearanceOf(const city::ViewState& view) {
    const double up = std::tan(view.verticalFov / 2), right = up * view.aspect();
    return 0.02 + 1.01 * view.nearDistance * std::sqrt(1 + up * up + right * right);
  }

  const Aabbf& boundsOf(const Entry& entry) const {
    switch (entry.kind) {
      case Kind::BuildingNode:
        return city_.buildings.nodes[entry.index].bounds;
      case Kind::Building:
        return city_.buildings.bounds[entry.index];
      case Kind::TreeNode:
        return city_.trees.nodes[entry.index].bounds;
      case Kind::Tree:
        return city_.trees.bounds[entry.index];
      case Kind::Monument:
        return city_.monuments[entry.index].bounds;
      case Kind::Tile:
        break;
    }
    return city_.tiles[entry.index].bounds;
  }

  PlanBox relative(const Aabbf& box) const {
    return {{static_cast<double>(box.min.x) - eye_.x, static_cast<double>(box.min.y) - eye_.y},
            {static_cast<double>(box.max.x) - eye_.x, static_cast<double>(box.max.y) - eye_.y}};
  }

  /// Depth of the box's nearest point, whatever the face.
  double distanceOf(const Aabbf& box) const {
    const PlanBox b = relative(box);
    const double x = std::max({b.min.x, -b.max.x, 0.0}), y = std::max({b.min.y, -b.max.y, 0.0});
    return std::max(x, y);
  }

  bool hidden(const Aabbf& box) const { return horizon_.hides(relative(box), static_cast<double>(box.max.z) - eye_.z); }

  void offer(const Aabbf& box, uint32_t index, Kind kind) {
    open_.push_back({distanceOf(box), index, kind});
    std::push_heap(open_.begin(), open_.end(), later);
  }

  void offerNode(SetWalk& walk, uint32_t index, Kind node, Kind instance) {
    const city::BoundsNode& n = walk.set.nodes[index];
    for (uint32_t child = n.firstChild; child < n.firstChild + n.childCount; ++child)
      if (walk.planned(walk.set.nodes[child].instances)) offer(walk.set.nodes[child].bounds, child, node);
    if (n.childCount > 0) return;
    for (size_t k = walk.runAt(n.instances.first); k < walk.plan.drawn.size(); ++k) {
      const Range& run = walk.plan.drawn[k];
      if (run.first >= n.instances.end()) break;
      const uint32_t end = std::min(run.end(), n.instances.end());
      for (uint32_t i = std::max(run.first, n.instances.first); i < end; ++i) offer(walk.set.bounds[i], i, instance);
    }
  }

  void visit(const Entry& entry) {
    switch (entry.kind) {
      case Kind::BuildingNode:
        return offerNode(buildings_, entry.index, Kind::BuildingNode, Kind::Building);
      case Kind::TreeNode:
        return offerNode(trees_, entry.index, Kind::TreeNode, Kind::Tree);
      case Kind::Building:
        see(entry);
        return prepare(entry.index);
      default:
        return see(entry);
    }
  }

  void see(const Entry& entry) {
    switch (entry.kind) {
      case Kind::BuildingNode:
        buildings_.seen.push_back(city_.buildings.nodes[entry.index].instances);
        break;
      case Kind::Building:
        buildings_.seen.push_back({entry.index, 1});
        break;
      case Kind::TreeNode:
        trees_.seen.push_back(city_.trees.nodes[entry.index].instances);
        break;
      case Kind::Tree:
        trees_.seen.push_back({entry.index, 1});
        break;
      case Kind::Monument:
        monuments_.push_back(entry.index);
        break;
      case Kind::Tile:
        tiles_.push_back(entry.index);
        break;
    }
  }

  /// Puts a building that is seen on the list of those whose walls come next.
  void prepare(uint32_t building) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    if (range.count == 0) return;
    if (place(building) == 0) return;
    double farthest = 0;
    for (uint32_t i = 0; i < range.count; ++i)
      if (placed_[i].faces) farthest = std::max({farthest, largerOf(placed_[i].a), largerOf(placed_[i].b)});
    const double recess = static_cast<double>(occluders_.recess[instance.geometry]);
    const double first = kWholeHouse + 2 * distanceOf(city_.buildings.bounds[building]);
    pend({std::min(first, farthest + recess), building, farthest + recess});
  }

  void pend(const Pending& pending) {
    pending_.push_back(pending);
    std::push_heap(pending_.begin(), pending_.end(), laterPending);
  }

  /// Places a building's walls about the eye; how many of them face it.
  int place(uint32_t building) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    const uint8_t* stands = occluders_.stands.data() + occluders_.firstOfBuilding[building];
    const Placement cityFromBuilding(instance);
    placed_.resize(range.count);
    int facing = 0;
    for (uint32_t i = 0; i < range.count; ++i) {
      const OccluderWall& wall = occluders_.walls[range.first + i];
      PlacedWall& p = placed_[i];
      p.faces = p.done = false;
      if (!stands[i]) continue;
      const dvec2 eye(eye_);
      p.a = cityFromBuilding(wall.a) - eye, p.b = cityFromBuilding(wall.b) - eye;
      const dvec2 along = p.b - p.a;
      // Outside is on the right of a → b. The eye, at 0, is this far outside:
      const double outside = (along.x * p.a.y - along.y * p.a.x) / glm::length(along);
      if (!(outside > (wall.reach > 0 ? wall.reach + clear_ : kFacing))) continue;
      if (!occluders_.terrain && instance.position.z + static_cast<double>(wall.bottom) > eye_.z) continue;
      if (distanceToSegment2(p.a, p.b) < clear_ * clear_) continue;
      p.faces = true;
      ++facing;
    }
    return facing;
  }

  void addNextPending() {
    std::pop_heap(pending_.begin(), pending_.end(), laterPending);
    const Pending now = pending_.back();
    pending_.pop_back();
    const uint32_t building = now.building;
    limit_ = now.distance - static_cast<double>(occluders_.recess[city_.buildings.instances[building].geometry]);
    if (now.distance < now.farthest)
      pend({std::min(2 * now.distance, now.farthest), building, now.farthest});
    else
      limit_ = kInfinity;
    place(building);
    const auto count = static_cast<uint32_t>(placed_.size());
    // Chains run counter-clockwise, against the walls' own sense: each begins at a wall without a neighbour there.
    for (uint32_t i = 0; i < count; ++i)
      if (placed_[i].faces && !facingNext(building, i)) addChain(building, i);
    // What is left goes all round the eye: a court.
    for (uint32_t i = 0; i < count; ++i)
      if (placed_[i].faces && !placed_[i].done) addChain(building, i);
  }

  bool facingNext(uint32_t building, uint32_t i) const {
    const Range range = occluders_.ofType[city_.buildings.instances[building].geometry];
    const uint32_t next = occluders_.walls[range.first + i].next;
    return next != kNone && placed_[next].faces;
  }

  void addChain(uint32_t building, uint32_t i) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    horizon_.beginChain();
    const auto goesOn = [&](uint32_t k) { return k != kNone && placed_[k].faces && !placed_[k].done; };
    for (bool first = true; goesOn(i); first = false) {
      const OccluderWall& wall = occluders_.walls[range.first + i];
      placed_[i].done = true;
      horizon_.addWall(placed_[i].b, placed_[i].a,
                       instance.position.z + static_cast<double>(wall.top) - kLessHigh - eye_.z, limit_,
                       {first, !goesOn(wall.previous)});
      ++stats_.occluders;
      i = wall.previous;
    }
  }

  /// Metres: a building that reaches on this far behind its nearest point adds its walls all at once; a longer one,
  /// near the eye, adds them piece by piece as the walk comes past.
  static constexpr double kWholeHouse = 32;
  static constexpr double kFacing = 0.005;  ///< metres: an eye nearer to a wall's plane sees it edge on

  struct PlacedWall {
    dvec2 a, b;
    bool faces = false, done = false;
  };

  const City& city_;
  const Occluders& occluders_;
  Horizon& horizon_;
  city::FramePlan& plan_;
  CullMapStats& stats_;
  dvec3 eye_;
  double clear_;
  SetWalk buildings_, trees_;
  std::vector<uint32_t> monuments_, tiles_;
  std::vector<Entry> open_;
  std::vector<Pending> pending_;
  std::vector<PlacedWall> placed_;
  double limit_ = kInfinity;  ///< depth up to which walls may join the horizon now
  uint64_t hiddenBoxes_ = 0;
};

/// Narrows the horizon to the directions in the picture; all round where the picture holds a direction straight up or
/// down.
void narrow(Horizon& horizon, const city::ViewState& view) {
  const double up = std::tan(view.verticalFov / 2), right = up * view.aspect();
  const dvec2 forward = dvec2(view.forward);
  const dvec2 ahead = forward / glm::length(forward);
  dvec2 leftmost(0), rightmost(0);
  double most = -kInfinity, least = kInfinity;
  for (const double v : {-up, up})
    for (const double h : {-right, right}) {
      const dvec3 d = view.forward + h * view.right + v * view.up;
      const dvec2 corner(d);
      const double along = glm::dot(corner, ahead);
      if (!(along > 1e-3 * glm::length(d))) return horizon.allRound();
      const double sideways = (ahead.x * corner.y - ahead.y * corner.x) / along;
      if (sideways > most) most = sideways, leftmost = corner;
      if (sideways < least) least = sideways, rightmost = corner;
    }
  horizon.between(rightmost, leftmost);
}

/// Why nothing can be hidden from this eye; empty where something may.
std::string_view reasonAgainst(const City& city, const Occluders& occluders, dvec3 eye) {
  if (!std::isfinite(eye.x) || !std::isfinite(eye.y) || !std::isfinite(eye.z)) return "the eye is nowhere";
  if (eye.z >= occluders.highest) return "the eye is above all roofs";
  if (!occluders.terrain) return eye.z > occluders.lowest ? "" : "the eye is below the ground";
  const city::HeightField& terrain = *city.terrain;
  const dvec2 lo = terrain.origin, hi = terrain.origin + terrain.extent();
  if (eye.x < lo.x || eye.y < lo.y || eye.x > hi.x || eye.y > hi.y)
    return eye.z > static_cast<double>(terrain.maxHeight) ? "" : "the eye is beside the terrain, not above it";
  const std::optional<double> ground = terrain.heightAt(eye.x, eye.y);
  return !ground || eye.z > *ground ? "" : "the eye is below the ground";
}

}  // namespace

Occluders occludersOf(const City& city) {
  Occluders out;
  out.ofType.reserve(city.buildingTypes.size());
  for (const city::BuildingGeometry& type : city.buildingTypes) {
    const std::vector<OccluderWall> walls = wallsOf(type);
    out.ofType.push_back({static_cast<uint32_t>(out.walls.size()), static_cast<uint32_t>(walls.size())});
    out.walls.insert(out.walls.end(), walls.begin(), walls.end());
    float recess = 0;
    for (const city::ExternalOpening& opening : type.externalOpenings) recess = std::max(recess, opening.depth);
    out.recess.push_back(recess);
  }

  out.terrain = city.terrain && !city.terrain->empty();
  out.lowest = kInfinity, out.highest = -kInfinity;
  const auto reach = [&](const Aabbf& box) {
    if (box.empty()) return;
    out.lowest = std::min(out.lowest, static_cast<double>(box.min.z));
    out.highest = std::max(out.highest, static_cast<double>(box.max.z));
  };
  for (const city::InstanceSet* set : {&city.buildings, &city.trees})
    if (!set->nodes.empty()) reach(set->nodes[0].bounds);
  for (const city::Monument& monument : city.monuments) reach(monument.bounds);

  out.firstOfBuilding.reserve(city.buildings.size() + 1);
  for (const city::Instance& instance : city.buildings.instances) {
    out.firstOfBuilding.push_back(static_cast<uint32_t>(out.stands.size()));
    const Range range = out.ofType[instance.geometry];
    const Placement cityFromBuilding(instance);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const OccluderWall& wall = out.walls[i];
      const double foot = instance.position.z + static_cast<double>(wall.bottom);
      const bool stands = out.terrain
                              ? standsIn(*city.terrain, cityFromBuilding(wall.a), cityFromBuilding(wall.b), foot)
                              : foot <= out.lowest + kSamePoint;
      out.stands.push_back(stands);
      out.standing += stands;
    }
  }
  out.firstOfBuilding.push_back(static_cast<uint32_t>(out.stands.size()));
  return out;
}

CullMapStats cullOccluded(const City& city, const Occluders& occluders, const CullMapOptions& options,
                          city::FramePlan& plan) {
  CullMapStats stats;
  stats.off = occluders.standing == 0 ? "no walls that hide" : reasonAgainst(city, occluders, plan.view.eye);
  if (!stats.off.empty()) return stats;
  const double pixel = 2 * std::tan(plan.view.verticalFov / 2) / plan.view.viewport.y;
  Horizon horizon(std::max(options.columns / kFaces, 1u) * kFaces, pixel / 64);
  if (options.onlyInView)
    narrow(horizon, plan.view);
  else
    horizon.allRound();
  horizon.clear();
  Walk(city, occluders, horizon, plan, stats).run();
  return stats;
}

}  // namespace vicus::culling
