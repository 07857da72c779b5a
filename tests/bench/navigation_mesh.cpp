/// The wall grid against a navigation mesh: what each costs before the first step and for each step, and how true its
/// walls are. Usage: bench_navigation_mesh [SCENE [VOXEL]] (norvic, 0.15 m).
///
/// The mesh is Recast's as its makers recommend it for large worlds: tiles of 48 m, voxels of VOXEL metres on the plan
/// and 0.1 m high, the visitor's radius, height, step and slope. Houses are their footprints' walls and no ground. It
/// is built for 5 × 5 tiles about the middle of the town; both walk the same 100 000 random moves there.
#include <DetourNavMesh.h>
#include <DetourNavMeshBuilder.h>
#include <DetourNavMeshQuery.h>
#include <Recast.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "assets/load_city.hpp"
#include "city/random.hpp"
#include "walking/surroundings.hpp"
#include "walking/walker.hpp"

namespace vicus {
namespace {

constexpr double kTile = 48;  // metres
constexpr int kTiles = 5;     // to a side
constexpr float kVoxelHeight = 0.1f;
constexpr int kMoves = 100'000;

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Triangles in Recast's frame: metres from `middle`, y up, z south.
struct Soup {
  glm::dvec2 middle{0};
  std::vector<float> vertices;
  std::vector<int> triangles;
  std::vector<unsigned char> areas;  ///< RC_WALKABLE_AREA or RC_NULL_AREA, one for each triangle

