#include <gmock/gmock.h>

#include "assets/shaders/shaders.hpp"
#include "scenegraph/passes.hpp"

namespace vicus::scenegraph {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(ShaderSource, BeginsWithVersionAndDefines) {
  const std::vector<std::string> defines = {"CUT_OUT", "TEXTURE_CLASSES 2"};
  EXPECT_THAT(assets::shaderSource("surface.frag", defines),
              StartsWith("#version 430 compatibility\n#define CUT_OUT\n#define TEXTURE_CLASSES 2\n"));
}

TEST(ShaderSource, IncludesEachFileOnce) {
  const std::string source = assets::shaderSource("instance.vert", {});
  const std::string once = "Seen seen(";
  const size_t first = source.find(once);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(source.find(once, first + 1), std::string::npos);
  EXPECT_EQ(source.find("#include"), std::string::npos);
}

TEST(ShaderSource, AMissingFileIsSaid) {
  EXPECT_THAT(assets::shaderSource("no.frag", {}), HasSubstr("#error no shader file no.frag"));
  EXPECT_TRUE(assets::shaderText("no.frag").empty());
}

TEST(ShaderSource, EveryColouredSurfaceSharesTheLighting) {
  for (const char* file : {"surface.frag", "ground.frag", "water.frag", "sky.frag"})
    EXPECT_THAT(assets::shaderSource(file, {}), HasSubstr("vec3 displayed(vec3 light)")) << file;
}

TEST(Passes, AreListedInTheOrderDrawn) {
  for (size_t i = 0; i < kPasses.size(); ++i) {
    EXPECT_EQ(static_cast<size_t>(kPasses[i].id), i);
    if (i > 0) {
      EXPECT_GT(kPasses[i].bin, kPasses[i - 1].bin);
    }
  }
}

}  // namespace
}  // namespace vicus::scenegraph
