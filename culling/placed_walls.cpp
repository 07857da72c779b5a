#include "culling/placed_walls.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::culling {

using glm::dvec2;

namespace {

/// Metres about the eye within which the near plane may cut a surface open.
double clearanceOf(const city::ViewState& view) {
  const double up = std::tan(view.verticalFov / 2), right = up * view.aspect();
  return 0.02 + 1.01 * view.nearDistance * std::sqrt(1 + up * up + right * right);
}

}  // namespace

double distanceToSegment2(dvec2 a, dvec2 b) {
  const dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(-glm::dot(a, along) / length2, 0.0, 1.0) : 0;
  const dvec2 nearest = a + t * along;
  return glm::dot(nearest, nearest);
}

PlacedWalls::PlacedWalls(const city::City& city, const Occluders& occluders, const city::ViewState& view)
    : eye(view.eye), city_(&city), occluders_(&occluders), clear_(clearanceOf(view)) {}

int PlacedWalls::place(uint32_t building) {
  const city::Instance& instance = city_->buildings.instances[building];
  const city::Range range = occluders_->ofType[instance.geometry];
  const uint8_t* stands = occluders_->stands.data() + occluders_->firstOfBuilding[building];
  const Placement cityFromBuilding(instance);
  walls.resize(range.count);
  int facing = 0;
  for (uint32_t i = 0; i < range.count; ++i) {
    const OccluderWall& wall = occluders_->walls[range.first + i];
    PlacedWall& p = walls[i];
    p.faces = p.done = false;
    if (!stands[i]) continue;
    const dvec2 from(eye);
    p.a = cityFromBuilding(wall.a) - from, p.b = cityFromBuilding(wall.b) - from;
    const dvec2 along = p.b - p.a;
    // Outside is on the right of a → b. The eye, at 0, is this far outside:
    const double outside = (along.x * p.a.y - along.y * p.a.x) / glm::length(along);
    if (!(outside > (wall.reach > 0 ? wall.reach + clear_ : kFacing))) continue;
    if (!occluders_->terrain && instance.position.z + static_cast<double>(wall.bottom) > eye.z) continue;
    if (distanceToSegment2(p.a, p.b) < clear_ * clear_) continue;
    p.faces = true;
    ++facing;
  }
  return facing;
}

bool PlacedWalls::faces(const MeshWall& wall) const {
  const dvec2 a = wall.a - dvec2(eye), b = wall.b - dvec2(eye), along = b - a;
  return (along.x * a.y - along.y * a.x) / glm::length(along) > kFacing &&
         (occluders_->terrain || wall.bottom <= eye.z) && distanceToSegment2(a, b) >= clear_ * clear_;
}

}  // namespace vicus::culling
