/// The GLSL files of this folder, embedded into the program when it is built.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vicus::assets {

/// Text of a shader file as it lies in assets/shaders ("lighting.glsl"); empty where there is none of that name.
std::string_view shaderText(std::string_view fileName);

/// A whole shader ready to compile: `#version 430`, one `#define` line for each of
/// `defines` ("CUT_OUT", "TEXTURE_CLASSES 2"), then the file with each `#include "name"` line replaced by that file,
/// once. A missing file gives an `#error` line, so that the compiler reports it.
std::string shaderSource(std::string_view fileName, std::span<const std::string> defines);

}  // namespace vicus::assets
