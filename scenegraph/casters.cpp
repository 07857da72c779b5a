#include "scenegraph/casters.hpp"

#include <algorithm>
#include <cmath>
#include <osg/RenderInfo>
#include <osg/State>

#include "scenegraph/material_textures.hpp"

namespace vicus::scenegraph {
namespace {

using As = VertexAttribute::As;

/// At the locations of shaders/vertex.glsl and caster.vert.
constexpr VertexAttribute kVertexAttributes[] = {
    {0, 3, GL_FLOAT, As::Float, offsetof(city::Vertex, position)},
    {1, 2, GL_FLOAT, As::Float, offsetof(city::Vertex, uv)},
    {3, 2, GL_UNSIGNED_SHORT, As::Integer, offsetof(city::Vertex, material)},
};
constexpr VertexAttribute kInstanceAttributes[] = {
    {4, 3, GL_FLOAT, As::Float, offsetof(GpuInstance, position)},
    {5, 1, GL_UNSIGNED_INT, As::Integer, offsetof(GpuInstance, tile)},
    {6, 2, GL_FLOAT, As::Float, offsetof(GpuInstance, turn)},
};

/// Appends a geometry: of its triangles those in `runs`, with the vertices that they use.
void addGeometry(Casters& out, std::span<const city::Vertex> vertices, std::span<const uint32_t> indices,
                 std::span<const city::Range> runs, std::span<const uint8_t> cutOut) {
  Casters::Geometry geometry;
  geometry.baseVertex = static_cast<uint32_t>(out.vertices.size());
  std::vector<uint32_t> numbers(vertices.size(), UINT32_MAX);
  for (const ArenaPart part : {ArenaPart::Opaque, ArenaPart::CutOut}) {
    city::Range& range = geometry.parts[static_cast<size_t>(part)];
    range.first = static_cast<uint32_t>(out.indices.size());
    for (const city::Range& run : runs)
      for (uint32_t i = run.first; i + 2 < run.end(); i += 3) {
        const city::MaterialId material = vertices[indices[i]].material;
        const bool holes = material < cutOut.size() && cutOut[material] != 0;
        if (holes != (part == ArenaPart::CutOut)) continue;
        for (uint32_t k = i; k < i + 3; ++k) {
          uint32_t& number = numbers[indices[k]];
          if (number == UINT32_MAX) {
            number = static_cast<uint32_t>(out.vertices.size()) - geometry.baseVertex;
            out.vertices.push_back(vertices[indices[k]]);
          }
          out.indices.push_back(number);
        }
      }
    range.count = static_cast<uint32_t>(out.indices.size()) - range.first;
  }
  out.geometries.push_back(geometry);
}

void addInstance(Casters& out, const city::City& city, const TileTable& tiles, const glm::dvec3& position,
                 double heading, uint32_t geometry) {
  const uint32_t tile = city.grid.tileAt(position.x, position.y);
  out.instances.push_back({glm::vec3(position - tiles.base(tile)), tile,
                           glm::vec2(glm::dvec2(std::cos(heading), std::sin(heading))), 0, 0});
  out.geometryOf.push_back(geometry);
}

void addWhole(Casters& out, const city::TriangleMesh& mesh, std::span<const uint8_t> cutOut) {
  const city::Range all{0, static_cast<uint32_t>(mesh.indices.size())};
  addGeometry(out, mesh.vertices, mesh.indices, {&all, 1}, cutOut);
}

}  // namespace

bool Casters::has(ArenaPart part) const {
  return std::any_of(geometries.begin(), geometries.end(),
                     [&](const Geometry& g) { return g.parts[static_cast<size_t>(part)].count > 0; });
}

Casters buildingCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut) {
  Casters out;
  std::vector<city::Range> runs;
  for (const city::BuildingGeometry& type : city.buildingTypes) {
    runs.clear();
    for (const city::Plane& plane : type.planes) {
      runs.push_back(plane.flat);
      for (uint32_t i = plane.externalGeometry.first; i < plane.externalGeometry.end(); ++i)
        if (type.externalGeometry[i].depth >= kLeastThrowingDepth) runs.push_back(type.externalGeometry[i].indices);
    }
    addGeometry(out, type.vertices, type.indices, runs, cutOut);
  }
  for (const city::Instance& i : city.buildings.instances)
    addInstance(out, city, tiles, i.position, static_cast<double>(i.heading), i.geometry);
  return out;
}

