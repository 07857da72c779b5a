// People: bodies by level, cards far away, shadows on the ground.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <osg/BufferIndexBinding>
#include <osg/BufferObject>
#include <osg/Image>
#include <osg/Texture2DArray>
#include <tuple>

#include "avatars/impostor.hpp"
#include "scenegraph/avatar_drawable.hpp"
#include "scenegraph/features.hpp"

namespace vicus::scenegraph {
namespace {

/// Dresses that one uniform block of 64 KB holds.
constexpr size_t kMostDresses = 512;

/// Where each character's dresses begin in the table of all.
struct DressTable {
  std::vector<uint32_t> first;
  osg::ref_ptr<osg::FloatArray> rows;
  size_t count = 0;
};

DressTable dressTable(const std::vector<city::Character>& characters) {
  DressTable out;
  out.rows = new osg::FloatArray;
  for (const city::Character& c : characters) {
    out.first.push_back(static_cast<uint32_t>(std::min(out.count, kMostDresses - 1)));
    for (const city::Dress& dress : c.dresses) {
      if (out.count == kMostDresses) break;
      ++out.count;
      for (const glm::vec3& colour : dress)
        for (const float v : {colour.r, colour.g, colour.b, 1.0F}) out.rows->push_back(v);
    }
  }
  return out;
}

class Avatars : public Feature {
 public:
  Avatars(const city::City& city, const SceneParts& parts)
      : Feature("avatars"),
        terrain_(city.terrain && !city.terrain->empty() ? &*city.terrain : nullptr),
        firstItem_(city.itemOfPerson(0)),
        buffers_(parts.people),
        dresses_(dressTable(city.people.characters)) {
    const std::vector<city::Character>& characters = city.people.characters;
    std::vector<std::string> defines = {"DRESSES " + std::to_string(std::max<size_t>(dresses_.count, 1)),
                                        "CHARACTERS " + std::to_string(characters.size())};
    for (const std::string& define : parts.lightDefines()) defines.push_back(define);
    osg::ref_ptr<osg::UniformBufferObject> block = new osg::UniformBufferObject;
    dresses_.rows->setBufferObject(block);
    node_->getOrCreateStateSet()->setAttribute(new osg::UniformBufferBinding(
        kDressBinding, dresses_.rows.get(), 0, static_cast<GLsizeiptr>(dresses_.rows->getTotalDataSize())));

    add("bodies", AvatarPart::Bodies, surfaceStates(PassId::Opaque, "avatar.vert", "avatar.frag", defines),
        PassId::Opaque);
    ovals_ = parts.cascades == 0;
    if (ovals_)
      add("shadows", AvatarPart::Shadows, surfaceStates(PassId::Shadow, "avatar_shadow.vert", "avatar_shadow.frag", {}),
          PassId::Shadow);
    add("cards", AvatarPart::Cards, cardStates(characters, defines), PassId::CutOut);
    gpuBytes_ += buffers_->bytes() + dresses_.rows->getTotalDataSize();
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    // Bodies first, by character and level, then cards: each a run for one draw.
    order_.resize(plan.avatars.drawn.size());
    for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
    const auto keyOf = [&](uint32_t i) {
      const city::AvatarDraw& a = plan.avatars.drawn[i];
      return std::tuple(a.level == city::kAvatarMeshLevels, a.character, a.level, i);
    };
    std::sort(order_.begin(), order_.end(), [&](uint32_t a, uint32_t b) { return keyOf(a) < keyOf(b); });

    std::vector<GpuAvatar> people;
    std::vector<AvatarBuffers::Body> bodies;
    people.reserve(order_.size());
    for (const uint32_t i : order_) {
      const city::AvatarDraw& a = plan.avatars.drawn[i];
      const auto heading = static_cast<double>(a.heading);
      const auto phase =
          std::clamp(static_cast<int>(a.phase * avatars::kImpostorPhases), 0, avatars::kImpostorPhases - 1);
      const auto row = static_cast<uint32_t>(static_cast<int>(a.role) * avatars::kImpostorPhases + phase);
      glm::vec2 slope(0);
      if (a.level < city::kAvatarMeshLevels) {
        bodies.push_back({a.character, a.level});
        if (terrain_) {
          const glm::dvec3 up = terrain_->normalAt(a.position.x, a.position.y);
          slope = glm::vec2(-glm::dvec2(up) / std::max(up.z, 0.2));
        }
      }
      people.push_back({glm::vec3(a.position - plan.view.eye), a.scale,
                        glm::vec2(glm::dvec2(std::cos(heading), std::sin(heading))), a.firstMatrix,
                        std::min(dresses_.first[a.character] + a.dress, static_cast<uint32_t>(kMostDresses - 1)),
                        firstItem_ + a.person, row + 16 * a.character, slope});
    }
    buffers_->show(std::move(people), bodies, plan.avatars.matrices);
    DrawCounts counts;
    counts.triangles = buffers_->triangles() + (ovals_ ? 2 * buffers_->bodyCount() : 0);
    counts.indirectCommands = buffers_->commandCount();
    counts.drawCalls = (buffers_->bodyCount() > 0 ? (ovals_ ? 2U : 1U) : 0U) + (buffers_->cardCount() > 0 ? 1U : 0U);
    counts.textureBinds = buffers_->cardCount() > 0 ? 1 : 0;
    return counts;
  }

