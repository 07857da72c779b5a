#include "scenegraph/arena_drawable.hpp"

#include <algorithm>
#include <cassert>
#include <osg/RenderInfo>
#include <osg/State>

namespace vicus::scenegraph {
namespace {

using As = VertexAttribute::As;

/// At the locations of shaders/vertex.glsl and instance.vert.
constexpr VertexAttribute kVertexAttributes[] = {
    {0, 3, GL_FLOAT, As::Float, offsetof(city::Vertex, position)},
    {1, 2, GL_FLOAT, As::Float, offsetof(city::Vertex, uv)},
    {2, 2, GL_SHORT, As::Normalised, offsetof(city::Vertex, normal)},
    {3, 2, GL_UNSIGNED_SHORT, As::Integer, offsetof(city::Vertex, material)},
    {8, 2, GL_BYTE, As::Normalised, offsetof(city::Vertex, slide)},
    {9, 1, GL_HALF_FLOAT, As::Float, offsetof(city::Vertex, slide) + 2},
};
constexpr VertexAttribute kInstanceAttributes[] = {
    {4, 3, GL_FLOAT, As::Float, offsetof(GpuInstance, position)},
    {5, 1, GL_UNSIGNED_INT, As::Integer, offsetof(GpuInstance, tile)},
    {6, 2, GL_FLOAT, As::Float, offsetof(GpuInstance, turn)},
    {7, 2, GL_UNSIGNED_INT, As::Integer, offsetof(GpuInstance, seed)},
};

}  // namespace

uint32_t fadingTile(uint32_t tile, FadeSide side, float share) {
  assert(tile < 0x8000u);
  const auto steps = static_cast<uint32_t>(std::clamp(share, 0.0f, 1.0f) * 65535.0f + 0.5f);
  return tile | (side == FadeSide::Flat ? 0x8000u : 0u) | steps << 16;
}

ArenaBuffers::ArenaBuffers(Arena arena) : arena_(std::move(arena)) {
  for (const ArenaChunk& chunk : arena_.chunks) {
    chunks_.push_back(std::make_unique<Chunk>());
    bytes_ += chunk.vertices.size() * sizeof(city::Vertex) + chunk.indices.size() * sizeof(uint32_t);
  }
}

void ArenaBuffers::bind(uint32_t index, GLuint instances) {
  Chunk& chunk = *chunks_[index];
  if (chunk.vertexArray == 0) {
    ArenaChunk& data = arena_.chunks[index];
    chunk.vertices.fill(std::span<const city::Vertex>(data.vertices), GL_STATIC_DRAW);
    chunk.indices.fill(std::span<const uint32_t>(data.indices), GL_STATIC_DRAW);
    chunk.vertexArray = makeVertexArray(chunk.indices, kVertexAttributes, kInstanceAttributes);
    data = {};
  }
  glBindVertexArray(chunk.vertexArray);
  glBindVertexBuffer(kVertexSource, chunk.vertices.name(), 0, sizeof(city::Vertex));
  glBindVertexBuffer(kInstanceSource, instances, 0, sizeof(GpuInstance));
}

void ArenaBuffers::release() {
  for (const auto& chunk : chunks_) {
    if (chunk->vertexArray != 0) glDeleteVertexArrays(1, &chunk->vertexArray);
    chunk->vertices.release();
    chunk->indices.release();
  }
}

InstanceGroup::InstanceGroup(std::vector<GpuInstance> instances, std::vector<uint32_t> geometryOf)
    : geometries(std::move(geometryOf)), instances_(std::move(instances)) {}

void InstanceGroup::replace(std::vector<GpuInstance> instances, std::vector<uint32_t> geometriesOf) {
  assert(instances.size() == geometriesOf.size());
  instances_ = std::move(instances);
  geometries = std::move(geometriesOf);
  drawn.clear();
}

GLuint InstanceGroup::buffer() {
  if (!buffer_.exists() || !instances_.empty()) {
    buffer_.fill(std::span<const GpuInstance>(instances_), GL_STATIC_DRAW);
    instances_ = {};
  }
  return buffer_.name();
}

ArenaDrawable::ArenaDrawable(std::shared_ptr<ArenaBuffers> buffers, std::shared_ptr<InstanceGroup> group,
                             std::shared_ptr<TileTable> tiles, std::shared_ptr<const MaterialTextures> textures,
                             ArenaPart part, Ordering ordering)
    : buffers_(std::move(buffers)),
      group_(std::move(group)),
      tiles_(std::move(tiles)),
      textures_(std::move(textures)),
      part_(part),
      ordering_(ordering),
      commands_(buffers_->arena().chunks.size()) {
  setUseDisplayList(false);
  setUseVertexBufferObjects(false);
  setCullingActive(false);
}

DrawCounts ArenaDrawable::apply() {
  DrawCounts counts;
  const Arena& arena = buffers_->arena();
  for (auto& list : commands_) list.clear();
  for (const auto& [i, level] : group_->drawn) {
    const ArenaGeometry& g = arena.geometries[group_->geometries[i]];
    for (uint32_t r = g.runs.first; r < g.runs.end(); ++r) {
      const city::Range indices = indicesAt(arena, arena.runs[r], part_, level);
      if (indices.count == 0) continue;
      counts.triangles += indices.count / 3;
      if (ordering_ == Ordering::ByState)
        commands_[g.chunk].push_back({indices.count, 1, indices.first, g.baseVertex, i});
      else
        ++counts.drawCalls;
    }
  }
  if (ordering_ == Ordering::Scene) {
    counts.textureBinds = counts.drawCalls;
    return counts;
  }
  for (const auto& list : commands_) {
    counts.indirectCommands += list.size();
    counts.drawCalls += !list.empty();
  }
  return counts;
}

void ArenaDrawable::drawImplementation(osg::RenderInfo& info) const {
  osg::State& state = *info.getState();
  if (group_->drawn.empty()) return;
  state.unbindVertexBufferObject();
  tiles_->bind(kTileBinding);
  if (ordering_ == Ordering::ByState)
    drawOrdered(group_->buffer());
  else
    drawInSceneOrder(state, group_->buffer());
  glBindVertexArray(0);
}

void ArenaDrawable::drawOrdered(GLuint instances) const {
  size_t total = 0;
  for (const auto& list : commands_) total += list.size();
  if (total == 0) return;
  // The chunks' lists go into one buffer one after another; most scenes have one chunk.
  if (commands_.size() == 1) {
    commandBuffer_.fill(std::span<const DrawCommand>(commands_[0]), GL_STREAM_DRAW);
  } else {
    std::vector<DrawCommand> all;
    all.reserve(total);
    for (const auto& list : commands_) all.insert(all.end(), list.begin(), list.end());
    commandBuffer_.fill(std::span<const DrawCommand>(all), GL_STREAM_DRAW);
  }
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commandBuffer_.name());
  size_t first = 0;
  for (uint32_t chunk = 0; chunk < commands_.size(); ++chunk) {
    const size_t count = commands_[chunk].size();
    if (count == 0) continue;
    buffers_->bind(chunk, instances);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(first * sizeof(DrawCommand)), static_cast<GLsizei>(count),
                                0);
    first += count;
  }
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
}

