// Shadow maps: of each cascade one layer of a texture, drawn by a camera of its own when what is in it has changed.
#include "scenegraph/gl.hpp"

#include <osg/Camera>
#include <osg/CullFace>
#include <osg/PolygonOffset>
#include <osg/Texture2DArray>

#include "city/shadow_plan.hpp"
#include "scenegraph/casters.hpp"
#include "scenegraph/features.hpp"
#include "scenegraph/glm_osg.hpp"
#include "scenegraph/ground_caster.hpp"

namespace vicus::scenegraph {
namespace {

/// A surface's own depths differ by its slope over the texels that the filter looks at, from which the map is moved
/// away by so many slopes; and by what no slope tells, texels.
constexpr float kSlopes = 2;
constexpr double kTexels = 0.6;

/// Copies a layer of the maps before people are drawn over it.
class CopyLayer : public osg::Camera::DrawCallback {
 public:
  CopyLayer(osg::Texture2DArray* maps, int from, int to) : maps_(maps), from_(from), to_(to) {}
  void operator()(osg::RenderInfo& info) const override {
    const osg::Texture::TextureObject* texture = maps_->getTextureObject(info.getContextID());
    if (!texture) return;
    const int size = maps_->getTextureWidth();
    glCopyImageSubData(texture->id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, from_, texture->id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0,
                       to_, size, size, 1);
  }

 private:
  osg::observer_ptr<osg::Texture2DArray> maps_;
  int from_, to_;
};

osg::ref_ptr<osg::Texture2DArray> mapTexture(int size, int layers) {
  osg::ref_ptr<osg::Texture2DArray> maps = new osg::Texture2DArray;
  maps->setName("shadow maps");
  maps->setTextureSize(size, size, layers);
  maps->setInternalFormat(GL_DEPTH_COMPONENT32F);
  maps->setSourceFormat(GL_DEPTH_COMPONENT);
  maps->setSourceType(GL_FLOAT);
  // Four texels are compared, and what comes of it is blended.
  maps->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR);
  maps->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  maps->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  maps->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  maps->setShadowComparison(true);
  maps->setShadowCompareFunc(osg::Texture::GEQUAL);
  maps->setShadowTextureMode(osg::Texture::LUMINANCE);
  return maps;
}

osg::ref_ptr<osg::Camera> mapCamera(osg::Texture2DArray* maps, int layer, int order, bool clears) {
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;
  camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  camera->setCullingMode(osg::CullSettings::NO_CULLING);
  camera->setCullingActive(false);
  camera->setRenderOrder(osg::Camera::PRE_RENDER, order);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setImplicitBufferAttachmentMask(0, 0);
  camera->attach(osg::Camera::DEPTH_BUFFER, maps, 0, static_cast<unsigned>(layer));
  camera->setDrawBuffer(GL_NONE);
  camera->setReadBuffer(GL_NONE);
  camera->setViewport(0, 0, maps->getTextureWidth(), maps->getTextureHeight());
  camera->setClearMask(clears ? GL_DEPTH_BUFFER_BIT : 0);
  camera->setClearDepth(0);  // reversed: the end away from the sun
  camera->setAllowEventFocus(false);
  osg::StateSet* states = camera->getOrCreateStateSet();
  states->setAttributeAndModes(new osg::PolygonOffset(-kSlopes, 0));
  // What is nearer to the sun than the map's depth begins still throws its shadow.
  states->setMode(GL_DEPTH_CLAMP, osg::StateAttribute::ON);
  // Surfaces are seen from both sides: not all that is imported is closed.
  states->setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK),
                               osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
  camera->setNodeMask(0);
  return camera;
}

osg::ref_ptr<osg::StateSet> casterStates(std::string_view vertexFile, std::string_view fragmentFile,
                                         std::vector<std::string> defines, const char* name) {
  osg::ref_ptr<osg::StateSet> states = new osg::StateSet;
  states->setName(name);
  defines.emplace_back("ITEM_ID");
  states->setAttributeAndModes(programOf(vertexFile, fragmentFile, std::move(defines)));
  return states;
}

