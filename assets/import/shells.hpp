/// The surfaces of a building while they are made fit to be drawn.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "assets/import/source.hpp"
#include "assets/import/surfaces.hpp"

namespace vicus::assets {

/// A surface with its points merged, wound as it will be drawn.
struct Face {
  SurfaceKind kind = SurfaceKind::Unknown;
  uint32_t shell = 0;
  std::vector<std::vector<uint32_t>> rings;
  uint32_t material = kNoMaterial;
  std::vector<std::vector<glm::vec2>> uvs;  ///< as the rings, or empty
  glm::dvec3 areaVector{0};                 ///< normal times area, holes taken off
  glm::dvec3 normal{0, 0, 1};
  bool solid = false;  ///< belongs to a solid, whose shell ought to be closed
  bool bothSides = false;
  bool bent = false;  ///< some point lies off the plane of the others
};

/// Half the sum of cross products around a ring: its normal times its area, for a nearly flat one. `ring`: at least one
/// index into `points`.
glm::dvec3 newell(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& ring);

/// A building's faces: points at one place are merged into `points`, what has no area is dropped, holes run against
/// their outline. Counts in `report` what is bent or dropped.
std::vector<Face> facesOf(const SurfaceBuilding& building, std::vector<glm::dvec3>& points, SurfaceReport& report);

/// Winds every shell outward: neighbours across an edge agree, and the whole has a positive volume. What encloses
/// nothing, or is open at its top, is drawn from both sides.
void windOutward(std::vector<Face>& faces, const std::vector<glm::dvec3>& points, SurfaceReport& report);

/// Fills the holes in the shells of solids, as windOutward left them: a loop of edges that only one face has gets a
/// face of its own where it is flat to 5 cm, else the triangles of least area. Slits narrower than 1 cm are
/// none, nor are the holes of a face. Bent holes of more than 100 edges, and solids of which nearly half is missing,
/// stay open and are counted. True where any was filled: then the shells want winding again.
bool closeShells(std::vector<Face>& faces, const std::vector<glm::dvec3>& points, SurfaceReport& report);

}  // namespace vicus::assets
