/// Buffers and vertex arrays of the one GL context that a scene is drawn in.
#pragma once

#include "scenegraph/gl.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

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
  /// Makes room for `bytes` bytes. Returns whether the contents were lost by that; what is new is undefined.
  bool reserve(size_t bytes, GLenum usage);
  /// Replaces bytes from `offset` on; room for them must have been made.
  void write(size_t offset, const void* data, size_t bytes);
  void release();

  GLuint name() const { return name_; }
  bool exists() const { return name_ != 0; }
  size_t capacity() const { return capacity_; }

 private:
  GLuint name_ = 0;
  size_t capacity_ = 0;
};

/// One attribute of a vertex: where it goes and where it lies.
struct VertexAttribute {
  GLuint location;
  GLint components;
  GLenum type;
  enum class As : uint8_t { Float, Normalised, Integer } as;
  GLuint offset;  ///< bytes from the start of its vertex or instance
};

/// Where a vertex array takes its attributes from: one vertex after another, or one entry for each draw's base
/// instance.
constexpr GLuint kVertexSource = 0;
constexpr GLuint kInstanceSource = 1;

/// Makes a vertex array with these attributes from kVertexSource and kInstanceSource (whose buffers are bound when
/// drawing, by glBindVertexBuffer) and with 32-bit indices. The vertex array binding is 0 afterwards.
GLuint makeVertexArray(const GlBuffer& indices, std::span<const VertexAttribute> ofVertices,
                       std::span<const VertexAttribute> ofInstances);

}  // namespace vicus::scenegraph
