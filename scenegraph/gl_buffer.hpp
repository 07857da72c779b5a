/// Buffers and vertex arrays of the one GL context that a scene is drawn in.
#pragma once

#include "scenegraph/gl.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

#include "city/vertex.hpp"

namespace vicus::scenegraph {

/// A GL buffer, made when it is first filled. Invariant: owns its name until `release`, which needs the context
/// current; without it the name goes with the context. Leaves every binding but GL_COPY_WRITE_BUFFER alone, which
/// nobody else uses.
class GlBuffer {
 public:
  GlBuffer() = default;
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;

  /// Replaces the contents; grows as needed, never shrinks.
  void fill(const void* data, size_t bytes, GLenum usage);
  template <typename T>
  void fill(std::span<const T> data, GLenum usage) {
    fill(data.data(), data.size_bytes(), usage);
  }
  void release();

  GLuint name() const { return name_; }
  bool exists() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
  size_t capacity_ = 0;
};

/// Makes a vertex array over buffers of city::Vertex and 32-bit indices, at the locations of shaders/vertex.glsl. The
/// vertex array and array buffer bindings are 0 afterwards.
GLuint makeVertexArray(const GlBuffer& vertices, const GlBuffer& indices);

}  // namespace vicus::scenegraph
