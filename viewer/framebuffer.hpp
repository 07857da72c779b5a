/// Framebuffers of our own: a picture's colours or item ids with 32-bit float depth.
#pragma once

#include "scenegraph/gl.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>

namespace vicus::viewer {

/// A framebuffer with one colour attachment and, where asked for, depth. Invariant: complete whenever `name` is not 0;
/// owns its GL names until `release`, which needs the context current.
class Framebuffer {
 public:
  Framebuffer() = default;
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  /// Makes it (again) where size, samples or format differ from what it has. `samples` is lowered to what the card
  /// takes. An empty result is success, else it says what is wrong and `name` is 0.
  std::string ensure(glm::ivec2 size, GLenum colourFormat, int samples, bool depth);
  void release();

  GLuint name() const { return name_; }
  glm::ivec2 size() const { return size_; }
  int samples() const { return samples_; }
  /// Of its attachments, each four bytes for each sample; 0 where it is not made.
  uint64_t bytes() const {
    return static_cast<uint64_t>(size_.x) * static_cast<uint64_t>(size_.y) *
           static_cast<uint64_t>(std::max(samples_, 1)) * (depth_ != 0 ? 8U : 4U);
  }

 private:
  GLuint name_ = 0, colour_ = 0, depth_ = 0;
  glm::ivec2 size_{0};
  GLenum format_ = 0;
  int wantedSamples_ = 0, samples_ = 0;
};

}  // namespace vicus::viewer
