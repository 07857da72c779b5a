#include "scenegraph/ground_caster.hpp"

#include <algorithm>
#include <cmath>
#include <osg/RenderInfo>
#include <osg/State>

namespace vicus::scenegraph {
namespace {

constexpr int kMostCells = 192;
constexpr VertexAttribute kAttributes[] = {{0, 3, GL_FLOAT, VertexAttribute::As::Float, 0}};

}  // namespace

LowGround lowGround(const city::HeightField& field, int most) {
  LowGround ground;
  if (field.size.x < 2 || field.size.y < 2) return ground;
  const glm::ivec2 stride = (field.size - 2) / most + 1, cells = (field.size - 2) / stride + 1;
  const auto sample = [&](int k, int axis) { return std::min(k * stride[axis], field.size[axis] - 1); };
  ground.middle = glm::dvec3(field.origin + field.extent() / 2.0,
                             0.5 * (static_cast<double>(field.minHeight) + static_cast<double>(field.maxHeight)));
  for (int r = 0; r <= cells.y; ++r)
    for (int c = 0; c <= cells.x; ++c) {
      const glm::ivec2 at(sample(c, 0), sample(r, 1));
      double lowest = INFINITY;
      for (int y = std::max(at.y - stride.y, 0); y <= std::min(at.y + stride.y, field.size.y - 1); ++y)
        for (int x = std::max(at.x - stride.x, 0); x <= std::min(at.x + stride.x, field.size.x - 1); ++x)
          lowest = std::min(
              lowest,
              static_cast<double>(
                  field.heights[static_cast<size_t>(y) * static_cast<size_t>(field.size.x) + static_cast<size_t>(x)]));
      ground.positions.emplace_back(glm::dvec3(field.origin + glm::dvec2(at) * field.spacing, lowest) - ground.middle);
    }
  const auto corner = [&](int c, int r) { return static_cast<uint32_t>(r * (cells.x + 1) + c); };
  for (int r = 0; r < cells.y; ++r)
    for (int c = 0; c < cells.x; ++c)
      for (const uint32_t i :
           {corner(c, r), corner(c + 1, r), corner(c + 1, r + 1), corner(c, r), corner(c + 1, r + 1), corner(c, r + 1)})
        ground.indices.push_back(i);
  return ground;
}

GroundCaster::GroundCaster(const city::HeightField& field)
    : ground_(lowGround(field, kMostCells)),
      bytes_(ground_.positions.size() * sizeof(glm::vec3) + ground_.indices.size() * sizeof(uint32_t)),
      count_(ground_.indices.size()) {}

void GroundCaster::draw() {
  if (count_ == 0) return;
  if (vertexArray_ == 0) {
    vertices_.fill(std::span<const glm::vec3>(ground_.positions), GL_STATIC_DRAW);
    indices_.fill(std::span<const uint32_t>(ground_.indices), GL_STATIC_DRAW);
    vertexArray_ = makeVertexArray(indices_, kAttributes, {});
    ground_.positions = {}, ground_.indices = {};
  }
  glBindVertexArray(vertexArray_);
  glBindVertexBuffer(kVertexSource, vertices_.name(), 0, sizeof(glm::vec3));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count_), GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

void GroundCaster::release() {
  if (vertexArray_ != 0) glDeleteVertexArrays(1, &vertexArray_);
  vertexArray_ = 0;
  vertices_.release();
  indices_.release();
}

GroundCasterDrawable::GroundCasterDrawable(std::shared_ptr<GroundCaster> ground) : ground_(std::move(ground)) {
  setUseDisplayList(false);
  setUseVertexBufferObjects(false);
  setCullingActive(false);
}

void GroundCasterDrawable::drawImplementation(osg::RenderInfo& info) const {
  info.getState()->unbindVertexBufferObject();
  ground_->draw();
}

void GroundCasterDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (state) ground_->release();
}

}  // namespace vicus::scenegraph
