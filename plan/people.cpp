/// Based on: Willmott et al. 2001, §5.2 (a variable number of animations a second for each avatar).
#include "plan/people.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "avatars/crowd.hpp"
#include "avatars/pose.hpp"
#include "city/random.hpp"
#include "plan/shadows.hpp"

namespace vicus::plan {
namespace {

using city::Aabbf;
using city::Person;
using glm::dvec3;

constexpr double kNearest = 0.3;  // metres: who is nearer to the eye is no larger
constexpr double kUp = 8;         // metres that the ground beside a way may lie above or below it

/// As assets/shaders/avatar_shadow.vert draws it: away from the sun, 3 m at most; or whole, as shadow maps show it, but
/// for what the last minutes of sunlight make of it.
glm::dvec2 shadowOf(const city::Environment& light, bool maps) {
  const glm::dvec2 sun(std::sin(light.sunAzimuth), std::cos(light.sunAzimuth));
  const double slope = std::cos(light.sunElevation) / std::max(std::sin(light.sunElevation), 0.1);
  const double reach = maps ? 2.2 * slope : std::min(1.6 * slope, 3.0);
  return std::isfinite(sun.x) && std::isfinite(reach) ? -reach * sun : glm::dvec2(0);
}

/// The bounds of a body that may face anywhere, and of its shadow.
Aabbf boundsAt(const city::Character& body, const dvec3& position, double scale, glm::dvec2 shadow) {
  constexpr double kOval = 0.5, kSteep = 1;  // metres about the shadow's ends; of the ground, up for each metre
  const glm::vec3 far =
      body.bounds.empty() ? glm::vec3(0.5F, 0.5F, 2) : glm::max(glm::abs(body.bounds.min), glm::abs(body.bounds.max));
  const double radius = scale * std::hypot(static_cast<double>(far.x), static_cast<double>(far.y));
  const double below = body.bounds.empty() ? 0 : scale * std::max(0.0, -static_cast<double>(body.bounds.min.z));
  city::Aabb box{position - dvec3(radius, radius, below + 0.02),
                 position + dvec3(radius, radius, scale * static_cast<double>(far.z))};
  const double rise = kSteep * (scale * glm::length(shadow) + kOval);
  const dvec3 end = position + dvec3(scale * shadow, 0), about(kOval, kOval, rise);
  box.extend(end - about);
  box.extend(end + about);
  box.extend(position - about);
  return city::outward(box);
}

/// Runs of a person's clip at a time: how far his legs have come.
double runsAt(const Person& person, const city::Clip& clip, double time) {
  if (!(clip.duration > 0)) return 0;
  const double speed = static_cast<double>(person.speed);
  if (person.route != city::kNone && clip.stride > 0)
    return (person.start + speed * time) / (clip.stride * static_cast<double>(person.scale));
  return (person.start + speed * time) / clip.duration;
}

double fraction(double x) {
  return std::isfinite(x) ? x - std::floor(x) : 0;
}

}  // namespace

PeopleScene lookAtPeople(const city::City& city, const city::Knobs& knobs) {
  PeopleScene scene;
  if (city.people.empty() || !knobs.on("avatars.shown")) return scene;
  scene.lod = {knobs.on("avatar_lod"), knobs["avatar_lod.rate"], knobs["avatar_lod.pixel_error"]};
  const double number = knobs["avatars.number"];
  scene.persons = avatars::peopleOf(city.people, number > 0 ? static_cast<size_t>(number) : city.people.count);
  std::erase_if(scene.persons, [&](const Person& p) { return p.character >= city.people.characters.size(); });
  for (const city::Character& c : city.people.characters) scene.errors.push_back(avatars::levelErrorsOf(c));

  scene.shadow = shadowOf(city.environment, cascadeCount(city, knobs) > 0);
  uint32_t first = 0;
  city::Aabb ways;
  for (const Person& p : scene.persons) {
    const city::Character& body = city.people.characters[p.character];
    scene.firstMatrix.push_back(first);
    first += static_cast<uint32_t>(body.skeleton.joints.size());
    scene.reach.extend(boundsAt(body, p.position, static_cast<double>(p.scale), scene.shadow));
  }
  for (const city::WalkRoute& r : city.people.routes)
    for (const auto& point : r.points) ways.extend(point.position);
  if (!ways.empty()) {
    // Beside the way by its free width, and up and down with the ground there.
    constexpr double kBeside = 6;
    scene.reach.extend(
        city::outward({ways.min - dvec3(kBeside, kBeside, kUp), ways.max + dvec3(kBeside, kBeside, kUp)}));
  }
  return scene;
}

void placePeople(const city::City& city, const PeopleScene& scene, const culling::BoxTest* test,
                 city::FramePlan& plan) {
  const city::HeightField* terrain = city.terrain && !city.terrain->empty() ? &*city.terrain : nullptr;
  const avatars::Crowd crowd = avatars::crowdAt(city.people, scene.persons, plan.view.time);
  const auto outside = [&](const Aabbf& bounds) {
    uint32_t mask = test->allPlanes;
    ++plan.counts.boxTests;
    return culling::classify(*test, bounds, mask) == culling::Containment::Outside;
  };
  for (uint32_t i = 0; i < scene.persons.size(); ++i) {
    const Person& person = scene.persons[i];
    const city::Character& body = city.people.characters[person.character];
    const double scale = static_cast<double>(person.scale);
    if (test && crowd.walkers[i].walking) {
      // First all that he may be in: few are near the view.
      const double reach = avatars::reachOf(crowd, scene.persons, i);
      const dvec3 middle = crowd.walkers[i].middle, about(reach, reach, kUp);
      Aabbf wide;
      for (const dvec3& end : {middle - about, middle + about}) wide.extend(boundsAt(body, end, scale, scene.shadow));
      if (outside(wide)) continue;
    }
    const avatars::Place place = avatars::placeOf(crowd, city.people, scene.persons, terrain, i);
    const Aabbf bounds = boundsAt(body, place.position, scale, scene.shadow);
    if (test && outside(bounds)) continue;
    city::AvatarDraw draw;
    draw.person = i, draw.character = person.character, draw.role = person.role, draw.scale = person.scale;
    draw.dress = person.dress < body.dresses.size() ? person.dress : 0;
    draw.position = place.position, draw.heading = place.heading, draw.bounds = bounds;
    plan.avatars.drawn.push_back(draw);
  }
  plan.avatars.inFrustum = plan.avatars.drawn.size();
}

void posePeople(const city::City& city, const PeopleScene& scene, PeopleState& state, city::FramePlan& plan) {
  if (state.posedAt.size() != scene.persons.size()) {
    state.posedAt.assign(scene.persons.size(), std::numeric_limits<double>::quiet_NaN());
    const size_t last = scene.persons.empty() ? 0 : scene.persons.size() - 1;
    state.matrices.resize(scene.persons.empty()
                              ? 0
                              : scene.firstMatrix[last] +
                                    city.people.characters[scene.persons[last].character].skeleton.joints.size());
  }
  const double slope = city::pixelsPerUnitSlope(plan.view);
  const double time = std::isfinite(plan.view.time) ? plan.view.time : 0;
  city::Pose pose;
  std::vector<std::array<glm::vec4, 3>> made;
  for (city::AvatarDraw& draw : plan.avatars.drawn) {
    const Person& person = scene.persons[draw.person];
    const city::Character& body = city.people.characters[draw.character];
    const avatars::LevelErrors& errors = scene.errors[draw.character];
    const city::Clip& clip = body.clips[static_cast<size_t>(draw.role)];
    const double distance = std::max(glm::distance(draw.position, plan.view.eye), kNearest);
    const double pixelsPerMetre = slope / distance * static_cast<double>(draw.scale);
    draw.level = avatars::levelFor(scene.lod, errors, pixelsPerMetre);

    const double offset = city::hash32(draw.person) / 4294967296.0;
    const double rate = avatars::poseRate(scene.lod, distance);
    const double posed = avatars::poseTime(scene.lod, rate, offset, time);
    draw.phase = static_cast<float>(fraction(runsAt(person, clip, posed)));
    const double runsLate = std::abs(runsAt(person, clip, time) - runsAt(person, clip, posed));
    plan.avatars.pixelError =
        std::max(plan.avatars.pixelError,
                 (errors.fastest * runsLate * clip.duration + errors.metres[draw.level]) * pixelsPerMetre);
    if (draw.level == city::kAvatarMeshLevels) continue;

    const uint32_t first = scene.firstMatrix[draw.person];
    if (state.posedAt[draw.person] != posed) {
      avatars::samplePose(body.skeleton, clip, static_cast<double>(draw.phase) * clip.duration, pose);
      made.clear();
      avatars::addSkinMatrices(body, pose, made);
      std::copy(made.begin(), made.end(), state.matrices.begin() + first);
      state.posedAt[draw.person] = posed;
      ++plan.avatars.posesMade;
    }
    draw.firstMatrix = static_cast<uint32_t>(plan.avatars.matrices.size());
    const auto begin = state.matrices.begin() + first;
    plan.avatars.matrices.insert(plan.avatars.matrices.end(), begin,
                                 begin + static_cast<std::ptrdiff_t>(body.skeleton.joints.size()));
  }
}

}  // namespace vicus::plan