  int add(glm::dvec3 p) {
    for (const double v : {p.x - middle.x, p.z, middle.y - p.y}) vertices.push_back(static_cast<float>(v));
    return static_cast<int>(vertices.size() / 3) - 1;
  }
  void add(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, unsigned char area) {
    for (const glm::dvec3& p : {a, b, c}) triangles.push_back(add(p));
    areas.push_back(area);
  }
};

/// Everything that `walking::gatherObstacles` gives about the middle, and the ground under it.
Soup soupOf(const city::City& city, glm::dvec2 middle, double halfSide) {
  Soup soup{.middle = middle, .vertices = {}, .triangles = {}, .areas = {}};
  constexpr double kStep = 2;
  const int n = static_cast<int>(std::ceil(2 * halfSide / kStep));
  const auto at = [&](int column, int row) {
    const glm::dvec2 p = middle + glm::dvec2(column, row) * kStep - glm::dvec2(halfSide);
    return glm::dvec3(p, walking::dryGroundAt(city, p));
  };
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const glm::dvec3 a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                       d = at(column, row + 1);
      soup.add(a, b, c, RC_WALKABLE_AREA);
      soup.add(a, c, d, RC_WALKABLE_AREA);
    }
  const walking::Obstacles obstacles = walking::gatherObstacles(city, middle, halfSide);
  for (const walking::Wall& wall : obstacles.walls) {
    const double foot = std::min(walking::dryGroundAt(city, wall.a), walking::dryGroundAt(city, wall.b)) - 1;
    const double top = std::min(wall.top, foot + 20);  // a house ends at no height
    const glm::dvec3 a(wall.a, foot), b(wall.b, foot), c(wall.b, top), d(wall.a, top);
    soup.add(a, b, c, RC_NULL_AREA);
    soup.add(a, c, d, RC_NULL_AREA);
  }
  for (const walking::Face& face : obstacles.faces)
    soup.add(face.corners[0], face.corners[1], face.corners[2], face.walkable ? RC_WALKABLE_AREA : RC_NULL_AREA);
  return soup;
}

template <typename T, void (*free)(T*)>
struct Free {
  void operator()(T* p) const { free(p); }
};
using HeightfieldPtr = std::unique_ptr<rcHeightfield, Free<rcHeightfield, rcFreeHeightField>>;
using CompactPtr = std::unique_ptr<rcCompactHeightfield, Free<rcCompactHeightfield, rcFreeCompactHeightfield>>;
using ContoursPtr = std::unique_ptr<rcContourSet, Free<rcContourSet, rcFreeContourSet>>;
using MeshPtr = std::unique_ptr<rcPolyMesh, Free<rcPolyMesh, rcFreePolyMesh>>;
using DetailPtr = std::unique_ptr<rcPolyMeshDetail, Free<rcPolyMeshDetail, rcFreePolyMeshDetail>>;
using NavMeshPtr = std::unique_ptr<dtNavMesh, Free<dtNavMesh, dtFreeNavMesh>>;
using QueryPtr = std::unique_ptr<dtNavMeshQuery, Free<dtNavMeshQuery, dtFreeNavMeshQuery>>;

/// One tile's navigation data (Detour frees it), or nothing where nobody can stand.
std::optional<std::pair<unsigned char*, int>> buildTile(const Soup& soup, float voxel, int column, int row) {
  rcContext context(false);
  rcConfig config{};
  config.cs = voxel, config.ch = kVoxelHeight;
  config.walkableSlopeAngle = 50;
  config.walkableHeight = static_cast<int>(std::ceil(walking::kTall / kVoxelHeight));
  config.walkableClimb = static_cast<int>(std::floor(walking::kStep / kVoxelHeight));
  config.walkableRadius = static_cast<int>(std::ceil(walking::kRadius / voxel));
  config.maxEdgeLen = static_cast<int>(12 / voxel);
  config.maxSimplificationError = 1.3f;
  config.minRegionArea = 64, config.mergeRegionArea = 400;
  config.maxVertsPerPoly = DT_VERTS_PER_POLYGON;
  config.detailSampleDist = 6 * voxel, config.detailSampleMaxError = kVoxelHeight;
  config.tileSize = static_cast<int>(std::round(kTile / voxel));
  config.borderSize = config.walkableRadius + 3;
  config.width = config.height = config.tileSize + 2 * config.borderSize;
  const double half = kTile * kTiles / 2, border = config.borderSize * double{voxel};
  config.bmin[0] = static_cast<float>(column * kTile - half - border), config.bmin[1] = -1000;
  config.bmin[2] = static_cast<float>(row * kTile - half - border);
  config.bmax[0] = static_cast<float>((column + 1) * kTile - half + border), config.bmax[1] = 1000;
  config.bmax[2] = static_cast<float>((row + 1) * kTile - half + border);

  std::vector<int> triangles;
  std::vector<unsigned char> areas;
  float low = 1e9f, high = -1e9f;
  for (size_t t = 0; t < soup.areas.size(); ++t) {
    const int* corners = &soup.triangles[3 * t];
    glm::vec3 min(1e9f), max(-1e9f);
    for (int k = 0; k < 3; ++k) {
      const float* p = &soup.vertices[3 * static_cast<size_t>(corners[k])];
      min = glm::min(min, glm::vec3(p[0], p[1], p[2])), max = glm::max(max, glm::vec3(p[0], p[1], p[2]));
    }
    if (max.x < config.bmin[0] || min.x > config.bmax[0] || max.z < config.bmin[2] || min.z > config.bmax[2]) continue;
    triangles.insert(triangles.end(), corners, corners + 3);
    areas.push_back(soup.areas[t]);
    low = std::min(low, min.y), high = std::max(high, max.y);
  }
  config.bmin[1] = low - 1, config.bmax[1] = high + 3;

  const HeightfieldPtr solid(rcAllocHeightfield());
  if (!rcCreateHeightfield(&context, *solid, config.width, config.height, config.bmin, config.bmax, voxel,
                           kVoxelHeight) ||
      !rcRasterizeTriangles(&context, soup.vertices.data(), static_cast<int>(soup.vertices.size() / 3),
                            triangles.data(), areas.data(), static_cast<int>(areas.size()), *solid,
                            config.walkableClimb))
    return std::nullopt;
  rcFilterLowHangingWalkableObstacles(&context, config.walkableClimb, *solid);
  rcFilterLedgeSpans(&context, config.walkableHeight, config.walkableClimb, *solid);
  rcFilterWalkableLowHeightSpans(&context, config.walkableHeight, *solid);
  const CompactPtr open(rcAllocCompactHeightfield());
  const ContoursPtr contours(rcAllocContourSet());
  const MeshPtr mesh(rcAllocPolyMesh());
  const DetailPtr detail(rcAllocPolyMeshDetail());
  if (!rcBuildCompactHeightfield(&context, config.walkableHeight, config.walkableClimb, *solid, *open) ||
      !rcErodeWalkableArea(&context, config.walkableRadius, *open) || !rcBuildDistanceField(&context, *open) ||
      !rcBuildRegions(&context, *open, config.borderSize, config.minRegionArea, config.mergeRegionArea) ||
      !rcBuildContours(&context, *open, config.maxSimplificationError, config.maxEdgeLen, *contours) ||
      contours->nconts == 0 || !rcBuildPolyMesh(&context, *contours, config.maxVertsPerPoly, *mesh) ||
      !rcBuildPolyMeshDetail(&context, *mesh, *open, config.detailSampleDist, config.detailSampleMaxError, *detail))
    return std::nullopt;
  std::fill_n(mesh->flags, mesh->npolys, uint16_t{1});
  dtNavMeshCreateParams params{};
  params.verts = mesh->verts, params.vertCount = mesh->nverts;
  params.polys = mesh->polys, params.polyAreas = mesh->areas, params.polyFlags = mesh->flags;
  params.polyCount = mesh->npolys, params.nvp = mesh->nvp;
  params.detailMeshes = detail->meshes, params.detailVerts = detail->verts, params.detailVertsCount = detail->nverts;
  params.detailTris = detail->tris, params.detailTriCount = detail->ntris;
  params.walkableHeight = static_cast<float>(walking::kTall),
  params.walkableRadius = static_cast<float>(walking::kRadius);
  params.walkableClimb = static_cast<float>(walking::kStep);
  params.tileX = column, params.tileY = row;
  std::copy_n(mesh->bmin, 3, params.bmin), std::copy_n(mesh->bmax, 3, params.bmax);
  params.cs = voxel, params.ch = kVoxelHeight, params.buildBvTree = true;
  std::pair<unsigned char*, int> data{nullptr, 0};
  if (!dtCreateNavMeshData(&params, &data.first, &data.second)) return std::nullopt;
  return data;
}

/// What a walk showed: its time, and how near to walls it came.
struct Walk {
  double seconds = 0, metres = 0, nearest = 1e9, furtherOff = 0;
  int contacts = 0;
};

/// The body's distance to the nearest footprint after a move that was cut short; `walk` keeps the least and the sum of
/// what is lost to the radius.
void touch(Walk& walk, const city::City& city, glm::dvec2 at) {
  const double apart = walking::clearance(city, at, 1.5);
  walk.nearest = std::min(walk.nearest, apart);
  if (apart < 1.5) walk.furtherOff += apart - walking::kRadius, ++walk.contacts;
}

/// The moves: mostly straight on, sometimes a turn, 0.02 to 0.2 m.
class Moves {
 public:
  glm::dvec2 next() {
    if (random_.uniform() < 0.02) heading_ = random_.uniform(0, 2 * std::numbers::pi);
    return random_.uniform(0.02, 0.2) * glm::dvec2(std::cos(heading_), std::sin(heading_));
  }

