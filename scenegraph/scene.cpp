#include "scenegraph/gl.hpp"

#include "scenegraph/scene.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <osg/ClipControl>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/Image>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <sstream>

#include "plan/shadows.hpp"
#include "scenegraph/features.hpp"
#include "scenegraph/glm_osg.hpp"
#include "scenegraph/ground_map.hpp"
#include "scenegraph/light.hpp"
#include "scenegraph/passes.hpp"

namespace vicus::scenegraph {
namespace {

constexpr city::Knob kKnobs[] = {
    {"state_ordering", 1, 0, 1, "on/off", "Binds each texture array once and draws each group of tiles with one call.",
     "off: one bind and one call for each wall", "on: the default"},
    {"textures.budget_mb", 256, 1, 16384, "MB", "Most memory that material textures take on the graphics card.",
     "blurred walls", "memory that other parts miss"},
    {"textures.anisotropy", 0, 0, 16, "samples",
     "Texture samples along a slanted surface; 0 chooses 8 on a graphics card and 1 on software GL.",
     "1: streets blur into the distance", "slow on software GL"},
    {"ground.map_size", 2048, 64, 8192, "pixels", "Largest side of the picture that colours the terrain.",
     "streets without edges", "a slower start and four bytes for each pixel"},
};

/// How many shadow maps the plans of this city come with.
size_t cascadesOf(const city::City& city, const city::Knobs& knobs) {
  return knobs.has("shadows.cascades") ? plan::cascadeCount(city, knobs) : 0;
}

/// The picture over the terrain, null where there is none.
osg::ref_ptr<osg::Texture2D> groundMapTexture(const city::City& city, int largest, bool sunFromMaps) {
  if (!city.terrain || city.terrain->empty()) return nullptr;
  const Light light = lightOf(city.environment);
  const int size = groundMapSize(city.terrain->extent(), largest);
  const GroundMap map = paintGroundMap(*city.terrain, city.groundCover ? &*city.groundCover : nullptr, size,
                                       shadeGround(city, light.sunDirection, size), light, sunFromMaps);
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(map.size, map.size, 1, GL_RGBA, GL_UNSIGNED_BYTE);
  std::copy(map.rgba.begin(), map.rgba.end(), image->data());
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setName("ground map");
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setUnRefImageDataAfterApply(true);
  return texture;
}

constexpr int kGroundDetailSize = 512;  // texels

/// The pages with the pictures of houses' walls; `plan` must outlive what it returns.
PageRequest pagesOf(const city::City& city, const houselod::TexturePlan& plan) {
  PageRequest request;
  request.pages = plan.pages;
  request.bake = [&](uint32_t page, std::span<const houselod::BakedFrom> materials, std::span<uint8_t> texels) {
    for (const houselod::PlanePicture& picture : plan.pictures)
      if (picture.page == page)
        houselod::bakePicture(city.buildingTypes[picture.type], plan, picture, materials, texels);
  };
  return request;
}

/// Uniforms of the shared shader files, set once (light) or each frame (view).
struct FrameUniforms {
  osg::ref_ptr<osg::Uniform> clipFromEyeRelative = new osg::Uniform("clipFromEyeRelative", osg::Matrixf());
  osg::ref_ptr<osg::Uniform> eyeRelativeFromClip = new osg::Uniform("eyeRelativeFromClip", osg::Matrixf());
  osg::ref_ptr<osg::Uniform> worldFromEye = new osg::Uniform("worldFromEye", osg::Matrix3());
  osg::ref_ptr<osg::Uniform> time = new osg::Uniform("time", 0.0f);
  osg::ref_ptr<osg::Uniform> slidePerMetre = new osg::Uniform("slidePerMetre", 0.0f);

  void addTo(osg::StateSet& states) const {
    for (const auto& u : {clipFromEyeRelative, eyeRelativeFromClip, worldFromEye, time, slidePerMetre})
      states.addUniform(u);
  }
};

void addLight(osg::StateSet& states, const Light& light) {
  const auto add = [&](const char* name, const glm::vec3& v) { states.addUniform(new osg::Uniform(name, toOsg(v))); };
  add("sunDirection", light.sunDirection);
  add("sunLight", light.sun);
  add("skyLight", light.sky);
  add("bounceLight", light.bounce);
  add("zenithRadiance", light.zenith);
  add("horizonRadiance", light.horizon);
  add("glowRadiance", light.glow);
  states.addUniform(new osg::Uniform("hazeDensity", light.hazeDensity));
}

/// Writes one line for each node: name, class, counts.
class GraphWriter : public osg::NodeVisitor {
 public:
  GraphWriter() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }

