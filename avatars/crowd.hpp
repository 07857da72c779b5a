/// Who the people are and where each is at a time.
///
/// Everything is a function of the time alone: nothing is remembered from frame to frame, so that a jump in time, a
/// picture of a single moment and a day-long pause show what a visitor who stayed would see.
#pragma once

#include <glm/glm.hpp>
#include <span>
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

/// Where all are at a time in seconds (not finite: 0), each on his side of the street, aside from those he meets
/// and off the walls. Heights are those of `terrain` where it has any (may be null), else the routes' own. Nobody is
/// anywhere that `person.route` or `character` do not reach: such people stand at their own position.
std::vector<Place> placesAt(const city::People& people, std::span<const city::Person> persons,
                            const city::HeightField* terrain, double time);

/// Metres that two people have between their middles when they pass.
constexpr double kPassing = 0.75;
/// Nobody moves faster than his own pace by more than this, metres a second.
constexpr double kFastestAside = 3.0;

}  // namespace vicus::avatars
