/// The plan of one quarter: a market, the streets that grow about it, and what stands along them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "assets/norvic/houses.hpp"
#include "assets/norvic/landscape.hpp"
#include "assets/norvic/plan_geometry.hpp"
#include "assets/norvic/street_net.hpp"

namespace vicus::assets::norvic {

/// A quarter beside which this one lies: what is nearer to it (distance less weight) is its ground.
struct Neighbour {
  glm::dvec2 centre{0};
  double weight = 0;
};

/// Where a road leaves the quarter's ground. Both quarters of a road name the same place and key.
struct Exit {
  glm::dvec2 place{0};
  uint32_t key = 0;
};

/// What a quarter is to be.
struct QuarterBrief {
  glm::dvec2 centre{0};       ///< of its market
  double radius = 300;        ///< of the streets about it, metres
  double weight = 0;          ///< as its neighbours see it
  double heading = 0;         ///< of its market, radians
  glm::dvec2 market{60, 36};  ///< metres
  uint32_t seed = 1;
  uint32_t fieldSeed = 1;  ///< the same for all quarters
  int churches = 1;
  int bridges = 0;  ///< wanted within the radius, where a river is
  bool walled = false, castle = false, cathedral = false;
  std::vector<Exit> exits;
  std::vector<Neighbour> neighbours;
  glm::dvec2 min{0}, max{0};  ///< nothing of it lies outside
};

/// A house in its place, not yet on the ground.
struct Plot {
  glm::dvec2 position{0};  ///< of the middle of its footprint
  float heading = 0;
  uint32_t variant = 0;  ///< in HouseCatalogue::variants
  float priority = 0;    ///< the lowest are built first
  uint32_t seed = 0;
};

enum class SpotKind : uint8_t { Church, Cathedral, Castle, MarketCross, Bridge };

/// A monument in its place.
struct Spot {
  SpotKind kind{};
  glm::dvec2 position{0};
  double heading = 0;
  int variant = 0;
};

/// A tree in its place.
struct TreeSpot {
  glm::dvec2 position{0};
  uint8_t kind = 0;
  uint32_t seed = 0;
};

struct Gate {
  glm::dvec2 position{0};
  glm::dvec2 outward{1, 0};  ///< along its street, unit
  double width = 5;          ///< of the passage
};

struct QuarterPlan {
  std::vector<glm::dvec2> nodes;  ///< of the street lines' ends
  std::vector<StreetLine> streets;
  std::vector<std::pair<uint32_t, uint32_t>> exitNodes;  ///< key and node
  std::vector<std::string> names;                        ///< by StreetStyle::name
  PlanRect market;
  std::vector<PlanRect> paved, grass, gardens;
  std::vector<PlanRect> trodden;  ///< about each house: nothing grows where people go
  std::vector<Plot> plots;        ///< by priority
  std::vector<Spot> spots;
  std::vector<TreeSpot> trees;
  std::vector<Gate> gates;
  std::vector<std::vector<glm::dvec2>> walls;  ///< stretches between gates and river
  std::vector<glm::dvec2> outline;             ///< of the town's ground, closed
};

/// Where the castle and the cathedral of a walled town lie, and its wall: known before the land is final.
struct TownDesign {
  glm::dvec2 castle{0};
  PlanRect close;  ///< of the cathedral
};
TownDesign designTown(const QuarterBrief& brief, const Landscape& land);

/// Lays out a quarter. Depends on the brief and the land alone.
QuarterPlan planQuarter(const QuarterBrief& brief, const Landscape& land, const HouseCatalogue& houses);

/// Deck height of a bridge at `distance` metres from the river's middle.
double deckHeight(const Landscape& land, double distance);
/// Half a bridge's length, metres.
double bridgeHalfLength(const Landscape& land);

/// The ground about a house's footprint that is bare.
inline PlanRect troddenAbout(PlanRect footprint) {
  footprint.halfWidth += 1.6, footprint.halfDepth += 1.6;
  return footprint;
}

constexpr double kMoundTop = 34, kMoundFoot = 66, kMoundRise = 16;  ///< metres

}  // namespace vicus::assets::norvic
