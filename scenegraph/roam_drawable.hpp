/// Draws ROAM meshes from buffers that stay on the graphics card and take only what each frame changes.
#pragma once

#include "scenegraph/gl_buffer.hpp"

#include <memory>
#include <osg/Drawable>
#include <vector>

#include "city/height_field.hpp"
#include "city/roam_frame.hpp"

namespace vicus::scenegraph {

/// A vertex as shaders/terrain.vert (ROAM) reads it.
struct RoamVertex {
  uint16_t column, row;
  float height;  ///< metres above the city's origin
};
static_assert(sizeof(RoamVertex) == 8);

/// Slots in ascending order as runs, those that are few slots apart joined: one upload costs as much as some dozens of
/// slots.
struct SlotRun {
  uint32_t first = 0, count = 0;
  bool operator==(const SlotRun&) const = default;
};
std::vector<SlotRun> joinSlots(std::vector<uint32_t> slots);

/// Invariant: the buffers of a mesh hold what its last shown frame says, whichever frames were planned and not drawn
/// in between.
class RoamDrawable : public osg::Drawable {
 public:
  explicit RoamDrawable(glm::ivec2 samples);

  /// The next draw shows this frame's mesh.
  void show(const city::RoamFrame& frame);
  uint64_t bytes() const;
  /// Bytes that the last draw sent to the graphics card.
  uint64_t uploaded() const { return uploaded_; }

  void drawImplementation(osg::RenderInfo& info) const override;
  void releaseGLObjects(osg::State* state) const override;
  const char* className() const override { return "RoamDrawable"; }
  osg::Object* cloneType() const override { return nullptr; }
  osg::Object* clone(const osg::CopyOp&) const override { return nullptr; }

 private:
  /// One view's mesh, where it lies on the card, and what has changed since it was last sent there.
  struct Held {
    std::shared_ptr<const city::RoamMesh> mesh;
    uint64_t revision = 0;
    bool whole = true;
    std::vector<uint32_t> vertices, triangles;
    GlBuffer vertexBuffer, indexBuffer;
    GLuint vertexArray = 0;
  };
  void upload(Held& held) const;
  static void makeRoom(Held& held);

  glm::ivec2 samples_;
  mutable std::vector<std::unique_ptr<Held>> held_;  ///< the one last shown at the end
  mutable std::vector<RoamVertex> staged_;
  mutable uint64_t uploaded_ = 0;
};

}  // namespace vicus::scenegraph
