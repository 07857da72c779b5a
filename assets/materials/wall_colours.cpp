#include "assets/materials/wall_colours.hpp"

#include <algorithm>
#include <array>

namespace vicus::assets {
namespace {

struct WallColour {
  std::string_view name;
  glm::vec3 colour;
};

/// Measured from the pictures, which need not be painted to know them; the tests measure them again.
constexpr std::array<WallColour, 10> kColours = {{
    {"plaster", {0.602F, 0.527F, 0.397F}},
    {"limewash", {0.752F, 0.706F, 0.598F}},
    {"brick", {0.305F, 0.171F, 0.116F}},
    {"brick-dark", {0.145F, 0.0863F, 0.0657F}},
    {"ashlar", {0.492F, 0.432F, 0.320F}},
    {"rubble", {0.319F, 0.265F, 0.191F}},
    {"flint", {0.226F, 0.208F, 0.170F}},
    {"facade-limestone", {0.518F, 0.457F, 0.339F}},
    {"facade-plaster", {0.601F, 0.526F, 0.397F}},
    {"facade-brick", {0.310F, 0.175F, 0.118F}},
}};

}  // namespace

std::optional<glm::vec3> wallColour(std::string_view name) {
  const auto at = std::find_if(kColours.begin(), kColours.end(), [&](const WallColour& c) { return c.name == name; });
  if (at == kColours.end()) return std::nullopt;
  return at->colour;
}

}  // namespace vicus::assets
