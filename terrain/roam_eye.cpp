#include "terrain/roam_eye.hpp"

#include <cmath>

namespace vicus::terrain {
namespace {

constexpr double kFarthestPlace = 1 << 20;  // half samples; 32 times the largest field

}  // namespace

Eye eyeOf(const city::ViewState& view, const RoamSettings& settings, const city::HeightField& field) {
  Eye eye;
  eye.perspective = true;
  // From nowhere the ground is drawn as from its corner.
  const bool somewhere = std::isfinite(view.eye.x) && std::isfinite(view.eye.y) && std::isfinite(view.eye.z);
  if (somewhere) eye.position = view.eye - glm::dvec3(field.origin, 0);
  const glm::dvec2 halves = 2.0 * glm::dvec2(eye.position) / field.spacing;
  eye.place = glm::ivec2(glm::clamp(halves, -kFarthestPlace, kFarthestPlace));
  eye.rest = glm::vec2(glm::dvec2(eye.position) - glm::dvec2(eye.place) * field.spacing / 2.0);
  eye.height = static_cast<float>(eye.position.z);
  eye.heightRest = static_cast<float>(eye.position.z - static_cast<double>(eye.height));
  eye.wantedPixels = settings.pixelError;
  eye.pixelsPerRatio = settings.pixelError * settings.morph;
  eye.band = static_cast<float>(settings.morph);
  const double scale = city::pixelsPerUnitSlope(view) / eye.pixelsPerRatio;
  eye.scaleSquared = static_cast<float>(scale * scale);
  eye.scale = static_cast<float>(scale);
  if (!settings.frustum) return eye;

  const double tanY = std::tan(view.verticalFov / 2), tanX = tanY * view.aspect();
  // Wider by 2⁻²⁰ of the distance: what rounding may move.
  constexpr double kSlack = 0x1p-20;
  uint32_t count = 0;
  const auto add = [&](const glm::dvec3& normal, double distance) {
    const glm::vec3 unit(glm::normalize(normal));
    eye.planes[count++] = {unit.x, unit.y, unit.z, std::abs(unit.z), static_cast<float>(distance)};
  };
  add(view.forward * (tanX + kSlack) + view.right, 0);
  add(view.forward * (tanX + kSlack) - view.right, 0);
  add(view.forward * (tanY + kSlack) + view.up, 0);
  add(view.forward * (tanY + kSlack) - view.up, 0);
  add(view.forward, -view.nearDistance * (1 - kSlack));
  if (std::isfinite(view.farDistance)) add(-view.forward, view.farDistance * (1 + kSlack));
  eye.allPlanes = static_cast<uint8_t>((1U << count) - 1);
  return eye;
}

}  // namespace vicus::terrain
