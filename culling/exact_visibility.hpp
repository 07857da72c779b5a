/// The reference that frustum culling is measured against: slow, from clip space itself, with no planes of its own.
#pragma once

#include <glm/glm.hpp>

#include "city/aabb.hpp"

namespace vicus::culling {

/// Whether any point of the box's surface lies in clip space −w ≤ x ≤ w, −w ≤ y ≤ w, 0 ≤ z ≤ w: each face is cut by the
/// six inequalities in homogeneous coordinates (Sutherland and Hodgman 1974, "Reentrant Polygon Clipping") in extended
/// precision. Also true where numbers are not finite, so that nothing can be proven; false for an empty box.
///
/// The matrix takes positions relative to `origin`, as in `frustumFromClip`.
bool isSurfaceInClipSpace(const glm::dmat4& clipFromRelative, const glm::dvec3& origin, const city::Aabbf& box);

}  // namespace vicus::culling
