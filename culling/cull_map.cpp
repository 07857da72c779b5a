#include "culling/cull_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "culling/horizon.hpp"
#include "culling/placed_walls.hpp"
#include "culling/plan_walk.hpp"
#include "culling/set_walk.hpp"

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::City;
using city::kNone;
using city::Range;
using glm::dvec2;
using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// ---- The walk -------------------------------------------------------------------------------------------------------

enum class Kind : uint8_t { BuildingNode, Building, TreeNode, Tree, Monument, Tile, Avatar };

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
  uint32_t building;  ///< or `kMonumentWalls` + a monument's wall
  double farthest;    ///< after which all of them have joined
};

constexpr uint32_t kMonumentWalls = 1U << 31U;

bool laterPending(const Pending& a, const Pending& b) {
  return a.distance != b.distance ? a.distance > b.distance : a.building > b.building;
}

class Walk {
 public:
  Walk(const City& city, const Occluders& occluders, Horizon& horizon, city::FramePlan& plan, CullMapStats& stats,
       CullMapView* shown)
      : city_(city),
        occluders_(occluders),
        horizon_(horizon),
        plan_(plan),
        stats_(stats),
        shown_(shown),
        eye_(plan.view.eye),
        placer_(city, occluders, plan.view),
        buildings_{city.buildings, plan.buildings, {}},
        trees_{city.trees, plan.trees, {}} {}

  void run() {
    if (!city_.buildings.nodes.empty()) offer(city_.buildings.nodes[0].bounds, 0, Kind::BuildingNode);
    if (!city_.trees.nodes.empty()) offer(city_.trees.nodes[0].bounds, 0, Kind::TreeNode);
    for (const uint32_t m : plan_.monuments) offer(city_.monuments[m].bounds, m, Kind::Monument);
    for (const uint32_t t : plan_.tiles) offer(city_.tiles[t].bounds, t, Kind::Tile);
    for (uint32_t a = 0; a < plan_.avatars.drawn.size(); ++a) offer(plan_.avatars.drawn[a].bounds, a, Kind::Avatar);

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
      if (hidden(boundsOf(entry)) || (entry.kind == Kind::Building && slabsHidden(entry.index))) {
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
    std::sort(avatars_.begin(), avatars_.end());
    for (size_t k = 0; k < avatars_.size(); ++k) plan_.avatars.drawn[k] = plan_.avatars.drawn[avatars_[k]];
    plan_.avatars.drawn.resize(avatars_.size());
  }

 private:
  /// After kTrial boxes the walk goes on only while one in kWorthwhile was hidden. Tuned on flights over the town of
  /// tests/bench/cull_map.cpp, where little is hidden and looking for it costs more than drawing it.
  static constexpr uint64_t kTrial = 1024, kWorthwhile = 8;

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
      case Kind::Avatar:
        return plan_.avatars.drawn[entry.index].bounds;
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

  /// Whether each slab of a building lies below the horizon: asked where its box does not.
  bool slabsHidden(uint32_t building) const {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.slabsOfType[instance.geometry];
    if (range.count == 1 && instance.heading == 0) return false;  // the box says it all
    const Placement cityFromBuilding(instance);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const BuildingSlab& s = occluders_.slabs[i];
      const dvec2 eye(eye_);
      const std::array<dvec2, 4> corners = {cityFromBuilding(s.min) - eye, cityFromBuilding({s.max.x, s.min.y}) - eye,
                                            cityFromBuilding(s.max) - eye, cityFromBuilding({s.min.x, s.max.y}) - eye};
      if (!horizon_.hides(corners, instance.position.z + s.top - eye_.z)) return false;
    }
    return true;
  }

  void offer(const Aabbf& box, uint32_t index, Kind kind) {
    open_.push_back({distanceOf(box), index, kind});
    std::push_heap(open_.begin(), open_.end(), later);
  }

