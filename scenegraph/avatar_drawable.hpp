/// Draws people: all bodies in one pair of buffers, all poses in one, all who are drawn in one.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <osg/Drawable>
#include <vector>

#include "city/avatars.hpp"
#include "scenegraph/arena.hpp"

namespace vicus::scenegraph {

/// A person as shaders/avatar*.vert get him.
struct GpuAvatar {
  glm::vec3 fromEye;  ///< metres from the eye, subtracted in double
  float scale;
  glm::vec2 turn;  ///< cosine and sine of the heading
  uint32_t firstMatrix;
  uint32_t dress;
  uint32_t item;
  uint32_t picture;  ///< row of pictures + 16 × character
  glm::vec2 slope;   ///< of the ground, metres for each metre
};
static_assert(sizeof(GpuAvatar) == 48);

/// What is drawn of people: their bodies, or cards in their place, or ovals of shadow, or the bodies near the eye as
/// they throw shadows.
enum class AvatarPart : uint8_t { Bodies, Cards, Shadows, ThrowingBodies };

/// All bodies and levels, uploaded when first drawn; and of the frame at hand everybody with his pose. Bodies come
/// first, ordered by body and level, then who is shown by a card. Shared by the drawables of the parts.
class AvatarBuffers {
 public:
  explicit AvatarBuffers(const std::vector<city::Character>& characters);
  uint64_t bytes() const { return bytes_; }

  /// Takes a frame's people: `bodies[k]` is the level and body of the first people, `matrices` their poses.
  struct Body {
    uint32_t character;
    uint8_t level;
  };
  void show(std::vector<GpuAvatar> people, const std::vector<Body>& bodies,
            const std::vector<std::array<glm::vec4, 3>>& matrices);
  uint64_t triangles() const { return triangles_; }
  size_t commandCount() const { return commands_.size(); }
  size_t bodyCount() const { return bodyCount_; }
  size_t cardCount() const { return people_.size() - bodyCount_; }
  /// Of the bodies those within `reach` metres of the eye throw shadows. After `show`; returns how many.
  size_t throwWithin(float reach);

  /// With the context current.
  void draw(AvatarPart part);
  void release();

 private:
  void upload();

  std::vector<city::AvatarVertex> vertices_;
  std::vector<uint32_t> indices_;
  struct Mesh {
    uint32_t firstIndex, count;
    int32_t baseVertex;
  };
  std::vector<Mesh> meshes_;  // by character and level
  std::vector<GpuAvatar> people_;
  std::vector<std::array<glm::vec4, 3>> matrices_;
  std::vector<DrawCommand> commands_, throwing_;
  size_t bodyCount_ = 0;
  uint64_t triangles_ = 0, bytes_ = 0;
  bool changed_ = true, made_ = false;
  GlBuffer vertexBuffer_, indexBuffer_, quad_, quadIndices_, personBuffer_, poseBuffer_, commandBuffer_,
      throwingBuffer_;
  GLuint bodyArray_ = 0, quadArray_ = 0;
};

/// An OpenSceneGraph drawable that draws one part. Leaves OpenSceneGraph's record of GL state right: vertex array 0 and
/// no array buffer.
class AvatarDrawable : public osg::Drawable {
 public:
  AvatarDrawable(std::shared_ptr<AvatarBuffers> buffers, AvatarPart part);

  void drawImplementation(osg::RenderInfo& info) const override;
  void releaseGLObjects(osg::State* state) const override;
  const char* className() const override { return "AvatarDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  std::shared_ptr<AvatarBuffers> buffers_;
  AvatarPart part_;
};

}  // namespace vicus::scenegraph
