#include "viewer/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/surroundings.hpp"

namespace vicus::viewer {
namespace {

using std::numbers::pi;

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The velocity that the keys ask for.
glm::dvec3 wantedVelocity(const Navigator& navigator, const Input& input) {
  const double ch = std::cos(navigator.pose.heading), sh = std::sin(navigator.pose.heading);
  const double pitch = navigator.flying ? navigator.pose.pitch : 0;
  const glm::dvec3 forward(ch * std::cos(pitch), sh * std::cos(pitch), std::sin(pitch));
  const glm::dvec3 right(sh, -ch, 0);
  const auto axis = [](bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); };
  glm::dvec3 wanted = axis(input.forward, input.back) * forward + axis(input.right, input.left) * right;
  if (navigator.flying) wanted.z += axis(input.up, input.down);
  const double length = glm::length(wanted);
  if (!(length > 0)) return glm::dvec3(0);
  const double speed =
      navigator.flying ? (input.fast ? kFastFlySpeed : kFlySpeed) : (input.fast ? kRunSpeed : kWalkSpeed);
  return wanted * (speed / length);
}

}  // namespace

void step(Navigator& navigator, const Input& input, double dt, const city::City& city) {
  constexpr double kResponse = 0.1;  // seconds in which speed and height close 63 % of their gap
  constexpr double kSteepest = 89 * pi / 180;
  dt = std::isfinite(dt) ? std::clamp(dt, 0.0, kLongestStep) : 0;

  // Mend what cannot be used.
  city::ViewPose& pose = navigator.pose;
  if (!finite(pose.eye)) {
    const glm::dvec2 middle = densestPoint(city);
    pose.eye = glm::dvec3(middle, groundAt(city, middle) + kEyeHeight);
  }
  if (!std::isfinite(pose.heading)) pose.heading = 0;
  if (!std::isfinite(pose.pitch)) pose.pitch = 0;
  if (!std::isfinite(pose.roll)) pose.roll = 0;
  if (!finite(navigator.velocity)) navigator.velocity = glm::dvec3(0);
  if (input.toggleFlight) navigator.flying = !navigator.flying;

  // The head turns by what the mouse moved, however long the frame took.
  if (std::isfinite(input.mouse.x) && std::isfinite(input.mouse.y)) {
    pose.heading = std::remainder(pose.heading - kRadiansPerPixel * input.mouse.x, 2 * pi);
    pose.pitch = std::clamp(pose.pitch - kRadiansPerPixel * input.mouse.y, -kSteepest, kSteepest);
  }

  // v' = (wanted − v) / response, solved exactly over the step.
  const glm::dvec3 wanted = wantedVelocity(navigator, input);
  const double kept = std::exp(-dt / kResponse);
  pose.eye += wanted * dt + (navigator.velocity - wanted) * (kResponse * (1 - kept));
  navigator.velocity = wanted + (navigator.velocity - wanted) * kept;
  if (navigator.flying) return;

  const double ground = groundAt(city, glm::dvec2(pose.eye));
  const double standing = ground + kEyeHeight;
  pose.eye.z = std::max(standing + (pose.eye.z - standing) * kept, ground + 0.5 * kEyeHeight);
  navigator.velocity.z = 0;
}

}  // namespace vicus::viewer