void ArenaDrawable::drawInSceneOrder(osg::State& state, GLuint instances) const {
  const Arena& arena = buffers_->arena();
  uint32_t bound = UINT32_MAX;
  for (const auto& [i, level] : group_->drawn) {
    const ArenaGeometry& g = arena.geometries[group_->geometries[i]];
    for (uint32_t r = g.runs.first; r < g.runs.end(); ++r) {
      const ArenaRun& run = arena.runs[r];
      const city::Range indices = indicesAt(arena, run, part_, level);
      if (indices.count == 0) continue;
      if (g.chunk != bound) buffers_->bind(bound = g.chunk, instances);
      // The same texture as the state sets put on this unit, so OpenSceneGraph's record stays right.
      const uint32_t textureClass = run.material < textures_->classOf.size() ? textures_->classOf[run.material] : 0;
      state.setActiveTextureUnit(textureClass);
      if (auto* texture = textures_->arrays[textureClass]->getTextureObject(state.getContextID())) texture->bind();
      glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(indices.count), GL_UNSIGNED_INT,
                                                    reinterpret_cast<const void*>(indices.first * sizeof(uint32_t)), 1,
                                                    g.baseVertex, i);
    }
  }
}

void ArenaDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (!state) return;
  commandBuffer_.release();
  group_->release();
  buffers_->release();
  tiles_->release();
}

}  // namespace vicus::scenegraph
