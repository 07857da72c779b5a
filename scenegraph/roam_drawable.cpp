/// Based on: Willmott et al. 2001, §4.1.4 (triangles kept in one array from frame to frame, changed in place).
#include "scenegraph/roam_drawable.hpp"

#include <algorithm>
#include <cassert>

namespace vicus::scenegraph {
namespace {

using As = VertexAttribute::As;

/// At the locations of shaders/terrain.vert.
constexpr VertexAttribute kAttributes[] = {
    {0, 2, GL_UNSIGNED_SHORT, As::Integer, offsetof(RoamVertex, column)},
    {1, 1, GL_FLOAT, As::Float, offsetof(RoamVertex, height)},
};

/// Slots farther apart than this are sent by themselves: a call costs as much as about 500 bytes.
constexpr uint32_t kGap = 48;
/// Views whose meshes stay on the card: the eye's and a reference's, and some that a report compares.
constexpr size_t kMostHeld = 16;

RoamVertex gpuVertex(const city::RoamMesh::Vertex& v) {
  return {static_cast<uint16_t>(v.sample.x), static_cast<uint16_t>(v.sample.y), v.height};
}

}  // namespace

std::vector<SlotRun> joinSlots(std::vector<uint32_t> slots) {
  std::sort(slots.begin(), slots.end());
  std::vector<SlotRun> runs;
  for (const uint32_t slot : slots) {
    if (runs.empty() || slot > runs.back().first + runs.back().count + kGap)
      runs.push_back({slot, 1});
    else
      runs.back().count = slot - runs.back().first + 1;
  }
  return runs;
}

RoamDrawable::RoamDrawable(glm::ivec2 samples) : samples_(samples) {
  assert(samples.x <= 1 << 16 && samples.y <= 1 << 16);
  setUseDisplayList(false);
  setCullingActive(false);
}

void RoamDrawable::show(const city::RoamFrame& frame) {
  auto at = std::find_if(held_.begin(), held_.end(), [&](const auto& h) { return h->mesh == frame.mesh; });
  if (at == held_.end()) {
    held_.push_back(std::make_unique<Held>());
    held_.back()->mesh = frame.mesh;
    at = std::prev(held_.end());
  }
  std::rotate(at, at + 1, held_.end());
  Held& held = *held_.back();
  const uint64_t now = frame.mesh->revision;
  if (held.revision == now) return;
  // What this frame changed suffices where nothing was missed and nothing came after.
  if (held.revision + 1 == frame.revision && frame.revision == now) {
    held.vertices.insert(held.vertices.end(), frame.changedVertices.begin(), frame.changedVertices.end());
    held.triangles.insert(held.triangles.end(), frame.changedTriangles.begin(), frame.changedTriangles.end());
  } else {
    held.whole = true;
  }
  held.revision = now;
}

uint64_t RoamDrawable::bytes() const {
  uint64_t sum = 0;
  for (const auto& held : held_) sum += held->vertexBuffer.capacity() + held->indexBuffer.capacity();
  return sum;
}

void RoamDrawable::makeRoom(Held& held) {
  // Room to grow by half, so that buffers are seldom made anew.
  const size_t vertices = held.mesh->vertices.size(), triangles = held.mesh->triangles.size();
  const auto withRoom = [](size_t bytes) { return bytes + bytes / 2; };
  held.vertexBuffer.reserve(withRoom(vertices * sizeof(RoamVertex)), GL_DYNAMIC_DRAW);
  held.indexBuffer.reserve(withRoom(triangles * sizeof(held.mesh->triangles[0])), GL_DYNAMIC_DRAW);
}

void RoamDrawable::upload(Held& held) const {
  const city::RoamMesh& mesh = *held.mesh;
  constexpr size_t kTriangleBytes = sizeof(mesh.triangles[0]);
  const size_t vertexBytes = mesh.vertices.size() * sizeof(RoamVertex),
               indexBytes = mesh.triangles.size() * kTriangleBytes;
  uploaded_ = 0;
  const bool outgrown = !held.vertexBuffer.exists() || vertexBytes > held.vertexBuffer.capacity() ||
                        indexBytes > held.indexBuffer.capacity();
  const bool whole = held.whole || outgrown;
  if (outgrown) makeRoom(held);
  std::erase_if(held.triangles, [&](uint32_t slot) { return slot >= mesh.triangles.size(); });
  const auto runsOf = [&](std::vector<uint32_t>& slots, size_t all) {
    if (whole && all > 0) return std::vector<SlotRun>{{0, static_cast<uint32_t>(all)}};
    return joinSlots(std::move(slots));
  };
  for (const SlotRun& run : runsOf(held.vertices, mesh.vertices.size())) {
    staged_.clear();
    for (uint32_t slot = run.first; slot < run.first + run.count; ++slot)
      staged_.push_back(gpuVertex(mesh.vertices[slot]));
    held.vertexBuffer.write(run.first * sizeof(RoamVertex), staged_.data(), staged_.size() * sizeof(RoamVertex));
    uploaded_ += staged_.size() * sizeof(RoamVertex);
  }
  for (const SlotRun& run : runsOf(held.triangles, mesh.triangles.size())) {
    held.indexBuffer.write(run.first * kTriangleBytes, mesh.triangles.data() + run.first, run.count * kTriangleBytes);
    uploaded_ += run.count * kTriangleBytes;
  }
  held.vertices.clear();
  held.triangles.clear();
  held.whole = false;
}

void RoamDrawable::drawImplementation(osg::RenderInfo& info) const {
  if (held_.empty()) return;
  info.getState()->unbindVertexBufferObject();
  // Meshes of views that are gone, or were not shown for long.
  while (held_.size() > 1 && (held_.front()->mesh.use_count() == 1 || held_.size() > kMostHeld)) {
    Held& gone = *held_.front();
    gone.vertexBuffer.release();
    gone.indexBuffer.release();
    if (gone.vertexArray != 0) glDeleteVertexArrays(1, &gone.vertexArray);
    held_.erase(held_.begin());
  }
  Held& held = *held_.back();
  if (held.mesh->triangles.empty()) return;
  upload(held);
  if (held.vertexArray == 0) held.vertexArray = makeVertexArray(held.indexBuffer, kAttributes, {});
  glBindVertexArray(held.vertexArray);
  glBindVertexBuffer(kVertexSource, held.vertexBuffer.name(), 0, sizeof(RoamVertex));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * held.mesh->triangles.size()), GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

void RoamDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (!state) return;
  for (const auto& held : held_) {
    held->vertexBuffer.release();
    held->indexBuffer.release();
    if (held->vertexArray != 0) glDeleteVertexArrays(1, &held->vertexArray);
    held->vertexArray = 0;
    held->whole = true;
  }
}

}  // namespace vicus::scenegraph
