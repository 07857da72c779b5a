/// The visitor's own way: keys and mouse to the next pose.
#pragma once

#include <glm/glm.hpp>

#include "city/city.hpp"
#include "city/view_state.hpp"

namespace vicus::viewer {

/// What the devices said since the last frame. Anything may be missing or not finite.
struct Input {
  bool forward = false, back = false, left = false, right = false;
  bool up = false, down = false;                     ///< flying only
  bool fast = false;                                 ///< shift
  bool toggleFlight = false;                         ///< true once for each press
  glm::dvec2 mouse{0};                               ///< pixels that the mouse has moved: right and down positive
  bool toggleOverlay = false, toggleFreeze = false;  ///< F2, F3: true once for each press
  glm::dvec2 pointer{-1};                            ///< pixels from the picture's upper left corner
  bool leftButton = false, rightButton = false;      ///< held down
  double wheel = 0;                                  ///< notches since the last frame, up positive
  bool quit = false;                                 ///< Esc, or the window was closed
};

/// The visitor between two frames.
struct Navigator {
  city::ViewPose pose;
  glm::dvec3 velocity{0};  ///< metres a second
  bool flying = false;
};

/// Speeds in metres a second. Walking is that of people in a town (1.4); shift is a run.
constexpr double kWalkSpeed = 1.4, kRunSpeed = 5, kFlySpeed = 20, kFastFlySpeed = 100;
/// Radians that a mouse turns the head for each pixel: a hand's breadth (1 000 pixels) is a right angle and a half.
constexpr double kRadiansPerPixel = 0.0025;
/// A step covers at most this many seconds, so that nobody crosses the town during a pause.
constexpr double kLongestStep = 2;

/// Moves the visitor on by `dt` seconds. Speed approaches the wanted one with a time constant of 0.1 s and is
/// integrated exactly: with the same keys held, one step of 0.2 s and a hundred of 0.002 s end at the same place. On
/// foot the eye is `kEyeHeight` above the ground, eased over steps but never below half of that; in flight it goes
/// where it looks. Pitch stays within ±89°. A dt that is negative or not finite counts as 0, longer than kLongestStep
/// as that; mouse movement that is not finite is passed over; a pose that is not finite is replaced by one above the
/// middle of the town.
void step(Navigator& navigator, const Input& input, double dt, const city::City& city);

}  // namespace vicus::viewer
