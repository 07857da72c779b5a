#include "scenegraph/gl.hpp"

#include <algorithm>
#include <optional>
#include <osg/Texture2D>

#include "scenegraph/features.hpp"
#include "scenegraph/ground_map.hpp"
#include "scenegraph/roam_drawable.hpp"
#include "scenegraph/terrain_mesh.hpp"

namespace vicus::scenegraph {
namespace {

/// A tile's base in the ground map and in the detail's repeats; what terrain.vert gets for each patch.
struct GpuPatch {
  glm::vec4 uv;
  uint32_t tile;
};

using As = VertexAttribute::As;

/// At the locations of shaders/terrain.vert.
constexpr VertexAttribute kVertexAttributes[] = {
    {0, 3, GL_FLOAT, As::Float, offsetof(TerrainVertex, position)},
};
constexpr VertexAttribute kPatchAttributes[] = {
    {3, 4, GL_FLOAT, As::Float, offsetof(GpuPatch, uv)},
    {4, 1, GL_UNSIGNED_INT, As::Integer, offsetof(GpuPatch, tile)},
};

class TerrainDrawable : public osg::Drawable {
 public:
  TerrainDrawable(TerrainMesh mesh, std::vector<GpuPatch> gpuPatches, std::shared_ptr<TileTable> tiles,
                  Ordering ordering)
      : mesh_(std::move(mesh)), gpuPatches_(std::move(gpuPatches)), tiles_(std::move(tiles)), ordering_(ordering) {
    bytes_ = mesh_.vertices.size() * sizeof(TerrainVertex) + mesh_.indices.size() * sizeof(uint32_t) +
             gpuPatches_.size() * sizeof(GpuPatch);
    setUseDisplayList(false);
    setCullingActive(false);
  }
  uint64_t bytes() const { return bytes_; }

