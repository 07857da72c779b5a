/// Measures terrain meshes against the height field, knowing nothing of how they were made.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "city/height_field.hpp"
#include "city/view_state.hpp"
#include "terrain/roam.hpp"

namespace vicus::terrain {

/// Vertex and index buffers as a graphics card would hold them.
struct MeshBuffers {
  RoamMesh held;

  /// Copies what one frame changed; the frames before must have been applied.
  void apply(const RoamFrame& frame);
};

/// What is wrong with a mesh as a surface over the field; best: all 0, `coveredArea` that of the field's ground.
struct MeshFaults {
  uint64_t cracks =
      0;  ///< edges of one triangle alone with a vertex of another on them, or drawn twice in one direction
  uint64_t flipped = 0;    ///< triangles that are not counter-clockwise from above, or without area
  uint64_t twisted = 0;    ///< vertices whose height is not that of their sample, where that has data; some are while
                           ///< vertices move between a coarser mesh and their own height
  double coveredArea = 0;  ///< cells
};
MeshFaults findFaults(const city::HeightField& field, const RoamMesh& mesh);

/// Vertical distances between the mesh and the field's samples, sample by sample, in double.
struct MeasuredError {
  double largestMetres = 0, rmsMetres = 0;
  double largestPixels = 0, rmsPixels = 0;  ///< of the samples in the frustum
  uint64_t samples = 0, uncovered = 0;  ///< samples with data; those of them that belong to ground and have no triangle
};
/// With a view, pixels are metres · pixelsPerUnitSlope / distance from the eye to the mesh at the sample, of the
/// samples whose place on the mesh or on the ground projects into the picture.
MeasuredError measureError(const city::HeightField& field, const RoamMesh& mesh, const city::ViewState* view = nullptr);

}  // namespace vicus::terrain
