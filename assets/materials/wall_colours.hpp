/// Mean colours of the walls among the built-in textures: what they look like from far away.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

namespace vicus::assets {

/// Linear light, 0 to 1, before tints; of `facade-…` that of the wall about the window. Nothing for what is no wall.
std::optional<glm::vec3> wallColour(std::string_view name);

}  // namespace vicus::assets
