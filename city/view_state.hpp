/// The only camera that floors 0 to 3 know.
#pragma once

#include <glm/glm.hpp>

namespace vicus::city {

/// A perspective view. Eye axes: right, up, and −forward, as in OpenGL. The far plane is infinite unless `farDistance`
/// is finite.
struct ViewState {
  glm::dvec3 eye{0};  ///< metres from the city's origin
  /// Orthonormal.
  glm::dvec3 right{1, 0, 0}, up{0, 0, 1}, forward{0, 1, 0};
  double verticalFov = 1.0472;     ///< radians between the top and bottom of the picture, in (0, π)
  double nearDistance = 0.05;      ///< metres, > 0
  double farDistance;              ///< metres, > nearDistance; infinity by default
  glm::ivec2 viewport{1280, 720};  ///< pixels, each ≥ 1
  double time = 0;                 ///< seconds since the start

  ViewState();
  double aspect() const { return static_cast<double>(viewport.x) / static_cast<double>(viewport.y); }
};

/// What a device or a file may give; every field is made usable by `makeView`.
struct ViewPose {
  glm::dvec3 eye{0};
  double heading = 0;  ///< radians counter-clockwise from east
  double pitch = 0;    ///< radians, up positive; ±π/2 looks straight up and down
  double roll = 0;     ///< radians, clockwise as the viewer sees the horizon turn counter-clockwise
};

constexpr double kSmallestFov = 1e-3;   ///< radians (0.06°)
constexpr double kLargestFov = 3.1241;  ///< radians (179°)

/// View from a pose. Values that are not finite keep those of `fallback`; fov is clamped to kSmallestFov … kLargestFov,
/// the viewport to 1 … 16384. The frame is orthonormal for every pose, also straight up and down.
ViewState makeView(const ViewPose& pose, double verticalFov, glm::ivec2 viewport, const ViewState& fallback = {});

/// Rotation from world axes to eye axes.
glm::dmat3 eyeFromWorldRotation(const ViewState& view);
/// Reversed depth, 1 at the near plane and 0 at infinity (or at farDistance), clip z in 0 … w.
glm::dmat4 clipFromEye(const ViewState& view);
/// clipFromEye · rotation, for positions relative to the eye: what the graphics card gets.
glm::dmat4 clipFromEyeRelative(const ViewState& view);
/// For positions relative to the city's origin.
glm::dmat4 clipFromWorld(const ViewState& view);
/// Pixels that a length of 1 metre across the view takes at a distance of 1 metre.
double pixelsPerUnitSlope(const ViewState& view);

}  // namespace vicus::city
