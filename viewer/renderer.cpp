#include "scenegraph/gl.hpp"

#include "viewer/renderer.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <osg/Camera>
#include <osg/Group>
#include <osg/NodeVisitor>
#include <osg/Program>
#include <osgViewer/Viewer>
#include <set>

#include "city/city.hpp"
#include "scenegraph/glm_osg.hpp"
#include "viewer/framebuffer.hpp"

namespace vicus::viewer {
namespace {

/// Called by OpenSceneGraph when its cull traversal is done and drawing begins.
class DrawBegins : public osg::Camera::DrawCallback {
 public:
  void operator()(osg::RenderInfo&) const override { cullMilliseconds = clock.lap(); }
  mutable StageClock clock;
  mutable double cullMilliseconds = 0;
};

const char* errorInWords(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "unknown GL error";
  }
}

/// Finds programs that did not link: OpenSceneGraph then draws nothing and goes on.
class ProgramCheck : public osg::NodeVisitor {
 public:
  explicit ProgramCheck(osg::State& state) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), state_(state) {}
  void apply(osg::Node& node) override {
    const osg::StateSet* set = node.getStateSet();
    const auto* program =
        set ? dynamic_cast<const osg::Program*>(set->getAttribute(osg::StateAttribute::PROGRAM)) : nullptr;
    if (const auto* linked = program ? program->getPCP(state_) : nullptr; linked && !linked->isLinked())
      unlinked.insert(program->getName());
    traverse(node);
  }
  std::set<std::string> unlinked;

 private:
  osg::State& state_;
};

/// Rows of `row` values each, the last first.
template <typename T>
void flipRows(std::vector<T>& pixels, size_t row) {
  const size_t rows = pixels.size() / std::max<size_t>(row, 1);
  for (size_t y = 0; y < rows / 2; ++y)
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(y * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((y + 1) * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row));
}

}  // namespace

struct Renderer::Impl {
  GlContext& context;
  scenegraph::Scene& scene;
  int multisamples;
  osg::ref_ptr<osgViewer::Viewer> viewer = new osgViewer::Viewer;
  osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window;
  Framebuffer drawn, resolved, items, supersampled;
  glm::ivec2 pictureSize{0};
  std::vector<std::string> problems;
  std::array<bool, 2> programsChecked{};  ///< for each Variant
  osg::ref_ptr<DrawBegins> drawBegins = new DrawBegins;
  std::array<GLuint, 2> timers{};  ///< queries of the card's clock at a frame's begin and end; 0: it has none

  Impl(GlContext& c, scenegraph::Scene& s, int samples) : context(c), scene(s), multisamples(samples) {}

  void report(const std::string& problem) {
    if (!problem.empty() && std::find(problems.begin(), problems.end(), problem) == problems.end())
      problems.push_back(problem);
  }

  void checkGl(const char* where) {
    for (GLenum e = glGetError(); e != GL_NO_ERROR; e = glGetError())
      report(std::string(errorInWords(e)) + " while " + where);
  }

  /// OpenSceneGraph draws what the scene's last `apply` wrote into the bound framebuffer's corner of `size` pixels.
  /// Adds update, cull and draw to `stages` where given.
  void traverse(glm::ivec2 size, double time, scenegraph::Variant variant, StageSamples* stages = nullptr) {
    StageClock clock;
    osg::Camera* camera = viewer->getCamera();
    camera->setViewport(0, 0, size.x, size.y);
    camera->setViewMatrix(scenegraph::toOsg(scene.eyeFromWorld()));
    camera->setProjectionMatrix(scenegraph::toOsg(scene.clipFromEye()));
    viewer->advance(time);
    viewer->eventTraversal();
    viewer->updateTraversal();
    const double update = clock.lap();
    drawBegins->clock = StageClock();
    viewer->renderingTraversals();
    if (stages) {
      stages->add("update", update);
      stages->add("cull", drawBegins->cullMilliseconds);
      stages->add("draw", clock.lap() - drawBegins->cullMilliseconds);
    }
    if (programsChecked[static_cast<size_t>(variant)]) return;
    programsChecked[static_cast<size_t>(variant)] = true;
    ProgramCheck check(*window->getState());
    scene.root()->accept(check);
    for (const std::string& name : check.unlinked) report("shader program " + name + " does not link");
  }

