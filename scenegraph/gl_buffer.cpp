#include "scenegraph/gl_buffer.hpp"

#include <algorithm>
#include <cassert>

namespace vicus::scenegraph {

void GlBuffer::fill(const void* data, size_t bytes, GLenum usage) {
  if (name_ == 0) glGenBuffers(1, &name_);
  glBindBuffer(GL_COPY_WRITE_BUFFER, name_);
  if (bytes > capacity_ || capacity_ == 0) {
    capacity_ = std::max<size_t>(bytes, 16);  // an empty buffer cannot be bound as storage
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(capacity_), bytes == capacity_ ? data : nullptr, usage);
    if (bytes == capacity_) data = nullptr;
  }
  if (data && bytes > 0) glBufferSubData(GL_COPY_WRITE_BUFFER, 0, static_cast<GLsizeiptr>(bytes), data);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

bool GlBuffer::reserve(size_t bytes, GLenum usage) {
  if (name_ != 0 && bytes <= capacity_) return false;
  fill(nullptr, bytes, usage);
  return true;
}

void GlBuffer::write(size_t offset, const void* data, size_t bytes) {
  assert(offset + bytes <= capacity_);
  glBindBuffer(GL_COPY_WRITE_BUFFER, name_);
  glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
}

void GlBuffer::release() {
  if (name_ != 0) glDeleteBuffers(1, &name_);
  name_ = 0;
  capacity_ = 0;
}

GLuint makeVertexArray(const GlBuffer& indices, std::span<const VertexAttribute> ofVertices,
                       std::span<const VertexAttribute> ofInstances) {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  glBindVertexArray(name);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
  const auto add = [](const VertexAttribute& a, GLuint source) {
    if (a.as == VertexAttribute::As::Integer)
      glVertexAttribIFormat(a.location, a.components, a.type, a.offset);
    else
      glVertexAttribFormat(a.location, a.components, a.type, a.as == VertexAttribute::As::Normalised, a.offset);
    glVertexAttribBinding(a.location, source);
    glEnableVertexAttribArray(a.location);
  };
  for (const VertexAttribute& a : ofVertices) add(a, kVertexSource);
  for (const VertexAttribute& a : ofInstances) add(a, kInstanceSource);
  glVertexBindingDivisor(kInstanceSource, 1);
  glBindVertexArray(0);
  return name;
}

}  // namespace vicus::scenegraph
