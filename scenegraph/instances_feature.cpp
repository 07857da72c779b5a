// Buildings and trees: instances in groups of tiles.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

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
      : Feature(content.name),
        city_(city),
        set_(*content.set),
        tiles_(parts.tiles),
        firstItem_(content.ownItems ? std::optional(content.firstItem) : std::nullopt),
        ordering_(parts.ordering),
        isTrees_(!content.ownItems) {
    buffers_ = std::make_shared<ArenaBuffers>(std::move(content.arena));
    gpuBytes_ = buffers_->bytes() + content.set->size() * sizeof(GpuInstance);

    std::vector<std::string> defines = parts.textures->defines;
    if (!isTrees_) defines.emplace_back("SLIDES");
    if (!isTrees_ && parts.textures->pages > 0) defines.emplace_back("PICTURES");
    for (const std::string& define : parts.lightDefines()) defines.push_back(define);
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
      addGroup(std::move(group), parts, content, looks, groupName(city.grid, g * tilesOfGroup, tilesOfGroup));
    }
    // After the groups, whose children are put in order each frame.
    if (!isTrees_ && buffers_->arena().hasFlat()) addFading(parts, defines);
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    const city::SetPlan& set = isTrees_ ? plan.trees : plan.buildings;
    std::span<const uint8_t> levels;
    std::span<const city::HouseFade> fades;
    if (fading_) levels = plan.houseLod.levels, fades = plan.houseLod.fades;
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
    fades_.clear();
    for (GroupOfTiles& g : groups_) {
      g.instances->drawn.clear();
      for (const TileRun& tile : g.tiles) addDrawn(g, tile.run, set.drawn, levels, fades);
      for (ArenaDrawable* drawable : g.drawables) counts += drawable->apply();
    }
    if (fading_) counts += applyFading(levels);
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

  GpuInstance gpuInstance(uint32_t i) const {
    const city::Instance& instance = set_.instances[i];
    const uint32_t tile = city_.grid.tileAt(instance.position.x, instance.position.y);
    const auto heading = static_cast<double>(instance.heading);
    return {glm::vec3(instance.position - tiles_->base(tile)), tile,
            glm::vec2(glm::dvec2(std::cos(heading), std::sin(heading))), instance.seed,
            firstItem_ ? *firstItem_ + i : city::kItemOther};
  }

  /// What houses that fade are drawn by: their shaders alone pay for leaving out pixels.
  void addFading(const SceneParts& parts, std::vector<std::string> defines) {
    fading_ = std::make_shared<InstanceGroup>(std::vector<GpuInstance>(), std::vector<uint32_t>());
    osg::ref_ptr<osg::Group> node = new osg::Group;
    node->setName(node_->getName() + "/fading");
    defines.emplace_back("FADES");
    for (const ArenaPart part : {ArenaPart::Opaque, ArenaPart::CutOut}) {
      if (!buffers_->arena().has(part)) continue;
      const PassId pass = part == ArenaPart::Opaque ? PassId::Opaque : PassId::CutOut;
      if (part == ArenaPart::CutOut) defines.emplace_back("CUT_OUT");
      osg::ref_ptr<ArenaDrawable> drawable =
          new ArenaDrawable(buffers_, fading_, parts.tiles, parts.textures, part, ordering_);
      drawable->setName(part == ArenaPart::Opaque ? "opaque" : "cut-out");
      node->addChild(drawable);
      fadingDrawables_.push_back(drawable);
      addSurface(drawable, surfaceStates(pass, "instance.vert", "surface.frag", defines), pass);
    }
    node_->addChild(node);
  }

  /// Draws each house that fades twice: at full detail and at its level.
  DrawCounts applyFading(std::span<const uint8_t> levels) {
    std::vector<GpuInstance> gpu;
    std::vector<uint32_t> geometries;
    for (const city::HouseFade& fade : fades_) {
      const GpuInstance whole = gpuInstance(fade.building);
      for (const FadeSide side : {FadeSide::Full, FadeSide::Flat}) {
        gpu.push_back(whole);
        gpu.back().tile = fadingTile(whole.tile, side, fade.share);
        geometries.push_back(set_.instances[fade.building].geometry);
      }
    }
    fading_->replace(std::move(gpu), std::move(geometries));
    for (uint32_t k = 0; k < fades_.size(); ++k) {
      fading_->drawn.push_back({2 * k, houselod::kFullDetail});
      fading_->drawn.push_back({2 * k + 1, levels[fades_[k].building]});
    }
    DrawCounts counts;
    for (ArenaDrawable* drawable : fadingDrawables_) {
      hide(drawable, fades_.empty());
      counts += drawable->apply();
    }
    return counts;
  }

  void addGroup(GroupOfTiles group, const SceneParts& parts, const InstanceContent& content,
                const std::vector<std::pair<ArenaPart, SurfaceStates>>& looks, const std::string& tilesName) {
    std::vector<GpuInstance> gpu;
    std::vector<uint32_t> geometries;
    const uint32_t end = group.tiles.back().run.end();
    for (uint32_t i = group.first; i < end; ++i) {
      gpu.push_back(gpuInstance(i));
      geometries.push_back(set_.instances[i].geometry);
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

  /// Adds the part of the plan's ascending runs that lies in `tile`, as numbers within the group;
  /// those that fade go into `fades_`.
  void addDrawn(GroupOfTiles& group, const city::Range& tile, const std::vector<city::Range>& drawn,
                std::span<const uint8_t> levels, std::span<const city::HouseFade> fades) {
    auto fade = std::lower_bound(fades.begin(), fades.end(), tile.first,
                                 [](const city::HouseFade& f, uint32_t first) { return f.building < first; });
    auto run = std::upper_bound(drawn.begin(), drawn.end(), tile.first,
                                [](uint32_t first, const city::Range& r) { return first < r.end(); });
    for (; run != drawn.end() && run->first < tile.end(); ++run)
      for (uint32_t i = std::max(run->first, tile.first), end = std::min(run->end(), tile.end()); i < end; ++i) {
        while (fade != fades.end() && fade->building < i) ++fade;
        if (fade != fades.end() && fade->building == i)
          fades_.push_back(*fade++);
        else
          group.instances->drawn.push_back({i - group.first, levels.empty() ? houselod::kFullDetail : levels[i]});
      }
  }

  const city::City& city_;
  const city::InstanceSet& set_;
  std::shared_ptr<TileTable> tiles_;
  std::optional<uint32_t> firstItem_;  ///< item id of the first instance; none: all write kItemOther
  Ordering ordering_;
  bool isTrees_;
  std::shared_ptr<ArenaBuffers> buffers_;
  std::vector<GroupOfTiles> groups_;
  std::shared_ptr<InstanceGroup> fading_;  ///< null where no geometry has flat surfaces
  std::vector<ArenaDrawable*> fadingDrawables_;
  std::vector<city::HouseFade> fades_;  ///< of what is drawn, in the order drawn
};

}  // namespace

std::unique_ptr<Feature> makeBuildings(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Instances>(city, parts,
                                     InstanceContent{&city.buildings,
                                                     buildingArena(city, parts.textures->cutOut, parts.ordering,
                                                                   parts.houses.get(), parts.textures->firstPage),
                                                     city.itemOfBuilding(0), true, "buildings"});
}

std::unique_ptr<Feature> makeTrees(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Instances>(
      city, parts, InstanceContent{&city.trees, treeArena(city, parts.textures->cutOut), 0, false, "trees"});
}

}  // namespace vicus::scenegraph