  DrawCounts apply(const city::FramePlan& plan) {
    commands_.clear();
    order_.clear();
    auto next = mesh_.patches.begin();
    for (const uint32_t tile : plan.tiles) {
      while (next != mesh_.patches.end() && next->tile < tile) ++next;
      if (next != mesh_.patches.end() && next->tile == tile)
        order_.emplace_back(0.0f, static_cast<uint32_t>(next - mesh_.patches.begin()));
    }
    if (ordering_ == Ordering::ByState) {  // near to far
      for (auto& [distance, patch] : order_) {
        const glm::vec2 away(tiles_->fromEye()[mesh_.patches[patch].tile]);
        distance = glm::dot(away, away);
      }
      std::stable_sort(order_.begin(), order_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    }
    DrawCounts counts;
    for (const auto& entry : order_) {
      const TerrainPatch& p = mesh_.patches[entry.second];
      commands_.push_back({p.indices.count, 1, p.indices.first, static_cast<int32_t>(p.baseVertex), p.tile});
      counts.triangles += p.indices.count / 3;
    }
    counts.terrainTriangles = counts.triangles;
    const bool ordered = ordering_ == Ordering::ByState;
    counts.drawCalls = ordered ? !commands_.empty() : commands_.size();
    counts.indirectCommands = ordered ? commands_.size() : 0;
    counts.textureBinds = ordered ? 0 : commands_.size();
    return counts;
  }

  void drawImplementation(osg::RenderInfo& info) const override {
    if (commands_.empty()) return;
    info.getState()->unbindVertexBufferObject();
    if (vertexArray_ == 0) upload();
    tiles_->bind(kTileBinding);
    glBindVertexArray(vertexArray_);
    glBindVertexBuffer(kVertexSource, vertices_.name(), 0, sizeof(TerrainVertex));
    glBindVertexBuffer(kInstanceSource, patchBuffer_.name(), 0, sizeof(GpuPatch));
    if (ordering_ == Ordering::ByState) {
      commandBuffer_.fill(std::span<const DrawCommand>(commands_), GL_STREAM_DRAW);
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commandBuffer_.name());
      glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands_.size()), 0);
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    } else {
      for (const DrawCommand& c : commands_) {
        rebindMap(*info.getState());
        glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(c.count), GL_UNSIGNED_INT,
                                                      reinterpret_cast<const void*>(c.firstIndex * sizeof(uint32_t)), 1,
                                                      c.baseVertex, c.baseInstance);
      }
    }
    glBindVertexArray(0);
  }

  void setMap(osg::Texture2D* map) { map_ = map; }

  void releaseGLObjects(osg::State* state) const override {
    osg::Drawable::releaseGLObjects(state);
    if (!state) return;
    if (vertexArray_ != 0) glDeleteVertexArrays(1, &vertexArray_);
    vertexArray_ = 0;
    for (GlBuffer* buffer : {&vertices_, &indices_, &patchBuffer_, &commandBuffer_}) buffer->release();
    tiles_->release();
  }
  const char* className() const override { return "TerrainDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  void upload() const {
    vertices_.fill(std::span<const TerrainVertex>(mesh_.vertices), GL_STATIC_DRAW);
    indices_.fill(std::span<const uint32_t>(mesh_.indices), GL_STATIC_DRAW);
    patchBuffer_.fill(std::span<const GpuPatch>(gpuPatches_), GL_STATIC_DRAW);
    mesh_.vertices = {};
    mesh_.indices = {};
    vertexArray_ = makeVertexArray(indices_, kVertexAttributes, kPatchAttributes);
  }

  void rebindMap(osg::State& state) const {
    state.setActiveTextureUnit(kGroundMapUnit);
    if (auto* texture = map_->getTextureObject(state.getContextID())) texture->bind();
  }

  mutable TerrainMesh mesh_;
  std::vector<GpuPatch> gpuPatches_;  ///< one for each tile
  std::shared_ptr<TileTable> tiles_;
  Ordering ordering_;
  osg::ref_ptr<osg::Texture2D> map_;
  uint64_t bytes_ = 0;
  std::vector<DrawCommand> commands_;
  std::vector<std::pair<float, uint32_t>> order_;  ///< distance squared, patch
  mutable GLuint vertexArray_ = 0;
  mutable GlBuffer vertices_, indices_, patchBuffer_, commandBuffer_;
};

/// Uniforms that tell shaders/terrain.vert (ROAM) where the eye is over the samples.
class SamplesFromEye {
 public:
  SamplesFromEye(const city::HeightField& field, osg::StateSet& states) : origin_(field.origin), step_(field.spacing) {
    for (const auto& u : {sample_, beyond_, height_, detail_}) states.addUniform(u);
    const glm::vec2 step(step_), inMap(1.0 / glm::dvec2(field.size - 1));
    states.addUniform(new osg::Uniform("sampleSpacing", osg::Vec2f(step.x, step.y)));
    states.addUniform(new osg::Uniform("mapFromSample", osg::Vec2f(inMap.x, inMap.y)));
  }
  void moveTo(const glm::dvec3& eye) {
    constexpr double kFarthest = 1 << 24;  // samples
    const glm::dvec2 fromOrigin = glm::dvec2(eye) - origin_;
    const glm::dvec2 sample = glm::clamp(glm::floor(fromOrigin / step_), -kFarthest, kFarthest);
    const glm::vec2 beyond(fromOrigin - sample * step_), detail(glm::fract(glm::dvec2(eye) / kGroundDetailMetres));
    const auto height = static_cast<float>(eye.z);
    sample_->set(static_cast<int>(sample.x), static_cast<int>(sample.y));
    beyond_->set(osg::Vec2f(beyond.x, beyond.y));
    height_->set(osg::Vec2f(height, static_cast<float>(eye.z - static_cast<double>(height))));
    detail_->set(osg::Vec2f(detail.x, detail.y));
  }

