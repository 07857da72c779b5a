/// Draws plans of one scene into pictures: the GL context, our framebuffers and OpenSceneGraph's traversals.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "city/frame_plan.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/measure.hpp"

namespace vicus::viewer {

/// A GL context that somebody made current: EGL offscreen or a GLFW window.
class GlContext {
 public:
  virtual ~GlContext() = default;
  virtual void makeCurrent() = 0;
  /// Shows what was drawn; nothing offscreen.
  virtual void swap() = 0;
  /// GL_RENDERER.
  virtual std::string rendererName() const = 0;
};

/// An offscreen context through EGL: surfaceless, else the first device; a compatibility profile 4.5 (4.3 at least).
/// Null with the reason in `error` where there is none.
std::unique_ptr<GlContext> makeOffscreenContext(std::string& error);

/// 8-bit sRGB, row 0 at the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;  ///< width · height · 3
};

/// 32-bit item ids, row 0 at the top; 0 where nothing was drawn.
struct ItemBuffer {
  int width = 0, height = 0;
  std::vector<uint32_t> ids;
};

/// What drawing one frame took.
struct DrawTimes {
  /// apply FEATURE… (writing the plan into the scene graph), update, cull and draw (OpenSceneGraph's traversals),
  /// finish (resolve and glFinish).
  StageSamples stages;
  /// On the graphics card, from the first command to the last; nothing where the driver has no timer queries.
  std::optional<double> gpuMilliseconds;
};

/// Owns the framebuffers and the embedded osgViewer. One scene, any number of views drawn one after another.
class Renderer {
 public:
  /// `multisamples` 1, 2, 4 or 8 for colour.
  Renderer(GlContext& context, scenegraph::Scene& scene, int multisamples);
  ~Renderer();
  /// From the next picture on.
  void setMultisamples(int multisamples);

  /// Draws the plan's view at its viewport into the colour target and waits for the card (`glFinish`). `inScene`, where
  /// given, draws more with raw GL into the bound target, with the scene's depth (greater is nearer), before the
  /// samples are averaged.
  DrawTimes draw(const city::FramePlan& plan, const std::function<void()>& inScene = {});
  /// Lets `paint` draw with raw GL over the picture that `draw` made last: its framebuffer is bound, its viewport set.
  void drawOver(const std::function<void(glm::ivec2 size)>& paint);
  /// The picture that `draw` made last, with what was drawn over it.
  Picture readPicture();
  /// Copies it to the window's framebuffer.
  void present(glm::ivec2 windowSize);

  /// Item ids of the plan's view, one sample a pixel.
  ItemBuffer drawItems(const city::FramePlan& plan);
  /// The plan's view supersampled 4×4 and averaged; `plan` should be that of every technique off.
  Picture drawReference(const city::FramePlan& plan);

  /// Bytes of the framebuffers.
  uint64_t gpuBytes() const;
  /// Framebuffer errors and GL errors seen so far, in plain words; empty is good.
  const std::vector<std::string>& problems() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
