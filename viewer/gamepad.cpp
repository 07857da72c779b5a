#include "viewer/gamepad.hpp"

#include <cmath>

namespace vicus::viewer {
namespace {

/// Nothing within the dead middle, then up to 1, gently first.
glm::dvec2 stick(float x, float y) {
  constexpr double kDead = 0.15;
  const glm::dvec2 v(std::isfinite(x) ? x : 0, std::isfinite(y) ? -y : 0);
  const double length = glm::length(v);
  if (!(length > kDead)) return glm::dvec2(0);
  const double beyond = std::min((length - kDead) / (1 - kDead), 1.0);
  return v / length * beyond * beyond;
}

}  // namespace

void addGamepad(const Gamepad& now, const Gamepad& before, Input& input) {
  enum Button : size_t { A, B, X, Y, LeftBumper, RightBumper, Back, Start };
  const auto pressed = [&](Button b) { return now.buttons[b] == 1 && before.buttons[b] == 0; };
  input.stick += stick(now.axes[0], now.axes[1]);
  input.turnStick += stick(now.axes[2], now.axes[3]);
  input.fast = input.fast || now.buttons[LeftBumper] == 1;
  input.down = input.down || now.axes[4] > 0;
  input.up = input.up || now.axes[5] > 0;
  if (pressed(A)) input.mode = Mode::Fly;
  if (pressed(X)) input.mode = Mode::Orbit;
  if (pressed(Y)) input.mode = Mode::Map;
  if (pressed(Back)) input.mode = Mode::Tour;
  input.takeBack = input.takeBack || pressed(B);
  input.help = input.help || pressed(Start);
}

}  // namespace vicus::viewer
