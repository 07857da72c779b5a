#include "scenegraph/arena.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace vicus::scenegraph {
namespace {

/// A type's vertices and indices with its walls' pictures put on its flat surfaces. Vertices have as their item the
/// material whose tint a house's seed shifts: their own, on flat surfaces that of the wall, so that the shift stays.
struct Pictured {
  std::vector<city::Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<city::Range> flats;  ///< for each plane
};

Pictured withPictures(const city::BuildingGeometry& g, const houselod::TexturePlan& plan,
                      std::span<const houselod::PlanePicture> pictures, city::MaterialId firstPage) {
  Pictured out{g.vertices, g.indices, {}};
  for (city::Vertex& v : out.vertices) v.item = v.material;
  for (const city::Plane& plane : g.planes) {
    out.flats.push_back(plane.flat);
    if (plane.flat != plane.cut)
      for (uint32_t i = plane.flat.first; i < plane.flat.end(); ++i)
        out.vertices[g.indices[i]].item = plane.baseTexture;
  }
  for (const houselod::PlanePicture& picture : pictures) {
    const city::Plane& plane = g.planes[picture.plane];
    const houselod::PlaneFrame frame = houselod::planeFrame(g, plane);
    city::Range& flat = out.flats[picture.plane];
    flat = {static_cast<uint32_t>(out.indices.size()), plane.flat.count};
    for (uint32_t i = plane.flat.first; i < plane.flat.end(); ++i) {
      city::Vertex v = g.vertices[g.indices[i]];
      v.uv = houselod::onPage(plan, picture, frame, v.position);
      v.item = plane.baseTexture;
      v.material = static_cast<city::MaterialId>(firstPage + picture.page);
      out.indices.push_back(static_cast<uint32_t>(out.vertices.size()));
      out.vertices.push_back(v);
    }
  }
  return out;
}

/// The pieces of a building type; in scene order each plane is a run.
std::vector<Piece> piecesOf(const city::BuildingGeometry& g, std::span<const city::Range> flats,
                            const houselod::TypeLevels& levels, Ordering ordering) {
  std::vector<Piece> pieces;
  const auto add = [&](const city::Range& indices, uint32_t run, uint32_t order) {
    if (indices.count > 0) pieces.push_back({indices, run, order});
  };
  for (uint32_t p = 0; p < g.planes.size(); ++p) {
    const city::Plane& plane = g.planes[p];
    const uint32_t run = ordering == Ordering::Scene ? p : 0;
    const auto addOpenings = [&](uint32_t order) {
      for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
        add(g.externalOpenings[i].indices, run, order);
    };
    const bool whole = houselod::staysWhole(plane);
    const auto addItems = [&](uint32_t order) {
      for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i)
        add(g.externalGeometry[i].indices, run, whole ? order : 1 + levels.stepOf[i]);
    };
    add(plane.cut, run, 0);
    addOpenings(0);
    addItems(0);
    if (!levels.flat) continue;
    add(flats[p], run, kFlatSurface);
    if (whole) addOpenings(kFlatSurface), addItems(kFlatSurface);
  }
  return pieces;
}

/// Every item in one step, and no flat walls.
houselod::TypeLevels fullDetailOf(const city::BuildingGeometry& g) {
  houselod::TypeLevels levels;
  levels.reaches = {0};
  levels.stepOf.assign(g.externalGeometry.size(), 0);
  return levels;
}

}  // namespace

bool Arena::hasFlat() const {
  return std::any_of(runs.begin(), runs.end(), [](const ArenaRun& run) {
    return std::any_of(std::begin(run.parts), std::end(run.parts), [](const ArenaPiece& p) { return p.end > p.flat; });
  });
}

bool Arena::has(ArenaPart part) const {
  return std::any_of(runs.begin(), runs.end(), [&](const ArenaRun& run) {
    const ArenaPiece& piece = run.parts[static_cast<size_t>(part)];
    return piece.end > piece.first;
  });
}

city::Range indicesAt(const Arena& arena, const ArenaRun& run, ArenaPart part, houselod::Level level) {
  const ArenaPiece& piece = run.parts[static_cast<size_t>(part)];
  if (level == houselod::kFullDetail) return {piece.first, piece.flat - piece.first};
  const uint32_t first = arena.steps[piece.steps + level - 1u];
  return {first, piece.end - first};
}

