/// The visitor's own way: keys, mouse, gamepad and touch to the next pose.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "city/city.hpp"
#include "city/knob.hpp"
#include "city/view_state.hpp"
#include "walking/walker.hpp"

namespace vicus::viewer {

/// How one moves: on foot; through the air; about a point that one looks at; over the town as on a map; along a tour.
enum class Mode : uint8_t { Walk, Fly, Orbit, Map, Tour };

/// What the devices said since the last frame. Anything may be missing or not finite.
struct Input {
  bool forward = false, back = false, left = false, right = false;
  bool up = false, down = false;                     ///< flying only
  bool fast = false;                                 ///< shift
  glm::dvec2 stick{0};                               ///< gamepad's left stick, −1 … 1: right and forward positive
  glm::dvec2 turnStick{0};                           ///< gamepad's right stick, −1 … 1: right and up positive
  bool drags = false;                                ///< the pointer is free: the mouse turns only with the button held
  glm::dvec2 mouse{0};                               ///< pixels that the mouse has moved: right and down positive
  std::optional<Mode> mode;                          ///< the key of a mode was pressed; its own key again: on foot
  int view = 0;                                      ///< 1 … 9: go to that view
  bool takeBack = false;                             ///< back to the last good place
  bool toggleRecord = false;                         ///< begins to record the way, or ends and keeps it
  bool help = false, fullScreen = false;             ///< F1, F11: true once for each press
  bool screenshot = false;                           ///< F12
  bool toggleOverlay = false, toggleFreeze = false;  ///< F2, F3: true once for each press
  bool togglePeople = false;                         ///< P
  glm::dvec2 pointer{-1};                            ///< pixels from the picture's upper left corner; −1: captured
  bool leftButton = false, rightButton = false;      ///< held down
  bool tap = false;                                  ///< the left button was pressed and let go on the spot
  double wheel = 0;                                  ///< notches since the last frame, up positive
  glm::dvec2 push{0};                                ///< two fingers on a pad, notches: right and forward positive
  glm::ivec2 viewport{1};                            ///< pixels of the picture that `pointer` lies in
  bool quit = false;                                 ///< Esc, or the window was closed
};

/// What the visitor's feeling is made of; from the knobs walk.… and viewer.fov.
struct Manners {
  double lanePull = 0;  ///< 0 … 1
  bool headBob = false;
  bool reducedMotion = false;   ///< nothing is eased, nothing glides
  double verticalFov = 1.0472;  ///< radians
};
std::span<const city::Knob> navigatorKnobs();
Manners mannersFrom(const city::Knobs& knobs);

/// Where one can go at once.
struct Sights {
  city::Tour tour;                    ///< what T plays; without keys there is none
  std::vector<city::ViewPose> views;  ///< of the keys 1 to 9
};

/// The visitor between two frames. Whoever sets `pose.eye` moves the visitor there; on foot that is the nearest place
/// to stand.
struct Navigator {
  city::ViewPose pose;
  glm::dvec3 velocity{0};  ///< metres a second
  Mode mode = Mode::Walk;
  Manners manners;

  std::optional<walking::Ground> ground;      ///< made with the first step on foot
  std::optional<walking::Standing> standing;  ///< on foot; nothing where there is no ground to stand on
  glm::dvec3 shownEye{0};                     ///< `pose.eye` as the last step left it
  double lag = 0;                             ///< metres that the eye is still above where steps have brought it
  double paced = 0;                           ///< metres walked, for the head's bob
  glm::dvec2 turning{0};                      ///< radians of heading and pitch that are asked for and not turned yet
  std::vector<walking::Standing> trail;       ///< good places, the last one last
  std::optional<glm::dvec2> goal;             ///< where a tap sent the visitor
  double idle = 0;                            ///< seconds without progress towards the goal

  glm::dvec3 pivot{0};   ///< orbit: the point that is looked at
  double distance = 60;  ///< orbit: metres from it; map: metres above the ground
  double tourTime = 0;   ///< seconds since the tour's start
  struct Glide {
    city::ViewPose from, to;
    double passed = 0;  ///< seconds
  };
  std::optional<Glide> glide;  ///< a way to another place that the visitor does not walk

  bool wantsPointer() const { return mode == Mode::Map; }
};

/// Speeds in metres a second. Walking is that of people in a town (1.4).
constexpr double kWalkSpeed = 1.4, kRunSpeed = 4, kFlySpeed = 20, kFastFlySpeed = 100;
/// Radians that a mouse turns the head for each pixel: a hand's breadth (1 000 pixels) is a right angle and a half.
constexpr double kRadiansPerPixel = 0.0025;
/// Radians a second that a gamepad's stick turns the head: once round in three seconds.
constexpr double kStickTurn = 2.1;
/// A step covers at most this many seconds, so that nobody crosses the town during a pause.
constexpr double kLongestStep = 2;
/// Seconds in which speed closes 63 % of its gap, the head its turn, the eye a step of a stair.
constexpr double kSpeedResponse = 0.12, kTurnResponse = 0.04, kStepResponse = 0.1;
/// Seconds that a glide to another place takes.
constexpr double kGlideSeconds = 0.8;

/// Moves the visitor on by `dt` seconds. Speed and turn approach what is wanted exponentially and are integrated
/// exactly: with the same keys held, one step of 0.2 s and a hundred of 0.002 s end at the same place, but for walls
/// that come between.
///   Walk: walking::Ground::move; the eye is `kEyeHeight` above the feet, eased over steps by at most a step. Where
///     there is no place to stand within 60 m (an empty scene) one walks on the ground's height alone.
///   Fly: where one looks, through walls, never lower than half a metre over the ground.
///   Orbit: the mouse turns about what one looked at; forward and back, or the wheel, go nearer and farther.
///   Map: from above, north up; keys and drags move it, the wheel changes its height, a tap goes there on foot.
///   Tour: plays `sights.tour`; any key of movement, or its end, leaves it on foot.
/// Pitch stays within ±89° but for the map. A dt that is negative or not finite counts as 0, longer than kLongestStep
/// as that; movement that is not finite is passed over; a pose that is not finite is replaced by one in the middle of
/// the town. The city must be the same at every step.
void step(Navigator& navigator, const Input& input, double dt, const city::City& city, const Sights& sights = {});

/// Puts the visitor into a mode: on foot where one can stand, over the map, about what one looks at.
void enter(Navigator& navigator, Mode mode, const city::City& city, const Sights& sights = {});

/// Brings the visitor back to the last good place: where there was room, at least 1.5 m from here. Where there is none
/// yet, to the nearest place to stand. The visitor is on foot then.
void takeBack(Navigator& navigator, const city::City& city);

/// The point of the ground that a pixel of the picture shows; nothing within 5 km, or where the pixel is outside.
std::optional<glm::dvec3> groundUnder(const city::City& city, const city::ViewState& view, glm::dvec2 pixel);

/// The views of the keys 1 to 9: those of the city's own tour `views` where it has one, else six along the tour
/// `street` and three along `flyover`.
std::vector<city::ViewPose> makeViews(std::span<const city::Tour> tours);

}  // namespace vicus::viewer
