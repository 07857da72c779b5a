/// The city's materials on the graphics card: texture arrays by size class and the material table.
#pragma once

#include "scenegraph/gl.hpp"

#include <osg/BufferIndexBinding>
#include <osg/StateSet>
#include <osg/Texture2DArray>
#include <osg/ref_ptr>
#include <span>
#include <string>
#include <vector>

#include "assets/load_city.hpp"
#include "city/city.hpp"
#include "city/diagnostics.hpp"
#include "scenegraph/texture_classes.hpp"

namespace vicus::scenegraph {

struct MaterialTextures {
  std::vector<osg::ref_ptr<osg::Texture2DArray>> arrays;  ///< one for each size class, on texture units 0, 1, …
  osg::ref_ptr<osg::BufferIndexBinding> table;            ///< at kMaterialBinding
  std::vector<std::string> defines;                       ///< that shaders/materials.glsl and surface.frag need
  std::vector<uint8_t> cutOut;                            ///< for each material: its picture has holes
  std::vector<uint32_t> classOf;                          ///< for each material
  uint64_t bytes = 0;
};

/// Bindings of uniform and storage blocks; shaders/*.glsl names the same.
constexpr GLuint kTileBinding = 1;
constexpr GLuint kPoseBinding = 3;
constexpr GLuint kDressBinding = 4;
constexpr GLuint kMaterialBinding = 2;

/// Texture units after those of the material arrays.
constexpr unsigned kGroundMapUnit = 4;
constexpr unsigned kGroundDetailUnit = 5;
constexpr unsigned kRippleUnit = 6;
constexpr unsigned kCloudUnit = 7;
constexpr unsigned kAvatarUnit = 8;

/// Mip levels of one layer after the other.
using LayerLevels = std::vector<std::vector<uint8_t>>;

/// A mip-mapped RGBA8 array of square layers whose pixels are handed to GL when it is first drawn and then dropped.
/// `anisotropy` 0: 8 on a graphics card, 1 on software GL, where it costs more than it shows.
osg::ref_ptr<osg::Texture2DArray> textureArray(std::string name, int size, bool repeat, std::vector<LayerLevels> layers,
                                               double anisotropy);

/// Makes (or reads) the pictures of all materials, two at a time. A city without materials gets one of grey.
MaterialTextures makeMaterialTextures(std::span<const city::Material> materials, uint64_t budgetBytes,
                                      double anisotropy, city::Diagnostics& diagnostics,
                                      const assets::Progress& progress);

}  // namespace vicus::scenegraph
