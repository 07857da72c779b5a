#include "viewer/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/tours.hpp"
#include "walking/surroundings.hpp"

namespace vicus::viewer {
namespace {

using std::numbers::pi;
using walking::Standing;

constexpr double kSteepest = 89 * pi / 180;

constexpr city::Knob kNavigatorKnobs[] = {
    {"walk.lane_pull", 0, 0, 1, "share", "Draws a walker gently to the middle of the lane.",
     "0: one walks exactly where one steers", "hard to walk up to a house"},
    {"walk.head_bob", 0, 0, 1, "on/off", "The eye goes up and down with the steps.", "off: as on rails",
     "on is the most; some people become sick"},
    {"walk.reduced_motion", 0, 0, 1, "on/off",
     "Nothing is eased and nothing glides: for people whom moving pictures make dizzy.",
     "off: speed and turns are eased, changes of place glide", "on is the most"},
};

bool finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

glm::dvec3 lookingAlong(double heading, double pitch) {
  return {std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch), std::sin(pitch)};
}

/// Keys and stick together: right and forward, at most of length 1.
glm::dvec2 wantedWay(const Input& input) {
  const auto axis = [](bool plus, bool minus) { return (plus ? 1.0 : 0.0) - (minus ? 1.0 : 0.0); };
  glm::dvec2 way(axis(input.right, input.left), axis(input.forward, input.back));
  if (const double length = glm::length(way); length > 1) way /= length;
  if (finite(input.stick)) way += input.stick;
  const double length = glm::length(way);
  return length > 1 ? way / length : way;
}

bool wantsToMove(const Input& input) {
  return glm::length(wantedWay(input)) > 0.1 || input.up || input.down;
}

walking::Ground& groundOf(Navigator& n, const city::City& city) {
  if (!n.ground) n.ground.emplace(city);
  return *n.ground;
}

void showStanding(Navigator& n, const city::City& city) {
  const glm::dvec2 at = n.standing ? n.standing->at : glm::dvec2(n.pose.eye);
  const double feet = n.standing ? n.standing->feet : walking::groundAt(city, at);
  constexpr double kPace = 0.75, kBob = 0.03;  // metres: of a step, of the head's way up and down in it
  const double bob = n.manners.headBob && !n.manners.reducedMotion ? kBob * std::sin(2 * pi * n.paced / kPace) : 0;
  n.pose.eye = glm::dvec3(at, feet + walking::kEyeHeight + n.lag + bob);
  n.pose.roll = 0;
}

/// From wherever the eye is to the nearest place to stand.
void land(Navigator& n, const city::City& city) {
  n.standing = groundOf(n, city).place(glm::dvec2(n.pose.eye), n.pose.eye.z - walking::kEyeHeight);
  n.lag = 0;
  n.velocity = glm::dvec3(0);
  if (n.standing && n.trail.empty()) n.trail.push_back(*n.standing);
  showStanding(n, city);
}

/// Shows the way from `from` to where the visitor is now.
void glideFrom(Navigator& n, const city::ViewPose& from) {
  n.glide.reset();
  if (n.manners.reducedMotion || glm::distance(from.eye, n.pose.eye) < 1e-3) return;
  n.glide = Navigator::Glide{from, n.pose, 0};
}

void playGlide(Navigator& n, double dt) {
  Navigator::Glide& g = *n.glide;
  g.passed += dt;
  const double t = std::clamp(g.passed / kGlideSeconds, 0.0, 1.0), s = t * t * (3 - 2 * t);
  n.pose.eye = glm::mix(g.from.eye, g.to.eye, s);
  n.pose.heading = g.from.heading + s * std::remainder(g.to.heading - g.from.heading, 2 * pi);
  n.pose.pitch = glm::mix(g.from.pitch, g.to.pitch, s);
  if (t < 1) return;
  n.pose = g.to;
  n.glide.reset();
}

/// Moves `velocity` towards `wanted` over dt; the way that this takes.
glm::dvec3 accelerate(Navigator& n, const glm::dvec3& wanted, double dt) {
  if (n.manners.reducedMotion) {
    n.velocity = wanted;
    return wanted * dt;
  }
  // v' = (wanted − v) / response, solved exactly.
  const double kept = std::exp(-dt / kSpeedResponse);
  const glm::dvec3 way = wanted * dt + (n.velocity - wanted) * (kSpeedResponse * (1 - kept));
  n.velocity = wanted + (n.velocity - wanted) * kept;
  return way;
}

/// The head turns by what mouse and stick asked for, however long the frame took, eased.
glm::dvec2 turn(Navigator& n, const Input& input, double dt) {
  // A free pointer drags the picture along, as a finger does; a captured one turns the head.
  const double sense = input.drags ? (input.leftButton ? 1 : 0) : -1;
  if (finite(input.mouse)) n.turning += sense * kRadiansPerPixel * input.mouse;
  if (finite(input.turnStick)) n.turning += kStickTurn * dt * glm::dvec2(-input.turnStick.x, input.turnStick.y);
  const glm::dvec2 now = n.manners.reducedMotion ? n.turning : n.turning * (1 - std::exp(-dt / kTurnResponse));
  n.turning -= now;
  return now;
}

void look(Navigator& n, const Input& input, double dt) {
  const glm::dvec2 by = turn(n, input, dt);
  n.pose.heading = std::remainder(n.pose.heading + by.x, 2 * pi);
  n.pose.pitch = std::clamp(n.pose.pitch + by.y, -kSteepest, kSteepest);
}

// ---- On foot ----

/// The velocity on the plan that keys, stick, a tap or the lane ask for.
glm::dvec2 wantedOnFoot(Navigator& n, const Input& input, const city::City& city, double dt) {
  const glm::dvec2 forward(std::cos(n.pose.heading), std::sin(n.pose.heading)), right(forward.y, -forward.x);
  const double speed = input.fast ? kRunSpeed : kWalkSpeed;
  const glm::dvec2 way = wantedWay(input) + (finite(input.push) && dt > 0 ? 0.3 * input.push / dt : glm::dvec2(0));
  glm::dvec2 wanted = speed * (way.x * right + way.y * forward);
  if (const double length = glm::length(wanted); length > kRunSpeed) wanted *= kRunSpeed / length;
  if (glm::length(way) > 0.05) n.goal.reset();
  if (n.goal) {
    const glm::dvec2 to = *n.goal - glm::dvec2(n.pose.eye);
    const double distance = glm::length(to);
    n.idle = glm::length(glm::dvec2(n.velocity)) < 0.1 ? n.idle + dt : 0;
    if (distance < 0.2 || n.idle > 1)
      n.goal.reset();
    else  // never beyond it within this frame
      wanted = to / distance * std::min(speed, distance / std::max(dt, 0.2));
  }
  // In a lane, that is with walls on both sides, a little sideways to its middle.
  const double pace = glm::length(wanted);
  if (!(n.manners.lanePull > 0) || pace < 0.1 || !n.standing) return wanted;
  constexpr double kWidest = 8;  // metres to a wall: what is wider is a place, not a lane
  const glm::dvec2 aside(-wanted.y / pace, wanted.x / pace);
  const double onLeft = groundOf(n, city).freeWay(*n.standing, aside, kWidest);
  const double onRight = groundOf(n, city).freeWay(*n.standing, -aside, kWidest);
  if (onLeft < kWidest && onRight < kWidest && onLeft + onRight > 0)
    wanted += aside * (0.4 * n.manners.lanePull * pace * (onLeft - onRight) / (onLeft + onRight));
  return wanted;
}

/// Remembers where there is room to come back to.
void leaveTrail(Navigator& n) {
  constexpr double kApart = 3;      // metres between places
  constexpr size_t kLongest = 200;  // places: half a kilometre
  if (!n.trail.empty() && glm::distance(n.trail.back().at, n.standing->at) < kApart) return;
  n.trail.push_back(*n.standing);
  if (n.trail.size() > kLongest) n.trail.erase(n.trail.begin());
}

void walk(Navigator& n, const Input& input, double dt, const city::City& city) {
  if (!n.standing || n.pose.eye != n.shownEye) land(n, city);
  look(n, input, dt);
  const glm::dvec2 way(accelerate(n, glm::dvec3(wantedOnFoot(n, input, city, dt), 0), dt));
  if (!n.standing) {  // nowhere to stand: on the ground's height alone
    n.pose.eye += glm::dvec3(way, 0);
    showStanding(n, city);
    return;
  }
  glm::dvec2 blocked(0);
  const double feet = n.standing->feet;
  const Standing next = groundOf(n, city).move(*n.standing, way, &blocked);
  n.velocity -= glm::dvec3(std::min(glm::dot(glm::dvec2(n.velocity), blocked), 0.0) * blocked, 0);
  n.paced += glm::distance(next.at, n.standing->at);
  n.standing = next;
  leaveTrail(n);
  // The eye follows the feet over steps.
  const double kept = n.manners.reducedMotion ? 0 : std::exp(-dt / kStepResponse);
  n.lag = std::clamp(n.lag + feet - next.feet, -walking::kStep, walking::kStep) * kept;
  showStanding(n, city);
}

// ---- The other modes ----

void keepAbove(Navigator& n, const city::City& city, double above) {
  n.pose.eye.z = std::max(n.pose.eye.z, walking::groundAt(city, glm::dvec2(n.pose.eye)) + above);
}

void fly(Navigator& n, const Input& input, double dt, const city::City& city) {
  look(n, input, dt);
  const glm::dvec2 way = wantedWay(input);
  const glm::dvec3 right(std::sin(n.pose.heading), -std::cos(n.pose.heading), 0);
  glm::dvec3 wanted = way.y * lookingAlong(n.pose.heading, n.pose.pitch) + way.x * right;
  wanted.z += (input.up ? 1.0 : 0.0) - (input.down ? 1.0 : 0.0);
  if (const double length = glm::length(wanted); length > 1) wanted /= length;
  n.pose.eye += accelerate(n, wanted * (input.fast ? kFastFlySpeed : kFlySpeed), dt);
  keepAbove(n, city, 0.5);
}

void orbit(Navigator& n, const Input& input, double dt, const city::City& city) {
  constexpr double kNearest = 3, kFarthest = 5000;     // metres
  constexpr double kLowest = -1.45, kHighest = -0.02;  // radians of pitch: from above, from the horizon
  const glm::dvec2 by = turn(n, input, dt), way = wantedWay(input);
  n.pose.heading = std::remainder(n.pose.heading + by.x - 0.8 * way.x * dt, 2 * pi);
  n.pose.pitch = std::clamp(n.pose.pitch + by.y, kLowest, kHighest);
  const double wheel = std::isfinite(input.wheel) ? input.wheel : 0;
  n.distance =
      std::clamp(n.distance * std::exp(-way.y * dt * (input.fast ? 2.5 : 1) - 0.15 * wheel), kNearest, kFarthest);
  n.pose.eye = n.pivot - n.distance * lookingAlong(n.pose.heading, n.pose.pitch);
  keepAbove(n, city, 0.5);
}

void map(Navigator& n, const Input& input, double dt, const city::City& city) {
  constexpr double kLowest = 30, kHighest = 20'000;  // metres
  const glm::dvec2 way = wantedWay(input);
  // A screen's height takes two seconds, half of one with Shift.
  const double across = 2 * n.distance * std::tan(0.5 * n.manners.verticalFov);
  const glm::dvec3 moved = accelerate(n, glm::dvec3(way * across * (input.fast ? 2.0 : 0.5), 0), dt);
  n.pose.eye += glm::dvec3(moved.x, moved.y, 0);
  if (input.leftButton && finite(input.mouse) && input.viewport.y > 0)  // the map goes with the hand
    n.pose.eye += glm::dvec3(-input.mouse.x, input.mouse.y, 0) * (across / input.viewport.y);
  const double wheel = std::isfinite(input.wheel) ? input.wheel : 0;
  const double zoom = (input.down ? 1.0 : 0.0) - (input.up ? 1.0 : 0.0);
  n.distance = std::clamp(n.distance * std::exp(zoom * dt - 0.15 * wheel), kLowest, kHighest);
  n.pose.eye.z = walking::groundAt(city, glm::dvec2(n.pose.eye)) + n.distance;
  n.pose.heading = pi / 2, n.pose.pitch = -pi / 2, n.pose.roll = 0;
}

/// The ground under the pointer, or what the middle of the picture shows.
std::optional<glm::dvec3> pointedAt(const Navigator& n, const Input& input, const city::City& city) {
  const city::ViewState view = city::makeView(n.pose, n.manners.verticalFov, input.viewport);
  const glm::dvec2 middle = 0.5 * glm::dvec2(view.viewport);
  return groundUnder(city, view, input.pointer.x >= 0 ? input.pointer : middle);
}

void tap(Navigator& n, const Input& input, const city::City& city) {
  const std::optional<glm::dvec3> point = pointedAt(n, input, city);
  if (!point) return;
  if (n.mode == Mode::Walk) {
    n.goal = glm::dvec2(*point), n.idle = 0;
  } else if (n.mode == Mode::Map) {
    const city::ViewPose from = n.pose;
    n.mode = Mode::Walk;
    n.pose.eye = *point + glm::dvec3(0, 0, walking::kEyeHeight);
    n.pose.pitch = 0;
    land(n, city);
    glideFrom(n, from);
  }
}

/// On foot where the view is one of somebody who stands, else in the air.
void goTo(Navigator& n, const city::ViewPose& view, const city::City& city) {
  const city::ViewPose from = n.pose;
  n.pose = view;
  n.velocity = glm::dvec3(0), n.turning = glm::dvec2(0);
  n.goal.reset();
  const auto place = groundOf(n, city).place(glm::dvec2(view.eye), view.eye.z - walking::kEyeHeight, 2);
  n.mode = place && std::abs(place->feet + walking::kEyeHeight - view.eye.z) < 1 ? Mode::Walk : Mode::Fly;
  if (n.mode == Mode::Walk) land(n, city);
  glideFrom(n, from);
}

void mend(Navigator& n, const city::City& city) {
  city::ViewPose& pose = n.pose;
  if (!finite(pose.eye)) {
    const glm::dvec2 middle = walking::densestPoint(city);
    pose.eye = glm::dvec3(middle, walking::groundAt(city, middle) + walking::kEyeHeight);
    n.standing.reset();
  }
  for (double* angle : {&pose.heading, &pose.pitch, &pose.roll})
    if (!std::isfinite(*angle)) *angle = 0;
  if (!finite(n.velocity)) n.velocity = glm::dvec3(0);
  if (!finite(n.turning)) n.turning = glm::dvec2(0);
}

}  // namespace