void addGeometry(Arena& arena, std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                 std::vector<Piece> pieces, std::span<const city::MaterialId> runs, uint32_t steps,
                 std::span<const uint8_t> cutOut, uint64_t chunkBytes) {
  size_t count = 0;
  for (const Piece& piece : pieces) count += piece.indices.count;
  const auto full = [&](const ArenaChunk& chunk) {
    return (chunk.vertices.size() + vertices.size()) * sizeof(city::Vertex) > chunkBytes ||
           (chunk.indices.size() + count) * sizeof(uint32_t) > chunkBytes;
  };
  if (arena.chunks.empty() || (full(arena.chunks.back()) && !arena.chunks.back().vertices.empty()))
    arena.chunks.emplace_back();
  ArenaChunk& chunk = arena.chunks.back();

  ArenaGeometry geometry;
  geometry.chunk = static_cast<uint32_t>(arena.chunks.size() - 1);
  geometry.baseVertex = static_cast<int32_t>(chunk.vertices.size());
  geometry.runs = {static_cast<uint32_t>(arena.runs.size()), static_cast<uint32_t>(runs.size())};
  geometry.steps = steps;
  chunk.vertices.insert(chunk.vertices.end(), vertices.begin(), vertices.end());

  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const Piece& a, const Piece& b) { return a.run != b.run ? a.run < b.run : a.order < b.order; });
  size_t next = 0;
  for (uint32_t r = 0; r < runs.size(); ++r) {
    const size_t begin = next;
    while (next < pieces.size() && pieces[next].run == r) ++next;
    ArenaRun run;
    run.material = runs[r];
    for (size_t part = 0; part < kArenaParts; ++part) {
      ArenaPiece& out = run.parts[part];
      const auto here = [&] { return static_cast<uint32_t>(chunk.indices.size()); };
      out.first = here();
      out.steps = static_cast<uint32_t>(arena.steps.size());
      arena.steps.resize(arena.steps.size() + steps + 1);
      uint32_t step = 0;  // steps whose beginning is known
      for (size_t k = begin; k < next; ++k) {
        const Piece& piece = pieces[k];
        while (step <= steps && piece.order > step) arena.steps[out.steps + step++] = here();
        for (uint32_t i = piece.indices.first; i + 2 < piece.indices.end(); i += 3) {
          assert(std::max({indices[i], indices[i + 1], indices[i + 2]}) < vertices.size());
          const city::MaterialId material = vertices[indices[i]].material;
          const bool holes = material < cutOut.size() && cutOut[material] != 0;
          if (holes == (part == static_cast<size_t>(ArenaPart::CutOut)))
            chunk.indices.insert(chunk.indices.end(), &indices[i], &indices[i] + 3);
        }
      }
      while (step <= steps) arena.steps[out.steps + step++] = here();
      out.flat = arena.steps[out.steps + steps];
      out.end = here();
    }
    arena.runs.push_back(run);
  }
  arena.geometries.push_back(geometry);
}

Arena buildingArena(const city::City& city, std::span<const uint8_t> cutOut, Ordering ordering,
                    const houselod::HouseTypes* houses, city::MaterialId firstPage) {
  const houselod::TexturePlan none;
  const houselod::TexturePlan& pictures = houses ? houses->pictures : none;
  Arena arena;
  arena.geometries.reserve(city.buildingTypes.size());
  std::vector<city::MaterialId> materials;
  size_t nextPicture = 0;
  for (uint32_t t = 0; t < city.buildingTypes.size(); ++t) {
    const city::BuildingGeometry& g = city.buildingTypes[t];
    const size_t firstPicture = nextPicture;
    while (nextPicture < pictures.pictures.size() && pictures.pictures[nextPicture].type == t) ++nextPicture;
    const houselod::TypeLevels levels = houses ? houses->levels[t] : fullDetailOf(g);
    materials.clear();
    if (ordering == Ordering::Scene)
      for (const city::Plane& plane : g.planes) materials.push_back(plane.baseTexture);
    else
      materials.push_back(g.planes.empty() ? city::MaterialId{0} : g.planes[0].baseTexture);
    const auto steps = static_cast<uint32_t>(levels.reaches.size());
    const Pictured pictured = withPictures(
        g, pictures, std::span(pictures.pictures).subspan(firstPicture, nextPicture - firstPicture), firstPage);
    addGeometry(arena, pictured.vertices, pictured.indices, piecesOf(g, pictured.flats, levels, ordering), materials,
                steps, cutOut);
  }
  return arena;
}

Arena treeArena(const city::City& city, std::span<const uint8_t> cutOut) {
  Arena arena;
  for (const city::MeshGeometry& g : city.treeTypes) {
    const city::MaterialId material = g.mesh.vertices.empty() ? city::MaterialId{0} : g.mesh.vertices[0].material;
    addGeometry(arena, g.mesh.vertices, g.mesh.indices, {{{0, static_cast<uint32_t>(g.mesh.indices.size())}, 0, 0}},
                {&material, 1}, 0, cutOut);
  }
  return arena;
}

}  // namespace vicus::scenegraph
