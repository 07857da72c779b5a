/// A plain window.
#pragma once

#include <memory>
#include <string>

#include "viewer/navigator.hpp"
#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Whether there is a display to open a window on: empty, or in plain words why not. For asking before a long load.
std::string displayProblem();

/// A window with a GL context (compatibility profile, 4.5 down to 4.3), its keys and its mouse: W A S D or the arrows,
/// Q and E down and up in flight, shift fast, F walk or fly, F2 the
/// overlay, F3 the frozen plan, Esc ends. Invariant: while it lives the mouse is its own, unless freed.
class Window : public GlContext {
 public:
  struct Options {
    std::string title;
    glm::ivec2 size{1280, 720};
    bool vsync = true;
  };
  /// Null with the reason in `error`, in plain words, where there is no display or no such context.
  static std::unique_ptr<Window> open(const Options& options, std::string& error);
  ~Window() override;

  void makeCurrent() override;
  void swap() override;
  std::string rendererName() const override;

  /// What happened since the last call.
  Input poll();
  /// Shows the pointer and lets it go anywhere, or takes it back.
  void freeMouse(bool free);
  /// Pixels of the framebuffer; 1 × 1 at least, also while the window is minimised.
  glm::ivec2 size() const;
  void setTitle(const std::string& title);

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
