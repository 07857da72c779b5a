/// The overlay (F2): what the last frames cost, what was drawn, how wrong it may be, and every knob. For staff and
/// classes; visitors never see it.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "city/frame_plan.hpp"
#include "city/knob.hpp"
#include "plan/planner.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::viewer {

/// The pointer over the picture.
struct OverlayInput {
  glm::dvec2 pointer{-1, -1};  ///< pixels from the picture's upper left corner
  bool pressed = false;        ///< the left button is down
  double wheel = 0;            ///< notches, up positive
};

/// What the overlay tells.
struct OverlayFacts {
  std::string_view scene, renderer;
  const city::Knobs& knobs;
  std::span<const plan::FeatureReport> features;
  const city::FramePlan& plan;
  const FrameRecord& record;
  uint64_t gpuBytes = 0;
  bool frozen = false;  ///< the plan is frozen; the picture shows it from elsewhere
};

/// A knob that the user has turned.
struct KnobChange {
  std::string name;
  double value = 0;
};

/// Draws with Dear ImGui. Made with the renderer's context current, and let go with it current. Invariant: remembers
/// the times of the last frames that it was told of, and nothing else.
class Overlay {
 public:
  Overlay();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// A frame that was drawn, shown or not.
  void note(const FrameRecord& record);
  /// Draws into the bound framebuffer of `size` pixels: for `Renderer::drawOver`. `dt` in seconds since the last call.
  /// The knob that the user has let go of since then, where there is one; switches change at once.
  std::optional<KnobChange> draw(glm::ivec2 size, double dt, const OverlayInput& input, const OverlayFacts& facts);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
