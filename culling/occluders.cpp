#include "culling/occluders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "culling/monument_walls.hpp"
#include "culling/occluder_caps.hpp"

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::City;
using city::kNone;
using city::Range;
using glm::dvec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A wall counts as standing in the ground when its foot is this deep in it where the terrain was sampled.
constexpr double kInGround = 0.02;
constexpr double kSampleStep = 1;      ///< metres between samples of the terrain along a wall
constexpr double kSmallestWall = 0.1;  ///< metres long: shorter ones cover no column
constexpr float kLowestWall = 0.5f;    ///< metres above the building's ground: lower ones hide nothing of note
constexpr double kFarthestJut = 2;     ///< metres that a storey may stand out over the ground floor

/// Whether `upper` goes on above `lower` as high as `top`: in the same upright plane, over its whole length.
bool goesOnAbove(const city::OccluderLine& lower, float top, const city::OccluderLine& upper) {
  if (upper.bottom > top + 1e-3f || upper.top <= top) return false;
  const dvec2 a(lower.a), b(lower.b), along = b - a, dir = along / glm::length(along);
  const auto local = [&](glm::vec2 p) {
    const dvec2 d = dvec2(p) - a;
    return dvec2(glm::dot(d, dir), dir.x * d.y - dir.y * d.x);
  };
  const dvec2 from = local(upper.a), to = local(upper.b);
  if (std::abs(from.y) > kSamePoint || std::abs(to.y) > kSamePoint) return false;
  return from.x <= kSamePoint && to.x >= glm::length(along) - kSamePoint;
}

/// How far outside of `lower` the wall `upper` stands when it is that of a storey which juts out above it, its
/// underside closed by a floor from `reach` on (what stands out so far already); 0 where it is not. Behind such a front
/// the building is solid above the lower wall too.
double jutAbove(const city::BuildingGeometry& type, const city::OccluderLine& lower, float top, double reach,
                const city::OccluderLine& upper) {
  if (std::abs(upper.bottom - top) > 1e-3f || upper.top <= top) return 0;
  const dvec2 a(lower.a), b(lower.b), along = b - a, dir = along / glm::length(along);
  const auto local = [&](glm::vec2 p) {
    const dvec2 d = dvec2(p) - a;
    return dvec2(glm::dot(d, dir), dir.x * d.y - dir.y * d.x);
  };
  const dvec2 from = local(upper.a), to = local(upper.b);
  if (std::abs(from.y - to.y) > kSamePoint || from.y > -reach - kSamePoint || from.y < -kFarthestJut) return 0;
  if (from.x > kSamePoint || to.x < glm::length(along) - kSamePoint) return 0;
  // The floor between them is drawn, facing down, from one end to the other.
  for (const city::Plane& plane : type.planes) {
    if (plane.kind != city::PlaneKind::Floor || plane.normal.z > -0.99f || plane.cut.count == 0) continue;
    dvec2 lo(kInfinity), hi(-kInfinity);
    bool level = true;
    for (uint32_t i = plane.cut.first; i < plane.cut.end(); ++i) {
      const glm::vec3 p = type.vertices[type.indices[i]].position;
      level = level && std::abs(p.z - top) <= 1e-3f;
      lo = glm::min(lo, local(glm::vec2(p))), hi = glm::max(hi, local(glm::vec2(p)));
    }
    if (level && lo.x <= kSamePoint && hi.x >= glm::length(along) - kSamePoint && hi.y >= -reach - kSamePoint &&
        lo.y <= from.y + kSamePoint)
      return -from.y;
  }
  return 0;
}

std::vector<OccluderWall> wallsOf(const city::BuildingGeometry& type) {
  std::vector<OccluderWall> walls;
  for (const city::OccluderLine& line : type.occluders) {
    if (!(glm::distance(line.a, line.b) >= static_cast<float>(kSmallestWall)) || !(line.bottom <= 0)) continue;
    OccluderWall wall{dvec2(line.a), dvec2(line.b), line.bottom, line.top};
    // Storey upon storey, as often as one goes on above the others.
    for (bool grew = true; grew;) {
      grew = false;
      for (const city::OccluderLine& upper : type.occluders) {
        const double jut = jutAbove(type, line, wall.top, wall.reach, upper);
        if (jut > 0 || (wall.reach == 0 && goesOnAbove(line, wall.top, upper)))
          wall.top = upper.top, wall.reach = std::max(wall.reach, jut), grew = true;
      }
    }
    if (wall.top > kLowestWall) walls.push_back(wall);
  }
  for (uint32_t i = 0; i < walls.size(); ++i)
    for (uint32_t k = 0; k < walls.size(); ++k)
      if (i != k && walls[i].next == kNone && walls[k].previous == kNone &&
          glm::distance(walls[i].b, walls[k].a) <= kSamePoint) {
        walls[i].b = walls[k].a;
        walls[i].next = k, walls[k].previous = i;
      }
  return walls;
}