  void offerNode(SetWalk& walk, uint32_t index, Kind node, Kind instance) {
    const city::BoundsNode& n = walk.set.nodes[index];
    for (uint32_t child = n.firstChild; child < n.firstChild + n.childCount; ++child)
      if (walk.planned(walk.set.nodes[child].instances)) offer(walk.set.nodes[child].bounds, child, node);
    if (n.childCount > 0) return;
    walk.forEachPlanned(n.instances, [&](uint32_t i) { offer(walk.set.bounds[i], i, instance); });
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
      case Kind::Monument:
        see(entry);
        return prepareMonument(entry.index);
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
      case Kind::Avatar:
        avatars_.push_back(entry.index);
        break;
    }
  }

  /// Puts a building that is seen on the list of those whose walls come next.
  void prepare(uint32_t building) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    if (range.count == 0) return;
    if (placer_.place(building) == 0) return;
    double farthest = 0;
    for (uint32_t i = 0; i < range.count; ++i)
      if (placer_.walls[i].faces)
        farthest = std::max({farthest, largerOf(placer_.walls[i].a), largerOf(placer_.walls[i].b)});
    forEachCap(building, [&](const OccluderCap& cap) {
      for (const dvec3& p : capPoints(cap, Placement(instance))) farthest = std::max(farthest, largerOf(dvec2(p)));
    });
    const double recess = static_cast<double>(occluders_.recess[instance.geometry]);
    const double first = kWholeHouse + 2 * distanceOf(city_.buildings.bounds[building]);
    pend({std::min(first, farthest + recess), building, farthest + recess});
  }

  /// Each of a monument's walls joins by itself: a town wall is long.
  void prepareMonument(uint32_t monument) {
    const Range range = occluders_.ofMonument[monument];
    const dvec2 eye(eye_);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const MeshWall& wall = occluders_.monumentWalls[i];
      if (!placer_.faces(wall)) continue;
      const dvec2 a = wall.a - eye, b = wall.b - eye;
      const double farthest = std::max(largerOf(a), largerOf(b));
      pend({farthest, kMonumentWalls + i, farthest});
    }
  }

  void addMonumentWall(uint32_t index) {
    const MeshWall& wall = occluders_.monumentWalls[index];
    const dvec2 eye(eye_);
    const double less = kLessHigh + eye_.z;
    horizon_.beginChain();
    addToHorizon(dvec3(wall.b - eye, wall.topB - less), dvec3(wall.a - eye, wall.topA - less), kInfinity, {true, true});
    ++stats_.occluders;
  }

  void addToHorizon(const dvec3& p, const dvec3& q, double limit, Horizon::FreeEnds free) {
    horizon_.addWall(p, q, limit, free);
    if (shown_) shown_->occluders.push_back({eye_ + p, eye_ + q});
  }

  void pend(const Pending& pending) {
    pending_.push_back(pending);
    std::push_heap(pending_.begin(), pending_.end(), laterPending);
  }

  void addNextPending() {
    std::pop_heap(pending_.begin(), pending_.end(), laterPending);
    const Pending now = pending_.back();
    pending_.pop_back();
    const uint32_t building = now.building;
    if (building >= kMonumentWalls) return addMonumentWall(building - kMonumentWalls);
    limit_ = now.distance - static_cast<double>(occluders_.recess[city_.buildings.instances[building].geometry]);
    if (now.distance < now.farthest)
      pend({std::min(2 * now.distance, now.farthest), building, now.farthest});
    else
      limit_ = kInfinity;
    placer_.place(building);
    const auto count = static_cast<uint32_t>(placer_.walls.size());
    // Chains run counter-clockwise, against the walls' own sense: each begins at a wall without a neighbour there.
    for (uint32_t i = 0; i < count; ++i)
      if (placer_.walls[i].faces && !facingNext(building, i)) addChain(building, i);
    // What is left goes all round the eye: a court.
    for (uint32_t i = 0; i < count; ++i)
      if (placer_.walls[i].faces && !placer_.walls[i].done) addChain(building, i);
    forEachCap(building, [&](const OccluderCap& cap) { addCap(building, cap); });
  }

  /// Calls `run` for each gable and slope of the placed building whose wall faces the eye and which does so itself.
  template <typename Run>
  void forEachCap(uint32_t building, const Run& run) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range caps = occluders_.capsOfType[instance.geometry];
    if (caps.count == 0) return;
    const Placement cityFromBuilding(instance);
    const dvec3 d = eye_ - instance.position;
    const dvec3 eye(cityFromBuilding.cosine * d.x + cityFromBuilding.sine * d.y,
                    cityFromBuilding.cosine * d.y - cityFromBuilding.sine * d.x, d.z);
    for (uint32_t c = caps.first; c < caps.end(); ++c) {
      const OccluderCap& cap = occluders_.caps[c];
      const auto above = [&](const glm::dvec4& plane) { return glm::dot(dvec3(plane), eye) + plane.w > kFacing; };
      if (placer_.walls[cap.wall].faces && above(cap.above[0]) && above(cap.above[1])) run(cap);
    }
  }

  /// A cap's upper edge about the eye, counter-clockwise.
  const std::vector<dvec3>& capPoints(const OccluderCap& cap, const Placement& cityFromBuilding) {
    capPoints_.clear();
    for (uint32_t i = cap.points.first; i < cap.points.end(); ++i) {
      const dvec3& p = occluders_.capPoints[i];
      capPoints_.emplace_back(cityFromBuilding(dvec2(p)) - dvec2(eye_),
                              cityFromBuilding.position.z + p.z - kLessHigh - eye_.z);
    }
    return capPoints_;
  }

  /// Raises the horizon to the cap's upper edge, as far as the wall below it goes.
  void addCap(uint32_t building, const OccluderCap& cap) {
    const city::Instance& instance = city_.buildings.instances[building];
    const OccluderWall& wall = occluders_.walls[occluders_.ofType[instance.geometry].first + cap.wall];
    const PlacedWall& placed = placer_.walls[cap.wall];
    const dvec2 along = glm::normalize(placed.b - placed.a), out = dvec2(along.y, -along.x) * wall.reach;
    const std::vector<dvec3>& points = capPoints(cap, Placement(instance));
    const auto cross = [](dvec2 a, dvec2 b) { return a.x * b.y - a.y * b.x; };
    // Between the directions of the wall's ends, and of those of the storey that stands out above it.
    const dvec2 right[] = {placed.b, placed.b + out}, left[] = {placed.a, placed.a + out};
    pieces_.clear();
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const dvec3 p = points[i], q = points[i + 1];
      if (!(cross(dvec2(p), dvec2(q)) > 0)) continue;
      double from = 0, to = 1;
      const auto keep = [&](double atP, double atQ) {
        if (atP < 0 && atQ < 0) to = -1;
        if (atP < 0 && atQ > 0) from = std::max(from, atP / (atP - atQ));
        if (atQ < 0 && atP > 0) to = std::min(to, atP / (atP - atQ));
      };
      for (const dvec2& r : right) keep(cross(r, dvec2(p)), cross(r, dvec2(q)));
      for (const dvec2& l : left) keep(cross(dvec2(p), l), cross(dvec2(q), l));
      if (from < to) pieces_.emplace_back(glm::mix(p, q, from), glm::mix(p, q, to));
    }
    horizon_.beginChain();
    for (size_t i = 0; i < pieces_.size(); ++i) {
      const bool joined = i > 0 && pieces_[i - 1].second == pieces_[i].first;
      const bool goesOn = i + 1 < pieces_.size() && pieces_[i + 1].first == pieces_[i].second;
      if (!joined) horizon_.beginChain();
      addToHorizon(pieces_[i].first, pieces_[i].second, limit_, {!joined, !goesOn});
    }
    ++stats_.occluders;
  }

  bool facingNext(uint32_t building, uint32_t i) const {
    const Range range = occluders_.ofType[city_.buildings.instances[building].geometry];
    const uint32_t next = occluders_.walls[range.first + i].next;
    return next != kNone && placer_.walls[next].faces;
  }

  void addChain(uint32_t building, uint32_t i) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    horizon_.beginChain();
    const auto goesOn = [&](uint32_t k) { return k != kNone && placer_.walls[k].faces && !placer_.walls[k].done; };
    for (bool first = true; goesOn(i); first = false) {
      const OccluderWall& wall = occluders_.walls[range.first + i];
      placer_.walls[i].done = true;
      const double top = instance.position.z + static_cast<double>(wall.top) - kLessHigh - eye_.z;
      addToHorizon(dvec3(placer_.walls[i].b, top), dvec3(placer_.walls[i].a, top), limit_,
                   {first, !goesOn(wall.previous)});
      ++stats_.occluders;
      i = wall.previous;
    }
  }

  /// Metres: a building that reaches on this far behind its nearest point adds its walls all at once; a longer one,
  /// near the eye, adds them piece by piece as the walk comes past.
  static constexpr double kWholeHouse = 32;

  const City& city_;
  const Occluders& occluders_;
  Horizon& horizon_;
  city::FramePlan& plan_;
  CullMapStats& stats_;
  CullMapView* shown_;
  dvec3 eye_;
  PlacedWalls placer_;
  SetWalk buildings_, trees_;
  std::vector<uint32_t> monuments_, tiles_, avatars_;
  std::vector<Entry> open_;
  std::vector<Pending> pending_;
  std::vector<dvec3> capPoints_;
  std::vector<std::pair<dvec3, dvec3>> pieces_;
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

CullMapStats cullOccluded(const City& city, const Occluders& occluders, const CullMapOptions& options,
                          city::FramePlan& plan, CullMapView* shown) {
  CullMapStats stats;
  stats.off = occluders.standing == 0 ? "no walls that hide" : reasonAgainst(city, occluders, plan.view.eye);
  if (!stats.off.empty()) return stats;
  if (options.kind != CullMapKind::Horizon) return cullOnPlan(city, occluders, options, plan, shown);
  const double pixel = 2 * std::tan(plan.view.verticalFov / 2) / plan.view.viewport.y;
  Horizon horizon(std::max(options.columns / kFaces, 1u) * kFaces, pixel / 64);
  if (options.onlyInView)
    narrow(horizon, plan.view);
  else
    horizon.allRound();
  horizon.clear();
  Walk(city, occluders, horizon, plan, stats, shown).run();
  if (shown) shown->columns = horizon.columns(), shown->slopes = horizon.slopes();
  return stats;
}

}  // namespace vicus::culling