std::span<const city::Knob> navigatorKnobs() {
  return kNavigatorKnobs;
}

Manners mannersFrom(const city::Knobs& knobs) {
  return {knobs["walk.lane_pull"], knobs.on("walk.head_bob"), knobs.on("walk.reduced_motion"),
          glm::radians(knobs["viewer.fov"])};
}

std::optional<glm::dvec3> groundUnder(const city::City& city, const city::ViewState& view, glm::dvec2 pixel) {
  constexpr double kFarthest = 5000;  // metres
  const glm::dvec2 size(view.viewport);
  if (!finite(pixel) || pixel.x < 0 || pixel.y < 0 || pixel.x > size.x || pixel.y > size.y) return std::nullopt;
  const double slope = std::tan(0.5 * view.verticalFov);
  const glm::dvec2 aside = (2.0 * pixel / size - 1.0) * glm::dvec2(view.aspect(), -1) * slope;
  const glm::dvec3 way = glm::normalize(view.forward + aside.x * view.right + aside.y * view.up);
  const auto above = [&](double t) {
    const glm::dvec3 p = view.eye + t * way;
    return p.z - walking::groundAt(city, glm::dvec2(p));
  };
  // March until under the ground, then halve the last stretch.
  double t = 0;
  while (above(t) > 0) {
    if (t >= kFarthest) return std::nullopt;
    t += std::clamp(0.5 * above(t), 0.25, 50.0);
  }
  double lo = std::max(0.0, t - 50), hi = t;
  for (int k = 0; k < 30; ++k) {
    const double mid = 0.5 * (lo + hi);
    (above(mid) > 0 ? lo : hi) = mid;
  }
  return view.eye + hi * way;
}