class ShadowMaps : public Feature {
 public:
  ShadowMaps(const city::City& city, const SceneParts& parts, osg::StateSet& shared)
      : Feature("shadow maps"), people_(parts.people) {
    const auto count = static_cast<int>(parts.cascades);
    const int layers = count + (people_ ? 1 : 0);
    maps_ = mapTexture(parts.shadowTexels, layers);
    gpuBytes_ = static_cast<uint64_t>(layers) * sizeof(float) * static_cast<uint64_t>(parts.shadowTexels) *
                static_cast<uint64_t>(parts.shadowTexels);
    addPass(PassId::ShadowMaps);

    std::vector<Content> contents;
    const std::vector<uint8_t>& cutOut = parts.textures->cutOut;
    const auto add = [&](const char* name, Casters casters) {
      contents.push_back({name, std::make_shared<CasterBuffers>(std::move(casters))});
      gpuBytes_ += contents.back().buffers->bytes();
    };
    if (!city.buildings.empty()) add("buildings", buildingCasters(city, *parts.tiles, cutOut));
    if (!city.trees.empty()) add("trees", treeCasters(city, *parts.tiles, cutOut));
    if (!city.monuments.empty()) add("monuments", monumentCasters(city, *parts.tiles, cutOut));
    std::vector<std::string> withHoles = parts.textures->defines;
    withHoles.emplace_back("CUT_OUT");
    const auto opaque = casterStates("caster.vert", "caster.frag", {}, "casters"),
               cut = casterStates("caster.vert", "surface.frag", withHoles, "casters with holes"),
               ground = casterStates("caster_ground.vert", "caster.frag", {}, "ground that throws shadows");
    if (city.terrain && !city.terrain->empty()) ground_ = std::make_shared<GroundCaster>(*city.terrain);
    if (ground_) gpuBytes_ += ground_->bytes();

    for (int k = 0; k < count; ++k) {
      Cascade& cascade = cascades_.emplace_back();
      cascade.tiles = std::make_shared<TileTable>(tileBases(city));
      // The first map without its people lies in the layer after the last.
      cascade.camera = mapCamera(maps_, k == 0 && people_ ? count : k, k, true);
      cascade.camera->setName("shadow maps/cascade " + std::to_string(k));
      cascade.camera->getOrCreateStateSet()->addUniform(cascade.clipFromCentre);
      for (const Content& c : contents)
        for (const ArenaPart part : {ArenaPart::Opaque, ArenaPart::CutOut}) {
          if (!c.buffers->casters().has(part)) continue;
          osg::ref_ptr<CasterDrawable> drawable = new CasterDrawable(c.buffers, cascade.tiles, part);
          drawable->setName(std::string(c.name) + (part == ArenaPart::CutOut ? " cut-out" : ""));
          drawable->setStateSet(part == ArenaPart::CutOut ? cut : opaque);
          cascade.camera->addChild(drawable);
          cascade.drawables.emplace_back(c.name, drawable);
        }
      if (ground_) {
        cascade.ground = new GroundCasterDrawable(ground_);
        cascade.ground->setName("ground");
        cascade.ground->setStateSet(ground);
        cascade.camera->getOrCreateStateSet()->addUniform(cascade.fieldFromCentre);
        cascade.camera->addChild(cascade.ground);
      }
      node_->addChild(cascade.camera);
    }
    if (people_) addPeople(city, parts, count);

    fit_ = new osg::Uniform(osg::Uniform::FLOAT_VEC4, "shadowFit", count);
    reach2_ = new osg::Uniform(osg::Uniform::FLOAT, "shadowReach2", count);
    shared.setTextureAttribute(kShadowUnit, maps_);
    shared.addUniform(new osg::Uniform("shadowMaps", static_cast<int>(kShadowUnit)));
    for (osg::Uniform* u : {fit_.get(), reach2_.get(), depth_.get(), lightFromWorld_.get()}) shared.addUniform(u);
    // Nothing is in shadow before the first plan.
    for (int k = 0; k < count; ++k) reach2_->setElement(static_cast<unsigned>(k), -1.0F);
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    DrawCounts counts;
    for (size_t k = 0; k < cascades_.size(); ++k) {
      Cascade& cascade = cascades_[k];
      const city::ShadowPlan* wanted = k < plan.shadows.size() ? plan.shadows[k].get() : nullptr;
      cascade.wanted = wanted != nullptr;
      const auto index = static_cast<unsigned>(k);
      reach2_->setElement(index, wanted ? static_cast<float>(wanted->view.reach * wanted->view.reach) : -1.0F);
      if (!wanted) continue;
      const city::ShadowView& view = wanted->view;
      fitTo(view, plan.view.eye, index);
      if (!cascade.drawn || cascade.centre != view.centre || cascade.halfExtent != view.halfExtent)
        counts.triangles += take(cascade, *wanted);
      if (k == 0 && people_) placePeople(view, plan.view.eye);
    }
    counts.textureBinds = 1;
    return counts;
  }

  void show(Variant variant) override {
    const bool colour = variant == Variant::Colour;
    bool firstIsNew = false;
    for (size_t k = 0; k < cascades_.size(); ++k) {
      Cascade& cascade = cascades_[k];
      const bool draws = colour && cascade.wanted && !cascade.drawn;
      cascade.camera->setNodeMask(draws ? ~0U : 0U);
      cascade.drawn = cascade.drawn || draws;
      if (k == 0) firstIsNew = draws;
    }
    if (!people_) return;
    // Whose shadow may fall within the first map: who stands in it, or a long shadow away.
    const bool somebody = people_->throwWithin(static_cast<float>(1.25 * cascades_[0].halfExtent)) > 0;
    const bool draws = colour && cascades_[0].wanted && (somebody || hadPeople_ || firstIsNew);
    peopleCamera_->setNodeMask(draws ? ~0U : 0U);
    if (draws) hadPeople_ = somebody;
  }

