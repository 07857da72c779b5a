/// What a view can see, as planes, and the test of boxes against them.
///
/// Based on: Gribb and Hartmann 2001, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection
/// Matrix"; Assarsson and Möller 2000, "Optimized View Frustum Culling Algorithms for Bounding Boxes" (nearest and
/// farthest corner, plane masks); Willmott et al. 2001, §3.1.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "city/aabb.hpp"
#include "city/view_state.hpp"

namespace vicus::culling {

/// A point p is on the inner side where dot(normal, p − Frustum::origin) + distance ≥ 0.
struct FrustumPlane {
  glm::dvec3 normal{0};  ///< unit, pointing inward
  double distance = 0;   ///< metres; rounding of the matrix is already added, so it errs outward
};

/// Intersection of at most six half-spaces. A view with an infinite far plane has five; a matrix with rows that give no
/// plane has fewer, none in the worst case: then everything counts as visible.
struct Frustum {
  glm::dvec3 origin{0};  ///< of the planes, metres from the city's origin: the eye
  std::array<FrustumPlane, 6> planes{};
  uint32_t count = 0;  ///< planes in use
};

/// Planes of clip space −w ≤ x ≤ w, −w ≤ y ≤ w, 0 ≤ z ≤ w for positions relative to `origin` (with origin 0 the matrix
/// is clipFromWorld itself; relative to the eye it is precise for an eye however far away). A row that gives no plane –
/// its normal is zero (infinite far plane) or lost in rounding – is left out, and a matrix with an entry that is not
/// finite gives no planes at all: nothing visible is ever cut off.
Frustum frustumFromClip(const glm::dmat4& clipFromRelative, const glm::dvec3& origin);

/// The view's frustum, from its eye-relative matrix.
Frustum frustumOf(const city::ViewState& view);

enum class Containment : uint8_t { Outside, Crossing, Inside };

/// A frustum readied for float boxes: its planes in float relative to a float origin next to the eye, pushed outward by
/// `slack`. The slack covers the rounding of this test and that of a graphics card which transforms the same positions
/// in float; it is 2⁻²⁰ of the distance to the farthest point that may be tested (2 mm at 2 km).
///
/// Rounding is monotone in each operation of the test, so a box within an outside box is outside, and one within an
/// inside box is inside: testing a hierarchy gives exactly what testing every box gives.
struct BoxTest {
  struct Plane {
    float x = 0, y = 0, z = 0, distance = 0;
    /// Byte offset within Aabbf of the farthest corner's coordinates along the normal, and of the nearest corner's.
    std::array<uint32_t, 3> farthest{}, nearest{};
  };
  float originX = 0, originY = 0, originZ = 0;
  std::array<Plane, 6> planes{};
  uint32_t allPlanes = 0;  ///< mask with one bit for each plane in use
  double slack = 0;        ///< metres
};

/// `reach` must contain every box that will be tested; an empty one stands for the frustum's origin alone.
BoxTest boxTestFor(const Frustum& frustum, const city::Aabbf& reach);

/// Where a box lies. `mask` has a bit for each plane that the box may cross (begin with `allPlanes`); bits of planes
/// that the box is wholly inside of are cleared, so that what the box contains need not be tested against them again.
///
/// A box of zero volume is a point, a line or a rectangle like any other box. A box around the eye is crossing, or
/// inside, once it reaches past the near plane; nearer than that it cannot be seen and is outside. An empty box
/// contains nothing and is outside. A box with a NaN is crossing: it may be anywhere.
Containment classify(const BoxTest& test, const city::Aabbf& box, uint32_t& mask);

}  // namespace vicus::culling
