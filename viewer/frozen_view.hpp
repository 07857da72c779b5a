/// The frozen view (F3): one plan, seen from elsewhere, with what it left out and why.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "culling/cull_map.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Why the frozen plan draws an item or not.
enum class Fate : uint8_t { Drawn, OutsidePicture, Hidden };

/// The fate of every item (City::itemOfBuilding…), by item id; 0 stands for nothing and counts as drawn.
std::vector<Fate> fatesOf(const city::City& city, const city::FramePlan& plan);

/// sRGB and opacity, 0 to 255, that a fate lays over an item: nothing over what is drawn, blue over what lies outside
/// the picture, red over what is hidden.
glm::u8vec4 tintOf(Fate fate);

/// A line in the scene, ends in metres from the city's origin.
struct SceneLine {
  glm::dvec3 a{0}, b{0};
  glm::u8vec4 colour{255};
};

/// The frozen picture's edges as rays from the eye with frames at growing distances (yellow), and the tiles on top of
/// what stands on them: green where the plan draws them, grey where not.
std::vector<SceneLine> linesOf(const city::City& city, const city::FramePlan& plan);

/// The cull map of a plan: the tops of the walls that were chosen (orange); the horizon by direction as a curtain's
/// edge 10 m from the eye, or the heights of the grid on the plan as a net (magenta).
std::vector<SceneLine> linesOf(const culling::CullMapView& map, const glm::dvec3& eye);

/// Draws a frozen plan. Made with the renderer's context current, and let go with it current.
class FrozenView {
 public:
  /// What cannot be drawn is told in `problem`.
  FrozenView(const city::City& city, city::FramePlan frozen, const culling::CullMapView& cullMap, std::string& problem);
  ~FrozenView();
  FrozenView(const FrozenView&) = delete;
  FrozenView& operator=(const FrozenView&) = delete;

  const city::FramePlan& frozen() const;
  /// All buildings and monuments and the frozen plan's trees, from another view; the counts stay the frozen plan's.
  city::FramePlan planFrom(const city::ViewState& view) const;
  /// Draws the lines into the scene: for `Renderer::draw`.
  void drawLines(const city::ViewState& view) const;
  /// Lays the tints over the picture that was drawn last, from an item buffer of the same plan.
  void drawTints(Renderer& renderer, const ItemBuffer& items) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
