/// What surfaces are made of.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace vicus::city {

/// A texture with its size and how it takes light. Colours are linear, 0 to 1.
struct Material {
  std::string name;              ///< as the scene calls it
  std::string source;            ///< `builtin:plaster` (made by code) or the path of an image
  glm::vec2 metresPerRepeat{1};  ///< size of one repeat of the texture; (1, 1) where uv are texture coordinates already
  glm::vec3 tint{1};             ///< multiplies the texture
  float tintVariation = 0;       ///< 0 to 1: how far an instance's seed may shift its brightness and hue
  float specular = 0;            ///< 0 matt … 1 mirror-like (window panes, water)
  bool repeat = true;            ///< false: clamped at its edges

  bool operator==(const Material&) const = default;
};

}  // namespace vicus::city
