/// Where people walk and stand: closed ways along streets, and groups in open places.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "city/city.hpp"

namespace vicus::avatars {

/// What the ground is like, as the routes ask for it. All in metres from the city's origin.
struct Ground {
  /// Distance from a point to the nearest thing that one walks into, at most a few metres; negative inside.
  std::function<double(glm::dvec2)> clearance;
  /// Height of what one walks on; nothing where one cannot (water, no ground).
  std::function<std::optional<double>(glm::dvec2)> height;
};

struct RouteOptions {
  size_t count = 60;                    ///< of routes; fewer where the streets give no more
  double shortest = 60, longest = 260;  ///< metres one way
  glm::dvec2 centre{0};                 ///< near which most begin
  double spread = 350;                  ///< metres from it at which a third as many begin
  uint32_t seed = 1;
};

constexpr double kBodyRadius = 0.3;  ///< metres that a person keeps from walls

/// Ways along the graph, out and back; each point's free width to the right is measured with the ground's clearance, so
/// whoever keeps within it meets no wall. Deterministic. Streets that are blocked end a way; ways under `shortest` are
/// dropped. An empty graph gives none.
std::vector<city::WalkRoute> makeRoutes(const city::StreetGraph& streets, const Ground& ground,
                                        const RouteOptions& options);

/// A graph over a grid of `cell` metres about a place: cells with room for two to pass, joined to their neighbours. For
/// cities without streets.
city::StreetGraph walkableGrid(const Ground& ground, glm::dvec2 centre, double halfSide, double cell);

/// Groups of two to five about the candidates, taken in a seeded order: all with room about them, at least 5 m apart,
/// and off the middle of the routes.
std::vector<city::StandingPlace> makeGroups(std::span<const glm::dvec2> candidates,
                                            std::span<const city::WalkRoute> routes, const Ground& ground,
                                            size_t people, uint32_t seed);

}  // namespace vicus::avatars
