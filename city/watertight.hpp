/// Closes the hairline cracks between surfaces that meet but do not share their corners.
///
/// Where a corner of one triangle lies on an edge of another (a T-junction), or two corners differ by rounding, a
/// rasteriser leaves single pixels between them open, and through these shows what stands behind the house.
///
/// Based on: Barequet and Kumar 1997, "Repairing CAD Models" (vertices are merged, then edges split at the vertices
/// that lie on them).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/vertex.hpp"

namespace vicus::city {

/// Corners nearer than this to each other, or to an edge, were meant to meet: metres. More than the rounding of a
/// generator in float (1e-5 at 100 m), less than anything that is modelled.
constexpr float kWeldDistance = 5e-4f;

/// Moves corners of the surfaces that nearly coincide onto one position, and splits triangles whose edges pass through
/// corners of others, so that neighbours share whole edges, bit by bit. Edges that have their opposite are left alone.
/// Each surface is a list of triangles, three indices into `vertices` each; new vertices take their attributes from
/// the edge that they lie on. Triangles that lose their area are dropped. Returns the number of splits.
size_t makeWatertight(std::vector<Vertex>& vertices, std::span<std::vector<uint32_t>* const> surfaces);

}  // namespace vicus::city
