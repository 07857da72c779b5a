/// Based on: Willmott et al. 2001, §3.1.3 (tiles, buildings, trees and meshes are each culled by their boxes) and §6
/// (the techniques in one walkthrough).
#include "plan/planner.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include "culling/cull_map.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"
#include "plan/ground_weights.hpp"
#include "plan/house_levels.hpp"
#include "plan/people.hpp"
#include "terrain/error_table.hpp"

namespace vicus::plan {
namespace {

using city::City;
using city::FramePlan;

constexpr city::Knob kCullingKnobs[] = {
    {"frustum_culling", 1, 0, 1, "on/off", "Leaves out what lies outside the picture's edges.",
     "off: everything is drawn, also behind the viewer", "on is the most"},
    {"cull_map", 1, 0, 1, "on/off", "Leaves out what stands hidden behind houses.",
     "off: everything within the picture's edges is drawn", "on is the most"},
    {"cull_map.size", 8192, 64, 65536, "columns all round",
     "Into how many directions the horizon that houses make is divided.", "narrow houses hide nothing, more is drawn",
     "planning takes longer and hides hardly more"},
    {"cull_map.kind", 0, 0, 2, "0, 1 or 2",
     "Which map: 0 the horizon by direction, 1 grids on the plan, 2 the plan as published in 2001, which errs.",
     "0: the fastest and the most hidden", "2: things that can be seen are missing"},
    {"cull_map.cells", 256, 16, 2048, "cells to a side", "How fine the grids on the plan are (cull_map.kind 1 and 2).",
     "coarse shadows hide less", "planning takes longer"},
};

/// Fewer buildings than these draw faster than they are sorted out.
constexpr size_t kFewestBuildings = 50;

bool hasTerrain(const City& city) {
  return city.terrain && !city.terrain->empty();
}

/// Samples of the largest field that can be drawn at full detail: 4 097² make 33 million triangles. Larger ones are
/// always meshed, without the technique to a quarter of a pixel, whatever that takes.
constexpr size_t kMostSamplesAtFullDetail = size_t{4097} * 4097;
constexpr double kPixelsInPlaceOfFullDetail = 0.25;

/// What the composition and the steps know of the scene: worked out once.
struct Scene {
  bool frustumCulling = false;
  bool tiles = false, buildings = false, trees = false, monuments = false;
  uint64_t tilesWithContent = 0;
  culling::TileTree tileTree;
  city::Aabbf reach;  ///< of every box that is tested against the frustum
  bool cullMap = false;
  culling::Occluders occluders;
  culling::CullMapOptions cullMapOptions;
  HouseLodScene houseLod;
  PeopleScene people;
  ShadowScene shadows;
  bool roam = false;
  terrain::RoamSettings roamSettings;
  /// Made when the first frame needs them: looking at a scene without drawing it stays quick.
  mutable std::once_flag groundErrorsMade;
  mutable terrain::ErrorTable groundErrors;
};

/// One frame in the making.
struct Frame {
  const City& city;
  const Scene& scene;
  const culling::BoxTest& boxTest;
  FramePlan& plan;
  PlannerState& state;
  uint64_t monumentsInFrustum = 0;
  culling::CullMapView* shownCullMap = nullptr;  ///< filled where somebody wants to look at it
};

/// One step of a frame: what it is called, whether this scene needs it, what it does. A technique is one or more rows
/// of the table below, in the order in which they run.
struct Step {
  std::string_view name;
  bool (*needed)(const Scene&);
  void (*run)(Frame&);
};

void cullSet(Frame& frame, const city::InstanceSet& set, city::SetPlan& out) {
  frame.plan.counts.boxTests += culling::cullInstances(set, frame.boxTest, out);
}

void drawWholeSet(const city::InstanceSet& set, city::SetPlan& out) {
  out.drawn = {{0, static_cast<uint32_t>(set.size())}};
  out.drawnCount = out.inFrustumCount = set.size();
}

void frustumTiles(Frame& frame) {
  frame.plan.counts.boxTests += culling::cullTiles(frame.scene.tileTree, frame.boxTest, frame.plan.tiles);
}

void frustumBuildings(Frame& frame) {
  cullSet(frame, frame.city.buildings, frame.plan.buildings);
}

void frustumTrees(Frame& frame) {
  cullSet(frame, frame.city.trees, frame.plan.trees);
}

void frustumMonuments(Frame& frame) {
  for (uint32_t i = 0; i < frame.city.monuments.size(); ++i) {
    uint32_t mask = frame.boxTest.allPlanes;
    if (culling::classify(frame.boxTest, frame.city.monuments[i].bounds, mask) != culling::Containment::Outside)
      frame.plan.monuments.push_back(i);
  }
  frame.monumentsInFrustum = frame.plan.monuments.size();
  frame.plan.counts.boxTests += frame.city.monuments.size();
}

void allTiles(Frame& frame) {
  for (uint32_t t = 0; t < frame.city.tiles.size(); ++t)
    if (!frame.city.tiles[t].bounds.empty()) frame.plan.tiles.push_back(t);
}

void allBuildings(Frame& frame) {
  drawWholeSet(frame.city.buildings, frame.plan.buildings);
}

void allTrees(Frame& frame) {
  drawWholeSet(frame.city.trees, frame.plan.trees);
}

void allMonuments(Frame& frame) {
  for (uint32_t i = 0; i < frame.city.monuments.size(); ++i) frame.plan.monuments.push_back(i);
  frame.monumentsInFrustum = frame.plan.monuments.size();
}

void cullHidden(Frame& frame) {
  const Scene& scene = frame.scene;
  const culling::CullMapStats stats =
      culling::cullOccluded(frame.city, scene.occluders, scene.cullMapOptions, frame.plan, frame.shownCullMap);
  frame.plan.counts.horizonTests = stats.boxTests;
  frame.plan.counts.occluders = stats.occluders;
}

void frustumAvatars(Frame& frame) {
  placePeople(frame.city, frame.scene.people, &frame.boxTest, frame.plan);
}

void allAvatars(Frame& frame) {
  placePeople(frame.city, frame.scene.people, nullptr, frame.plan);
}

void poseAvatars(Frame& frame) {
  posePeople(frame.city, frame.scene.people, frame.state.people, frame.plan);
}

void levelHouses(Frame& frame) {
  chooseLevels(frame.city, frame.scene.houseLod, frame.plan);
}

void castShadows(Frame& frame) {
  planShadows(frame.city, frame.scene.shadows, frame.scene.reach, frame.state.shadows, frame.plan);
}

void meshGround(Frame& frame) {
  const Scene& scene = frame.scene;
  const city::HeightField& field = *frame.city.terrain;
  std::call_once(scene.groundErrorsMade,
                 [&] { scene.groundErrors = terrain::buildErrorTable(field, groundWeights(frame.city)); });
  if (!frame.state.ground) frame.state.ground.emplace(field, scene.groundErrors);
  frame.plan.roam = frame.state.ground->update(frame.plan.view, scene.roamSettings);
}

bool hasPeople(const Scene& scene) {
  return !scene.people.persons.empty();
}

constexpr Step kSteps[] = {
    {"frustum tiles", [](const Scene& s) { return s.frustumCulling && s.tiles; }, frustumTiles},
    {"frustum buildings", [](const Scene& s) { return s.frustumCulling && s.buildings; }, frustumBuildings},
    {"frustum trees", [](const Scene& s) { return s.frustumCulling && s.trees; }, frustumTrees},
    {"frustum monuments", [](const Scene& s) { return s.frustumCulling && s.monuments; }, frustumMonuments},
    {"all tiles", [](const Scene& s) { return !s.frustumCulling && s.tiles; }, allTiles},
    {"all buildings", [](const Scene& s) { return !s.frustumCulling && s.buildings; }, allBuildings},
    {"all trees", [](const Scene& s) { return !s.frustumCulling && s.trees; }, allTrees},
    {"all monuments", [](const Scene& s) { return !s.frustumCulling && s.monuments; }, allMonuments},
    {"frustum avatars", [](const Scene& s) { return s.frustumCulling && hasPeople(s); }, frustumAvatars},
    {"all avatars", [](const Scene& s) { return !s.frustumCulling && hasPeople(s); }, allAvatars},
    {"cull map", [](const Scene& s) { return s.cullMap; }, cullHidden},
    {"house lod", [](const Scene& s) { return s.houseLod.on; }, levelHouses},
    {"roam", [](const Scene& s) { return s.roam; }, meshGround},
    {"avatar poses", hasPeople, poseAvatars},
    {"shadows", [](const Scene& s) { return s.shadows.on(); }, castShadows},
};

void lookAt(const City& city, const city::Knobs& knobs, Scene& scene) {
  for (const city::Tile& tile : city.tiles) {
    if (tile.bounds.empty()) continue;
    ++scene.tilesWithContent;
    scene.reach.extend(tile.bounds);
  }
  for (const city::Monument& m : city.monuments) scene.reach.extend(m.bounds);
  scene.tiles = scene.tilesWithContent > 0;
  scene.buildings = !city.buildings.empty();
  scene.trees = !city.trees.empty();
  scene.monuments = !city.monuments.empty();
  scene.people = lookAtPeople(city, knobs);
  scene.reach.extend(scene.people.reach);
  scene.frustumCulling = knobs.on("frustum_culling") &&
                         (scene.tiles || scene.buildings || scene.trees || scene.monuments || hasPeople(scene));
  // Sets made without tiles are reached through their own roots.
  for (const city::InstanceSet* set : {&city.buildings, &city.trees})
    if (!set->nodes.empty()) scene.reach.extend(set->nodes[0].bounds);
  scene.shadows = lookAtShadows(city, knobs, scene.reach);
  if (scene.frustumCulling) scene.tileTree = culling::buildTileTree(city.tiles);
  if (knobs.on("cull_map") && city.buildings.size() >= kFewestBuildings) {
    scene.occluders = culling::occludersOf(city);
    scene.cullMap = scene.occluders.standing > 0;
    scene.cullMapOptions = {static_cast<uint32_t>(knobs["cull_map.size"]), scene.frustumCulling,
                            static_cast<culling::CullMapKind>(std::clamp(std::round(knobs["cull_map.kind"]), 0.0, 2.0)),
                            static_cast<uint32_t>(knobs["cull_map.cells"])};
  }
  scene.houseLod = lookAtHouses(city, knobs);
  const bool tooLarge = hasTerrain(city) && city.terrain->heights.size() > kMostSamplesAtFullDetail;
  scene.roam = hasTerrain(city) && (knobs.on("roam") || tooLarge);
  if (scene.roam && !knobs.on("roam")) {
    scene.roamSettings.pixelError = kPixelsInPlaceOfFullDetail;
    scene.roamSettings.budget = std::numeric_limits<uint32_t>::max();
    scene.roamSettings.morph = 1;
  } else if (scene.roam) {
    scene.roamSettings.pixelError = knobs["roam.pixel_error"];
    scene.roamSettings.budget = static_cast<uint32_t>(knobs["roam.budget"]);
    if (knobs["roam.milliseconds"] > 0) scene.roamSettings.milliseconds = knobs["roam.milliseconds"];
    scene.roamSettings.frustum = knobs.on("frustum_culling");
  }
}

/// "1 tree", "388 trees".
std::string counted(uint64_t count, std::string_view one, std::string_view many) {
  return std::to_string(count) + " " + std::string(count == 1 ? one : many);
}

FeatureReport content(std::string name, uint64_t count, std::string_view one, std::string_view many) {
  return {std::move(name), false, count > 0, count > 0 ? counted(count, one, many) : "no " + std::string(many)};
}

std::vector<FeatureReport> describe(const City& city, const city::Knobs& knobs, const Scene& scene) {
  std::vector<FeatureReport> features;
  std::string why = std::to_string(scene.tilesWithContent) + " of " + counted(city.tiles.size(), "tile", "tiles") +
                    (scene.tilesWithContent == 1 ? " holds" : " hold") + " something";
  if (!knobs.on("frustum_culling"))
    why = "knob";
  else if (!scene.frustumCulling)
    why = "nothing stands in the scene";
  features.push_back({"frustum_culling", true, scene.frustumCulling, std::move(why)});

  if (!knobs.on("cull_map"))
    why = "knob";
  else if (city.buildings.size() < kFewestBuildings)
    why = counted(city.buildings.size(), "building", "buildings");
  else if (!scene.cullMap)
    why = "no wall stands in the ground";
  else
    why = counted(scene.occluders.standing, "wall", "walls") + " may hide what is behind";
  features.push_back({"cull_map", true, scene.cullMap, std::move(why)});

  if (!knobs.on("house_lod"))
    why = "knob";
  else if (city.buildings.empty())
    why = "no buildings";
  else
    why = scene.houseLod.on ? counted(scene.houseLod.flatTypes, "type of building has", "types of buildings have") +
                                  " things on walls"
                            : "nothing is on the walls";
  features.push_back({"house_lod", true, scene.houseLod.on, std::move(why)});

  if (!knobs.on("roam"))
    why = scene.roam ? "the field is too large to be drawn at full detail" : "knob";
  else
    why = scene.roam ? "the ground is drawn as finely as the eye can tell" : "no height field";
  features.push_back({"roam", true, scene.roam, std::move(why)});

  if (scene.people.persons.empty())
    why = "no people";
  else
    why = knobs.on("avatar_lod") ? "posed and drawn as finely as the eye can tell" : "knob";
  features.push_back({"avatar_lod", true, !scene.people.persons.empty() && scene.people.lod.on, std::move(why)});

  const bool terrain = hasTerrain(city);
  features.push_back(
      {"terrain", false, terrain,
       terrain ? std::to_string(city.terrain->size.x) + " × " + std::to_string(city.terrain->size.y) + " heights"
               : "no height field"});
  features.push_back(content("buildings", city.buildings.size(), "building", "buildings"));
  features.push_back(content("trees", city.trees.size(), "tree", "trees"));
  features.push_back(content("monuments", city.monuments.size(), "monument", "monuments"));
  features.push_back(content("avatars", scene.people.persons.size(), "person", "people"));
  if (!city.people.empty() && !knobs.on("avatars.shown")) features.back().why = "knob";
  if (knobs["shadows.cascades"] < 1)
    why = "knob";
  else if (scene.shadows.on())
    why = counted(scene.shadows.reaches.size(), "map", "maps") + " about the eye, to " +
          std::to_string(static_cast<int>(scene.shadows.reaches.back())) + " m";
  else
    why = scene.reach.empty() ? "nothing stands in the scene" : "the sun is down";
  features.push_back({"shadows", false, scene.shadows.on(), std::move(why)});
  features.push_back(content("water", city.water.size(), "body of water", "bodies of water"));
  features.push_back(content("streets", city.streets ? city.streets->edges.size() : 0, "street", "streets"));
  return features;
}

/// Drawn and dropped runs cover a set of `size` exactly once, drawn ones never touch, and the counts are theirs.
[[maybe_unused]] bool coversOnce(const city::SetPlan& set, size_t size) {
  size_t drawn = 0, dropped = 0, end = 0;
  uint64_t drawnCount = 0;
  while (drawn < set.drawn.size() || dropped < set.dropped.size()) {
    if (drawn < set.drawn.size() && set.drawn[drawn].first == end && set.drawn[drawn].count > 0) {
      if (drawn > 0 && set.drawn[drawn - 1].end() == end) return false;
      drawnCount += set.drawn[drawn].count;
      end = set.drawn[drawn++].end();
    } else if (dropped < set.dropped.size() && set.dropped[dropped].range.first == end &&
               set.dropped[dropped].range.count > 0) {
      end = set.dropped[dropped++].range.end();
    } else {
      return false;
    }
  }
  return end == size && drawnCount == set.drawnCount && set.drawnCount <= set.inFrustumCount &&
         set.inFrustumCount <= size;
}

void count(const City& city, const Scene& scene, uint64_t monumentsInFrustum, FramePlan& plan) {
  city::PlanCounts& counts = plan.counts;
  counts.tiles = scene.tilesWithContent;
  counts.tilesDrawn = plan.tiles.size();
  counts.instances = city.buildings.size() + city.monuments.size();
  counts.instancesInFrustum = plan.buildings.inFrustumCount + monumentsInFrustum;
  counts.instancesDrawn = plan.buildings.drawnCount + plan.monuments.size();
  counts.instancesOccluded = counts.instancesInFrustum - counts.instancesDrawn;
  counts.treesDrawn = plan.trees.drawnCount;
  counts.avatarsDrawn = plan.avatars.drawn.size();
  counts.avatarPoses = plan.avatars.posesMade;
}

}  // namespace

struct Planner::Impl {
  Scene scene;
  std::vector<Step> steps;
  std::vector<FeatureReport> features;
};

std::span<const city::Knob> planKnobs() {
  static const std::vector<city::Knob> all = [] {
    std::vector<city::Knob> knobs(std::begin(kCullingKnobs), std::end(kCullingKnobs));
    knobs.insert(knobs.end(), houselod::houseLodKnobs().begin(), houselod::houseLodKnobs().end());
    knobs.insert(knobs.end(), terrain::roamKnobs().begin(), terrain::roamKnobs().end());
    knobs.insert(knobs.end(), shadowKnobs().begin(), shadowKnobs().end());
    knobs.insert(knobs.end(), avatars::avatarKnobs().begin(), avatars::avatarKnobs().end());
    return knobs;
  }();
  return all;
}

Planner::Planner(const City& city, const city::Knobs& knobs) : impl_(std::make_unique<Impl>()) {
  lookAt(city, knobs, impl_->scene);
  std::copy_if(std::begin(kSteps), std::end(kSteps), std::back_inserter(impl_->steps),
               [&](const Step& step) { return step.needed(impl_->scene); });
  impl_->features = describe(city, knobs, impl_->scene);
}

Planner::~Planner() = default;
Planner::Planner(Planner&&) noexcept = default;
Planner& Planner::operator=(Planner&&) noexcept = default;

FramePlan Planner::plan(const City& city, const city::ViewState& view, double /*dt*/, PlannerState& state) const {
  using Clock = std::chrono::steady_clock;
  FramePlan plan;
  plan.view = view;
  plan.stages.reserve(impl_->steps.size());
  for (city::SetPlan* set : {&plan.buildings, &plan.trees}) {
    set->drawn.reserve(state.runs);
    set->dropped.reserve(state.runs);
  }

  const culling::BoxTest boxTest = culling::boxTestFor(culling::frustumOf(view), impl_->scene.reach);
  Frame frame{city, impl_->scene, boxTest, plan, state};
  for (const Step& step : impl_->steps) {
    const Clock::time_point begin = Clock::now();
    step.run(frame);
    plan.stages.push_back({step.name, std::chrono::duration<double, std::milli>(Clock::now() - begin).count()});
  }
  count(city, impl_->scene, frame.monumentsInFrustum, plan);

  assert(coversOnce(plan.buildings, city.buildings.size()));
  assert(coversOnce(plan.trees, city.trees.size()));
  state.runs = std::max(plan.buildings.drawn.size(), plan.buildings.dropped.size());
  return plan;
}

culling::CullMapView Planner::cullMap(const City& city, const city::ViewState& view) const {
  culling::CullMapView shown;
  FramePlan plan;
  plan.view = view;
  PlannerState state;
  const culling::BoxTest boxTest = culling::boxTestFor(culling::frustumOf(view), impl_->scene.reach);
  Frame frame{city, impl_->scene, boxTest, plan, state, 0, &shown};
  const auto cull =
      std::find_if(impl_->steps.begin(), impl_->steps.end(), [](const Step& step) { return step.run == cullHidden; });
  if (cull == impl_->steps.end()) return shown;
  for (auto step = impl_->steps.begin(); step <= cull; ++step) step->run(frame);
  return shown;
}

const std::vector<FeatureReport>& Planner::features() const {
  return impl_->features;
}

std::shared_ptr<const houselod::HouseTypes> Planner::houses() const {
  return impl_->scene.houseLod.types;
}

std::vector<std::string> Planner::steps() const {
  std::vector<std::string> names;
  for (const Step& step : impl_->steps) names.emplace_back(step.name);
  return names;
}

}  // namespace vicus::plan
