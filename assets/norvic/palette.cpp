#include "assets/norvic/palette.hpp"

#include <iterator>

#include "assets/materials/materials.hpp"

namespace vicus::assets::norvic {
namespace {

/// A material made by code under the name that the town calls it, with the town's own tint upon it.
struct Entry {
  const char* name;
  const char* builtin;
  glm::vec3 tint{1};
};

constexpr Entry kEntries[] = {
    {"plaster", "plaster"},
    {"plaster ochre", "plaster", {1.0f, 0.82f, 0.55f}},
    {"plaster rose", "plaster", {1.0f, 0.72f, 0.60f}},
    {"limewash", "limewash"},
    {"limewash grey", "limewash", {0.86f, 0.85f, 0.80f}},
    {"brick", "brick"},
    {"dark brick", "brick-dark"},
    {"rubble", "rubble"},
    {"flint", "flint"},
    {"ashlar", "ashlar"},
    {"timber", "timber"},
    {"oak", "oak"},
    {"planks", "planks"},
    {"tile", "tile"},
    {"brown tile", "tile", {0.80f, 0.70f, 0.62f}},
    {"slate", "slate"},
    {"thatch", "thatch"},
    {"lead", "lead"},
    {"cobbles", "cobbles"},
    {"glass", "glass"},
    {"lead glass", "lead-glass"},
    {"door", "door"},
    {"green door", "door", {0.45f, 0.62f, 0.42f}},
    {"shutter", "shutter"},
    {"iron", "iron"},
    {"red cloth", "wool", {0.75f, 0.22f, 0.16f}},
    {"straw cloth", "wool", {0.90f, 0.78f, 0.48f}},
    {"bark", "bark"},
    {"leaves", "leaves"},
    {"dark leaves", "leaves-dark"},
};
static_assert(std::size(kEntries) == kPaintCount);

}  // namespace

std::vector<city::Material> paletteMaterials() {
  std::vector<city::Material> out;
  for (const Entry& entry : kEntries) {
    city::Material material = builtinMaterial(entry.builtin);
    material.name = entry.name;
    material.tint *= entry.tint;
    out.push_back(material);
  }
  return out;
}

}  // namespace vicus::assets::norvic
