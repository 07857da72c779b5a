/// The steps that decide what throws shadows: squares about the eye as the sun sees them, each larger than the last.
///
/// Based on: Engel 2006, "Cascaded Shadow Maps" (ShaderX5); Losasso and Hoppe 2004, "Geometry Clipmaps" (nested squares
/// about the eye instead of slices of its frustum, so that turning the head changes nothing); Valient 2008, "Stable
/// Rendering of Cascaded Shadow Maps" (squares move by whole texels).
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "city/shadow_plan.hpp"

namespace vicus::plan {

constexpr size_t kMostCascades = 4;

/// What is known of a scene's shadows, worked out once.
struct ShadowScene {
  std::vector<double> reaches;  ///< of each cascade, metres from the eye; empty: no shadow maps
  double texels = 1;            ///< to a side
  glm::dmat3 lightFromWorld{1};
  double middle = 0, halfDepth = 1;  ///< metres along the light, of all that stands
  bool culling = true;               ///< each cascade by its own square
  bool ground = false;               ///< some slope is steeper than the sun stands

  bool on() const { return !reaches.empty(); }
};

/// A view's cascades as last planned: they stay while the eye stays in its cell.
struct ShadowState {
  std::vector<std::shared_ptr<const city::ShadowPlan>> cascades;
};

/// Knobs of shadow maps: shadows.cascades, shadows.size, shadows.distance.
std::span<const city::Knob> shadowKnobs();

/// How many cascades the knobs ask for where anything stands in the sun; 0 where the sun is down.
size_t cascadeCount(const city::City& city, const city::Knobs& knobs);

/// No cascades where the knob is 0, nothing stands in the scene, or the sun is down. `reach` is the bounds of all that
/// stands.
ShadowScene lookAtShadows(const city::City& city, const city::Knobs& knobs, const city::Aabbf& reach);

/// Puts a plan for each cascade into `plan.shadows`: what may stand between its square and the sun, whether or not the
/// eye sees that. Null for cascades that nothing is near enough for. The same eye gives the same plans, whatever was
/// planned before.
void planShadows(const city::City& city, const ShadowScene& scene, const city::Aabbf& reach, ShadowState& state,
                 city::FramePlan& plan);

}  // namespace vicus::plan
