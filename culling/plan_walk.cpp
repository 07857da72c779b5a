#include "culling/plan_walk.hpp"

#include <algorithm>
#include <cmath>

#include "culling/placed_walls.hpp"
#include "culling/plan_map.hpp"
#include "culling/set_walk.hpp"

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::City;
using city::kNone;
using city::Range;
using glm::dvec2;
using glm::dvec3;

class PlanWalk {
 public:
  PlanWalk(const City& city, const Occluders& occluders, const CullMapOptions& options, city::FramePlan& plan,
           CullMapStats& stats, CullMapView* shown)
      : city_(city),
        occluders_(occluders),
        options_(options),
        plan_(plan),
        stats_(stats),
        shown_(shown),
        eye_(plan.view.eye),
        placer_(city, occluders, plan.view),
        map_(options.cells, kFinestCell, reachOf(city, eye_), swayOf(plan.view),
             options.kind == CullMapKind::Published),
        buildings_{city.buildings, plan.buildings, {}},
        trees_{city.trees, plan.trees, {}} {}

  void run() {
    if (options_.kind == CullMapKind::Published) return runPublished();
    drawNearest();
    map_.finish(occluders_.lowest - eye_.z, occluders_.highest - eye_.z);
    if (!city_.buildings.nodes.empty()) look(buildings_, 0);
    if (!city_.trees.nodes.empty()) look(trees_, 0);
    buildings_.finish();
    trees_.finish();
    std::erase_if(plan_.monuments, [&](uint32_t m) { return hidden(city_.monuments[m].bounds); });
    std::erase_if(plan_.avatars.drawn, [&](const city::AvatarDraw& a) { return hidden(a.bounds); });
    std::erase_if(plan_.tiles, [&](uint32_t t) { return hidden(city_.tiles[t].bounds); });
    show();
  }

 private:
  static constexpr int kLocalTiles = 1;     ///< the published local model: the eye's tile and those about it
  static constexpr double kFinestCell = 1;  ///< metres: less than the width of a house

  static double reachOf(const City& city, dvec3 eye) {
    const dvec2 lo(city.extent.min), hi(city.extent.max);
    return 1 + std::max(largerOf(lo - dvec2(eye)), largerOf(hi - dvec2(eye)));
  }
  static double swayOf(const city::ViewState& view) {
    return 2 * std::tan(view.verticalFov / 2) / view.viewport.y / 64;
  }

  PlanBox relative(const Aabbf& box) const { return {dvec2(dvec3(box.min) - eye_), dvec2(dvec3(box.max) - eye_)}; }
  double distanceOf(const Aabbf& box) const {
    const PlanBox b = relative(box);
    return glm::length(glm::max(glm::max(b.min, -b.max), dvec2(0)));
  }
  bool hidden(const Aabbf& box) {
    ++stats_.boxTests;
    return map_.hides(relative(box), static_cast<double>(box.max.z) - eye_.z);
  }

  /// The walls of the nearest planned buildings, until there are as many as the budget allows.
  void drawNearest() {
    struct Near {
      double distance;
      uint32_t index;
      bool node;
    };
    const auto later = [](const Near& a, const Near& b) {
      return a.distance != b.distance ? a.distance > b.distance : a.index > b.index;
    };
    std::vector<Near> open;
    const auto offer = [&](const Aabbf& box, uint32_t index, bool node) {
      open.push_back({distanceOf(box), index, node});
      std::push_heap(open.begin(), open.end(), later);
    };
    if (!city_.buildings.nodes.empty()) offer(city_.buildings.nodes[0].bounds, 0, true);
    while (!open.empty() && stats_.occluders < options_.budget) {
      std::pop_heap(open.begin(), open.end(), later);
      const Near near = open.back();
      open.pop_back();
      if (!near.node) {
        drawBuilding(near.index);
        continue;
      }
      const city::BoundsNode& node = city_.buildings.nodes[near.index];
      for (uint32_t child = node.firstChild; child < node.firstChild + node.childCount; ++child)
        if (buildings_.planned(city_.buildings.nodes[child].instances))
          offer(city_.buildings.nodes[child].bounds, child, true);
      if (node.childCount > 0) continue;
      buildings_.forEachPlanned(node.instances, [&](uint32_t i) { offer(city_.buildings.bounds[i], i, false); });
    }
  }

