/// Ways through a city that the eye follows: sampling them, and making those that every scene has.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "city/city.hpp"
#include "city/random.hpp"
#include "city/view_state.hpp"

namespace vicus::viewer {

/// Pose of the eye at a time in seconds. Between keys: positions on a Catmull–Rom spline whose tangents take the keys'
/// own times (so speed does not jump where keys are uneven), headings and pitches likewise along the shorter arc.
/// Before the first key and after the last the eye stands still. A tour that jumps shows its last key whose time has
/// come. Keys whose times do not increase act as a jump. No keys give the default pose, a time that is not finite the
/// first key.
city::ViewPose poseAt(const city::Tour& tour, double time);

/// Seconds from the first key to the last.
double durationOf(const city::Tour& tour);

/// One frame of a tour that is played frame by frame.
struct TourFrame {
  double time = 0;      ///< on the tour, seconds
  double dt = 0;        ///< since the frame before, seconds
  bool warmUp = false;  ///< drawn, but not counted
};

constexpr size_t kWarmUpFrames = 10;

/// The warm-up frames at the tour's start, then `frames` spread evenly over the tour from its first key to its last.
std::vector<TourFrame> spreadFrames(const city::Tour& tour, size_t frames);

/// Names of the tours that every scene has: street, flyover, turn, teleport.
inline constexpr std::string_view kTourNames[] = {"street", "flyover", "turn", "teleport"};

/// All tours of a scene: those named above, the city's own where it has one of that name with keys, else made here;
/// then the city's further ones. The same city gives the same tours.
///   street: a walk through the middle of the town along its streets, or where it has none along the ridges of the
///     distance to the footprints; eye at `kEyeHeight` above the ground, outside every building.
///   flyover: in from outside, low over the roofs, round and out again.
///   turn: once round on the spot, in the street.
///   teleport: 24 views in and above the streets, one a second.
std::vector<city::Tour> makeTours(const city::City& city);

/// The tour of that name; null where there is none.
const city::Tour* findTour(const std::vector<city::Tour>& tours, std::string_view name);

/// A view from anywhere: in turn at eye level in the streets and gardens (heading at random, level or nearly so) and
/// from the air (up to 200 m above the roofs, looking down). For checks over many views; the same `random` gives the
/// same view.
city::ViewPose randomView(const city::City& city, city::Random& random);

/// Those of them at eye level only.
city::ViewPose randomStreetView(const city::City& city, city::Random& random);

}  // namespace vicus::viewer