  void apply(osg::Node& node) override {
    line(node, "");
    ++depth_;
    traverse(node);
    --depth_;
  }
  void apply(osg::Group& group) override {
    line(group, group.getNumChildren() == 1 ? "1 child" : std::to_string(group.getNumChildren()) + " children");
    ++depth_;
    traverse(group);
    --depth_;
  }
  void apply(osg::Transform& transform) override { apply(static_cast<osg::Group&>(transform)); }
  void apply(osg::Drawable& drawable) override {
    const osg::Geometry* geometry = drawable.asGeometry();
    size_t triangles = 0;
    for (unsigned i = 0; geometry && i < geometry->getNumPrimitiveSets(); ++i)
      triangles += geometry->getPrimitiveSet(i)->getNumIndices() / 3;
    const auto* arena = dynamic_cast<const ArenaDrawable*>(&drawable);
    line(drawable, geometry ? std::to_string(triangles) + " triangles"
                   : arena  ? std::to_string(arena->instanceCount()) + " instances"
                            : "");
  }

  std::string text() const { return out_.str(); }

 private:
  void line(const osg::Node& node, const std::string& count) {
    out_ << std::string(2 * static_cast<size_t>(depth_), ' ') << node.getName() << " (" << node.className();
    if (!count.empty()) out_ << ", " << count;
    out_ << ")\n";
  }
  std::ostringstream out_;
  int depth_ = 0;
};

}  // namespace

DrawCounts& DrawCounts::operator+=(const DrawCounts& more) {
  triangles += more.triangles;
  terrainTriangles += more.terrainTriangles;
  drawCalls += more.drawCalls;
  indirectCommands += more.indirectCommands;
  textureBinds += more.textureBinds;
  return *this;
}

std::span<const city::Knob> sceneKnobs() {
  static const std::vector<city::Knob> all = [] {
    std::vector<city::Knob> knobs(std::begin(kKnobs), std::end(kKnobs));
    knobs.insert(knobs.end(), houselod::pictureKnobs().begin(), houselod::pictureKnobs().end());
    return knobs;
  }();
  return all;
}

/// Grass, earth and stones as factors of the ground map's colour: each texel over its surroundings' mean, halved. What
/// is coarser than a sixteenth of a repeat belongs to the map: here it would show from the air as a pattern.
GroundDetail paintGroundDetail(city::Diagnostics& diagnostics) {
  constexpr int kSize = kGroundDetailSize, kCoarse = 16;
  std::vector<city::Material> materials;
  for (const char* name : {"grass", "earth", "cobbles"}) materials.push_back(assets::builtinMaterial(name));
  GroundDetail detail;
  for (const assets::Image& image : assets::materialImages(materials, diagnostics)) {
    LayerLevels levels = mipLevels(image, kSize);
    const std::vector<uint8_t> coarse = levels[std::countr_zero(unsigned{kSize / kCoarse})];
    for (int size = kSize, at = 0; size > 0; size /= 2, ++at) {
      std::vector<uint8_t>& level = levels[static_cast<size_t>(at)];
      level =
          size <= kCoarse ? std::vector<uint8_t>(level.size(), 128) : overSurroundings(level, size, coarse, kCoarse);
    }
    detail.layers.push_back(std::move(levels));
  }
  return detail;
}

struct Scene::Impl {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  std::vector<std::unique_ptr<Feature>> features;
  std::shared_ptr<TileTable> tiles;
  FrameUniforms uniforms;
  DrawCounts counts;
  std::vector<std::string> applyNames;  ///< one for each feature
  std::vector<city::StageTime> applyTimes;
  uint64_t sharedBinds = 0;  ///< textures on the root, each bound once a frame
  uint64_t sharedBytes = 0;
  glm::dmat4 eyeFromWorld{1}, clipFromEye{1};
  bool madeForHouseLod = true;
};