Casters treeCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut) {
  Casters out;
  for (const city::MeshGeometry& type : city.treeTypes) addWhole(out, type.mesh, cutOut);
  for (const city::Instance& i : city.trees.instances)
    addInstance(out, city, tiles, i.position, static_cast<double>(i.heading), i.geometry);
  return out;
}

Casters monumentCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut) {
  Casters out;
  for (const city::MeshGeometry& mesh : city.meshes) addWhole(out, mesh.mesh, cutOut);
  for (const city::Monument& m : city.monuments)
    addInstance(out, city, tiles, m.position, static_cast<double>(m.heading), m.mesh);
  return out;
}

CasterBuffers::CasterBuffers(Casters casters)
    : casters_(std::move(casters)),
      bytes_(casters_.vertices.size() * sizeof(city::Vertex) + casters_.indices.size() * sizeof(uint32_t) +
             casters_.instances.size() * sizeof(GpuInstance)) {}

void CasterBuffers::bind() {
  if (vertexArray_ == 0) {
    vertices_.fill(std::span<const city::Vertex>(casters_.vertices), GL_STATIC_DRAW);
    indices_.fill(std::span<const uint32_t>(casters_.indices), GL_STATIC_DRAW);
    instances_.fill(std::span<const GpuInstance>(casters_.instances), GL_STATIC_DRAW);
    vertexArray_ = makeVertexArray(indices_, kVertexAttributes, kInstanceAttributes);
    casters_.vertices = {}, casters_.indices = {}, casters_.instances = {};
  }
  glBindVertexArray(vertexArray_);
  glBindVertexBuffer(kVertexSource, vertices_.name(), 0, sizeof(city::Vertex));
  glBindVertexBuffer(kInstanceSource, instances_.name(), 0, sizeof(GpuInstance));
}

void CasterBuffers::release() {
  if (vertexArray_ != 0) glDeleteVertexArrays(1, &vertexArray_);
  vertexArray_ = 0;
  for (GlBuffer* buffer : {&vertices_, &indices_, &instances_}) buffer->release();
}

CasterDrawable::CasterDrawable(std::shared_ptr<CasterBuffers> buffers, std::shared_ptr<TileTable> tiles, ArenaPart part)
    : buffers_(std::move(buffers)), tiles_(std::move(tiles)), part_(part) {
  setUseDisplayList(false);
  setUseVertexBufferObjects(false);
  setCullingActive(false);
}

uint64_t CasterDrawable::take(std::span<const city::Range> drawn) {
  const Casters& casters = buffers_->casters();
  uint64_t triangles = 0;
  commands_.clear();
  for (const city::Range& run : drawn)
    for (uint32_t i = run.first; i < run.end(); ++i) {
      const Casters::Geometry& g = casters.geometries[casters.geometryOf[i]];
      const city::Range& range = g.parts[static_cast<size_t>(part_)];
      if (range.count == 0) continue;
      commands_.push_back({range.count, 1, range.first, static_cast<int32_t>(g.baseVertex), i});
      triangles += range.count / 3;
    }
  return triangles;
}

void CasterDrawable::drawImplementation(osg::RenderInfo& info) const {
  if (commands_.empty()) return;
  info.getState()->unbindVertexBufferObject();
  tiles_->bind(kTileBinding);
  buffers_->bind();
  commandBuffer_.fill(std::span<const DrawCommand>(commands_), GL_STREAM_DRAW);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commandBuffer_.name());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands_.size()), 0);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindVertexArray(0);
}

void CasterDrawable::releaseGLObjects(osg::State* state) const {
  osg::Drawable::releaseGLObjects(state);
  if (!state) return;
  commandBuffer_.release();
  buffers_->release();
  tiles_->release();
}

}  // namespace vicus::scenegraph
