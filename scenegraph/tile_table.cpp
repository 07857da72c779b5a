#include "scenegraph/tile_table.hpp"

#include <cassert>

namespace vicus::scenegraph {

std::vector<glm::dvec3> tileBases(const city::City& city) {
  std::vector<glm::dvec3> bases(city.grid.tileCount());
  for (uint32_t t = 0; t < bases.size(); ++t) {
    const bool empty = t >= city.tiles.size() || city.tiles[t].bounds.empty();
    const double z = empty ? 0.0 : static_cast<double>(city.tiles[t].bounds.centre().z);
    bases[t] = glm::dvec3(city.grid.centre(t), z);
  }
  return bases;
}

TileTable::TileTable(std::vector<glm::dvec3> bases) : bases_(std::move(bases)), fromEye_(kMostTiles) {
  assert(bases_.size() <= kMostTiles);
  moveTo(glm::dvec3(0));
}

void TileTable::moveTo(const glm::dvec3& eye) {
  for (size_t t = 0; t < bases_.size(); ++t) fromEye_[t] = glm::vec4(glm::vec3(bases_[t] - eye), 0);
  changed_ = true;
}

void TileTable::bind(GLuint index) {
  if (changed_) buffer_.fill(std::span<const glm::vec4>(fromEye_), GL_STREAM_DRAW);
  changed_ = false;
  glBindBufferBase(GL_UNIFORM_BUFFER, index, buffer_.name());
}

}  // namespace vicus::scenegraph