  /// Tells OpenSceneGraph what our own GL between frames has set. (`dirtyAllModes` would not do: it takes each mode for
  /// the opposite of what it was, so that one which is off, like the depth test between frames, is never switched on
  /// again.)
  void forgetState() {
    osg::State& state = *window->getState();
    for (const GLenum off : {GL_SCISSOR_TEST, GL_DITHER, GL_BLEND}) state.haveAppliedMode(off, GL_FALSE);
    state.haveAppliedMode(GL_MULTISAMPLE, static_cast<osg::StateAttribute::GLModeValue>(glIsEnabled(GL_MULTISAMPLE)));
    state.dirtyAllAttributes();
    // A new state believes that unit 0 is active, whoever drew in this context before.
    state.setActiveTextureUnit(0);
    glActiveTexture(GL_TEXTURE0);
  }

  /// Makes, binds and clears a framebuffer: ids to 0, colours to black (the sky draws over all of it), depth to far.
  bool begin(Framebuffer& target, glm::ivec2 size, GLenum format, int samples) {
    context.makeCurrent();
    const std::string problem = target.ensure(size, format, samples, true);
    report(problem);
    if (!problem.empty()) return false;
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    // Where OpenSceneGraph goes back to after it has drawn into textures.
    window->setDefaultFboId(target.name());
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    if (format == GL_R32UI) {
      const GLuint nothing[4] = {0, 0, 0, 0};
      glClearBufferuiv(GL_COLOR, 0, nothing);
    } else {
      const GLfloat black[4] = {0, 0, 0, 1};
      glClearBufferfv(GL_COLOR, 0, black);
    }
    const GLfloat farAway = 0;
    glClearBufferfv(GL_DEPTH, 0, &farAway);
    glDisable(GL_DITHER);
    glDisable(GL_BLEND);
    if (samples > 1)
      glEnable(GL_MULTISAMPLE);
    else
      glDisable(GL_MULTISAMPLE);
    forgetState();
    return true;
  }

  /// Copies the multisampled picture's average.
  void resolve(const Framebuffer& from) {
    report(resolved.ensure(from.size(), GL_RGBA8, 0, false));
    if (resolved.name() == 0) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved.name());
    glBlitFramebuffer(0, 0, from.size().x, from.size().y, 0, 0, from.size().x, from.size().y, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  }

  /// Where the finished picture lies.
  const Framebuffer& picture() const { return drawn.samples() > 0 ? resolved : drawn; }
};

Renderer::Renderer(GlContext& context, scenegraph::Scene& scene, int multisamples)
    : impl_(std::make_unique<Impl>(context, scene, multisamples)) {
  Impl& s = *impl_;
  context.makeCurrent();
  s.viewer->setThreadingModel(osgViewer::Viewer::SingleThreaded);
  s.viewer->setUseConfigureAffinity(false);
  s.viewer->setReleaseContextAtEndOfFrameHint(false);
  s.viewer->setKeyEventSetsDone(0);
  s.window = s.viewer->setUpViewerAsEmbeddedInWindow(0, 0, 16, 16);
  s.window->getState()->setUseModelViewAndProjectionUniforms(true);
  s.window->getState()->setUseVertexAttributeAliasing(true);
  s.viewer->setLightingMode(osg::View::NO_LIGHT);

  osg::Camera* camera = s.viewer->getCamera();
  camera->setClearMask(0);  // `begin` clears
  // Without it OpenSceneGraph switches off what `begin` switched on; targets of one sample do not care.
  camera->getOrCreateStateSet()->setMode(GL_MULTISAMPLE, osg::StateAttribute::ON);
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setCullingMode(osg::CullSettings::NO_CULLING);
  camera->setAllowEventFocus(false);
  camera->setProjectionResizePolicy(osg::Camera::FIXED);
  camera->setInitialDrawCallback(s.drawBegins);
  s.viewer->setSceneData(scene.root());
  s.viewer->realize();
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  if (bits > 0) glGenQueries(static_cast<GLsizei>(s.timers.size()), s.timers.data());
  s.checkGl("setting up");
}

