/// Walls of free meshes – town walls, churches, castles – that hide what is behind them.
#pragma once

#include <vector>

#include "culling/occluders.hpp"

namespace vicus::culling {

/// The upright quadrilaterals with upright sides of a mesh, drawn on the right of a → b: two triangles with an edge in
/// common. In the mesh's frame.
std::vector<MeshWall> uprightQuadsOf(const city::TriangleMesh& mesh);

}  // namespace vicus::culling
