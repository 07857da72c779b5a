#include "scenegraph/terrain_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vicus::scenegraph {
namespace {

/// First cell of each tile column (or row) and one past the last tile's: cells go to the tile of their centre.
std::vector<int> cellStarts(double fieldOrigin, double spacing, int samples, double gridOrigin, double tileSize,
                            uint32_t tiles) {
  std::vector<int> starts(tiles + 1);
  const int cells = samples - 1;
  for (uint32_t t = 0; t <= tiles; ++t) {
    const double edge = (gridOrigin + t * tileSize - fieldOrigin) / spacing;  // in cells
    starts[t] = static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, static_cast<double>(cells)));
  }
  // Nothing is lost where the field reaches over the grid.
  starts.front() = 0;
  starts.back() = cells;
  return starts;
}

/// Slope along one axis from the samples before and after, whichever have data.
float slope(float before, float here, float after, double spacing) {
  const bool hasBefore = std::isfinite(before), hasAfter = std::isfinite(after);
  const auto step = static_cast<float>(spacing);
  if (hasBefore && hasAfter) return (after - before) / (2 * step);
  if (hasAfter) return (after - here) / step;
  if (hasBefore) return (here - before) / step;
  return 0;
}

}  // namespace

glm::vec3 sampleNormal(const city::HeightField& field, int column, int row) {
  const auto height = [&](int c, int r) {
    return c < 0 || r < 0 || c >= field.size.x || r >= field.size.y ? NAN : field.at(c, r);
  };
  const float here = height(column, row);
  if (!std::isfinite(here)) return {0, 0, 1};
  const float sx = slope(height(column - 1, row), here, height(column + 1, row), field.spacing.x);
  const float sy = slope(height(column, row - 1), here, height(column, row + 1), field.spacing.y);
  return glm::normalize(glm::vec3(-sx, -sy, 1));
}

TerrainMesh terrainMesh(const city::HeightField& field, const city::TileGrid& grid,
                        const std::vector<glm::dvec3>& tileBases) {
  TerrainMesh mesh;
  if (field.empty()) return mesh;
  const std::vector<int> columns =
      cellStarts(field.origin.x, field.spacing.x, field.size.x, grid.origin.x, grid.tileSize, grid.size);
  const std::vector<int> rows =
      cellStarts(field.origin.y, field.spacing.y, field.size.y, grid.origin.y, grid.tileSize, grid.size);
  // A patch without holes is known by its columns, rows and where the diagonals start.
  std::map<std::array<int, 3>, city::Range> wholePatches;

  for (uint32_t tile = 0; tile < grid.tileCount(); ++tile) {
    const glm::uvec2 cell = grid.cell(tile);
    const int c0 = columns[cell.x], c1 = columns[cell.x + 1], r0 = rows[cell.y], r1 = rows[cell.y + 1];
    if (c0 >= c1 || r0 >= r1) continue;

    TerrainPatch patch;
    patch.tile = tile;
    patch.baseVertex = static_cast<uint32_t>(mesh.vertices.size());
    const glm::dvec3 base = tileBases[tile];
    bool whole = true;
    for (int r = r0; r <= r1; ++r)
      for (int c = c0; c <= c1; ++c) {
        const float height = field.at(c, r);
        const bool has = std::isfinite(height);
        whole &= has;
        const glm::dvec2 plan = field.origin + field.spacing * glm::dvec2(c, r);
        mesh.vertices.push_back({glm::vec3(glm::dvec3(plan, has ? static_cast<double>(height) : base.z) - base)});
      }

    const std::array<int, 3> shape = {c1 - c0, r1 - r0, (c0 + r0) & 1};
    if (const auto known = wholePatches.find(shape); whole && known != wholePatches.end()) {
      patch.indices = known->second;
      mesh.patches.push_back(patch);
      continue;
    }
    patch.indices.first = static_cast<uint32_t>(mesh.indices.size());
    const auto width = static_cast<uint32_t>(c1 - c0 + 1);
    const auto add = [&](std::array<glm::ivec2, 3> corners) {
      for (const glm::ivec2& p : corners)
        if (!std::isfinite(field.at(p.x, p.y))) return;
      for (const glm::ivec2& p : corners)
        mesh.indices.push_back(static_cast<uint32_t>(p.y - r0) * width + static_cast<uint32_t>(p.x - c0));
    };
    for (int r = r0; r < r1; ++r)
      for (int c = c0; c < c1; ++c) {
        const glm::ivec2 sw(c, r), se(c + 1, r), nw(c, r + 1), ne(c + 1, r + 1);
        if ((c + r) % 2 == 0) {
          add({sw, se, ne});
          add({sw, ne, nw});
        } else {
          add({sw, se, nw});
          add({se, ne, nw});
        }
      }
    patch.indices.count = static_cast<uint32_t>(mesh.indices.size()) - patch.indices.first;
    if (whole) wholePatches.emplace(shape, patch.indices);
    if (patch.indices.count > 0) mesh.patches.push_back(patch);
  }
  return mesh;
}

}  // namespace vicus::scenegraph