Scene::Scene(const city::City& city, const city::Knobs& knobs, city::Diagnostics& diagnostics,
             const assets::Progress& progress, GroundDetail groundDetail,
             std::shared_ptr<const houselod::HouseTypes> houses)
    : impl_(std::make_unique<Impl>()) {
  Impl& s = *impl_;
  s.root->setName("root");
  s.tiles = std::make_shared<TileTable>(tileBases(city));

  const double anisotropy = knobs["textures.anisotropy"];
  SceneParts parts;
  // Without house LOD nothing is ever flat.
  s.madeForHouseLod = !knobs.has("house_lod") || knobs.on("house_lod");
  if (s.madeForHouseLod && !city.buildings.empty())
    parts.houses = houses
                       ? std::move(houses)
                       : std::make_shared<const houselod::HouseTypes>(houselod::lookAtTypes(city.buildingTypes, knobs));
  const houselod::TexturePlan noPictures;
  const auto textures = std::make_shared<const MaterialTextures>(
      makeMaterialTextures(city.materials, static_cast<uint64_t>(knobs["textures.budget_mb"]) << 20, anisotropy,
                           diagnostics, progress, pagesOf(city, parts.houses ? parts.houses->pictures : noPictures)));
  parts.tiles = s.tiles;
  parts.textures = textures;
  parts.ordering = knobs.on("state_ordering") ? Ordering::ByState : Ordering::Scene;
  parts.cascades = cascadesOf(city, knobs);
  if (parts.cascades > 0) parts.shadowTexels = static_cast<int>(knobs["shadows.size"]);
  parts.groundMap = groundMapTexture(city, static_cast<int>(knobs["ground.map_size"]), parts.cascades > 0);

  if (!city.people.empty() && knobs.on("avatars.shown"))
    parts.people = std::make_shared<AvatarBuffers>(city.people.characters);

  // The scene's one composition: what the city has, in the order of the passes.
  const bool hasTerrain = city.terrain && !city.terrain->empty();
  if (!city.buildings.empty()) s.features.push_back(makeBuildings(city, parts));
  if (!city.monuments.empty()) s.features.push_back(makeMonuments(city, parts));
  if (!city.trees.empty()) s.features.push_back(makeTrees(city, parts));
  if (parts.people) s.features.push_back(makeAvatars(city, parts));
  if (hasTerrain) s.features.push_back(makeTerrain(city, parts));
  s.features.push_back(makeGround(city, parts));
  s.features.push_back(makeSky());
  if (!city.water.empty()) s.features.push_back(makeWater(city));
  osg::StateSet& states = *s.root->getOrCreateStateSet();
  if (parts.cascades > 0) s.features.push_back(makeShadowMaps(city, parts, states));
  for (const auto& feature : s.features) s.root->addChild(feature->node());
  for (const auto& feature : s.features) s.applyNames.push_back("apply " + feature->name());
  for (const std::string& name : s.applyNames) s.applyTimes.push_back({name, 0});

  states.setAttributeAndModes(new osg::Depth(osg::Depth::GREATER, 0, 1, true));
  states.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
  states.setAttributeAndModes(new osg::ClipControl(osg::ClipControl::LOWER_LEFT, osg::ClipControl::ZERO_TO_ONE));
  s.uniforms.addTo(states);
  addLight(states, lightOf(city.environment));

  const bool usesMaterials = !city.buildings.empty() || !city.monuments.empty() || !city.trees.empty();
  if (usesMaterials) {
    for (unsigned i = 0; i < textures->arrays.size(); ++i) {
      states.setTextureAttribute(i, textures->arrays[i]);
      states.addUniform(new osg::Uniform(("materialClass" + std::to_string(i)).c_str(), static_cast<int>(i)));
    }
    states.setAttribute(textures->table);
    s.sharedBinds += textures->arrays.size();
    s.sharedBytes += textures->bytes;
  }
  if (groundDetail.layers.empty()) groundDetail = paintGroundDetail(diagnostics);
  const auto detail =
      textureArray("ground detail", kGroundDetailSize, true, std::move(groundDetail.layers), anisotropy);
  states.setTextureAttribute(kGroundDetailUnit, detail);
  states.addUniform(new osg::Uniform("groundDetail", static_cast<int>(kGroundDetailUnit)));
  states.addUniform(new osg::Uniform("detailRepeats", static_cast<float>(1 / kGroundDetailMetres)));
  s.sharedBinds += 1;
  s.sharedBytes += 3 * layerBytes(detail->getTextureWidth());
  if (parts.groundMap) {
    states.setTextureAttribute(kGroundMapUnit, parts.groundMap);
    states.addUniform(new osg::Uniform("groundMap", static_cast<int>(kGroundMapUnit)));
    s.sharedBinds += 1;
    s.sharedBytes += layerBytes(parts.groundMap->getImage()->s());
  }
  if (!city.water.empty()) states.addUniform(new osg::Uniform("ripples", static_cast<int>(kRippleUnit)));

  // The plan decides what is drawn; nothing may be dropped for its bounds.
  s.root->setCullingActive(false);
  s.root->setInitialBound(osg::BoundingSphere(osg::Vec3d(), 1e9));
}