/// Whether the terrain is at or above the height `foot` all along a → b.
bool standsIn(const city::HeightField& terrain, dvec2 a, dvec2 b, double foot) {
  const int steps = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / kSampleStep)));
  for (int i = 0; i <= steps; ++i) {
    const dvec2 p = a + (b - a) * (static_cast<double>(i) / steps);
    const std::optional<double> ground = terrain.heightAt(p.x, p.y);
    if (!ground || *ground < foot + kInGround) return false;
  }
  return true;
}

}  // namespace

Occluders occludersOf(const City& city) {
  Occluders out;
  out.ofType.reserve(city.buildingTypes.size());
  for (const city::BuildingGeometry& type : city.buildingTypes) {
    const std::vector<OccluderWall> walls = wallsOf(type);
    out.ofType.push_back({static_cast<uint32_t>(out.walls.size()), static_cast<uint32_t>(walls.size())});
    out.walls.insert(out.walls.end(), walls.begin(), walls.end());
    const std::vector<BuildingSlab> slabs = slabsOf(type);
    out.slabsOfType.push_back({static_cast<uint32_t>(out.slabs.size()), static_cast<uint32_t>(slabs.size())});
    out.slabs.insert(out.slabs.end(), slabs.begin(), slabs.end());
    const std::vector<OccluderCap> caps = capsOf(type, walls, out.capPoints);
    out.capsOfType.push_back({static_cast<uint32_t>(out.caps.size()), static_cast<uint32_t>(caps.size())});
    out.caps.insert(out.caps.end(), caps.begin(), caps.end());
    float recess = 0;
    for (const city::ExternalOpening& opening : type.externalOpenings) recess = std::max(recess, opening.depth);
    out.recess.push_back(recess);
  }

  out.terrain = city.terrain && !city.terrain->empty();
  out.lowest = kInfinity, out.highest = -kInfinity;
  const auto reach = [&](const Aabbf& box) {
    if (box.empty()) return;
    out.lowest = std::min(out.lowest, static_cast<double>(box.min.z));
    out.highest = std::max(out.highest, static_cast<double>(box.max.z));
  };
  for (const city::InstanceSet* set : {&city.buildings, &city.trees})
    if (!set->nodes.empty()) reach(set->nodes[0].bounds);
  for (const city::Monument& monument : city.monuments) reach(monument.bounds);

  out.firstOfBuilding.reserve(city.buildings.size() + 1);
  for (const city::Instance& instance : city.buildings.instances) {
    out.firstOfBuilding.push_back(static_cast<uint32_t>(out.stands.size()));
    const Range range = out.ofType[instance.geometry];
    const Placement cityFromBuilding(instance);
    for (uint32_t i = range.first; i < range.end(); ++i) {
      const OccluderWall& wall = out.walls[i];
      const double foot = instance.position.z + static_cast<double>(wall.bottom);
      const bool stands = out.terrain
                              ? standsIn(*city.terrain, cityFromBuilding(wall.a), cityFromBuilding(wall.b), foot)
                              : foot <= out.lowest + kSamePoint;
      out.stands.push_back(stands);
      out.standing += stands;
    }
  }
  out.firstOfBuilding.push_back(static_cast<uint32_t>(out.stands.size()));

  for (const city::Monument& monument : city.monuments) {
    const auto first = static_cast<uint32_t>(out.monumentWalls.size());
    city::Instance instance;
    instance.position = monument.position, instance.heading = monument.heading;
    const Placement cityFromMesh(instance);
    for (MeshWall wall : uprightQuadsOf(city.meshes[monument.mesh].mesh)) {
      wall.a = cityFromMesh(wall.a), wall.b = cityFromMesh(wall.b);
      for (double* z : {&wall.bottom, &wall.topA, &wall.topB}) *z += monument.position.z;
      if (out.terrain ? standsIn(*city.terrain, wall.a, wall.b, wall.bottom) : wall.bottom <= out.lowest + kSamePoint)
        out.monumentWalls.push_back(wall);
    }
    out.ofMonument.push_back({first, static_cast<uint32_t>(out.monumentWalls.size()) - first});
  }
  return out;
}

}  // namespace vicus::culling
