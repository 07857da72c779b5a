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
#include "houselod/house_types.hpp"

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

  DrawCounts& operator+=(const DrawCounts& more);
  bool operator==(const DrawCounts&) const = default;
};

/// A part of a picture, for pictures that are drawn in pieces: the view's clip x and y are multiplied by `scale`, then
/// `offset` is added, so that the piece fills the viewport. The default is the whole picture.
struct PictureWindow {
  glm::dvec2 scale{1};
  glm::dvec2 offset{0};
};

/// Knobs of drawing (state_ordering, textures.budget_mb, textures.anisotropy, …).
std::span<const city::Knob> sceneKnobs();

/// Pictures that every scene needs, whatever its city: 512 × 512 texels of grass, earth and cobbles with all their
/// levels. They can be painted before the city is there.
struct GroundDetail {
  std::vector<std::vector<std::vector<uint8_t>>> layers;  ///< of each, of each level: rgba bytes
};
GroundDetail paintGroundDetail(city::Diagnostics& diagnostics);

/// Builds the graph for a city once, then writes each frame's plan into it. Invariant: it draws exactly what the plan
/// lists and decides nothing. Only features that the city has are made. Needs no current GL context until the first
/// frame. A ground detail that is empty is painted here.
class Scene {
 public:
  Scene(const city::City& city, const city::Knobs& knobs, city::Diagnostics& diagnostics,
        const assets::Progress& progress = {}, GroundDetail detail = {},
        std::shared_ptr<const houselod::HouseTypes> houses = {});
  ~Scene();

  /// False where it was made with the knob `house_lod` off, and has nothing flat to draw.
  bool madeForHouseLod() const;

  osg::Group* root() const;
  /// Writes the plan into the graph. The camera that draws `root` then needs `eyeFromWorld` and `clipFromEye`.
  void apply(const city::FramePlan& plan, Variant variant, const PictureWindow& window = {});
  const glm::dmat4& eyeFromWorld() const;
  const glm::dmat4& clipFromEye() const;
  const DrawCounts& counts() const;
  /// How long each feature took to write the last plan: "apply buildings", … The names live as long as the scene.
  std::span<const city::StageTime> applyTimes() const;
  /// Bytes allocated on the graphics card for buffers and textures.
  uint64_t gpuBytes() const;
  /// The graph as text: one line a node with its name, class and counts, indented (`vicus info --graph`).
  std::string describeGraph() const;
  /// Names of the features made: "buildings", "monuments", "trees", "avatars", "terrain", "ground", "sky", "water".
  std::vector<std::string> featureNames() const;
  /// Names of the passes that the scene has, in the order drawn (passes.hpp).
  std::vector<std::string> passNames() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::scenegraph
