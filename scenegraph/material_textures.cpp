#include "scenegraph/material_textures.hpp"

#include <algorithm>
#include <atomic>
#include <future>
#include <map>
#include <string_view>
#include <utility>

#include "assets/materials/materials.hpp"

namespace vicus::scenegraph {
namespace {

constexpr GLenum kTextureMaxAnisotropy = 0x84FE;

bool softwareGl() {
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string_view renderer = text ? text : "";
  return renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos;
}

/// Hands the levels to GL once.
class LevelUpload : public osg::Texture2DArray::SubloadCallback {
 public:
  LevelUpload(std::vector<LayerLevels> layers, double anisotropy)
      : layers_(std::move(layers)), anisotropy_(anisotropy) {}

  void load(const osg::Texture2DArray& texture, osg::State&) const override {
    const int size = texture.getTextureWidth();
    const auto depth = static_cast<GLsizei>(texture.getTextureDepth());
    GLint level = 0;
    for (int s = size; s > 0; s /= 2, ++level) {
      glTexImage3D(GL_TEXTURE_2D_ARRAY, level, GL_RGBA8, s, s, depth, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
      for (size_t layer = 0; layer < layers_.size(); ++layer)
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, static_cast<GLint>(layer), s, s, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                        layers_[layer][static_cast<size_t>(level)].data());
    }
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, level - 1);
    const double anisotropy = anisotropy_ > 0 ? anisotropy_ : softwareGl() ? 1 : 8;
    if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, kTextureMaxAnisotropy, static_cast<float>(anisotropy));
    layers_ = {};
  }
  void subload(const osg::Texture2DArray&, osg::State&) const override {}

 private:
  mutable std::vector<LayerLevels> layers_;
  double anisotropy_;
};

}  // namespace

osg::ref_ptr<osg::Texture2DArray> textureArray(std::string name, int size, bool repeat, std::vector<LayerLevels> layers,
                                               double anisotropy) {
  osg::ref_ptr<osg::Texture2DArray> texture = new osg::Texture2DArray;
  texture->setName(std::move(name));
  texture->setTextureSize(size, size, static_cast<int>(layers.size()));
  texture->setInternalFormat(GL_RGBA8);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  const auto wrap = repeat ? osg::Texture::REPEAT : osg::Texture::CLAMP_TO_EDGE;
  texture->setWrap(osg::Texture::WRAP_S, wrap);
  texture->setWrap(osg::Texture::WRAP_T, wrap);
  texture->setUseHardwareMipMapGeneration(false);
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setSubloadCallback(new LevelUpload(std::move(layers), anisotropy));
  return texture;
}