 private:
  void add(const char* name, AvatarPart part, const SurfaceStates& states, PassId pass) {
    osg::ref_ptr<AvatarDrawable> drawable = new AvatarDrawable(buffers_, part);
    drawable->setName(name);
    node_->addChild(drawable);
    addSurface(drawable, states, pass);
  }

  SurfaceStates cardStates(const std::vector<city::Character>& characters, const std::vector<std::string>& defines) {
    const SurfaceStates states = surfaceStates(PassId::CutOut, "avatar_card.vert", "avatar_card.frag", defines);
    osg::ref_ptr<osg::Texture2DArray> pictures = new osg::Texture2DArray;
    osg::ref_ptr<osg::Uniform> sizes =
        new osg::Uniform(osg::Uniform::FLOAT_VEC3, "cardSizes", static_cast<int>(characters.size()));
    pictures->setName("people far away");
    pictures->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    pictures->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    for (unsigned c = 0; c < characters.size(); ++c) {
      const avatars::Impostor impostor = avatars::makeImpostor(characters[c]);
      if (c == 0) pictures->setTextureSize(impostor.width, impostor.height, static_cast<int>(characters.size()));
      osg::ref_ptr<osg::Image> image = new osg::Image;
      image->allocateImage(impostor.width, impostor.height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
      std::copy(impostor.rgba.begin(), impostor.rgba.end(), image->data());
      pictures->setImage(c, image);
      sizes->setElement(c, osg::Vec3f(impostor.halfWidth, impostor.bottom, impostor.top));
      gpuBytes_ += impostor.rgba.size();
    }
    for (const Variant variant : {Variant::Colour, Variant::ItemId}) {
      states.of(variant)->setTextureAttribute(kAvatarUnit, pictures);
      states.of(variant)->addUniform(new osg::Uniform("avatarCards", static_cast<int>(kAvatarUnit)));
      states.of(variant)->addUniform(sizes);
      states.of(variant)->setMode(GL_SAMPLE_ALPHA_TO_COVERAGE, osg::StateAttribute::OFF);
    }
    return states;
  }

  const city::HeightField* terrain_;  ///< the city's, which outlives the scene; null where it has none
  uint32_t firstItem_;
  std::shared_ptr<AvatarBuffers> buffers_;
  DressTable dresses_;
  std::vector<uint32_t> order_;
  bool ovals_ = true;  ///< people have soft ovals under them: there are no shadow maps
};

}  // namespace

std::unique_ptr<Feature> makeAvatars(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Avatars>(city, parts);
}

}  // namespace vicus::scenegraph
