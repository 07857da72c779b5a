/// One thin adapter for each kind of content: made only where the city has it, written to from each frame's plan.
#pragma once

#include "scenegraph/gl.hpp"

#include <memory>
#include <osg/Group>
#include <osg/Texture2D>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "scenegraph/arena_drawable.hpp"
#include "scenegraph/avatar_drawable.hpp"
#include "scenegraph/material_textures.hpp"
#include "scenegraph/scene.hpp"
#include "scenegraph/surface_states.hpp"
#include "scenegraph/tile_table.hpp"

namespace vicus::scenegraph {

/// What all features are made from and share.
struct SceneParts {
  std::shared_ptr<TileTable> tiles;
  std::shared_ptr<const MaterialTextures> textures;
  Ordering ordering = Ordering::ByState;
  std::shared_ptr<const houselod::HouseTypes> houses;  ///< null where nothing is ever flat
  osg::ref_ptr<osg::Texture2D> groundMap;              ///< null where the scene has no terrain
  size_t cascades = 0;                                 ///< shadow maps; 0: none
  int shadowTexels = 0;                                ///< to a side of each
  std::shared_ptr<AvatarBuffers> people;               ///< null where the scene shows nobody

  /// What shaders/lit.glsl needs defined.
  std::vector<std::string> lightDefines() const {
    return cascades > 0 ? std::vector{"SHADOWS " + std::to_string(cascades)} : std::vector<std::string>();
  }
};

/// Content of one kind under one node of the graph.
class Feature {
 public:
  explicit Feature(std::string name);
  virtual ~Feature() = default;
  Feature(const Feature&) = delete;
  Feature& operator=(const Feature&) = delete;

  /// Writes the plan into the nodes; says what drawing them costs.
  virtual DrawCounts apply(const city::FramePlan& plan) = 0;
  /// Puts each node's state set of the variant in place; nodes without one are not drawn.
  virtual void show(Variant variant);

  osg::Group* node() const { return node_; }
  const std::string& name() const { return node_->getName(); }
  const std::vector<PassId>& passes() const { return passes_; }
  uint64_t gpuBytes() const { return gpuBytes_; }

 protected:
  /// Registers a node with its looks, drawn in `pass`. In `apply` too: `show` comes after it.
  void addSurface(osg::Node* node, const SurfaceStates& states, PassId pass);
  /// Says that the feature draws in a pass, before it has a surface there.
  void addPass(PassId pass);
  /// Whether a surface is left out of what `show` shows.
  void hide(const osg::Node* node, bool hidden);

  osg::ref_ptr<osg::Group> node_;
  uint64_t gpuBytes_ = 0;

 private:
  struct Surface {
    osg::ref_ptr<osg::Node> node;
    SurfaceStates states;
    bool hidden = false;
  };
  std::vector<Surface> surfaces_;
  std::vector<PassId> passes_;
};

std::unique_ptr<Feature> makeSky();
/// The city must outlive the feature.
std::unique_ptr<Feature> makeBuildings(const city::City& city, const SceneParts& parts);
/// The city must outlive the feature.
std::unique_ptr<Feature> makeTrees(const city::City& city, const SceneParts& parts);
std::unique_ptr<Feature> makeMonuments(const city::City& city, const SceneParts& parts);
std::unique_ptr<Feature> makeTerrain(const city::City& city, const SceneParts& parts);
std::unique_ptr<Feature> makeGround(const city::City& city, const SceneParts& parts);
/// The city must outlive the feature.
std::unique_ptr<Feature> makeAvatars(const city::City& city, const SceneParts& parts);
/// `shared` is the root's state set: it gets what all surfaces need to look shadows up.
std::unique_ptr<Feature> makeShadowMaps(const city::City& city, const SceneParts& parts, osg::StateSet& shared);
std::unique_ptr<Feature> makeWater(const city::City& city);

/// Metres that one repeat of the ground's detail covers.
constexpr double kGroundDetailMetres = 3.2;

}  // namespace vicus::scenegraph