Renderer::~Renderer() {
  Impl& s = *impl_;
  s.context.makeCurrent();
  s.scene.root()->releaseGLObjects(s.window->getState());
  if (s.timers[0] != 0) glDeleteQueries(static_cast<GLsizei>(s.timers.size()), s.timers.data());
  for (Framebuffer* target : {&s.drawn, &s.resolved, &s.items, &s.supersampled}) target->release();
  s.viewer->setSceneData(nullptr);
}

void Renderer::setMultisamples(int multisamples) {
  impl_->multisamples = multisamples;
}

DrawTimes Renderer::draw(const city::FramePlan& plan, const std::function<void()>& inScene) {
  Impl& s = *impl_;
  DrawTimes times;
  s.scene.apply(plan, scenegraph::Variant::Colour);
  for (const city::StageTime& t : s.scene.applyTimes()) times.stages.add(t.name, t.milliseconds);

  const glm::ivec2 size = plan.view.viewport;
  if (!s.begin(s.drawn, size, GL_RGBA8, s.multisamples)) return times;
  if (s.timers[0] != 0) glQueryCounter(s.timers[0], GL_TIMESTAMP);
  s.traverse(size, plan.view.time, scenegraph::Variant::Colour, &times.stages);

  StageClock finish;
  if (inScene) {
    glBindFramebuffer(GL_FRAMEBUFFER, s.drawn.name());
    inScene();
  }
  if (s.drawn.samples() > 0) s.resolve(s.drawn);
  if (s.timers[1] != 0) glQueryCounter(s.timers[1], GL_TIMESTAMP);
  glFinish();
  s.pictureSize = size;
  s.checkGl("drawing a picture");
  times.stages.add("finish", finish.lap());
  if (s.timers[1] != 0) {
    std::array<GLuint64, 2> at{};  // nanoseconds
    for (size_t k = 0; k < 2; ++k) glGetQueryObjectui64v(s.timers[k], GL_QUERY_RESULT, &at[k]);
    times.gpuMilliseconds = static_cast<double>(at[1] - at[0]) * 1e-6;
  }
  return times;
}

void Renderer::drawOver(const std::function<void(glm::ivec2)>& paint) {
  Impl& s = *impl_;
  if (s.pictureSize.x == 0 || s.picture().name() == 0) return;
  s.context.makeCurrent();
  glBindFramebuffer(GL_FRAMEBUFFER, s.picture().name());
  glViewport(0, 0, s.pictureSize.x, s.pictureSize.y);
  paint(s.pictureSize);
  s.checkGl("drawing over a picture");
}

uint64_t Renderer::gpuBytes() const {
  const Impl& s = *impl_;
  return s.drawn.bytes() + s.resolved.bytes() + s.items.bytes() + s.supersampled.bytes();
}

