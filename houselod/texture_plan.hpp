/// Which walls get a picture of themselves with all that is on them, and where each picture lies.
///
/// Based on: Willmott et al. 2001, §4.2.4 (an orthogonal projection that exactly captures a plane with its external
/// geometry). There each wall has a texture object; here the pictures of all share square pages.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "city/building_geometry.hpp"

namespace vicus::houselod {

/// The orthogonal projection of a wall: a point p of it is seen at (dot(p − origin, u), dot(p − origin, v)), metres,
/// and lies dot(p − origin, normal) before it.
struct PlaneFrame {
  glm::vec3 origin{0};  ///< lower left corner of its flat surface's bounds, seen from outside
  glm::vec3 u{1, 0, 0}, v{0, 0, 1}, normal{0, -1, 0};
  glm::vec2 size{0};  ///< metres
};
/// A plane without flat surface has no size.
PlaneFrame planeFrame(const city::BuildingGeometry& type, const city::Plane& plane);

/// The picture of one wall.
struct PlanePicture {
  uint32_t type = 0, plane = 0;
  uint32_t page = 0;
  glm::ivec2 corner{0};  ///< texels from the page's lower left corner
  glm::ivec2 size{0};    ///< texels that the wall's bounds fill
};

struct TexturePlan {
  std::vector<PlanePicture> pictures;  ///< by type, then plane
  std::vector<float> detail;           ///< for each type: metres of its coarsest texel; 0 where it has no picture
  uint32_t pages = 0;
  int pageSize = 0;
  double texelsPerMetre = 0;
};

/// Pictures begin at multiples of so many texels, so that the first four mip levels do not mix them.
constexpr int kPictureGrid = 8;
/// A wall's picture need not be finer than its materials are: texels a metre.
constexpr double kFinestPicture = 40;

/// Coarser ones are not worth having: under four texels a metre a window is three texels wide, and a style's far
/// texture shows it better.
constexpr double kCoarsestPicture = 4;
constexpr int kPageSize = 512;

/// Plans pictures for all walls with anything on them, as fine as `pages` pages of `pageSize`² texels (a power of two)
/// have room for, all equally; walls wider than a page get coarser ones. No pages: no pictures.
TexturePlan planPictures(std::span<const city::BuildingGeometry> types, uint32_t pages, int pageSize);
/// The same for a budget in megabytes, mip levels counted. None where they would be coarser than kCoarsestPicture: a
/// town in which each house is different has no room for pictures of all.
TexturePlan picturesWithin(std::span<const city::BuildingGeometry> types, double megabytes);

/// Texture coordinates on its page of a point of the wall.
glm::vec2 onPage(const TexturePlan& plan, const PlanePicture& picture, const PlaneFrame& frame, glm::vec3 point);

}  // namespace vicus::houselod
