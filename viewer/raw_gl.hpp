/// Raw GL beside OpenSceneGraph.
#pragma once

#include "scenegraph/gl.hpp"

#include <string>
#include <string_view>

namespace vicus::viewer {

/// Restores at its end what drawing changes: OpenSceneGraph believes that the state is as it left it.
class GlStateGuard {
 public:
  GlStateGuard();
  ~GlStateGuard();
  GlStateGuard(const GlStateGuard&) = delete;
  GlStateGuard& operator=(const GlStateGuard&) = delete;

 private:
  GLint program_ = 0, vertexArray_ = 0, arrayBuffer_ = 0, activeTexture_ = 0, texture_ = 0;
};

/// A program from two files of assets/shaders. 0, with the compiler's words in `error`, where it does not link.
GLuint linkProgram(std::string_view vertexFile, std::string_view fragmentFile, std::string& error);

}  // namespace vicus::viewer
