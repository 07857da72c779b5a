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
/// Q and E down and up in flight, shift fast, F fly, O orbit, M map, T tour, B take me back, 1 to 9 views, R record, F1
/// help, F2 overlay, F3 frozen plan, P people on or off, F11 full screen, F12 picture, Esc ends. The first gamepad that
/// GLFW knows counts like keys. Invariant: while it lives the mouse is its own, unless freed.
class Window : public GlContext {
 public:
  struct Options {
    std::string title;
    glm::ivec2 size{1280, 720};
    bool vsync = true;
    bool touch = false;  ///< the pointer stays free: a finger drags the picture, two fingers move, a tap goes there
    int monitor = 0;     ///< that full screen fills, from 1; 0: the one that the window is on
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
  /// Fills a monitor, or goes back to the window as it was. Empty, or in plain words why not.
  std::string toggleFullScreen();
  /// How many pixels the system takes for one of an ordinary screen: 2 on many laptops.
  double contentScale() const;
  /// Pixels of the framebuffer; 1 × 1 at least, also while the window is minimised.
  glm::ivec2 size() const;
  void setTitle(const std::string& title);

 private:
  struct Impl;
  explicit Window(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace vicus::viewer
