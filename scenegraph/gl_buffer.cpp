#include "scenegraph/gl_buffer.hpp"

#include <algorithm>

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

void GlBuffer::release() {
  if (name_ != 0) glDeleteBuffers(1, &name_);
  name_ = 0;
  capacity_ = 0;
}

GLuint makeVertexArray(const GlBuffer& vertices, const GlBuffer& indices) {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  glBindVertexArray(name);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices.name());
  constexpr auto kStride = static_cast<GLsizei>(sizeof(city::Vertex));
  const auto at = [](size_t offset) { return reinterpret_cast<const void*>(offset); };
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, at(offsetof(city::Vertex, position)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, kStride, at(offsetof(city::Vertex, uv)));
  glVertexAttribPointer(2, 2, GL_SHORT, GL_TRUE, kStride, at(offsetof(city::Vertex, normal)));
  glVertexAttribIPointer(3, 2, GL_UNSIGNED_SHORT, kStride, at(offsetof(city::Vertex, material)));
  for (GLuint location = 0; location < 4; ++location) glEnableVertexAttribArray(location);
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  return name;
}

}  // namespace vicus::scenegraph
