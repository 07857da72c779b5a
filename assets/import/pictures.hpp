/// Pictures that models name.
#pragma once

#include <glm/glm.hpp>
#include <string>

namespace vicus::assets {

/// Path of the picture that `modelFile` calls `name`: as written, relative to the model, or in the folders that
/// exporters put pictures in (appearance, appearances, textures, images). Empty where there is none; never leaves the
/// machine: names with a scheme (http://…) are not found.
std::string findPicture(const std::string& modelFile, const std::string& name);

/// A colour as people pick it (sRGB) in linear light, each channel 0 to 1; what is no number becomes 1.
glm::vec3 linearColour(glm::vec3 srgb);

}  // namespace vicus::assets
