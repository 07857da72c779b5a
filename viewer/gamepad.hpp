/// A gamepad with two sticks, in the layout that GLFW gives all known pads.
#pragma once

#include <array>
#include <cstdint>

#include "viewer/navigator.hpp"

namespace vicus::viewer {

/// What a pad says at one moment. Axes −1 … 1: left x, left y, right x, right y (down positive), left and right trigger
/// (−1 let go).
struct Gamepad {
  std::array<float, 6> axes{0, 0, 0, 0, -1, -1};
  std::array<uint8_t, 15> buttons{};  ///< 1: held; A B X Y LB RB Back Start Guide LT RT up right down left
};

/// Adds what the pad asks for: the left stick moves and the right one looks; LB held runs; the triggers go down and up;
/// A walk or fly, B take me back, X orbit, Y map, Back tour, Start help. What is held since `before` counts once.
/// Sticks within 15 % of the middle rest; values that are not finite count as 0.
void addGamepad(const Gamepad& now, const Gamepad& before, Input& input);

}  // namespace vicus::viewer