MaterialTextures makeMaterialTextures(std::span<const city::Material> materials, uint64_t budgetBytes,
                                      double anisotropy, city::Diagnostics& diagnostics,
                                      const assets::Progress& progress, const PageRequest& request) {
  city::Material grey;
  grey.name = "grey", grey.source = "builtin:plaster";
  if (materials.empty()) materials = {&grey, 1};

  // Materials that differ only in size or tint share a picture.
  std::map<std::pair<std::string, bool>, uint32_t> pictureOf;
  std::vector<uint32_t> pictures(materials.size());
  std::vector<const city::Material*> firstUse;
  for (size_t i = 0; i < materials.size(); ++i) {
    const auto [it, isNew] =
        pictureOf.try_emplace({materials[i].source, materials[i].repeat}, static_cast<uint32_t>(firstUse.size()));
    if (isNew) firstUse.push_back(&materials[i]);
    pictures[i] = it->second;
  }

  const size_t count = firstUse.size();
  std::vector<city::Material> sources(count);
  for (size_t i = 0; i < count; ++i) sources[i] = *firstUse[i];
  std::vector<assets::Image> images = assets::materialImages(sources, diagnostics);
  if (progress) progress("textures", 0.6);

  std::vector<TextureDemand> demands(count);
  std::vector<uint8_t> holes(count);
  for (size_t i = 0; i < count; ++i) {
    demands[i] = {std::max({images[i].width, images[i].height, 1}), firstUse[i]->repeat};
    holes[i] = hasHoles(images[i]);
  }
  demands.resize(count + request.pages, {houselod::kPageSize, true});
  const TexturePlan plan = planTextures(demands, budgetBytes);
  if (plan.halvings > 0)
    diagnostics.warn("textures", "",
                     "over the budget of " + std::to_string(budgetBytes >> 20) +
                         " MB (textures.budget_mb): the largest were halved " + std::to_string(plan.halvings) +
                         " times");

  std::vector<std::vector<LayerLevels>> layers(plan.classes.size());
  for (size_t c = 0; c < layers.size(); ++c) layers[c].resize(plan.classes[c].layers);
  std::atomic<size_t> next = 0;
  const auto makeLevels = [&] {
    for (size_t i = next++; i < count; i = next++) {
      const TexturePlace& place = plan.places[i];
      layers[place.textureClass][place.layer] = mipLevels(images[i], plan.classes[place.textureClass].size);
      images[i] = {};
    }
  };
  {
    auto other = std::async(std::launch::async, makeLevels);
    makeLevels();
    other.get();
  }
  // Pages are baked from the levels just made.
  std::vector<houselod::BakedFrom> bakedFrom;
  for (size_t i = 0; request.pages > 0 && i < materials.size(); ++i) {
    const city::Material& m = materials[i];
    const TexturePlace& place = plan.places[pictures[i]];
    houselod::BakedFrom& from = bakedFrom.emplace_back();
    from.size = plan.classes[place.textureClass].size;
    for (const std::vector<uint8_t>& level : layers[place.textureClass][place.layer]) from.levels.emplace_back(level);
    from.repeat = m.repeat, from.tint = m.tint, from.specular = m.specular;
    from.metresPerRepeat = {m.metresPerRepeat.x > 0 ? m.metresPerRepeat.x : 1,
                            m.metresPerRepeat.y > 0 ? m.metresPerRepeat.y : 1};
  }
  if (request.pages > 0) {
    std::atomic<uint32_t> nextPage = 0;
    const auto bakePages = [&] {
      for (uint32_t page = nextPage++; page < request.pages; page = nextPage++) {
        std::vector<uint8_t> texels(4 * static_cast<size_t>(houselod::kPageSize) * houselod::kPageSize, 0);
        request.bake(page, bakedFrom, texels);
        const TexturePlace& place = plan.places[count + page];
        layers[place.textureClass][place.layer] =
            houselod::pageLevels(std::move(texels), houselod::kPageSize, plan.classes[place.textureClass].size);
      }
    };
    auto other = std::async(std::launch::async, bakePages);
    bakePages();
    other.get();
  }
  if (progress) progress("textures", 1);

  MaterialTextures out;
  out.bytes = plan.bytes;
  for (size_t c = 0; c < plan.classes.size(); ++c) {
    const TextureClass& k = plan.classes[c];
    out.arrays.push_back(textureArray("materials " + std::to_string(k.size) + (k.repeat ? "" : " clamped"), k.size,
                                      k.repeat, std::move(layers[c]), anisotropy));
  }
  osg::ref_ptr<osg::Vec4Array> rows = new osg::Vec4Array;
  for (size_t i = 0; i < materials.size(); ++i) {
    const city::Material& m = materials[i];
    const TexturePlace& place = plan.places[pictures[i]];
    const auto repeats = [](float metres) { return metres > 0 ? 1 / metres : 1.0f; };
    rows->push_back({repeats(m.metresPerRepeat.x), repeats(m.metresPerRepeat.y), static_cast<float>(place.layer),
                     static_cast<float>(place.textureClass)});
    rows->push_back({m.tint.r, m.tint.g, m.tint.b, m.tintVariation});
    rows->push_back({m.specular, 0, 0, 0});
    out.cutOut.push_back(holes[pictures[i]]);
    out.classOf.push_back(place.textureClass);
  }
  out.firstPage = static_cast<city::MaterialId>(materials.size());
  out.pages = request.pages;
  for (uint32_t page = 0; page < request.pages; ++page) {
    const TexturePlace& place = plan.places[count + page];
    rows->push_back({1, 1, static_cast<float>(place.layer), static_cast<float>(place.textureClass)});
    rows->push_back({1, 1, 1, 0});
    rows->push_back({0, 1, 0, 0});
    out.cutOut.push_back(0);
    out.classOf.push_back(place.textureClass);
  }
  // A uniform block where the table fits one: software GL reads those much faster than storage blocks.
  constexpr size_t kLargestUniformBlock = 64 << 10;
  out.defines = {"TEXTURE_CLASSES " + std::to_string(out.arrays.size())};
  const auto bytes = static_cast<GLsizeiptr>(rows->getTotalDataSize());
  if (rows->getTotalDataSize() <= kLargestUniformBlock) {
    out.defines.push_back("MATERIALS " + std::to_string(materials.size() + request.pages));
    rows->setBufferObject(new osg::UniformBufferObject);
    out.table = new osg::UniformBufferBinding(kMaterialBinding, rows.get(), 0, bytes);
  } else {
    rows->setBufferObject(new osg::ShaderStorageBufferObject);
    out.table = new osg::ShaderStorageBufferBinding(kMaterialBinding, rows.get(), 0, bytes);
  }
  out.bytes += rows->getTotalDataSize();
  return out;
}

}  // namespace vicus::scenegraph
