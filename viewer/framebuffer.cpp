#include "viewer/framebuffer.hpp"

#include <algorithm>

namespace vicus::viewer {
namespace {

const char* inWords(GLenum status) {
  switch (status) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
      return "an attachment cannot be drawn to";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
      return "nothing is attached";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
      return "attachments differ in samples";
    case GL_FRAMEBUFFER_UNSUPPORTED:
      return "the card does not support these formats together";
    default:
      return "unknown reason";
  }
}

}  // namespace

std::string Framebuffer::ensure(glm::ivec2 size, GLenum colourFormat, int samples, bool depth) {
  if (name_ != 0 && size == size_ && colourFormat == format_ && samples == wantedSamples_ && depth == (depth_ != 0))
    return {};
  release();
  const std::string what = std::to_string(size.x) + " x " + std::to_string(size.y);
  GLint largest = 0, mostSamples = 1;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  glGetIntegerv(colourFormat == GL_R32UI ? GL_MAX_INTEGER_SAMPLES : GL_MAX_SAMPLES, &mostSamples);
  if (std::max(size.x, size.y) > largest)
    return "framebuffer of " + what + " pixels is larger than the card's " + std::to_string(largest);
  size_ = size, format_ = colourFormat, wantedSamples_ = samples;
  samples_ = samples > 1 ? std::min(samples, static_cast<int>(mostSamples)) : 0;

  const auto renderbuffer = [&](GLenum format, GLenum attachment) {
    GLuint name = 0;
    glGenRenderbuffers(1, &name);
    glBindRenderbuffer(GL_RENDERBUFFER, name);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, format, size.x, size.y);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    return name;
  };
  glGenFramebuffers(1, &name_);
  glBindFramebuffer(GL_FRAMEBUFFER, name_);
  colour_ = renderbuffer(colourFormat, GL_COLOR_ATTACHMENT0);
  if (depth) depth_ = renderbuffer(GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (status == GL_FRAMEBUFFER_COMPLETE) return {};
  release();
  return "framebuffer of " + what + " pixels with " + std::to_string(samples) +
         " samples is incomplete: " + inWords(status);
}

void Framebuffer::release() {
  if (name_ != 0) glDeleteFramebuffers(1, &name_);
  if (colour_ != 0) glDeleteRenderbuffers(1, &colour_);
  if (depth_ != 0) glDeleteRenderbuffers(1, &depth_);
  name_ = colour_ = depth_ = 0;
  size_ = glm::ivec2(0);
}

}  // namespace vicus::viewer