std::vector<city::ViewPose> makeViews(std::span<const city::Tour> tours) {
  std::vector<city::ViewPose> views;
  const auto find = [&](std::string_view name) -> const city::Tour* {
    const auto it = std::find_if(tours.begin(), tours.end(), [&](const city::Tour& t) { return t.name == name; });
    return it == tours.end() || it->keys.empty() ? nullptr : &*it;
  };
  if (const city::Tour* own = find("views")) {
    for (size_t k = 0; k < std::min<size_t>(own->keys.size(), 9); ++k) views.push_back(poseAt(*own, own->keys[k].time));
    return views;
  }
  for (const auto& [name, count] : {std::pair{"street", 6}, {"flyover", 3}}) {
    const city::Tour* tour = find(name);
    for (int k = 0; k < count && tour; ++k)
      views.push_back(poseAt(*tour, tour->keys.front().time + durationOf(*tour) * (k + 0.5) / count));
  }
  return views;
}

void enter(Navigator& n, Mode mode, const city::City& city, const Sights& sights) {
  if (mode == Mode::Tour && sights.tour.keys.empty()) return;
  const city::ViewPose from = n.pose;
  n.velocity = glm::dvec3(0), n.turning = glm::dvec2(0);
  n.goal.reset();
  const bool fromMap = n.mode == Mode::Map;
  n.mode = mode;
  switch (mode) {
    case Mode::Walk:
      if (n.pose.pitch < -0.35) n.pose.pitch = 0;  // who looked down on the town looks ahead in the street
      land(n, city);
      break;
    case Mode::Fly:
      if (fromMap) n.pose.pitch = -0.6;
      keepAbove(n, city, 2 * walking::kEyeHeight);
      break;
    case Mode::Orbit: {
      constexpr double kAhead = 40, kFarthest = 400;  // metres
      const glm::dvec3 ahead = lookingAlong(n.pose.heading, n.pose.pitch);
      const auto seen = groundUnder(city, city::makeView(n.pose, n.manners.verticalFov, {2, 2}), {1, 1});
      const bool usable = seen && glm::distance(*seen, n.pose.eye) < kFarthest && glm::distance(*seen, n.pose.eye) > 5;
      n.pivot = usable ? *seen : n.pose.eye + kAhead * glm::dvec3(ahead.x, ahead.y, 0);
      if (!usable) n.pivot.z = walking::groundAt(city, glm::dvec2(n.pivot)) + 3;
      n.distance = std::max(glm::distance(n.pose.eye, n.pivot), 50.0);
      n.pose.pitch = std::min(n.pose.pitch, -0.5);
      orbit(n, {}, 0, city);
      break;
    }
    case Mode::Map:
      n.distance = 300;  // metres: some blocks about the visitor
      map(n, {}, 0, city);
      break;
    case Mode::Tour:
      n.tourTime = 0;
      n.pose = poseAt(sights.tour, sights.tour.keys.front().time);
      break;
  }
  glideFrom(n, from);
}

