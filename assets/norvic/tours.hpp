/// The tours of a generated city.
#pragma once

#include <span>

#include "assets/norvic/quarter.hpp"
#include "city/city.hpp"

namespace vicus::assets::norvic {

/// A place worth looking at.
struct Sight {
  glm::dvec2 place{0};
  double height = 0;     ///< of its middle above the ground about it
  double distance = 40;  ///< from where it is well seen
};

/// What tours lead by, in the order of the walk.
struct TourStops {
  std::vector<glm::dvec2> walk;  ///< places that the walk passes, on streets or near them
  std::vector<Sight> sights;
  glm::dvec2 square{0};  ///< where one stands to look all round
  glm::dvec2 centre{0};  ///< of the flight
  double radius = 500;   ///< of the town
};

/// The tours `street` (a walk along streets at eye height), `flyover` (a circle above the town), `turn` (all round in
/// the square) and `teleport` (from sight to sight). The city's streets, terrain and buildings are there already.
std::vector<city::Tour> makeTours(const city::City& city, const TourStops& stops);

}  // namespace vicus::assets::norvic
