/// The surfaces of a derived wall.
#pragma once

#include <span>

#include "city/building_geometry.hpp"
#include "facade/derive_wall.hpp"

namespace vicus::facade {

/// What a paint looks like in the city: its material and how large one repeat of that is.
struct PaintLook {
  city::MaterialId material = 0;
  glm::vec2 metresPerRepeat{1};
};

/// A wall in space.
struct WallFrame {
  glm::dvec3 origin{0};          ///< lower left corner seen from outside, metres
  glm::dvec3 along{1, 0, 0};     ///< unit, to the right
  glm::dvec3 up{0, 0, 1};        ///< unit
  double width = 0, height = 0;  ///< metres
  double below = 0;              ///< metres that the wall reaches below its foot
  double thickness = 0.5;        ///< metres that openings may go in at most

  glm::dvec3 normal() const { return glm::cross(along, up); }
  glm::vec3 at(double x, double y, double z = 0) const { return glm::vec3(origin + along * x + up * y + normal() * z); }
};

/// Rectangles that do not overlap: what of each fill can be seen, openings cut out. Covers the wall (from −below to its
/// height) but for the openings; what no fill covers is `plain`.
struct VisibleFill {
  Rect rect;
  uint32_t fill = kNothing;  ///< in WallDetail::fills; kNothing: the plain wall
};
std::vector<VisibleFill> visibleFills(const WallDetail& detail, double width, double height, double below);

/// Adds the current plane's surfaces: the cut wall, its openings and what sticks out.
void addWallDetail(city::BuildingBuilder& builder, const WallFrame& frame, const WallDetail& detail,
                   std::span<const PaintLook> looks, uint32_t plain);

/// Adds one shape as an item of the current plane.
void addShape(city::BuildingBuilder& builder, const WallFrame& frame, const Attachment& attachment,
              std::span<const PaintLook> looks, uint32_t plain);

}  // namespace vicus::facade
