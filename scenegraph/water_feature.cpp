#include <cmath>
#include <numbers>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/Texture2D>

#include "city/random.hpp"
#include "scenegraph/features.hpp"
#include "scenegraph/glm_osg.hpp"

namespace vicus::scenegraph {
namespace {

/// A tileable picture of the slope of ripples: waves of whole periods in many directions. 0.5 is level.
osg::ref_ptr<osg::Texture2D> rippleTexture() {
  constexpr int kSize = 128, kWaves = 24;
  city::Random random(7);
  struct Wave {
    glm::vec2 periods;
    float phase, steepness;
  };
  std::vector<Wave> waves;
  for (int w = 0; w < kWaves; ++w) {
    const glm::vec2 periods(std::round(random.uniform(-9, 9)), std::round(random.uniform(-9, 9)));
    waves.push_back(
        {periods, static_cast<float>(random.uniform(0, 2 * std::numbers::pi)), 1 / (2 + glm::length(periods))});
  }
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(kSize, kSize, 1, GL_RGBA, GL_UNSIGNED_BYTE);
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      glm::vec2 slope(0);
      for (const Wave& w : waves) {
        const float turn =
            2 * std::numbers::pi_v<float> * glm::dot(w.periods, glm::vec2(x, y) / static_cast<float>(kSize)) + w.phase;
        slope += w.steepness * w.periods / (1 + glm::length(w.periods)) * std::cos(turn);
      }
      unsigned char* p = image->data(x, y);
      for (int k = 0; k < 2; ++k) p[k] = static_cast<uint8_t>(std::clamp(127.5f + 100 * slope[k], 0.0f, 255.0f));
      p[2] = 0, p[3] = 255;
    }
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setName("ripples");
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  return texture;
}

class Water : public Feature {
 public:
  explicit Water(const city::City& city) : Feature("water") {
    const SurfaceStates states = surfaceStates(PassId::Water, "water.vert", "water.frag", {});
    states.of(Variant::Colour)->setTextureAttributeAndModes(kRippleUnit, rippleTexture());
    for (size_t i = 0; i < city.water.size(); ++i) {
      const city::WaterBody& body = city.water[i];
      if (body.points.empty() || body.indices.empty()) continue;
      glm::dvec2 lo = body.points[0], hi = body.points[0];
      for (const glm::dvec2& p : body.points) lo = glm::min(lo, p), hi = glm::max(hi, p);
      const glm::dvec2 centre = 0.5 * (lo + hi);
      osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
      for (const glm::dvec2& p : body.points) positions->push_back(toOsg(glm::vec3(glm::dvec3(p - centre, 0))));
      osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
      geometry->setName("surface");
      geometry->setVertexAttribArray(0, positions, osg::Array::BIND_PER_VERTEX);
      geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, body.indices.begin(), body.indices.end()));
      useBuffers(*geometry);
      osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
      place->setName("water/" + (body.name.empty() ? std::to_string(i) : body.name));
      place->setMatrix(osg::Matrixd::translate(toOsg(glm::dvec3(centre, body.level))));
      place->addChild(geometry);
      node_->addChild(place);
      addSurface(geometry, states, PassId::Water);
      cost_.drawCalls += 1;
      cost_.triangles += body.indices.size() / 3;
      gpuBytes_ += positions->getTotalDataSize() + body.indices.size() * sizeof(uint32_t);
    }
    cost_.textureBinds = 1;
  }
  DrawCounts apply(const city::FramePlan&) override { return cost_; }

 private:
  DrawCounts cost_;
};

}  // namespace

std::unique_ptr<Feature> makeWater(const city::City& city) {
  return std::make_unique<Water>(city);
}

}  // namespace vicus::scenegraph
