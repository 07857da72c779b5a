/// Where each tile's base lies from the eye.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <glm/glm.hpp>
#include <vector>

#include "city/city.hpp"

namespace vicus::scenegraph {

/// Tiles that shaders/tiles.glsl has room for: the largest grid's.
constexpr size_t kMostTiles = 32 * 32;

/// A tile's base is the point that what stands on it is stored relative to: its centre, half way up its bounds. One for
/// each tile of the grid, metres from the city's origin.
std::vector<glm::dvec3> tileBases(const city::City& city);

/// The bases with their offsets from the eye, subtracted in double and then rounded to float: a city far from its
/// origin draws as one at it. Invariant: the buffer holds the offsets of the last `moveTo` when bound.
class TileTable {
 public:
  explicit TileTable(std::vector<glm::dvec3> bases);

  const glm::dvec3& base(uint32_t tile) const { return bases_[tile]; }
  void moveTo(const glm::dvec3& eye);
  const std::vector<glm::vec4>& fromEye() const { return fromEye_; }

  /// With the context current.
  void bind(GLuint index);
  void release() { buffer_.release(); }

 private:
  std::vector<glm::dvec3> bases_;
  std::vector<glm::vec4> fromEye_;
  GlBuffer buffer_;
  bool changed_ = true;
};

}  // namespace vicus::scenegraph
