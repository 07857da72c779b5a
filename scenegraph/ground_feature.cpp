#include "scenegraph/features.hpp"
#include "scenegraph/glm_osg.hpp"
#include "scenegraph/ground_map.hpp"
#include "scenegraph/ground_mesh.hpp"

namespace vicus::scenegraph {
namespace {

class Ground : public Feature {
 public:
  Ground(const city::City& city, const SceneParts& parts) : Feature("ground") {
    GroundMesh mesh = groundMesh(city);
    centre_ = mesh.centre;
    followsEye_ = mesh.followsEye;

    osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
    osg::ref_ptr<osg::Vec2Array> uvs = new osg::Vec2Array;
    osg::ref_ptr<osg::FloatArray> beyond = new osg::FloatArray;
    for (const GroundVertex& v : mesh.vertices) {
      positions->push_back(toOsg(v.position));
      uvs->push_back({v.uv.x, v.uv.y});
      beyond->push_back(v.beyond);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setName(followsEye_ ? "ground/plane" : "ground/country beyond the terrain");
    geometry->setVertexAttribArray(0, positions, osg::Array::BIND_PER_VERTEX);
    geometry->setVertexAttribArray(1, uvs, osg::Array::BIND_PER_VERTEX);
    geometry->setVertexAttribArray(2, beyond, osg::Array::BIND_PER_VERTEX);
    geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES, mesh.indices.begin(), mesh.indices.end()));
    useBuffers(*geometry);
    node_->addChild(geometry);
    gpuBytes_ = mesh.vertices.size() * sizeof(GroundVertex) + mesh.indices.size() * sizeof(uint32_t);
    triangles_ = mesh.indices.size() / 3;

    osg::StateSet* states = node_->getOrCreateStateSet();
    states->addUniform(fromEye_);
    states->addUniform(detailUv_);
    const glm::vec4 country = countrysideTexel();
    states->addUniform(new osg::Uniform("countryside", osg::Vec4f(country.r, country.g, country.b, country.a)));
    std::vector<std::string> defines = parts.lightDefines();
    defines.emplace_back("BEYOND");
    if (parts.groundMap && !followsEye_) defines.emplace_back("GROUND_MAP");
    addSurface(geometry, surfaceStates(PassId::Ground, "ground.vert", "ground.frag", defines), PassId::Ground);
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    glm::dvec3 centre = centre_;
    if (followsEye_) centre.x = plan.view.eye.x, centre.y = plan.view.eye.y;
    fromEye_->set(toOsg(glm::vec3(centre - plan.view.eye)));
    const glm::vec2 uv(glm::fract(glm::dvec2(centre) / kGroundDetailMetres));
    detailUv_->set(osg::Vec2f(uv.x, uv.y));
    DrawCounts counts;
    counts.triangles = triangles_, counts.drawCalls = 1;
    return counts;
  }

 private:
  glm::dvec3 centre_;
  bool followsEye_;
  uint64_t triangles_;
  osg::ref_ptr<osg::Uniform> fromEye_ = new osg::Uniform("groundFromEye", osg::Vec3f());
  osg::ref_ptr<osg::Uniform> detailUv_ = new osg::Uniform("groundDetailUv", osg::Vec2f());
};

}  // namespace

std::unique_ptr<Feature> makeGround(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Ground>(city, parts);
}

}  // namespace vicus::scenegraph
