/// The kinds of tree of Norvic.
#pragma once

#include <cstdint>
#include <vector>

#include "city/city.hpp"

namespace vicus::assets::norvic {

enum class TreeKind : uint8_t { Oak, Apple, Poplar, Willow, Bush };
constexpr int kTreeKinds = 5;

/// Three shapes of each kind, those of a kind one after another; under 120 triangles each.
constexpr int kTreeShapes = 3;
std::vector<city::MeshGeometry> makeTrees();

/// Index in City::treeTypes.
inline uint32_t treeType(TreeKind kind, uint32_t seed) {
  return static_cast<uint32_t>(kind) * kTreeShapes + seed % kTreeShapes;
}

}  // namespace vicus::assets::norvic
