/// Draws the instances of one group of tiles from the arenas.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <glm/glm.hpp>
#include <memory>
#include <osg/Drawable>
#include <vector>

#include "scenegraph/arena.hpp"
#include "scenegraph/material_textures.hpp"
#include "scenegraph/scene.hpp"
#include "scenegraph/tile_table.hpp"

namespace vicus::scenegraph {

/// An instance as shaders/instance.vert gets it: metres from its tile's base; cosine and sine of its heading.
struct GpuInstance {
  glm::vec3 position;
  uint32_t tile;
  glm::vec2 turn;
  uint32_t seed;
  uint32_t item;
};
static_assert(sizeof(GpuInstance) == 32);

/// The two levels of a house in a fade: `Flat` keeps the pixels whose threshold lies under the share, `Full` the
/// others.
enum class FadeSide : uint8_t { Full, Flat };
/// An instance's tile as shaders/instance.vert reads it with FADES: the tile's number (under 2¹⁵), the side, and the
/// share (0 to 1) in steps of 2⁻¹⁶.
uint32_t fadingTile(uint32_t tile, FadeSide side, float share);

/// An arena on the graphics card: uploaded when it is first drawn, after which only what drawing needs is kept.
class ArenaBuffers {
 public:
  explicit ArenaBuffers(Arena arena);
  const Arena& arena() const { return arena_; }
  uint64_t bytes() const { return bytes_; }

  /// Binds the chunk's vertex array with `instances` as its instances. With the context current.
  void bind(uint32_t chunk, GLuint instances);
  void release();

 private:
  struct Chunk {
    GlBuffer vertices, indices;
    GLuint vertexArray = 0;
  };
  Arena arena_;
  std::vector<std::unique_ptr<Chunk>> chunks_;
  uint64_t bytes_ = 0;
};

/// The instances of one group of tiles on the graphics card, and which of them the plan draws.
class InstanceGroup {
 public:
  explicit InstanceGroup(std::vector<GpuInstance> instances, std::vector<uint32_t> geometries);
  size_t size() const { return geometries.size(); }
  /// Others in place of all, with their geometries; none is drawn until it is put into `drawn`.
  void replace(std::vector<GpuInstance> instances, std::vector<uint32_t> geometriesOf);
  /// The buffer of GpuInstance. With the context current.
  GLuint buffer();
  void release() { buffer_.release(); }

  std::vector<uint32_t> geometries;  ///< for each instance
  /// An instance of this group to be drawn.
  struct Drawn {
    uint32_t instance;
    houselod::Level level;
  };
  std::vector<Drawn> drawn;  ///< in the order drawn

 private:
  std::vector<GpuInstance> instances_;  ///< until they are in the buffer
  GlBuffer buffer_;
};

/// An OpenSceneGraph drawable that draws one part of a group with raw GL. Leaves OpenSceneGraph's record of GL state
/// right: vertex array 0, no array buffer, and on each unit the texture that the state sets put there.
class ArenaDrawable : public osg::Drawable {
 public:
  ArenaDrawable(std::shared_ptr<ArenaBuffers> buffers, std::shared_ptr<InstanceGroup> group,
                std::shared_ptr<TileTable> tiles, std::shared_ptr<const MaterialTextures> textures, ArenaPart part,
                Ordering ordering);

  /// Rewrites the commands from `group->drawn` and says what they cost.
  DrawCounts apply();

  size_t instanceCount() const { return group_->size(); }

  void drawImplementation(osg::RenderInfo& info) const override;
  void releaseGLObjects(osg::State* state) const override;
  const char* className() const override { return "ArenaDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  void drawOrdered(GLuint instances) const;
  void drawInSceneOrder(osg::State& state, GLuint instances) const;

  std::shared_ptr<ArenaBuffers> buffers_;
  std::shared_ptr<InstanceGroup> group_;
  std::shared_ptr<TileTable> tiles_;
  std::shared_ptr<const MaterialTextures> textures_;
  ArenaPart part_;
  Ordering ordering_;
  std::vector<std::vector<DrawCommand>> commands_;  ///< for each chunk
  mutable GlBuffer commandBuffer_;
};

}  // namespace vicus::scenegraph
