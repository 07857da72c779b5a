#include "assets/materials/wall_colours.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/materials/materials.hpp"

namespace vicus::assets {
namespace {

TEST(WallColours, AreTheMeansOfThePictures) {
  for (const std::string name : {"plaster", "limewash", "brick", "brick-dark", "ashlar", "rubble", "flint",
                                 "facade-limestone", "facade-plaster", "facade-brick"}) {
    city::Diagnostics diagnostics;
    const Image image = materialImage(builtinMaterial(name), diagnostics);
    // Below a facade's window there is only wall.
    const int rows = name.starts_with("facade") ? 100 : image.height;
    const size_t pixels = static_cast<size_t>(rows) * static_cast<size_t>(image.width);
    const std::optional<glm::vec3> colour = wallColour(name);
    ASSERT_TRUE(colour) << name;
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (size_t i = 0; i < pixels; ++i) {
        const double s = image.rgba[4 * i + static_cast<size_t>(c)] / 255.0;
        sum += s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
      }
      const double mean = sum / static_cast<double>(pixels);
      EXPECT_NEAR(static_cast<double>((*colour)[c]), mean, 0.02 * mean) << name << " channel " << c;
    }
  }
  EXPECT_FALSE(wallColour("glass"));
}

}  // namespace
}  // namespace vicus::assets
