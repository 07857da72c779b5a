/// Meshes of any format that assimp reads: glTF, OBJ, PLY, COLLADA, FBX, STL, …
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assets/import/source.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

/// Does the file's name end as one that assimp reads?
bool isMeshFile(const std::string& file);

struct MeshOptions {
  std::string up;                ///< "y" or "z": the file's upward axis; empty: z for PLY, STL and 3DS, else y
  double scale = 1;              ///< metres for each unit of the file
  std::optional<double> height;  ///< metres from the lowest to the highest point; takes the place of `scale`
};

struct MeshContent {
  city::TriangleMesh mesh;  ///< metres, z up, lowest point at z = 0 and middle of the plan at (0, 0)
  std::vector<SourceMaterial> materials;
};

/// All triangles of the file in one mesh; Vertex::material is an index into `materials`. Normals that the file lacks
/// are made smooth. Points and lines are left out, as are triangles with coordinates that are not finite. Pictures
/// inside the file (glTF binary, FBX) are named as slices of it ("FILE#bytes=OFFSET+LENGTH"). Nothing, with an error,
/// where there is no triangle.
std::optional<MeshContent> readMesh(const std::string& file, const MeshOptions& options,
                                    city::Diagnostics& diagnostics);

}  // namespace vicus::assets
