/// A building from its surfaces in space.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/finishes.hpp"
#include "assets/import/source.hpp"
#include "city/building_geometry.hpp"
#include "facade/house.hpp"

namespace vicus::assets {

/// What became of a building's surfaces.
struct SurfaceReport {
  uint32_t turned = 0;    ///< wound the wrong way round and turned
  uint32_t repaired = 0;  ///< crossed or touched themselves
  uint32_t bent = 0;      ///< not flat: drawn as the triangles that its outline gives on its mean plane
  uint32_t closed = 0;    ///< holes in solids that were filled
  uint32_t open = 0;      ///< holes in solids that were not
  uint32_t leftOut = 0;   ///< no area, or no triangles could be made
  double floating = 0;    ///< metres that the lowest walls hung above the ground before they were lengthened; negative:
                          ///< they reach into it
};

struct SurfaceOptions {
  Style style;
  /// The rules whose `Facade` upright walls without pictures of their own get; nullptr: none.
  const facade::StyleInUse* rules = nullptr;
  facade::HouseFacts facts;                 ///< what is known of the building
  std::vector<city::MaterialId> materials;  ///< the city's number of each of the source's materials
  std::vector<uint8_t> mayHaveHoles;        ///< for each of them: 1 where its picture may be transparent
  /// Height of the ground under a point of the building's frame, in the same frame; may be empty, may give NaN.
  std::function<double(glm::dvec2)> groundAt;
};

/// Triangles, planes and occluder lines of a building whose points are given in its own frame (metres, ground near z =
/// 0). Kinds that the source does not state follow from the slope. Shells are wound outward; surfaces that bound no
/// volume are drawn from both sides, roofs only upward. Ground surfaces are not drawn. Walls whose feet hang up to 2.5
/// m above the ground are lengthened to 0.3 m below it. Nothing where no surface is left.
std::optional<city::BuildingGeometry> buildFromSurfaces(const SurfaceBuilding& building, std::string name,
                                                        const SurfaceOptions& options, SurfaceReport& report);

}  // namespace vicus::assets
