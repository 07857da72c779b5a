/// The colour of a city's ground, painted once from what covers it, how steep it is and how the light falls on it. No
/// GL: it is the same however coarsely the ground is meshed.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"
#include "scenegraph/ground_shade.hpp"
#include "scenegraph/light.hpp"

namespace vicus::scenegraph {

/// Square picture over the height field, row 0 in the south. rgb: square root of linear albedo times the light on the
/// slope over that on level ground; alpha: which detail
/// goes with it, 0 grass, 0.5 earth, 1 stones.
struct GroundMap {
  int size = 0;
  std::vector<uint8_t> rgba;
};

/// Colour of open country, as a texel of the map (0 to 1).
glm::vec4 countrysideTexel();

/// Side in pixels for a field of this extent (metres): a power of two, half a metre to a pixel or finer, `largest` at
/// most and 64 at least.
int groundMapSize(glm::dvec2 extent, int largest);

/// Paints the map: the cover's classes with softened, slightly ragged borders, mottled; earth and rock where it is
/// steep; lit by `light` as the field's own slopes are; darker where `shade` (of the same size, or of size 0) keeps sun
/// and sky away. Without cover: grass
/// and meadows. Deterministic, rows in parallel.
/// `sunFromMaps`: the sun is kept away by shadow maps where the map is drawn, not by the map itself: it then holds what
/// sky and slope change of the light that is left.
GroundMap paintGroundMap(const city::HeightField& field, const city::GroundCover* cover, int size,
                         const GroundShade& shade, const Light& light, bool sunFromMaps = false);

}  // namespace vicus::scenegraph
