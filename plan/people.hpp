/// The steps that show people: where everybody is, who may be seen, how finely and how often each is posed.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "avatars/lod.hpp"
#include "city/city.hpp"
#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "culling/frustum.hpp"

namespace vicus::plan {

/// What is known of a city's people, worked out once.
struct PeopleScene {
  std::vector<city::Person> persons;
  std::vector<avatars::LevelErrors> errors;  ///< by character
  std::vector<uint32_t> firstMatrix;         ///< by person, of all joints of all
  avatars::LodSettings lod;
  glm::dvec2 shadow{0};  ///< where the shadow of somebody of usual size ends on level ground, metres from his feet
  city::Aabbf reach;     ///< of everybody, wherever he goes
};

/// The poses that a view keeps from frame to frame. Who is posed when depends on the time alone, so that a view that
/// remembers and one that does not show the same.
struct PeopleState {
  std::vector<double> posedAt;  ///< by person, seconds; NaN: never
  std::vector<std::array<glm::vec4, 3>> matrices;
};

/// Nobody where the city has no people or the knob `avatars.shown` is off.
PeopleScene lookAtPeople(const city::City& city, const city::Knobs& knobs);

/// Puts into the plan everybody whose bounds may be in the picture; everybody without a test.
void placePeople(const city::City& city, const PeopleScene& scene, const culling::BoxTest* test, city::FramePlan& plan);

/// Chooses level and pose of those that are still in the plan.
void posePeople(const city::City& city, const PeopleScene& scene, PeopleState& state, city::FramePlan& plan);

}  // namespace vicus::plan
