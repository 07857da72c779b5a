#include "scenegraph/gl.hpp"

#include <osg/Image>
#include <osg/Texture2D>

#include "city/random.hpp"
#include "scenegraph/features.hpp"

namespace vicus::scenegraph {
namespace {

/// A triangle whose corners the shader makes from their number.
class WholePicture : public osg::Drawable {
 public:
  WholePicture() {
    setUseDisplayList(false);
    setCullingActive(false);
  }
  void drawImplementation(osg::RenderInfo&) const override {
    // A vertex array of our own: none of its arrays is on, whatever OpenSceneGraph left on in its own.
    if (vertexArray_ == 0) glGenVertexArrays(1, &vertexArray_);
    glBindVertexArray(vertexArray_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
  }
  void releaseGLObjects(osg::State* state) const override {
    osg::Drawable::releaseGLObjects(state);
    if (state && vertexArray_ != 0) glDeleteVertexArrays(1, &vertexArray_), vertexArray_ = 0;
  }
  const char* className() const override { return "WholePicture"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  mutable GLuint vertexArray_ = 0;
};

/// A tileable picture of scattered clouds: six octaves of value noise, of which the upper part shows.
osg::ref_ptr<osg::Texture2D> cloudTexture() {
  constexpr int kSize = 256, kOctaves = 6, kCellsOfFirst = 4;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(kSize, kSize, 1, GL_RED, GL_UNSIGNED_BYTE);
  image->setInternalTextureFormat(GL_R8);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      float sum = 0, weight = 0.5f;
      for (int octave = 0, cells = kCellsOfFirst; octave < kOctaves; ++octave, cells *= 2, weight *= 0.5f) {
        const glm::vec2 at = glm::vec2(x, y) * static_cast<float>(cells) / static_cast<float>(kSize);
        const glm::vec2 cell = glm::floor(at);
        glm::vec2 t = at - cell;
        t = t * t * (3.0f - 2.0f * t);
        const auto corner = [&](int dx, int dy) {
          const auto cx = static_cast<uint32_t>((static_cast<int>(cell.x) + dx) % cells);
          const auto cy = static_cast<uint32_t>((static_cast<int>(cell.y) + dy) % cells);
          return static_cast<float>(city::hash32(city::hash32(cx, cy), static_cast<uint32_t>(octave)) >> 8) /
                 16777216.0f;
        };
        sum += weight *
               glm::mix(glm::mix(corner(0, 0), corner(1, 0), t.x), glm::mix(corner(0, 1), corner(1, 1), t.x), t.y);
      }
      *image->data(x, y) = static_cast<uint8_t>(255 * glm::smoothstep(0.50f, 0.72f, sum));
    }
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setName("clouds");
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  return texture;
}

class Sky : public Feature {
 public:
  Sky() : Feature("sky") {
    osg::ref_ptr<WholePicture> drawable = new WholePicture;
    drawable->setName("sky/whole picture");
    node_->addChild(drawable);
    const SurfaceStates states = surfaceStates(PassId::Sky, "sky.vert", "sky.frag", {});
    states.of(Variant::Colour)->setTextureAttribute(kCloudUnit, cloudTexture());
    states.of(Variant::Colour)->addUniform(new osg::Uniform("clouds", static_cast<int>(kCloudUnit)));
    addSurface(drawable, states, PassId::Sky);
  }
  DrawCounts apply(const city::FramePlan&) override {
    DrawCounts counts;
    counts.triangles = 1, counts.drawCalls = 1, counts.textureBinds = 1;
    return counts;
  }
};

}  // namespace

std::unique_ptr<Feature> makeSky() {
  return std::make_unique<Sky>();
}

}  // namespace vicus::scenegraph
