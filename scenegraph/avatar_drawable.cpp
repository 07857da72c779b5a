#include "scenegraph/avatar_drawable.hpp"

#include <osg/RenderInfo>
#include <osg/State>

#include "scenegraph/material_textures.hpp"

namespace vicus::scenegraph {
namespace {

using As = VertexAttribute::As;

/// At the locations of shaders/avatar.vert.
constexpr VertexAttribute kVertexAttributes[] = {
    {0, 3, GL_FLOAT, As::Float, offsetof(city::AvatarVertex, position)},
    {1, 2, GL_SHORT, As::Normalised, offsetof(city::AvatarVertex, normal)},
    {2, 4, GL_UNSIGNED_BYTE, As::Integer, offsetof(city::AvatarVertex, joints)},
    {3, 4, GL_UNSIGNED_BYTE, As::Normalised, offsetof(city::AvatarVertex, weights)},
    {4, 4, GL_UNSIGNED_BYTE, As::Integer, offsetof(city::AvatarVertex, colour)},
};
constexpr VertexAttribute kPersonAttributes[] = {
    {5, 4, GL_FLOAT, As::Float, offsetof(GpuAvatar, fromEye)},
    {6, 2, GL_FLOAT, As::Float, offsetof(GpuAvatar, turn)},
    {7, 4, GL_UNSIGNED_INT, As::Integer, offsetof(GpuAvatar, firstMatrix)},
    {8, 2, GL_FLOAT, As::Float, offsetof(GpuAvatar, slope)},
};
constexpr VertexAttribute kCornerAttributes[] = {{0, 2, GL_FLOAT, As::Float, 0}};
constexpr glm::vec2 kCorners[] = {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}};
constexpr uint32_t kCornerOrder[] = {0, 1, 2, 0, 2, 3};

}  // namespace

AvatarBuffers::AvatarBuffers(const std::vector<city::Character>& characters) {
  for (const city::Character& c : characters)
    for (const city::AvatarMesh& m : c.levels) {
      meshes_.push_back({static_cast<uint32_t>(indices_.size()), static_cast<uint32_t>(m.indices.size()),
                         static_cast<int32_t>(vertices_.size())});
      vertices_.insert(vertices_.end(), m.vertices.begin(), m.vertices.end());
      indices_.insert(indices_.end(), m.indices.begin(), m.indices.end());
    }
  bytes_ = vertices_.size() * sizeof(city::AvatarVertex) + indices_.size() * sizeof(uint32_t);
}

void AvatarBuffers::show(std::vector<GpuAvatar> people, const std::vector<Body>& bodies,
                         const std::vector<std::array<glm::vec4, 3>>& matrices) {
  people_ = std::move(people), matrices_ = matrices, bodyCount_ = bodies.size(), changed_ = true;
  commands_.clear();
  throwing_.clear();
  triangles_ = 2 * cardCount();
  for (size_t k = 0; k < bodies.size();) {
    size_t end = k;
    while (end < bodies.size() && bodies[end].character == bodies[k].character && bodies[end].level == bodies[k].level)
      ++end;
    const Mesh& mesh = meshes_[bodies[k].character * city::kAvatarMeshLevels + bodies[k].level];
    const auto count = static_cast<uint32_t>(end - k);
    commands_.push_back({mesh.count, count, mesh.firstIndex, mesh.baseVertex, static_cast<uint32_t>(k)});
    triangles_ += uint64_t{count} * (mesh.count / 3);
    k = end;
  }
}

void AvatarBuffers::upload() {
  if (!made_) {
    vertexBuffer_.fill(std::span<const city::AvatarVertex>(vertices_), GL_STATIC_DRAW);
    indexBuffer_.fill(std::span<const uint32_t>(indices_), GL_STATIC_DRAW);
    quad_.fill(std::span<const glm::vec2>(kCorners), GL_STATIC_DRAW);
    quadIndices_.fill(std::span<const uint32_t>(kCornerOrder), GL_STATIC_DRAW);
    bodyArray_ = makeVertexArray(indexBuffer_, kVertexAttributes, kPersonAttributes);
    quadArray_ = makeVertexArray(quadIndices_, kCornerAttributes, kPersonAttributes);
    vertices_ = {}, indices_ = {};
    made_ = true;
  }
  if (!changed_) return;
  changed_ = false;
  personBuffer_.fill(std::span<const GpuAvatar>(people_), GL_STREAM_DRAW);
  poseBuffer_.fill(std::span<const std::array<glm::vec4, 3>>(matrices_), GL_STREAM_DRAW);
  commandBuffer_.fill(std::span<const DrawCommand>(commands_), GL_STREAM_DRAW);
}

size_t AvatarBuffers::throwWithin(float reach) {
  throwing_.clear();
  for (const DrawCommand& run : commands_)
    for (uint32_t k = run.baseInstance; k < run.baseInstance + run.instanceCount; ++k)
      if (glm::dot(people_[k].fromEye, people_[k].fromEye) <= reach * reach)
        throwing_.push_back({run.count, 1, run.firstIndex, run.baseVertex, k});
  return throwing_.size();
}

void AvatarBuffers::draw(AvatarPart part) {
  const size_t count = part == AvatarPart::Cards            ? cardCount()
                       : part == AvatarPart::ThrowingBodies ? throwing_.size()
                                                            : bodyCount_;
  if (count == 0) return;
  upload();
  if (part == AvatarPart::Bodies || part == AvatarPart::ThrowingBodies) {
    const bool throwing = part == AvatarPart::ThrowingBodies;
    const std::vector<DrawCommand>& commands = throwing ? throwing_ : commands_;
    if (throwing) throwingBuffer_.fill(std::span<const DrawCommand>(throwing_), GL_STREAM_DRAW);
    glBindVertexArray(bodyArray_);
    glBindVertexBuffer(kVertexSource, vertexBuffer_.name(), 0, sizeof(city::AvatarVertex));
    glBindVertexBuffer(kInstanceSource, personBuffer_.name(), 0, sizeof(GpuAvatar));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kPoseBinding, poseBuffer_.name());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, throwing ? throwingBuffer_.name() : commandBuffer_.name());
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands.size()), 0);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  } else {
    const auto first = static_cast<GLuint>(part == AvatarPart::Cards ? bodyCount_ : 0);
    glBindVertexArray(quadArray_);
    glBindVertexBuffer(kVertexSource, quad_.name(), 0, sizeof(glm::vec2));
    glBindVertexBuffer(kInstanceSource, personBuffer_.name(), 0, sizeof(GpuAvatar));
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, 6, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(count), first);
  }
  glBindVertexArray(0);
}

void AvatarBuffers::release() {
  for (GLuint* array : {&bodyArray_, &quadArray_}) {
    if (*array != 0) glDeleteVertexArrays(1, array);
    *array = 0;
  }
  for (GlBuffer* b : {&vertexBuffer_, &indexBuffer_, &quad_, &quadIndices_, &personBuffer_, &poseBuffer_,
                      &commandBuffer_, &throwingBuffer_})
    b->release();
}

AvatarDrawable::AvatarDrawable(std::shared_ptr<AvatarBuffers> buffers, AvatarPart part)
    : buffers_(std::move(buffers)), part_(part) {
  setUseDisplayList(false);
  setUseVertexBufferObjects(false);
  setCullingActive(false);
}

void AvatarDrawable::drawImplementation(osg::RenderInfo& info) const {
  info.getState()->unbindVertexBufferObject();
  buffers_->draw(part_);
}

void AvatarDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (state) buffers_->release();
}

}  // namespace vicus::scenegraph
