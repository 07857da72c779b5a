#include "viewer/shown_picture.hpp"

namespace vicus::viewer {

ShownPicture::~ShownPicture() {
  if (framebuffer_ == 0) return;
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &colour_);
}

void ShownPicture::set(const Picture& picture) {
  size_ = {picture.width, picture.height};
  if (picture.rgb.size() != 3 * static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y)) size_ = glm::ivec2(0);
  if (size_.x == 0 || size_.y == 0) {
    size_ = glm::ivec2(0);
    return;
  }
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
  if (framebuffer_ == 0) {
    glGenTextures(1, &colour_);
    glGenFramebuffers(1, &framebuffer_);
  }
  glBindTexture(GL_TEXTURE_2D, colour_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, size_.x, size_.y, 0, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
}

void ShownPicture::paint(glm::ivec2 windowSize, glm::ivec2 corner) const {
  if (empty()) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  // Row 0 of the picture is its top, that of the framebuffer the bottom.
  glBlitFramebuffer(0, 0, size_.x, size_.y, corner.x, windowSize.y - corner.y, corner.x + size_.x,
                    windowSize.y - corner.y - size_.y, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace vicus::viewer