  void drawBuilding(uint32_t building) {
    if (placer_.place(building) == 0) return;
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    const auto shadow = [&](uint32_t i) {
      const double top =
          instance.position.z + static_cast<double>(occluders_.walls[range.first + i].top) - kLessHigh - eye_.z;
      return ShadowWall{dvec3(placer_.walls[i].b, top), dvec3(placer_.walls[i].a, top)};
    };
    for (uint32_t i = 0; i < range.count; ++i) {
      if (!placer_.walls[i].faces) continue;
      add(shadow(i));
      const uint32_t next = occluders_.walls[range.first + i].previous;
      if (next != kNone && placer_.walls[next].faces) map_.addJoint(shadow(i), shadow(next));
    }
  }

  /// Willmott et al. 2001, §3.2.5 to §3.2.8: all occluder lines of the local model's buildings, whichever way they
  /// face, shrunk by half a cell at both ends; what is not in the local model is hidden where the highest point over
  /// its centre lies below the map. (The printed test is the other way round.) Trees and monuments are not culled.
  void runPublished() {
    const auto inLocalModel = [&](uint32_t building) {
      const dvec3& p = city_.buildings.instances[building].position;
      const glm::ivec2 at(city_.grid.cell(city_.grid.tileAt(p.x, p.y)));
      const glm::ivec2 here(city_.grid.cell(city_.grid.tileAt(eye_.x, eye_.y)));
      return std::max(std::abs(at.x - here.x), std::abs(at.y - here.y)) <= kLocalTiles;
    };
    const Range all = {0, static_cast<uint32_t>(city_.buildings.size())};
    buildings_.forEachPlanned(all, [&](uint32_t i) {
      if (inLocalModel(i)) drawPublished(i);
    });
    map_.finish(occluders_.lowest - eye_.z, occluders_.highest - eye_.z);
    buildings_.forEachPlanned(all, [&](uint32_t i) {
      if (inLocalModel(i) || !hidden(city_.buildings.bounds[i])) buildings_.seen.push_back({i, 1});
    });
    buildings_.finish();
    show();
  }

  void drawPublished(uint32_t building) {
    const city::Instance& instance = city_.buildings.instances[building];
    const Range range = occluders_.ofType[instance.geometry];
    const Placement cityFromBuilding(instance);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const OccluderWall& wall = occluders_.walls[i];
      dvec2 a = cityFromBuilding(wall.a) - dvec2(eye_), b = cityFromBuilding(wall.b) - dvec2(eye_);
      const dvec2 along = glm::normalize(b - a);
      if (glm::distance(a, b) <= map_.cellSize()) continue;
      a += 0.5 * map_.cellSize() * along, b -= 0.5 * map_.cellSize() * along;
      if (a.x * b.y - a.y * b.x > 0) std::swap(a, b);
      const double top = instance.position.z + static_cast<double>(wall.top) - eye_.z;
      add({dvec3(b, top), dvec3(a, top)});
    }
  }

  void add(const ShadowWall& wall) {
    map_.add(wall);
    ++stats_.occluders;
    if (shown_) shown_->occluders.push_back({eye_ + wall.right, eye_ + wall.left});
  }

  void show() const {
    if (shown_) shown_->cells = map_.cells(), shown_->cellSize = map_.cellSize(), shown_->heights = map_.heights();
  }

  void look(SetWalk& walk, uint32_t index) {
    const city::BoundsNode& node = walk.set.nodes[index];
    if (!walk.planned(node.instances)) return;
    if (hidden(node.bounds)) return;
    for (uint32_t child = node.firstChild; child < node.firstChild + node.childCount; ++child) look(walk, child);
    if (node.childCount > 0) return;
    walk.forEachPlanned(node.instances, [&](uint32_t i) {
      if (!hidden(walk.set.bounds[i])) walk.seen.push_back({i, 1});
    });
  }

  const City& city_;
  const Occluders& occluders_;
  const CullMapOptions& options_;
  city::FramePlan& plan_;
  CullMapStats& stats_;
  CullMapView* shown_;
  dvec3 eye_;
  PlacedWalls placer_;
  PlanMap map_;
  SetWalk buildings_, trees_;
};

}  // namespace

CullMapStats cullOnPlan(const City& city, const Occluders& occluders, const CullMapOptions& options,
                        city::FramePlan& plan, CullMapView* shown) {
  CullMapStats stats;
  PlanWalk(city, occluders, options, plan, stats, shown).run();
  return stats;
}

}  // namespace vicus::culling
