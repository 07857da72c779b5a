#include "scenegraph/surface_states.hpp"

#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Program>
#include <osg/Shader>

#include "assets/shaders/shaders.hpp"

namespace vicus::scenegraph {

osg::ref_ptr<osg::Program> programOf(std::string_view vertexFile, std::string_view fragmentFile,
                                     std::vector<std::string> defines) {
  osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(std::string(vertexFile) + " + " + std::string(fragmentFile));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, assets::shaderSource(fragmentFile, defines)));
  defines.emplace_back("VERTEX");
  program->addShader(new osg::Shader(osg::Shader::VERTEX, assets::shaderSource(vertexFile, defines)));
  return program;
}

SurfaceStates surfaceStates(PassId id, std::string_view vertexFile, std::string_view fragmentFile,
                            std::vector<std::string> defines) {
  const Pass& thePass = pass(id);
  SurfaceStates states;
  for (const Variant variant : {Variant::Colour, Variant::ItemId}) {
    if (variant == Variant::ItemId && !thePass.items) continue;
    if (variant == Variant::ItemId) defines.emplace_back("ITEM_ID");
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    set->setName(std::string(thePass.name) + (variant == Variant::ItemId ? " items" : ""));
    set->setRenderBinDetails(thePass.bin, "RenderBin");
    set->setAttributeAndModes(programOf(vertexFile, fragmentFile, defines));
    if (id == PassId::CutOut) {
      set->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK), osg::StateAttribute::OFF);
      if (variant == Variant::Colour) set->setMode(GL_SAMPLE_ALPHA_TO_COVERAGE, osg::StateAttribute::ON);
    }
    // The sky lies at the depth that pictures are cleared to, and hides nothing.
    if (id == PassId::Sky) set->setAttributeAndModes(new osg::Depth(osg::Depth::GEQUAL, 0, 1, false));
    if (id == PassId::Shadow) {
      set->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
      set->setAttributeAndModes(new osg::Depth(osg::Depth::GEQUAL, 0, 1, false));
      set->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK), osg::StateAttribute::OFF);
    }
    if (id == PassId::Water && variant == Variant::Colour) {
      set->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
      set->setAttributeAndModes(new osg::Depth(osg::Depth::GEQUAL, 0, 1, false));
    }
    states.variants[static_cast<size_t>(variant)] = set;
  }
  return states;
}

void useBuffers(osg::Geometry& geometry) {
  geometry.setUseDisplayList(false);
  geometry.setUseVertexBufferObjects(true);
  geometry.setCullingActive(false);
}

}  // namespace vicus::scenegraph
