#include "avatars/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "avatars/crowd.hpp"
#include "avatars/cycle.hpp"
#include "avatars/lod.hpp"
#include "avatars/pose.hpp"
#include "avatars/resample.hpp"
#include "avatars/retarget.hpp"

namespace vicus::avatars {
namespace {

using city::Clip;
using city::Pose;
using city::Skeleton;
using city::StabilityRow;
using glm::quat;
using glm::vec3;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
/// Metres that floats of a body's size may be off by after a chain of joints.
constexpr double kRounding = 1e-5;

/// An arm of two bones of half a metre.
Skeleton arm() {
  Skeleton s;
  s.joints = {{"root", city::kNone, {}},
              {"upper", 0, {quat(1, 0, 0, 0), vec3(0.5F, 0, 0), vec3(1)}},
              {"lower", 1, {quat(1, 0, 0, 0), vec3(0.5F, 0, 0), vec3(1)}}};
  return s;
}

quat about(double angle) {
  return glm::angleAxis(static_cast<float>(angle), vec3(0, 0, 1));
}

/// Turns the root through those rotations at those times.
Clip turning(std::vector<float> times, std::vector<quat> rotations, double duration) {
  Clip clip;
  clip.duration = duration, clip.loops = false;
  clip.tracks.emplace_back();
  clip.tracks[0].rotationTimes = std::move(times), clip.tracks[0].rotations = std::move(rotations);
  return clip;
}

/// Where the arm's end is.
vec3 endAt(const Clip& clip, double time) {
  Pose pose;
  samplePose(arm(), clip, time, pose);
  return vec3(characterFromJoints(arm(), pose).back()[3]);
}

double offBy(const vec3& a, const vec3& b) {
  const double d = static_cast<double>(glm::distance(a, b));
  return std::isfinite(d) ? d : std::numeric_limits<double>::infinity();
}

/// A straight street of 100 m, walked out and back by two people.
city::People street() {
  city::People people;
  people.characters.emplace_back();
  city::WalkRoute route;
  route.step = 2;
  for (int k = 0; k < 100; ++k) {
    const double x = k < 50 ? 2.0 * k : 2.0 * (100 - k);
    route.points.push_back({{x, 0, 0}, 2, false});
  }
  people.routes.push_back(route);
  for (int k = 0; k < 2; ++k) {
    city::Person p;
    p.role = city::Role::Walk, p.route = 0, p.start = 30.0 * k, p.speed = 1.2F + 0.2F * static_cast<float>(k);
    people.placed.push_back(p);
  }
  people.count = 2;
  return people;
}

}  // namespace

std::vector<StabilityRow> avatarStability() {
  std::vector<StabilityRow> rows;
  const auto row = [&](const char* name, const char* what, double figure, double bound) {
    rows.push_back(city::stabilityRow("avatars", name, what, figure, bound));
  };
  const double quarter = std::numbers::pi / 2;
  const vec3 ahead(1, 0, 0), left(0, 1, 0);
  const auto at = [](double angle) {
    return vec3(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0);
  };

  const Clip one = turning({0}, {about(quarter)}, 0);
  row("one frame", "metres off at any time",
      std::max({offBy(endAt(one, 0), left), offBy(endAt(one, 5), left), offBy(endAt(one, -5), left)}), kRounding);

  const Clip equal = turning({0, 1, 1, 2}, {about(0), about(0), about(quarter), about(quarter)}, 2);
  row("equal key times", "metres off before, at and after them",
      std::max({offBy(endAt(equal, 0.999), ahead), offBy(endAt(equal, 1), left), offBy(endAt(equal, 1.5), left)}),
      kRounding);

  const Clip antipodal = turning({0, 1}, {about(0.7), -about(0.7)}, 1);
  double moved = 0;
  for (int k = 0; k <= 100; ++k) moved = std::max(moved, offBy(endAt(antipodal, 0.01 * k), at(0.7)));
  row("antipodal quaternions", "metres moved between a rotation and its negative", moved, kRounding);

  const Clip longWay = turning({0, 1}, {about(-0.2), -about(0.2)}, 1);
  row("shortest arc", "metres off half way", offBy(endAt(longWay, 0.5), ahead), kRounding);

  const Clip opposite = turning({0, 1}, {about(0), about(2 * quarter)}, 1);
  double step = 0;
  for (int k = 0; k < 100; ++k)
    step = std::max(step, offBy(endAt(opposite, 0.01 * k), endAt(opposite, 0.01 * (k + 1))));
  row("half a turn between keys", "metres in the largest of 100 steps", step, 1.01 * 2 * quarter / 100);

  double length = 0;
  for (const quat& q : {quat(0, 0, 0, 0), quat(1e-30F, 0, 0, 1e-30F), quat(3e20F, 0, 0, 3e20F), quat(5, 0, 0, 5),
                        quat(kNaN, 0, 0, 1), quat(1, std::numeric_limits<float>::infinity(), 0, 0)})
    length =
        std::max(length, std::abs(static_cast<double>(glm::length(vec3(endAt(turning({0, 1}, {q, q}, 1), 0.5)))) - 1));
  row("unnormalised quaternions", "metres that the arm changes its length", length, kRounding);

  // A skeleton whose every bone has no length, retargeted both ways.
  Skeleton points;
  for (const char* name : {"Hips", "LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg", "RightFoot"})
    points.joints.push_back({name, points.joints.empty() ? city::kNone : 0, {}});
  const Clip turned = turning({0, 1}, {about(0), about(1)}, 1);
  double lost = 0;
  Pose pose;
  samplePose(points, retarget(points, turned, points), 0.5, pose);
  for (const glm::mat4& m : characterFromJoints(points, pose)) lost = std::max(lost, offBy(vec3(m[3]), vec3(0)));
  row("zero-length bones", "metres that a joint leaves the origin", lost, kRounding);

  for (const auto& [name, rate] :
       {std::pair{"0.001 frames a second", 0.001}, std::pair{"10 000 frames a second", 1e4}}) {
    std::vector<float> times;
    std::vector<quat> rotations;
    for (int k = 0; k < 1000; ++k) times.push_back(static_cast<float>(k / rate)), rotations.push_back(about(0.01 * k));
    const Clip clip = turning(times, rotations, 999 / rate);
    double off = 0;
    for (const double frame : {0.0, 0.5, 17.25, 500.5, 998.9})
      off = std::max(off, offBy(endAt(clip, frame / rate), at(0.01 * frame)));
    row(name, "metres off between keys", off, 1e-4);
    row(name, "metres off after compression to 5 mm", compress(arm(), clip, 0.005).error, 0.005);
  }

  const double day = 86'400;
  Clip loop = turning({0, 1}, {about(0), about(1)}, 1);
  loop.loops = true;
  row("a day-long pause", "metres between a loop's pose and a day later",
      offBy(endAt(loop, 0.3), endAt(loop, day + 0.3)), 1e-4);

  const city::People people = street();
  const auto persons = peopleOf(people, 2);
  const auto before = placesAt(people, persons, nullptr, day), after = placesAt(people, persons, nullptr, day + 0.01);
  double farthest = 0, jump = 0;
  for (size_t i = 0; i < 2; ++i) {
    farthest = std::max(farthest, std::abs(after[i].position.y));
    jump = std::max(jump, glm::distance(before[i].position, after[i].position) / 0.01);
  }
  row("a day-long pause", "metres from the street's middle", farthest, 2);
  row("a day-long pause", "metres a second after it", jump, 1.4 + kFastestAside);

  double nowhere = 0;
  for (const double time : {static_cast<double>(kNaN), std::numeric_limits<double>::infinity(), -day, 1e12})
    for (const Place& p : placesAt(people, persons, nullptr, time))
      nowhere += std::isfinite(p.position.x + p.position.y + p.position.z + static_cast<double>(p.heading)) ? 0 : 1;
  row("times that are none", "people nowhere", nowhere, 0);

  LodSettings lod;
  double late = 0;
  for (const double distance : {0.0, 10.0, 35.0, 1e9})
    for (const double time : {0.0, 1.0 / 3, day}) {
      const double rate = poseRate(lod, distance);
      late = std::max(late, (time - poseTime(lod, rate, 0.3, time)) * rate);
    }
  row("pose updates", "frames that a pose is late", late, 1 + 1e-6);

  Skeleton unordered = arm();
  unordered.joints[0].parent = 2, unordered.joints[1].parent = 77;
  double bad = 0;
  for (const glm::mat4& m : characterFromJoints(unordered, restPose(unordered))) bad += std::isfinite(m[3].x) ? 0 : 1;
  row("parents that do not come before", "joints nowhere", bad, 0);
  return rows;
}

}  // namespace vicus::avatars
