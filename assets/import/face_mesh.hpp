/// A face of a building as triangles.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "assets/import/face_occluder.hpp"
#include "assets/import/shells.hpp"
#include "assets/import/surfaces.hpp"

namespace vicus::assets {

/// Triangles of a face: corners in space and in its own plane.
struct FaceMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec2> uvs;  ///< the source's texture coordinates; empty where it gives none
  std::vector<uint32_t> triangles;
};

/// Triangulates a face over its plane (`axes`: unit, u and v in it). A face that crosses or touches itself is repaired
/// there and counted in `report`; points that it had keep their place in space. Empty where nothing is left of it.
FaceMesh meshOf(const Face& face, const Axes& axes, const std::vector<glm::dvec3>& points, SurfaceReport& report);

}  // namespace vicus::assets