 private:
  struct Content {
    const char* name;
    std::shared_ptr<CasterBuffers> buffers;
  };
  struct Cascade {
    osg::ref_ptr<osg::Camera> camera;
    std::shared_ptr<TileTable> tiles;  ///< from the centre
    std::vector<std::pair<std::string_view, osg::ref_ptr<CasterDrawable>>> drawables;
    osg::ref_ptr<GroundCasterDrawable> ground;
    osg::ref_ptr<osg::Uniform> clipFromCentre = new osg::Uniform("clipFromCentre", osg::Matrixf());
    osg::ref_ptr<osg::Uniform> fieldFromCentre = new osg::Uniform("fieldFromCentre", osg::Vec3f());
    glm::dvec3 centre{0};
    double halfExtent = 0;
    bool wanted = false, drawn = false;
  };

  void addPeople(const city::City& city, const SceneParts&, int count) {
    peopleCamera_ = mapCamera(maps_, 0, count, false);
    peopleCamera_->setName("shadow maps/people");
    peopleCamera_->setPreDrawCallback(new CopyLayer(maps_, count, 0));
    osg::ref_ptr<AvatarDrawable> bodies = new AvatarDrawable(people_, AvatarPart::ThrowingBodies);
    bodies->setName("bodies");
    const std::vector<std::string> defines = {"DRESSES 1",
                                              "CHARACTERS " + std::to_string(city.people.characters.size())};
    bodies->setStateSet(casterStates("avatar.vert", "avatar.frag", defines, "people who throw shadows"));
    peopleCamera_->getOrCreateStateSet()->addUniform(clipFromEye_);
    peopleCamera_->addChild(bodies);
    node_->addChild(peopleCamera_);
  }

  /// Where a surface looks itself up: light's axes from the eye to the map's.
  void fitTo(const city::ShadowView& view, const glm::dvec3& eye, unsigned index) {
    const glm::dvec3 fromCentre = view.lightFromWorld * (eye - view.centre);
    const double texel = 2 * view.halfExtent / maps_->getTextureWidth();
    const glm::dvec4 fit(0.5 / view.halfExtent, 0.5 + 0.5 * fromCentre.x / view.halfExtent,
                         0.5 + 0.5 * fromCentre.y / view.halfExtent,
                         0.5 + 0.5 * (fromCentre.z + kTexels * texel) / view.halfDepth);
    fit_->setElement(index, osg::Vec4f(static_cast<float>(fit.x), static_cast<float>(fit.y), static_cast<float>(fit.z),
                                       static_cast<float>(fit.w)));
    depth_->set(static_cast<float>(0.5 / view.halfDepth));
    osg::Matrix3 m;
    const glm::mat3 rotation(view.lightFromWorld);
    std::copy(glm::value_ptr(rotation), glm::value_ptr(rotation) + 9, m.ptr());
    lightFromWorld_->set(m);
  }

  /// Writes a cascade's draws; returns their triangles.
  uint64_t take(Cascade& cascade, const city::ShadowPlan& plan) {
    cascade.centre = plan.view.centre, cascade.halfExtent = plan.view.halfExtent, cascade.drawn = false;
    cascade.tiles->moveTo(plan.view.centre);
    cascade.clipFromCentre->set(toOsg(glm::mat4(plan.view.clipFromRelative())));
    std::vector<city::Range> monuments;
    for (const uint32_t m : plan.monuments) monuments.push_back({m, 1});
    uint64_t triangles = 0;
    for (const auto& [name, drawable] : cascade.drawables)
      triangles += drawable->take(name == "buildings" ? plan.buildings.drawn
                                  : name == "trees"   ? plan.trees.drawn
                                                      : monuments);
    if (cascade.ground) {
      cascade.ground->setNodeMask(plan.ground ? ~0U : 0U);
      cascade.fieldFromCentre->set(toOsg(glm::vec3(ground_->middle() - plan.view.centre)));
      triangles += plan.ground ? ground_->triangles() : 0;
    }
    return triangles;
  }

  void placePeople(const city::ShadowView& view, const glm::dvec3& eye) {
    glm::dmat4 toCentre(1);
    toCentre[3] = glm::dvec4(eye - view.centre, 1);
    clipFromEye_->set(toOsg(glm::mat4(view.clipFromRelative() * toCentre)));
  }

  std::shared_ptr<AvatarBuffers> people_;
  std::shared_ptr<GroundCaster> ground_;
  osg::ref_ptr<osg::Texture2DArray> maps_;
  std::vector<Cascade> cascades_;
  osg::ref_ptr<osg::Camera> peopleCamera_;
  bool hadPeople_ = false;
  osg::ref_ptr<osg::Uniform> clipFromEye_ = new osg::Uniform("clipFromEyeRelative", osg::Matrixf());
  osg::ref_ptr<osg::Uniform> fit_, reach2_;
  osg::ref_ptr<osg::Uniform> depth_ = new osg::Uniform("shadowDepth", 0.0F);
  osg::ref_ptr<osg::Uniform> lightFromWorld_ = new osg::Uniform("lightFromWorld", osg::Matrix3());
};

}  // namespace

std::unique_ptr<Feature> makeShadowMaps(const city::City& city, const SceneParts& parts, osg::StateSet& shared) {
  return std::make_unique<ShadowMaps>(city, parts, shared);
}

}  // namespace vicus::scenegraph
