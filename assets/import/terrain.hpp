/// Height fields from triangles and from scattered ground altitudes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "assets/import/source.hpp"
#include "city/aabb.hpp"
#include "city/height_field.hpp"

namespace vicus::assets {

/// Samples to a side that a height field made from triangles or points may have: 2^10 + 1.
constexpr int kLargestField = 1025;

/// An empty field (all NaN) that covers `extent` in the plan, its samples at whole multiples of `spacing` metres from
/// the city's origin; coarser where it would have more than kLargestField samples to a side. At least 2 × 2.
city::HeightField fieldOver(const city::Aabb& extent, double spacing);

/// Gives every sample without data a height between those that have one: they keep theirs, the others become the
/// solution of Laplace's equation (a membrane pinned at the known samples, free at the edges), so no height leaves the
/// range of the data. Returns how many were filled; 0 where no sample has data.
uint64_t fillByMembrane(city::HeightField& field);

/// The heights of a triangulated surface at the field's samples; samples outside keep NaN. Where triangles lie over
/// each other the highest counts. Positions relative to the city's origin. Returns the number of samples covered.
uint64_t rasteriseTin(const Tin& tin, city::HeightField& field);

/// Spacing in metres that shows a TIN's own detail: a quarter of the mean edge of its triangles' plan, 0.5 to 4.
double spacingOf(const Tin& tin);

/// A field through scattered ground altitudes, points in metres from the city's origin: the samples at the corners of
/// each point's cell take the mean of the points near them (weighted bilinearly), the rest follow by `fillByMembrane`.
/// Give a building as points along its outline: a membrane pinned at single points has cusps there. All NaN where there
/// are no points.
city::HeightField fieldThrough(std::span<const glm::dvec3> points, const city::Aabb& extent, double spacing);

/// Moves neighbouring samples towards each other until none differ by more than `steepest` (rise over run, > 0) along
/// the rows or columns, nearly; their mean stays. Samples without height stay so.
void limitSlope(city::HeightField& field, double steepest);

/// The ground along a closed outline, looked at every half spacing.
struct GroundUnder {
  double lowest = 0, highest = 0, mean = 0;
  bool known = false;  ///< false: the field has no data there
};
GroundUnder groundUnder(const city::HeightField& field, std::span<const glm::dvec2> outline);

}  // namespace vicus::assets