Scene::~Scene() = default;

bool Scene::madeForHouseLod() const {
  return impl_->madeForHouseLod;
}

osg::Group* Scene::root() const {
  return impl_->root;
}

void Scene::apply(const city::FramePlan& plan, Variant variant, const PictureWindow& window) {
  Impl& s = *impl_;
  const city::ViewState& view = plan.view;

  // The piece of the picture that is drawn, then the matrices from it.
  glm::dmat4 piece(1);
  piece[0][0] = window.scale.x, piece[1][1] = window.scale.y;
  piece[3][0] = window.offset.x, piece[3][1] = window.offset.y;
  const glm::dmat3 rotation = city::eyeFromWorldRotation(view);
  s.clipFromEye = piece * city::clipFromEye(view);
  glm::dmat4 toEye(1);
  toEye[3] = glm::dvec4(-view.eye, 1);
  s.eyeFromWorld = glm::dmat4(rotation) * toEye;
  const glm::dmat4 clipFromEyeRelative = s.clipFromEye * glm::dmat4(rotation);
  s.uniforms.clipFromEyeRelative->set(toOsg(glm::mat4(clipFromEyeRelative)));
  s.uniforms.eyeRelativeFromClip->set(toOsg(glm::mat4(glm::inverse(clipFromEyeRelative))));
  const glm::mat3 worldFromEye(glm::transpose(rotation));
  osg::Matrix3 m;
  std::copy(glm::value_ptr(worldFromEye), glm::value_ptr(worldFromEye) + 9, m.ptr());
  s.uniforms.worldFromEye->set(m);
  s.uniforms.time->set(static_cast<float>(std::isfinite(view.time) ? std::fmod(view.time, 3600.0) : 0.0));
  s.uniforms.slidePerMetre->set(static_cast<float>(plan.houseLod.inverseScalar));
  s.tiles->moveTo(view.eye);

  s.counts = {};
  s.counts.textureBinds = s.sharedBinds;
  for (size_t k = 0; k < s.features.size(); ++k) {
    const auto begin = std::chrono::steady_clock::now();
    s.counts += s.features[k]->apply(plan);
    s.features[k]->show(variant);
    s.applyTimes[k].milliseconds =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
}

const glm::dmat4& Scene::eyeFromWorld() const {
  return impl_->eyeFromWorld;
}

const glm::dmat4& Scene::clipFromEye() const {
  return impl_->clipFromEye;
}

const DrawCounts& Scene::counts() const {
  return impl_->counts;
}

std::span<const city::StageTime> Scene::applyTimes() const {
  return impl_->applyTimes;
}

uint64_t Scene::gpuBytes() const {
  uint64_t sum = impl_->sharedBytes;
  for (const auto& feature : impl_->features) sum += feature->gpuBytes();
  return sum;
}

std::string Scene::describeGraph() const {
  GraphWriter writer;
  impl_->root->accept(writer);
  return writer.text();
}

std::vector<std::string> Scene::featureNames() const {
  std::vector<std::string> names;
  for (const auto& feature : impl_->features) names.push_back(feature->name());
  return names;
}

std::vector<std::string> Scene::passNames() const {
  std::vector<std::string> names;
  for (const Pass& p : kPasses)
    for (const auto& feature : impl_->features)
      if (std::find(feature->passes().begin(), feature->passes().end(), p.id) != feature->passes().end()) {
        names.emplace_back(p.name);
        break;
      }
  return names;
}

}  // namespace vicus::scenegraph
