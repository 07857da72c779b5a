/// The OpenSceneGraph side of one city: the graph, its features, and what the last frame cost.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assets/load_city.hpp"
#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"

namespace osg {
class Group;
}

namespace vicus::scenegraph {

/// Colour for people; item ids (32-bit, City::itemOfBuilding…) for measuring.
enum class Variant : uint8_t { Colour, ItemId };

/// What drawing the last applied plan costs; counts that no machine changes.
struct DrawCounts {
  uint64_t triangles = 0;  ///< all, terrain too
  uint64_t terrainTriangles = 0;
  uint64_t drawCalls = 0;         ///< GL draw calls issued (an indirect multi-draw is one)
  uint64_t indirectCommands = 0;  ///< draws inside the indirect calls
  uint64_t textureBinds = 0;
};

/// Knobs of drawing (state_ordering, textures.budget_mb, textures.anisotropy, …).
std::span<const city::Knob> sceneKnobs();

/// Builds the graph for a city once, then writes each frame's plan into it. Invariant: it draws exactly what the plan
/// lists and decides nothing. Only features that the city has are made. Needs no current GL context until the first
/// frame.
class Scene {
 public:
  Scene(const city::City& city, const city::Knobs& knobs, city::Diagnostics& diagnostics,
        const assets::Progress& progress = {});
  ~Scene();

  osg::Group* root() const;
  void apply(const city::FramePlan& plan, Variant variant);
  const DrawCounts& counts() const;
  /// Bytes allocated on the graphics card for buffers and textures.
  uint64_t gpuBytes() const;
  /// The graph as text: one line a node with its name, class and counts, indented (`vicus info --graph`).
  std::string describeGraph() const;
  /// Names of the features made: "sky", "terrain", "buildings", "monuments", "trees", "water".
  std::vector<std::string> featureNames() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::scenegraph
