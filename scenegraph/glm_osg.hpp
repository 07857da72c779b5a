/// Between GLM and OpenSceneGraph: OpenSceneGraph multiplies row vectors and stores rows, GLM multiplies column vectors
/// and stores columns, so the same sixteen numbers mean the same transform and nothing is transposed.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <osg/Matrixd>
#include <osg/Matrixf>
#include <osg/Vec3d>
#include <osg/Vec3f>

namespace vicus::scenegraph {

inline osg::Matrixd toOsg(const glm::dmat4& m) {
  return osg::Matrixd(glm::value_ptr(m));
}
inline osg::Matrixf toOsg(const glm::mat4& m) {
  return osg::Matrixf(glm::value_ptr(m));
}
inline glm::dmat4 toGlm(const osg::Matrixd& m) {
  return glm::make_mat4(m.ptr());
}
inline osg::Vec3f toOsg(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}
inline osg::Vec3d toOsg(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace vicus::scenegraph
