/// Who the people are and where each is at a time.
///
/// Everything is a function of the time alone: nothing is remembered from frame to frame, so that a jump in time, a
/// picture of a single moment and a day-long pause show what a visitor who stayed would see.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "city/avatars.hpp"
#include "city/height_field.hpp"

namespace vicus::avatars {

/// The first `count` of a city's people, who is who decided by its seed: those placed, then one in three standing while
/// there are places and the others on the routes, each about as fast as his legs go in his clip. The first n of many
/// are the same as n. Fewer where there are neither routes nor places.
std::vector<city::Person> peopleOf(const city::People& people, size_t count);

/// Where somebody is.
struct Place {
  glm::dvec3 position{0};  ///< metres from the city's origin, on the ground between the feet
  float heading = 0;       ///< radians counter-clockwise from east
  double walked = 0;       ///< metres along the route since time 0: what the legs have done
};

/// Somebody before anybody makes way.
struct Walker {
  glm::dvec2 at{0}, ahead{1, 0}, right{0, -1};
  glm::dvec3 middle{0};  ///< of the street there, on the ground; of who stands, where he stands
  double along = 0;      ///< metres along the route
  double steady = 1;     ///< who turns round on the spot makes no way and asks for none
  bool walking = false;
};

/// All at one time, ready to be asked for one by one: working out who makes way for whom is the dear part, and
/// most are out of sight.
struct Crowd {
  std::vector<Walker> walkers;                         ///< one for each person
  std::vector<std::pair<uint64_t, uint32_t>> squares;  ///< square of the plan and person, sorted
  std::vector<double> widest;                          ///< metres: each route's largest free width
};

/// Time in seconds; not finite: 0. Nobody is anywhere that `person.route` or `character` do not reach: such people
/// stand at their own position.
Crowd crowdAt(const city::People& people, std::span<const city::Person> persons, double time);

/// Metres in plan from his walker's `middle` within which person `i` is, wherever he makes way to.
double reachOf(const Crowd& crowd, std::span<const city::Person> persons, uint32_t i);

/// Where person `i` is: on his side of the street, aside from those he meets and off the walls. The height is that of
/// `terrain` where it has any (may be null), else the route's own.
Place placeOf(const Crowd& crowd, const city::People& people, std::span<const city::Person> persons,
              const city::HeightField* terrain, uint32_t i);

/// Where all are.
std::vector<Place> placesAt(const city::People& people, std::span<const city::Person> persons,
                            const city::HeightField* terrain, double time);

/// Metres that two people have between their middles when they pass.
constexpr double kPassing = 0.75;
/// Nobody moves faster than his own pace by more than this, metres a second.
constexpr double kFastestAside = 3.0;

}  // namespace vicus::avatars
