// Buildings and trees: instances in groups of tiles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/features.hpp"

namespace vicus::scenegraph {
namespace {

/// The grid is cut into 4 × 4 groups of tiles, each a run of tiles in Morton order and so a run of instances.
constexpr uint32_t kGroups = 16;

/// "tiles 0-3 x 4-7": the columns and rows of a group.
std::string groupName(const city::TileGrid& grid, uint32_t firstTile, uint32_t tiles) {
  const glm::uvec2 first = grid.cell(firstTile), last = grid.cell(firstTile + tiles - 1);
  const auto span = [](uint32_t a, uint32_t b) { return std::to_string(a) + "-" + std::to_string(b); };
  return "tiles " + span(first.x, last.x) + " x " + span(first.y, last.y);
}

/// Square of the distance on the plan from a place to a box.
double distance2(const city::Aabbf& box, const glm::dvec3& eye) {
  const glm::dvec2 p(eye), lo(box.min), hi(box.max);
  const glm::dvec2 out = glm::max(glm::max(lo - p, p - hi), glm::dvec2(0));
  return glm::dot(out, out);
}

struct InstanceContent {
  const city::InstanceSet* set;
  Arena arena;
  uint32_t firstItem;  ///< item id of the first instance
  bool ownItems;       ///< else all write kItemOther
  const char* name;
};

class Instances : public Feature {
 public:
  Instances(const city::City& city, const SceneParts& parts, InstanceContent content)
      : Feature(content.name), ordering_(parts.ordering), isTrees_(!content.ownItems) {
    buffers_ = std::make_shared<ArenaBuffers>(std::move(content.arena));
    gpuBytes_ = buffers_->bytes() + content.set->size() * sizeof(GpuInstance);

    std::vector<std::string> defines = parts.textures->defines;
    if (!isTrees_) defines.emplace_back("SLIDES");
    if (!isTrees_ && parts.textures->pages > 0) defines.emplace_back("PICTURES");
    std::vector<std::string> withHoles = defines;
    withHoles.emplace_back("CUT_OUT");
    std::vector<std::pair<ArenaPart, SurfaceStates>> looks;
    if (buffers_->arena().has(ArenaPart::Opaque))
      looks.emplace_back(ArenaPart::Opaque, surfaceStates(PassId::Opaque, "instance.vert", "surface.frag", defines));
    if (buffers_->arena().has(ArenaPart::CutOut))
      looks.emplace_back(ArenaPart::CutOut, surfaceStates(PassId::CutOut, "instance.vert", "surface.frag", withHoles));

    const std::vector<city::Range> runs = city::tileRuns(*content.set, city.grid);
    const uint32_t tilesOfGroup = city.grid.tileCount() / kGroups;
    for (uint32_t g = 0; g < kGroups; ++g) {
      GroupOfTiles group;
      for (uint32_t t = g * tilesOfGroup; t < (g + 1) * tilesOfGroup; ++t) {
        if (runs[t].count == 0) continue;
        TileRun tile{runs[t], {}};
        for (uint32_t i = runs[t].first; i < runs[t].end(); ++i) tile.bounds.extend(content.set->bounds[i]);
        group.bounds.extend(tile.bounds);
        group.tiles.push_back(tile);
      }
      if (group.tiles.empty()) continue;
      group.first = group.tiles.front().run.first;
      addGroup(std::move(group), city, parts, content, looks, groupName(city.grid, g * tilesOfGroup, tilesOfGroup));
    }
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    const city::SetPlan& set = isTrees_ ? plan.trees : plan.buildings;
    const std::span<const uint8_t> levels = isTrees_ ? std::span<const uint8_t>() : plan.houseLod.levels;
    // Near to far, so that what is hidden is hidden before it is shaded; scene order where ordering is off.
    if (ordering_ == Ordering::ByState) {
      for (GroupOfTiles& g : groups_) {
        g.distance2 = distance2(g.bounds, plan.view.eye);
        for (TileRun& t : g.tiles) t.distance2 = distance2(t.bounds, plan.view.eye);
        std::stable_sort(g.tiles.begin(), g.tiles.end(),
                         [](const TileRun& a, const TileRun& b) { return a.distance2 < b.distance2; });
      }
      std::stable_sort(groups_.begin(), groups_.end(),
                       [](const GroupOfTiles& a, const GroupOfTiles& b) { return a.distance2 < b.distance2; });
      for (unsigned i = 0; i < groups_.size(); ++i)
        if (node_->getChild(i) != groups_[i].node) node_->setChild(i, groups_[i].node);
    }
    DrawCounts counts;
    for (GroupOfTiles& g : groups_) {
      g.instances->drawn.clear();
      for (const TileRun& tile : g.tiles) addDrawn(g, tile.run, set.drawn, levels);
      for (ArenaDrawable* drawable : g.drawables) counts += drawable->apply();
    }
    return counts;
  }

