/// The eye as ROAM's mesh sees it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "city/height_field.hpp"
#include "city/view_state.hpp"
#include "terrain/roam.hpp"

namespace vicus::terrain {

/// A place p from the eye is inside where normal · p + distance ≥ 0.
struct Plane {
  float x = 0, y = 0, z = 0;  ///< unit normal
  float steepness = 0;        ///< |z|: how far moving up by 1 leads from the plane
  float distance = 0;
  bool operator==(const Plane&) const = default;
};

/// The eye as the mesh sees it.
struct Eye {
  bool perspective = false;
  glm::dvec3 position{0};  ///< x, y from the field's first sample; metres
  /// The position as a place in half samples and the rest of the way, and as a height and the rest, so that differences
  /// from near places are as good in float as in double.
  glm::ivec2 place{0};
  glm::vec2 rest{0};
  float height = 0, heightRest = 0;
  /// Squared ratio of a triangle's error to the wanted one: error² · scaleSquared / distance² (distance 1 without an
  /// eye).
  float scaleSquared = 0;
  float scale = 0;
  double pixelsPerRatio = 0;      ///< the error in pixels at which splits begin
  double wantedPixels = 0;        ///< at which they are complete
  float band = 1;                 ///< pixelsPerRatio / wantedPixels; 1: splits are complete at once
  std::array<Plane, 6> planes{};  ///< the four sides, near and far
  uint8_t allPlanes = 0;

  bool operator==(const Eye&) const = default;
};

Eye eyeOf(const city::ViewState& view, const RoamSettings& settings, const city::HeightField& field);

}  // namespace vicus::terrain
