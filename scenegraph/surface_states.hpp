/// State sets of surfaces: program and pass, in each variant.
#pragma once

#include "scenegraph/gl.hpp"

#include <array>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/passes.hpp"
#include "scenegraph/scene.hpp"

namespace vicus::scenegraph {

/// One state set for each Variant; shared by all nodes that look alike, so that OpenSceneGraph draws them together.
struct SurfaceStates {
  std::array<osg::ref_ptr<osg::StateSet>, 2> variants;

  osg::StateSet* of(Variant variant) const { return variants[static_cast<size_t>(variant)]; }
};

/// A program from two files of assets/shaders; the vertex shader has VERTEX defined besides.
osg::ref_ptr<osg::Program> programOf(std::string_view vertexFile, std::string_view fragmentFile,
                                     std::vector<std::string> defines);

/// Programs from assets/shaders with `defines`, and with ITEM_ID besides for item buffers (none where the pass is not
/// drawn into them), in the render bin of `pass`.
SurfaceStates surfaceStates(PassId pass, std::string_view vertexFile, std::string_view fragmentFile,
                            std::vector<std::string> defines);

/// Makes a geometry keep its vertices in buffers, be drawn always and never be compiled into display lists.
void useBuffers(osg::Geometry& geometry);

}  // namespace vicus::scenegraph
