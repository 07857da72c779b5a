/// The wavefront of a polygon: all edges move inward at one speed. Used by straight_skeleton.cpp.
#pragma once

#include <optional>
#include <span>

#include "facade/straight_skeleton.hpp"

namespace vicus::facade {

/// Unchecked; nothing where the wavefront gets stuck.
std::optional<Skeleton> skeletonByWavefront(std::span<const Ring> rings);

}  // namespace vicus::facade
