/// The vertices and indices of all geometries of one kind in a few large buffers: no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/city.hpp"
#include "city/vertex.hpp"
#include "houselod/house_types.hpp"

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

/// How draws are issued: the technique `state_ordering` (Willmott et al. 2001, §5.1) on or off.
enum class Ordering : uint8_t {
  ByState,  ///< textures bound once, one indirect multi-draw for each group and chunk
  Scene,    ///< instance after instance, plane after plane: one texture bind and one draw for each
};

/// Triangles that are drawn together, in one part: surfaces of full detail, then items, those that reach least first,
/// then flat surfaces. So full detail is one range from the front, and every other level one range to the end.
struct ArenaPiece {
  uint32_t first = 0;  ///< in its chunk's indices
  uint32_t flat = 0;   ///< the flat surfaces begin here, and full detail ends
  uint32_t end = 0;
  uint32_t steps = 0;  ///< in Arena::steps: where the items of each of the geometry's steps begin
};

/// What one bind draws: a whole geometry, or in scene order one of its planes.
struct ArenaRun {
  ArenaPiece parts[kArenaParts];
  city::MaterialId material = 0;  ///< bound when the run is drawn alone
};

struct ArenaGeometry {
  uint32_t chunk = 0;
  int32_t baseVertex = 0;
  city::Range runs;    ///< in Arena::runs; drawn one after another
  uint32_t steps = 0;  ///< of items; levels are 0 to steps + 1 (houselod::Level)
};

/// One pair of buffers.
struct ArenaChunk {
  std::vector<city::Vertex> vertices;
  std::vector<uint32_t> indices;
};

/// Invariant: a geometry lies within one chunk, each part of a run in one range of indices.
struct Arena {
  std::vector<ArenaChunk> chunks;
  std::vector<ArenaGeometry> geometries;  ///< one for each added, in order
  std::vector<ArenaRun> runs;
  std::vector<uint32_t> steps;

  bool has(ArenaPart part) const;
  bool hasFlat() const;  ///< some geometry has flat surfaces
};

/// The indices of a run's part at a level; the level is one of its geometry's.
city::Range indicesAt(const Arena& arena, const ArenaRun& run, ArenaPart part, houselod::Level level);

/// Triangles of a geometry to be added.
struct Piece {
  city::Range indices;  ///< in the geometry's indices
  uint32_t run = 0;
  /// 0: surfaces of full detail; k + 1: items of step k; kFlatSurface: flat surfaces.
  uint32_t order = 0;
};
constexpr uint32_t kFlatSurface = UINT32_MAX;

/// Largest vertex or index buffer of a chunk, bytes: well under what cards and software GL take for one buffer.
constexpr uint64_t kArenaChunkBytes = 256ull << 20;

/// Appends a geometry of `runs.size()` runs with their materials and of `steps` steps. `cutOut[material]` tells which
/// part a triangle goes to (by its first vertex). Begins a new chunk where the current one would grow over
/// `chunkBytes`. A geometry without flat surfaces has full detail alone. Indices out of range are a broken
/// precondition.
void addGeometry(Arena& arena, std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                 std::vector<Piece> pieces, std::span<const city::MaterialId> runs, uint32_t steps,
                 std::span<const uint8_t> cutOut, uint64_t chunkBytes = kArenaChunkBytes);

/// All building types in all their levels, or at full detail alone where `houses` is null. Flat walls show their
/// pictures on the pages, which are the materials from `firstPage` on; their vertices' item is the wall's own material
/// then, whose tint a seed shifts.
Arena buildingArena(const city::City& city, std::span<const uint8_t> cutOut, Ordering ordering,
                    const houselod::HouseTypes* houses, city::MaterialId firstPage = 0);
/// All tree types, a run each.
Arena treeArena(const city::City& city, std::span<const uint8_t> cutOut);

}  // namespace vicus::scenegraph
