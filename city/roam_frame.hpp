/// The ground as ROAM draws it for one view: the mesh, and what one frame changed of it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace vicus::city {

/// Triangles over samples of a height field. Vertices and triangles keep their slots from frame to frame, so that
/// buffers on a graphics card need only what changed. Vertex slots that no triangle names hold anything.
struct RoamMesh {
  struct Vertex {
    glm::ivec2 sample{0};  ///< column and row in the field
    float height = 0;      ///< metres above the city's origin; between two splits on its way to the sample's own
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;  ///< slots of vertices, counter-clockwise from above
  uint64_t revision = 0;                           ///< grows by 1 with each frame
};

/// What stopped refinement first.
enum class StoppedBy : uint8_t { Error, Budget, Time };

struct RoamOperations {
  uint32_t splits = 0, merges = 0;  ///< triangles cut in two, pairs of triangles joined
  uint32_t evaluations = 0;         ///< priorities worked out
  uint32_t frustumTests = 0;
  uint32_t morphs = 0;  ///< vertices moved between their coarser and their own height
};

/// What one frame changed. Copying these slots from `mesh` brings buffers that hold revision − 1 to `revision`; all
/// others need the whole mesh.
struct RoamFrame {
  /// The view's own mesh, shared with the planner's state: its next frame changes it. A plan drawn after that shows the
  /// newer mesh.
  std::shared_ptr<const RoamMesh> mesh;
  uint64_t revision = 0;
  std::vector<uint32_t> changedVertices;   ///< slots, each once
  std::vector<uint32_t> changedTriangles;  ///< slots, each once, below `triangleCount`
  uint32_t triangleCount = 0;
  uint32_t trianglesInFrustum = 0;  ///< triangles that may be seen
  StoppedBy stoppedBy = StoppedBy::Error;
  /// No triangle in the frustum has more: the wanted error, or the largest left where budget or time stopped. Pixels.
  double pixelError = 0;
  RoamOperations operations;
};

}  // namespace vicus::city
