/// A picture of ours in the window, beside what the renderer shows.
#pragma once

#include "scenegraph/gl.hpp"

#include <glm/glm.hpp>

#include "viewer/renderer.hpp"

namespace vicus::viewer {

/// Keeps a picture on the card and copies it into the window's framebuffer. Touches no state that OpenSceneGraph keeps
/// between frames. Made with no context needed; `set`, `paint` and the end need it current.
class ShownPicture {
 public:
  ShownPicture() = default;
  ~ShownPicture();
  ShownPicture(const ShownPicture&) = delete;
  ShownPicture& operator=(const ShownPicture&) = delete;

  /// A picture without pixels takes it away.
  void set(const Picture& picture);
  bool empty() const { return size_.x == 0; }
  glm::ivec2 size() const { return size_; }
  /// Its upper left corner goes to `corner`, pixels from the window's upper left one; what lies outside is cut.
  void paint(glm::ivec2 windowSize, glm::ivec2 corner) const;

 private:
  GLuint framebuffer_ = 0, colour_ = 0;
  glm::ivec2 size_{0};
};

}  // namespace vicus::viewer
