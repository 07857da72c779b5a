#include "scenegraph/glm_osg.hpp"

#include <gmock/gmock.h>

namespace vicus::scenegraph {
namespace {

const glm::dmat4 kSkewed(1, 2, 3, 0, 4, 5, 7, 0, 8, 9, 11, 0, 13, 17, 19, 1);

TEST(GlmOsg, MatricesComeBackAsTheyWere) {
  EXPECT_EQ(toGlm(toOsg(kSkewed)), kSkewed);
}

TEST(GlmOsg, TheSameNumbersMeanTheSameTransform) {
  const glm::dvec4 p(1, 10, 100, 1);
  const osg::Vec4d moved = osg::Vec4d(p.x, p.y, p.z, p.w) * toOsg(kSkewed);
  const glm::dvec4 expected = kSkewed * p;
  for (int k = 0; k < 4; ++k) EXPECT_EQ(moved[k], expected[k]);
}

TEST(GlmOsg, ProductsAreWrittenTheOtherWayRound) {
  const glm::dmat4 other(2, 0, 1, 0, 0, 3, 0, 0, 5, 0, 1, 0, 1, 2, 3, 1);
  EXPECT_EQ(toGlm(toOsg(other) * toOsg(kSkewed)), kSkewed * other);
}

}  // namespace
}  // namespace vicus::scenegraph