Picture Renderer::readPicture() {
  Impl& s = *impl_;
  Picture picture;
  if (s.pictureSize.x == 0 || s.picture().name() == 0) return picture;
  s.context.makeCurrent();
  picture.width = s.pictureSize.x, picture.height = s.pictureSize.y;
  const size_t row = 3 * static_cast<size_t>(picture.width);
  picture.rgb.resize(row * static_cast<size_t>(picture.height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.picture().name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, picture.width, picture.height, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  flipRows(picture.rgb, row);
  s.checkGl("reading a picture");
  return picture;
}

void Renderer::present(glm::ivec2 windowSize) {
  Impl& s = *impl_;
  if (s.pictureSize.x == 0 || s.picture().name() == 0) return;
  s.context.makeCurrent();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.picture().name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, s.pictureSize.x, s.pictureSize.y, 0, 0, windowSize.x, windowSize.y, GL_COLOR_BUFFER_BIT,
                    windowSize == s.pictureSize ? GL_NEAREST : GL_LINEAR);
  s.checkGl("showing a picture");
}

ItemBuffer Renderer::drawItems(const city::FramePlan& plan) {
  Impl& s = *impl_;
  ItemBuffer buffer;
  s.scene.apply(plan, scenegraph::Variant::ItemId);
  const glm::ivec2 size = plan.view.viewport;
  if (!s.begin(s.items, size, GL_R32UI, 0)) return buffer;
  s.traverse(size, plan.view.time, scenegraph::Variant::ItemId);

  buffer.width = size.x, buffer.height = size.y;
  buffer.ids.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.items.name());
  glReadPixels(0, 0, size.x, size.y, GL_RED_INTEGER, GL_UNSIGNED_INT, buffer.ids.data());
  flipRows(buffer.ids, static_cast<size_t>(size.x));
  s.checkGl("drawing an item buffer");
  return buffer;
}

Picture Renderer::drawReference(const city::FramePlan& plan) {
  Impl& s = *impl_;
  constexpr int kSuper = 4, kLargestPiece = 1024;  // pieces of at most 4096 x 4096 samples
  const glm::ivec2 size = plan.view.viewport;
  Picture picture;
  picture.width = size.x, picture.height = size.y;
  picture.rgb.resize(3 * static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
  std::vector<uint8_t> samples;
  for (int y = 0; y < size.y; y += kLargestPiece)
    for (int x = 0; x < size.x; x += kLargestPiece) {
      // The piece's centre goes to the viewport's, its half to the whole.
      const glm::ivec2 piece = glm::min(glm::ivec2(kLargestPiece), size - glm::ivec2(x, y));
      scenegraph::PictureWindow window;
      window.scale = glm::dvec2(size) / glm::dvec2(piece);
      window.offset = window.scale - 1.0 - 2.0 * glm::dvec2(x, y) / glm::dvec2(piece);
      s.scene.apply(plan, scenegraph::Variant::Colour, window);
      if (!s.begin(s.supersampled, kSuper * piece, GL_RGBA8, 0)) return {};
      s.traverse(kSuper * piece, plan.view.time, scenegraph::Variant::Colour);
      const auto row = static_cast<size_t>(4 * kSuper * piece.x);
      samples.resize(row * static_cast<size_t>(kSuper * piece.y));
      glBindFramebuffer(GL_READ_FRAMEBUFFER, s.supersampled.name());
      glReadPixels(0, 0, kSuper * piece.x, kSuper * piece.y, GL_RGBA, GL_UNSIGNED_BYTE, samples.data());
      for (int py = 0; py < piece.y; ++py)
        for (int px = 0; px < piece.x; ++px) {
          unsigned sum[3] = {0, 0, 0};
          for (int sy = 0; sy < kSuper; ++sy) {
            const uint8_t* from =
                samples.data() + static_cast<size_t>(kSuper * py + sy) * row + static_cast<size_t>(4 * kSuper * px);
            for (int sx = 0; sx < kSuper; ++sx, from += 4)
              for (int k = 0; k < 3; ++k) sum[k] += from[k];
          }
          uint8_t* to =
              picture.rgb.data() + 3 * (static_cast<size_t>(size.y - 1 - (y + py)) * static_cast<size_t>(size.x) +
                                        static_cast<size_t>(x + px));
          for (int k = 0; k < 3; ++k) to[k] = static_cast<uint8_t>((sum[k] + kSuper * kSuper / 2) / (kSuper * kSuper));
        }
    }
  s.supersampled.release();
  s.checkGl("drawing a reference");
  return picture;
}

const std::vector<std::string>& Renderer::problems() const {
  return impl_->problems;
}

}  // namespace vicus::viewer
