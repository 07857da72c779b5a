/// The city's materials on the graphics card: texture arrays by size class and the material table.
#pragma once

#include "scenegraph/gl.hpp"

#include <functional>
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
#include "houselod/bake.hpp"
#include "scenegraph/texture_classes.hpp"

namespace vicus::scenegraph {

struct MaterialTextures {
  std::vector<osg::ref_ptr<osg::Texture2DArray>> arrays;  ///< one for each size class, on texture units 0, 1, …
  osg::ref_ptr<osg::BufferIndexBinding> table;            ///< at kMaterialBinding
  std::vector<std::string> defines;                       ///< that shaders/materials.glsl and surface.frag need
  std::vector<uint8_t> cutOut;                            ///< for each material: its picture has holes
  std::vector<uint32_t> classOf;                          ///< for each material
  city::MaterialId firstPage = 0;                         ///< the pages' materials follow the city's
  uint32_t pages = 0;
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
constexpr unsigned kShadowUnit = 9;

/// Mip levels of one layer after the other.
using LayerLevels = std::vector<std::vector<uint8_t>>;

/// A mip-mapped RGBA8 array of square layers whose pixels are handed to GL when it is first drawn and then dropped.
/// `anisotropy` 0: 8 on a graphics card, 1 on software GL, where it costs more than it shows.
osg::ref_ptr<osg::Texture2DArray> textureArray(std::string name, int size, bool repeat, std::vector<LayerLevels> layers,
                                               double anisotropy);

/// Pictures of walls that become layers and materials like any other.
struct PageRequest {
  uint32_t pages = 0;  ///< of houselod::kPageSize²
  /// Fills a page from the materials' pictures; called from several threads.
  std::function<void(uint32_t page, std::span<const houselod::BakedFrom> materials, std::span<uint8_t> texels)> bake;
};

/// Makes (or reads) the pictures of all materials, two at a time, then the pages. A city without materials gets one of
/// grey.
MaterialTextures makeMaterialTextures(std::span<const city::Material> materials, uint64_t budgetBytes,
                                      double anisotropy, city::Diagnostics& diagnostics,
                                      const assets::Progress& progress, const PageRequest& request = {});

}  // namespace vicus::scenegraph