 private:
  glm::dvec2 origin_, step_;
  osg::ref_ptr<osg::Uniform> sample_ = new osg::Uniform(osg::Uniform::INT_VEC2, "eyeSample");
  osg::ref_ptr<osg::Uniform> beyond_ = new osg::Uniform("eyeBeyondSample", osg::Vec2f());
  osg::ref_ptr<osg::Uniform> height_ = new osg::Uniform("eyeHeight", osg::Vec2f());
  osg::ref_ptr<osg::Uniform> detail_ = new osg::Uniform("eyeDetailUv", osg::Vec2f());
};

/// Plans with a ROAM mesh draw that, others the drawn tiles' patches at full detail. Each is made when a plan first
/// needs it: nobody pays for both who sees one.
class Terrain : public Feature {
 public:
  Terrain(const city::City& city, const SceneParts& parts) : Feature("terrain"), city_(city), parts_(parts) {
    const glm::vec2 mapRepeats(1.0 / city.terrain->extent());
    node_->getOrCreateStateSet()->addUniform(new osg::Uniform("mapRepeats", osg::Vec2f(mapRepeats.x, mapRepeats.y)));
    addPass(PassId::Ground);
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    DrawCounts counts;
    if (plan.roam) {
      if (!roam_) makeRoam();
      roam_->show(*plan.roam);
      samplesFromEye_->moveTo(plan.view.eye);
      counts.triangles = counts.terrainTriangles = plan.roam->mesh->triangles.size();
      counts.drawCalls = counts.triangles > 0;
    } else {
      if (!patches_) makePatches();
      counts = patches_->apply(plan);
    }
    gpuBytes_ = (roam_ ? roam_->bytes() : 0) + (patches_ ? patches_->bytes() : 0);
    if (roam_) hide(roam_, !plan.roam);
    if (patches_) hide(patches_, plan.roam.has_value());
    return counts;
  }

 private:
  std::vector<std::string> defines(std::vector<std::string> own) const {
    for (const std::string& define : parts_.lightDefines()) own.push_back(define);
    return own;
  }
  void makeRoam() {
    roam_ = new RoamDrawable(city_.terrain->size);
    roam_->setName("terrain/ROAM mesh");
    node_->addChild(roam_);
    samplesFromEye_.emplace(*city_.terrain, *node_->getOrCreateStateSet());
    addSurface(roam_, surfaceStates(PassId::Ground, "terrain.vert", "ground.frag", defines({"GROUND_MAP", "ROAM"})),
               PassId::Ground);
  }
  void makePatches() {
    const city::HeightField& field = *city_.terrain;
    std::vector<glm::dvec3> bases;
    std::vector<GpuPatch> patches;
    for (uint32_t t = 0; t < city_.grid.tileCount(); ++t) {
      bases.push_back(parts_.tiles->base(t));
      const glm::dvec2 inMap = (glm::dvec2(bases.back()) - field.origin) / field.extent();
      const glm::dvec2 inDetail = glm::fract(glm::dvec2(bases.back()) / kGroundDetailMetres);
      patches.push_back({glm::vec4(glm::vec2(inMap), glm::vec2(inDetail)), t});
    }
    patches_ =
        new TerrainDrawable(terrainMesh(field, city_.grid, bases), std::move(patches), parts_.tiles, parts_.ordering);
    patches_->setName("terrain/patches at full detail");
    patches_->setMap(parts_.groundMap);
    node_->addChild(patches_);
    addSurface(patches_, surfaceStates(PassId::Ground, "terrain.vert", "ground.frag", defines({"GROUND_MAP"})),
               PassId::Ground);
  }

  const city::City& city_;
  SceneParts parts_;
  osg::ref_ptr<TerrainDrawable> patches_;
  osg::ref_ptr<RoamDrawable> roam_;
  std::optional<SamplesFromEye> samplesFromEye_;
};

}  // namespace

std::unique_ptr<Feature> makeTerrain(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Terrain>(city, parts);
}

}  // namespace vicus::scenegraph
