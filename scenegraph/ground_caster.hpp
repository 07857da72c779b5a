/// The height field as it throws shadows: a coarse mesh that nowhere lies over the field, so that it never shades
/// itself.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <glm/glm.hpp>
#include <memory>
#include <osg/Drawable>
#include <vector>

#include "city/height_field.hpp"

namespace vicus::scenegraph {

/// Positions from the field's middle (metres) and triangles, at most `most` cells to a side; each corner lies at the
/// lowest of the samples about it.
struct LowGround {
  glm::dvec3 middle{0};
  std::vector<glm::vec3> positions;
  std::vector<uint32_t> indices;
};
LowGround lowGround(const city::HeightField& field, int most);

/// On the graphics card: uploaded when first drawn. Shared by the cascades.
class GroundCaster {
 public:
  explicit GroundCaster(const city::HeightField& field);
  const glm::dvec3& middle() const { return ground_.middle; }
  uint64_t bytes() const { return bytes_; }
  uint64_t triangles() const { return count_ / 3; }
  void draw();
  void release();

 private:
  LowGround ground_;
  uint64_t bytes_, count_;
  GlBuffer vertices_, indices_;
  GLuint vertexArray_ = 0;
};

class GroundCasterDrawable : public osg::Drawable {
 public:
  explicit GroundCasterDrawable(std::shared_ptr<GroundCaster> ground);
  void drawImplementation(osg::RenderInfo& info) const override;
  void releaseGLObjects(osg::State* state) const override;
  const char* className() const override { return "GroundCasterDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  std::shared_ptr<GroundCaster> ground_;
};

}  // namespace vicus::scenegraph
