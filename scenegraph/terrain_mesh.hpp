/// The full-detail surface of a height field, a patch for each tile of the city's grid: no GL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::scenegraph {

struct TerrainVertex {
  glm::vec3 position;  ///< metres from the tile's base
};
static_assert(sizeof(TerrainVertex) == 12);

struct TerrainPatch {
  uint32_t tile = 0;
  city::Range indices;      ///< in TerrainMesh::indices; patches of one shape share a run
  uint32_t baseVertex = 0;  ///< indices count from here
};

struct TerrainMesh {
  std::vector<TerrainVertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<TerrainPatch> patches;  ///< in ascending order of tiles; none for a tile without ground
};

/// Cells belong to the tile that their centre lies on, so a tile's bounds contain its patch. Each cell is cut as
/// city/height_field.hpp says; a triangle with a corner without data is left out. `tileBases` as tile_table.hpp makes
/// them.
TerrainMesh terrainMesh(const city::HeightField& field, const city::TileGrid& grid,
                        const std::vector<glm::dvec3>& tileBases);

/// Upward unit normal at a sample from its neighbours' heights, those without data left out.
glm::vec3 sampleNormal(const city::HeightField& field, int column, int row);

}  // namespace vicus::scenegraph
