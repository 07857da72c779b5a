/// What throws shadows, as the graphics card gets it: of each kind of content one pair of buffers and one draw call for
/// each cascade.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <memory>
#include <osg/Drawable>
#include <span>
#include <vector>

#include "city/city.hpp"
#include "scenegraph/arena.hpp"
#include "scenegraph/arena_drawable.hpp"
#include "scenegraph/tile_table.hpp"

namespace vicus::scenegraph {

/// Geometries and where they stand. Triangles of materials whose picture has holes are kept apart.
struct Casters {
  struct Geometry {
    city::Range parts[kArenaParts];  ///< in `indices`
    uint32_t baseVertex = 0;
  };
  std::vector<city::Vertex> vertices;
  std::vector<uint32_t> indices;
  std::vector<Geometry> geometries;
  std::vector<GpuInstance> instances;
  std::vector<uint32_t> geometryOf;  ///< for each instance

  bool has(ArenaPart part) const;
};

/// Items that stick out less far (metres) throw no shadow that one would miss.
constexpr float kLeastThrowingDepth = 0.2f;

/// Houses by their flat surfaces and what sticks far out of them; trees and monuments whole.
Casters buildingCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut);
Casters treeCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut);
Casters monumentCasters(const city::City& city, const TileTable& tiles, std::span<const uint8_t> cutOut);

/// Casters on the graphics card: uploaded when first drawn, after which only what drawing needs is kept.
class CasterBuffers {
 public:
  explicit CasterBuffers(Casters casters);
  const Casters& casters() const { return casters_; }
  uint64_t bytes() const { return bytes_; }
  /// With the context current.
  void bind();
  void release();

 private:
  Casters casters_;
  uint64_t bytes_;
  GlBuffer vertices_, indices_, instances_;
  GLuint vertexArray_ = 0;
};

/// One part of the casters in one cascade. Leaves OpenSceneGraph's record of GL state right: vertex array 0, no array
/// buffer.
class CasterDrawable : public osg::Drawable {
 public:
  /// `tiles` is moved to the cascade's centre by who plans it.
  CasterDrawable(std::shared_ptr<CasterBuffers> buffers, std::shared_ptr<TileTable> tiles, ArenaPart part);

  /// Takes what is drawn from now on; returns its triangles.
  uint64_t take(std::span<const city::Range> drawn);

  void drawImplementation(osg::RenderInfo& info) const override;
  void releaseGLObjects(osg::State* state) const override;
  const char* className() const override { return "CasterDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  std::shared_ptr<CasterBuffers> buffers_;
  std::shared_ptr<TileTable> tiles_;
  ArenaPart part_;
  std::vector<DrawCommand> commands_;
  mutable GlBuffer commandBuffer_;
};

}  // namespace vicus::scenegraph
