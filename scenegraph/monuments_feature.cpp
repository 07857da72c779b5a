#include <map>
#include <osg/MatrixTransform>

#include "scenegraph/features.hpp"
#include "scenegraph/glm_osg.hpp"

namespace vicus::scenegraph {
namespace {

/// The triangles of one part of a mesh; null where it has none. The meshes' vertices go in the arrays of
/// shaders/vertex.glsl.
osg::ref_ptr<osg::Geometry> geometryOf(const city::TriangleMesh& mesh, ArenaPart part,
                                       const std::vector<uint8_t>& cutOut) {
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const city::MaterialId material = mesh.vertices[mesh.indices[i]].material;
    const bool holes = material < cutOut.size() && cutOut[material] != 0;
    if (holes == (part == ArenaPart::CutOut))
      triangles->insert(triangles->end(), &mesh.indices[i], &mesh.indices[i] + 3);
  }
  if (triangles->empty()) return nullptr;

  osg::ref_ptr<osg::Vec3Array> positions = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec2Array> uvs = new osg::Vec2Array;
  osg::ref_ptr<osg::Vec2sArray> normals = new osg::Vec2sArray;
  osg::ref_ptr<osg::Vec2usArray> materials = new osg::Vec2usArray;
  for (const city::Vertex& v : mesh.vertices) {
    positions->push_back(toOsg(v.position));
    uvs->push_back({v.uv.x, v.uv.y});
    normals->push_back({static_cast<int16_t>(v.normal & 0xffffu), static_cast<int16_t>(v.normal >> 16)});
    materials->push_back({v.material, v.item});
  }
  normals->setNormalize(true);
  materials->setPreserveDataType(true);
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexAttribArray(0, positions, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(1, uvs, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(2, normals, osg::Array::BIND_PER_VERTEX);
  geometry->setVertexAttribArray(3, materials, osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(triangles);
  useBuffers(*geometry);
  return geometry;
}

/// Ordinary subgraphs: one geometry for each mesh and part, shared by all monuments of that mesh, under a transform
/// each.
class Monuments : public Feature {
 public:
  Monuments(const city::City& city, const SceneParts& parts) : Feature("monuments") {
    std::map<uint32_t, Mesh> meshes;
    for (uint32_t i = 0; i < city.monuments.size(); ++i) {
      const city::Monument& m = city.monuments[i];
      auto [it, isNew] = meshes.try_emplace(m.mesh);
      Mesh& mesh = it->second;
      if (isNew) addMesh(mesh, city.meshes[m.mesh], parts);

      osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
      place->setName("monuments/" + (m.name.empty() ? std::to_string(i) : m.name));
      place->setMatrix(osg::Matrixd::rotate(static_cast<double>(m.heading), osg::Vec3d(0, 0, 1)) *
                       osg::Matrixd::translate(toOsg(m.position)));
      place->getOrCreateStateSet()->addUniform(new osg::Uniform("itemId", city.itemOfMonument(i)));
      for (const auto& geometry : mesh.geometries) place->addChild(geometry);
      node_->addChild(place);
      cost_.push_back(mesh.cost);
    }
  }

  DrawCounts apply(const city::FramePlan& plan) override {
    for (unsigned i = 0; i < node_->getNumChildren(); ++i) node_->getChild(i)->setNodeMask(0);
    DrawCounts counts;
    for (const uint32_t i : plan.monuments) {
      node_->getChild(i)->setNodeMask(~0u);
      counts += cost_[i];
    }
    return counts;
  }

 private:
  struct Mesh {
    std::vector<osg::ref_ptr<osg::Geometry>> geometries;
    DrawCounts cost;
  };

  void addMesh(Mesh& mesh, const city::MeshGeometry& from, const SceneParts& parts) {
    for (const ArenaPart part : {ArenaPart::Opaque, ArenaPart::CutOut}) {
      const auto geometry = geometryOf(from.mesh, part, parts.textures->cutOut);
      if (!geometry) continue;
      const bool cutOut = part == ArenaPart::CutOut;
      geometry->setName(from.name + (cutOut ? " cut-out" : ""));
      SurfaceStates& states = cutOut ? cutOutStates_ : opaqueStates_;
      const PassId pass = cutOut ? PassId::CutOut : PassId::Opaque;
      if (!states.of(Variant::Colour)) {
        std::vector<std::string> defines = parts.textures->defines;
        for (const std::string& define : parts.lightDefines()) defines.push_back(define);
        if (cutOut) defines.emplace_back("CUT_OUT");
        states = surfaceStates(pass, "monument.vert", "surface.frag", defines);
      }
      addSurface(geometry, states, pass);
      mesh.geometries.push_back(geometry);
      mesh.cost.triangles += geometry->getPrimitiveSet(0)->getNumIndices() / 3;
      mesh.cost.drawCalls += 1;
      gpuBytes_ += from.mesh.vertices.size() * sizeof(city::Vertex) +
                   geometry->getPrimitiveSet(0)->getNumIndices() * sizeof(uint32_t);
    }
  }

  SurfaceStates opaqueStates_, cutOutStates_;
  std::vector<DrawCounts> cost_;
};

}  // namespace

std::unique_ptr<Feature> makeMonuments(const city::City& city, const SceneParts& parts) {
  return std::make_unique<Monuments>(city, parts);
}

}  // namespace vicus::scenegraph
