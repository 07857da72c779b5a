#include "city/view_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicus::city {

ViewState::ViewState() : farDistance(std::numeric_limits<double>::infinity()) {}

ViewState makeView(const ViewPose& pose, double verticalFov, glm::ivec2 viewport, const ViewState& fallback) {
  ViewState view = fallback;
  for (int k = 0; k < 3; ++k)
    if (std::isfinite(pose.eye[k])) view.eye[k] = pose.eye[k];
  if (std::isfinite(verticalFov)) view.verticalFov = std::clamp(verticalFov, kSmallestFov, kLargestFov);
  view.viewport = glm::clamp(viewport, glm::ivec2(1), glm::ivec2(16384));
  if (!std::isfinite(pose.heading) || !std::isfinite(pose.pitch) || !std::isfinite(pose.roll)) return view;

  // Heading and pitch give the frame without a cross product, so straight up and down are as good as any other
  // direction.
  const double ch = std::cos(pose.heading), sh = std::sin(pose.heading);
  const double cp = std::cos(pose.pitch), sp = std::sin(pose.pitch);
  const double cr = std::cos(pose.roll), sr = std::sin(pose.roll);
  const glm::dvec3 level(sh, -ch, 0);
  const glm::dvec3 upright(-ch * sp, -sh * sp, cp);
  view.forward = {ch * cp, sh * cp, sp};
  view.right = cr * level - sr * upright;
  view.up = sr * level + cr * upright;
  return view;
}

glm::dmat3 eyeFromWorldRotation(const ViewState& view) {
  return glm::transpose(glm::dmat3(view.right, view.up, -view.forward));
}

glm::dmat4 clipFromEye(const ViewState& view) {
  const double focal = 1 / std::tan(view.verticalFov / 2);
  const double n = view.nearDistance, f = view.farDistance;
  glm::dmat4 m(0);
  m[0][0] = focal / view.aspect();
  m[1][1] = focal;
  m[2][3] = -1;
  // z_clip = n for the infinite far plane; else the line through depth 1 at n and 0 at f.
  m[2][2] = std::isfinite(f) ? n / (f - n) : 0;
  m[3][2] = std::isfinite(f) ? f * n / (f - n) : n;
  return m;
}

glm::dmat4 clipFromEyeRelative(const ViewState& view) {
  return clipFromEye(view) * glm::dmat4(eyeFromWorldRotation(view));
}

glm::dmat4 clipFromWorld(const ViewState& view) {
  glm::dmat4 relative(1);
  relative[3] = glm::dvec4(-view.eye, 1);
  return clipFromEyeRelative(view) * relative;
}

double pixelsPerUnitSlope(const ViewState& view) {
  return view.viewport.y / (2 * std::tan(view.verticalFov / 2));
}

}  // namespace vicus::city
