/// Polygons on the plan: cleaning, repair and triangles.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace vicus::assets {

/// Points of a closed line; the last is joined to the first and not repeated.
using Ring = std::vector<glm::dvec2>;

/// An outer ring, counter-clockwise, then its holes, clockwise (after `cleanPolygon`; before, any winding).
struct Polygon {
  std::vector<Ring> rings;
};

/// Positions are kept to 1/4096 m. Up to 2 048 m from a building's origin such numbers are exact in float, and the
/// products of the orientation test are exact in double.
constexpr double kSnap = 1.0 / 4096;
glm::dvec2 snapped(glm::dvec2 p);
glm::dvec3 snapped(glm::dvec3 p);

/// Area in m², positive for a counter-clockwise ring.
double signedArea(std::span<const glm::dvec2> ring);
/// Area in m² without the holes.
double area(const Polygon& polygon);
glm::dvec2 centroid(const Polygon& polygon);
/// Whether p lies inside a closed line of any winding; on the line either answer may come.
bool insideRing(const Ring& ring, glm::dvec2 p);

/// Counter-clockwise, no reflex corner, at least three corners that are not in line.
bool isConvex(std::span<const glm::dvec2> ring);
/// No two edges meet but neighbours at their common corner, and holes lie inside the outer ring and outside each other.
/// False also where holes only touch, which is valid: then ask the geometry library.
bool isPlainlyValid(const Polygon& polygon);

struct CleanedPolygons {
  std::vector<Polygon> polygons;  ///< valid; more than one where a repair cut it
  bool repaired = false;          ///< it crossed or touched itself
  std::string problem;            ///< why `polygons` is empty
};
/// Footprints under this are left out: m².
constexpr double kSmallestArea = 0.1;
/// Snaps, drops repeated points and spikes, winds the rings, and repairs what crosses itself (GEOS MakeValid). Points
/// should lie within a few kilometres of (0, 0).
CleanedPolygons cleanPolygon(const Polygon& raw);

/// The faces that lines cut the plan into (GEOS: union, then polygonize): each with its holes, counter-clockwise. Lines
/// are open unless their last point is their first.
std::vector<Polygon> polygonise(std::span<const Ring> lines);

/// Corners of the ring that matter: points nearer than `tolerance` metres to the line between their kept neighbours are
/// dropped where `group` (one value for the edge after each point) is the same on both sides. At least three remain, or
/// the ring is returned as it came. Indices into the ring, ascending.
std::vector<uint32_t> cornersOf(std::span<const glm::dvec2> ring, std::span<const uint8_t> group, double tolerance);

struct Triangulation {
  Ring points;                      ///< those of the polygon's rings, one ring after another, then any added ones
  std::vector<uint32_t> triangles;  ///< three indices into `points` for each, counter-clockwise; empty: it failed
};
/// Triangles of a valid polygon: constrained Delaunay (GEOS). What that cannot do is first cut in two, which adds
/// points. Fails where even then the triangles do not cover the polygon.
Triangulation triangulate(const Polygon& polygon);

}  // namespace vicus::assets
