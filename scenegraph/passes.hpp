/// The passes of one picture in the order drawn: the one list of them.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace vicus::scenegraph {

enum class PassId : uint8_t { ShadowMaps, Opaque, Ground, Shadow, CutOut, Sky, Water };

/// A pass exists only where the scene has something to draw in it.
struct Pass {
  PassId id;
  std::string_view name;
  int bin;                 ///< OpenSceneGraph's render bin number: passes run in ascending order
  std::string_view needs;  ///< what a scene must have for it
  bool items;              ///< drawn into item buffers too
};

constexpr std::array kPasses = {
    // Into maps of their own, before the picture; a map is drawn again only when what is in it has changed.
    Pass{PassId::ShadowMaps, "shadow maps", -1, "shadows.cascades, and something that stands in the sun", false},
    Pass{PassId::Opaque, "opaque", 0, "buildings, trees, monuments or people", true},
    // Ground after what stands on it: most of it is hidden and costs nothing then.
    Pass{PassId::Ground, "ground", 1, "terrain or anything that stands on the ground", true},
    // Ovals under people where there are no shadow maps. On the ground alone: what stands there is drawn, and what is
    // see-through is not yet.
    Pass{PassId::Shadow, "shadows", 2, "people", false},
    // Separate, because a shader that discards takes the early depth test from all that it draws.
    Pass{PassId::CutOut, "cut-out", 3, "a material whose picture has holes, or people", true},
    Pass{PassId::Sky, "sky", 4, "nothing: every picture has a sky", false},
    Pass{PassId::Water, "water", 5, "water bodies", true},
};

constexpr const Pass& pass(PassId id) {
  return kPasses[static_cast<size_t>(id)];
}

}  // namespace vicus::scenegraph
