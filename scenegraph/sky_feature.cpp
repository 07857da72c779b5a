#include "scenegraph/gl.hpp"

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

class Sky : public Feature {
 public:
  Sky() : Feature("sky") {
    osg::ref_ptr<WholePicture> drawable = new WholePicture;
    drawable->setName("sky/whole picture");
    node_->addChild(drawable);
    addSurface(drawable, surfaceStates(PassId::Sky, "sky.vert", "sky.frag", {}), PassId::Sky);
  }
  DrawCounts apply(const city::FramePlan&) override {
    DrawCounts counts;
    counts.triangles = 1, counts.drawCalls = 1;
    return counts;
  }
};

}  // namespace

std::unique_ptr<Feature> makeSky() {
  return std::make_unique<Sky>();
}

}  // namespace vicus::scenegraph
