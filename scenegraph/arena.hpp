/// The vertices and indices of all geometries of one kind in a few large buffers: no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/city.hpp"
#include "city/vertex.hpp"

namespace vicus::scenegraph {

/// One entry of an indirect draw, laid out as GL reads it.
struct DrawCommand {
  uint32_t count = 0;  ///< indices
  uint32_t instanceCount = 1;
  uint32_t firstIndex = 0;
  int32_t baseVertex = 0;
  uint32_t baseInstance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

/// Surfaces without holes in their texture, and those with: drawn in different passes.
enum class ArenaPart : uint8_t { Opaque, CutOut };
constexpr size_t kArenaParts = 2;

/// A plane's triangles in each part, and the material that it binds when drawn alone.
struct ArenaPlane {
  city::Range parts[kArenaParts];  ///< in its chunk's indices
  city::MaterialId material = 0;
};

struct ArenaGeometry {
  uint32_t chunk = 0;
  int32_t baseVertex = 0;
  city::Range parts[kArenaParts];  ///< full detail, in the chunk's indices
  city::Range planes;              ///< in Arena::planes
};

/// One pair of buffers.
struct ArenaChunk {
  std::vector<city::Vertex> vertices;
  std::vector<uint32_t> indices;
};

/// Invariant: a geometry lies within one chunk, each part of it in one run of indices, plane after plane.
struct Arena {
  std::vector<ArenaChunk> chunks;
  std::vector<ArenaGeometry> geometries;  ///< one for each added, in order
  std::vector<ArenaPlane> planes;

  bool has(ArenaPart part) const;
};

/// A plane of a geometry to be added: its triangles in the geometry's indices.
struct PlaneRun {
  city::Range indices;
  city::MaterialId material = 0;
};

/// Largest vertex or index buffer of a chunk, bytes: well under what cards and software GL take for one buffer.
constexpr uint64_t kArenaChunkBytes = 256ull << 20;

/// Appends a geometry; `cutOut[material]` tells which part a triangle goes to (by its first vertex). Begins a new chunk
/// where the current one would grow over `chunkBytes`. Indices out of range are a broken precondition.
void addGeometry(Arena& arena, std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                 std::span<const PlaneRun> planes, std::span<const uint8_t> cutOut,
                 uint64_t chunkBytes = kArenaChunkBytes);

/// All building types at full detail, all planes with their items.
Arena buildingArena(const city::City& city, std::span<const uint8_t> cutOut);
/// All tree types, a plane each.
Arena treeArena(const city::City& city, std::span<const uint8_t> cutOut);

}  // namespace vicus::scenegraph