 private:
  city::Random random_{7};
  double heading_ = 0;
};

void print(const char* name, const Walk& walk) {
  std::printf(
      "%-16s %7.2f µs a move, %8.0f m walked, nearest to a wall %6.3f m, %d moves cut short, there %6.3f m farther off "
      "than the radius\n",
      name, walk.seconds / kMoves * 1e6, walk.metres, walk.nearest, walk.contacts,
      walk.contacts > 0 ? walk.furtherOff / walk.contacts : 0.0);
}

int run(const std::string& scene, float voxel) {
  const assets::LoadResult loaded = assets::loadCity(std::vector<std::string>{scene}, {});
  if (!loaded.city) return std::fprintf(stderr, "%s cannot be read\n", scene.c_str()), 1;
  const city::City& city = *loaded.city;
  const glm::dvec2 middle = walking::densestPoint(city);
  const double half = kTile * kTiles / 2;

  walking::Ground ground(city);
  auto start = Clock::now();
  const std::optional<walking::Standing> first = ground.place(middle, walking::groundAt(city, middle));
  if (!first) return std::fprintf(stderr, "nowhere to stand in %s\n", scene.c_str()), 1;
  std::printf("%s, %g m about (%.0f, %.0f)\nwall grid        %.1f ms before the first step\n", scene.c_str(), half,
              middle.x, middle.y, secondsSince(start) * 1e3);
  const auto inside = [&](glm::dvec2 p) {
    return std::abs(p.x - middle.x) < half - 2 && std::abs(p.y - middle.y) < half - 2;
  };
  {
    Walk walk;
    Moves moves;
    walking::Standing at = *first;
    std::vector<glm::dvec2> cutShort;
    start = Clock::now();
    for (int k = 0; k < kMoves; ++k) {
      const glm::dvec2 step = moves.next();
      if (!inside(at.at + step)) continue;
      const walking::Standing next = ground.move(at, step);
      const double way = glm::distance(next.at, at.at);
      walk.metres += way;
      if (way < 0.9 * glm::length(step)) cutShort.push_back(next.at);
      at = next;
    }
    walk.seconds = secondsSince(start);
    for (const glm::dvec2 p : cutShort) touch(walk, city, p);
    print("wall grid", walk);
  }

  const Soup soup = soupOf(city, middle, half + 2);
  start = Clock::now();
  const NavMeshPtr mesh(dtAllocNavMesh());
  dtNavMeshParams params{};
  params.orig[0] = params.orig[2] = static_cast<float>(-half);
  params.tileWidth = params.tileHeight = static_cast<float>(kTile);
  params.maxTiles = kTiles * kTiles, params.maxPolys = 1 << 14;
  if (dtStatusFailed(mesh->init(&params))) return 1;
  int64_t bytes = 0;
  for (int row = 0; row < kTiles; ++row)
    for (int column = 0; column < kTiles; ++column)
      if (const auto data = buildTile(soup, voxel, column, row)) {
        bytes += data->second;
        mesh->addTile(data->first, data->second, DT_TILE_FREE_DATA, 0, nullptr);
      }
  const double built = secondsSince(start), area = std::pow(kTile * kTiles / 1000, 2);
  const glm::dvec3 reach = city.extent.max - city.extent.min;
  std::printf("navigation mesh  %.1f s and %.2f MB for %.3f km²: %.0f s and %.0f MB for the whole city of %.1f km²\n",
              built, static_cast<double>(bytes) / 1e6, area, built / area * reach.x * reach.y / 1e6,
              static_cast<double>(bytes) / 1e6 / area * reach.x * reach.y / 1e6, reach.x * reach.y / 1e6);

  const QueryPtr query(dtAllocNavMeshQuery());
  if (dtStatusFailed(query->init(mesh.get(), 2048))) return 1;
  const dtQueryFilter filter;
  const auto recast = [&](glm::dvec2 p, double z) {
    return std::array{static_cast<float>(p.x - middle.x), static_cast<float>(z), static_cast<float>(middle.y - p.y)};
  };
  dtPolyRef ref = 0;
  std::array<float, 3> at = recast(first->at, first->feet);
  const float box[] = {4, 4, 4};
  std::array<float, 3> onMesh{};
  if (dtStatusFailed(query->findNearestPoly(at.data(), box, &filter, &ref, onMesh.data())) || ref == 0)
    return std::fprintf(stderr, "the navigation mesh has no ground there\n"), 1;
  at = onMesh;
  const auto plan = [&](const std::array<float, 3>& p) { return middle + glm::dvec2(p[0], -p[2]); };
  Walk walk;
  Moves moves;
  std::vector<glm::dvec2> cutShort;
  double worstHeight = 0;
  start = Clock::now();
  for (int k = 0; k < kMoves; ++k) {
    const glm::dvec2 step = moves.next(), from = plan(at);
    if (!inside(from + step)) continue;
    const std::array<float, 3> to = recast(from + step, at[1]);
    std::array<float, 3> end{};
    std::array<dtPolyRef, 16> visited{};
    int count = 0;
    if (dtStatusFailed(
            query->moveAlongSurface(ref, at.data(), to.data(), &filter, end.data(), visited.data(), &count, 16)))
      continue;
    if (count > 0) ref = visited[static_cast<size_t>(count - 1)];
    query->getPolyHeight(ref, end.data(), &end[1]);
    const double way = glm::distance(plan(end), from);
    walk.metres += way;
    if (way < 0.9 * glm::length(step)) cutShort.push_back(plan(end));
    at = end;
  }
  walk.seconds = secondsSince(start);
  for (const glm::dvec2 p : cutShort) touch(walk, city, p);
  print("navigation mesh", walk);

  // Where one can stand: points of the plan, and whether the mesh has ground within a voxel.
  city::Random random(11);
  int standable = 0, missing = 0, wrong = 0;
  for (int k = 0; k < 20'000; ++k) {
    const glm::dvec2 p = middle + (half - 2) * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
    const double z = walking::dryGroundAt(city, p);
    const bool stands = ground.stands({p, z}) && walking::clearance(city, p, 1) > 0;
    const std::array<float, 3> where = recast(p, z);
    const float near[] = {voxel / 2, 0.5f, voxel / 2};
    dtPolyRef found = 0;
    std::array<float, 3> point{};
    query->findNearestPoly(where.data(), near, &filter, &found, point.data());
    const bool has = found != 0 && std::hypot(point[0] - where[0], point[2] - where[2]) < voxel / 2;
    if (has && stands) worstHeight = std::max(worstHeight, std::abs(point[1] - z));
    standable += stands, missing += stands && !has;
    wrong += has && walking::clearance(city, p, 1) < walking::kRadius - 0.01 && walking::clearance(city, p, 1) > 0;
  }
  std::printf(
      "of %d places where one stands the mesh lacks %.1f %%; %d that it has are nearer to a wall than the radius; its "
      "ground lies up to %.2f m off\n",
      standable, 100.0 * missing / std::max(1, standable), wrong, worstHeight);
  return 0;
}

}  // namespace
}  // namespace vicus

int main(int count, char** words) {
  return vicus::run(count > 1 ? words[1] : "norvic", count > 2 ? std::strtof(words[2], nullptr) : 0.15f);
}