 private:
  struct TileRun {
    city::Range run;
    city::Aabbf bounds;
    double distance2 = 0;
  };
  struct GroupOfTiles {
    city::Aabbf bounds;
    std::vector<TileRun> tiles;
    uint32_t first = 0;  ///< first instance of the group in its set
    std::shared_ptr<InstanceGroup> instances;
    std::vector<ArenaDrawable*> drawables;  ///< children of `node`
    osg::ref_ptr<osg::Group> node;
    double distance2 = 0;
  };

  void addGroup(GroupOfTiles group, const city::City& city, const SceneParts& parts, const InstanceContent& content,
                const std::vector<std::pair<ArenaPart, SurfaceStates>>& looks, const std::string& tilesName) {
    std::vector<GpuInstance> gpu;
    std::vector<uint32_t> geometries;
    const uint32_t end = group.tiles.back().run.end();
    for (uint32_t i = group.first; i < end; ++i) {
      const city::Instance& instance = content.set->instances[i];
      const uint32_t tile = city.grid.tileAt(instance.position.x, instance.position.y);
      const auto heading = static_cast<double>(instance.heading);
      gpu.push_back({glm::vec3(instance.position - parts.tiles->base(tile)), tile,
                     glm::vec2(glm::dvec2(std::cos(heading), std::sin(heading))), instance.seed,
                     content.ownItems ? content.firstItem + i : city::kItemOther});
      geometries.push_back(instance.geometry);
    }
    group.instances = std::make_shared<InstanceGroup>(std::move(gpu), std::move(geometries));
    group.node = new osg::Group;
    group.node->setName(std::string(content.name) + "/" + tilesName);
    for (const auto& [part, states] : looks) {
      osg::ref_ptr<ArenaDrawable> drawable =
          new ArenaDrawable(buffers_, group.instances, parts.tiles, parts.textures, part, parts.ordering);
      drawable->setName(part == ArenaPart::Opaque ? "opaque" : "cut-out");
      group.node->addChild(drawable);
      group.drawables.push_back(drawable);
      addSurface(drawable, states, part == ArenaPart::Opaque ? PassId::Opaque : PassId::CutOut);
    }
    node_->addChild(group.node);
    groups_.push_back(std::move(group));
  }

  /// Adds the part of the plan's ascending runs that lies in `tile`, as numbers within the group.
  static void addDrawn(GroupOfTiles& group, const city::Range& tile, const std::vector<city::Range>& drawn,
                       std::span<const uint8_t> levels) {
    auto run = std::upper_bound(drawn.begin(), drawn.end(), tile.first,
                                [](uint32_t first, const city::Range& r) { return first < r.end(); });
    for (; run != drawn.end() && run->first < tile.end(); ++run)
      for (uint32_t i = std::max(run->first, tile.first), end = std::min(run->end(), tile.end()); i < end; ++i)
        group.instances->drawn.push_back({i - group.first, levels.empty() ? houselod::kFullDetail : levels[i]});
  }

  Ordering ordering_;
  bool isTrees_;
  std::shared_ptr<ArenaBuffers> buffers_;
  std::vector<GroupOfTiles> groups_;
};

}  // namespace

std::unique_ptr<Feature> makeBuildings(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Instances>(city, parts,
                                     InstanceContent{&city.buildings,
                                                     buildingArena(city, parts.textures->cutOut, parts.ordering,
                                                                   parts.pictures, parts.textures->firstPage),
                                                     city.itemOfBuilding(0), true, "buildings"});
}

std::unique_ptr<Feature> makeTrees(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Instances>(
      city, parts, InstanceContent{&city.trees, treeArena(city, parts.textures->cutOut), 0, false, "trees"});
}

}  // namespace vicus::scenegraph