void takeBack(Navigator& n, const city::City& city) {
  constexpr double kElsewhere = 1.5;  // metres
  const city::ViewPose from = n.pose;
  const glm::dvec2 here(n.pose.eye);
  while (n.trail.size() > 1 && glm::distance(n.trail.back().at, here) < kElsewhere) n.trail.pop_back();
  n.mode = Mode::Walk;
  n.velocity = glm::dvec3(0), n.turning = glm::dvec2(0), n.lag = 0;
  n.goal.reset();
  if (std::abs(n.pose.pitch) > 1) n.pose.pitch = 0;
  if (n.trail.empty())
    land(n, city);
  else
    n.standing = n.trail.back(), showStanding(n, city);
  glideFrom(n, from);
}

void step(Navigator& n, const Input& input, double dt, const city::City& city, const Sights& sights) {
  dt = std::isfinite(dt) ? std::clamp(dt, 0.0, kLongestStep) : 0;
  mend(n, city);

  // What is asked for once.
  if (n.glide && (input.mode || input.view > 0 || input.takeBack)) n.pose = n.glide->to, n.glide.reset();
  const auto view = static_cast<size_t>(std::max(input.view, 0));
  if (input.mode) enter(n, *input.mode == n.mode ? Mode::Walk : *input.mode, city, sights);
  if (view >= 1 && view <= sights.views.size()) goTo(n, sights.views[view - 1], city);
  if (input.takeBack) takeBack(n, city);
  if (input.tap && !n.glide) tap(n, input, city);

  if (n.glide) {
    playGlide(n, dt);
    n.shownEye = n.pose.eye;
    return;
  }
  if (n.mode == Mode::Tour) {
    n.tourTime += dt;
    if (wantsToMove(input) || n.tourTime > durationOf(sights.tour) || sights.tour.keys.empty())
      n.mode = Mode::Walk, land(n, city);
    else
      n.pose = poseAt(sights.tour, sights.tour.keys.front().time + n.tourTime);
  }
  switch (n.mode) {
    case Mode::Walk:
      walk(n, input, dt, city);
      break;
    case Mode::Fly:
      fly(n, input, dt, city);
      break;
    case Mode::Orbit:
      orbit(n, input, dt, city);
      break;
    case Mode::Map:
      map(n, input, dt, city);
      break;
    case Mode::Tour:
      break;
  }
  n.shownEye = n.pose.eye;
}

}  // namespace vicus::viewer
