#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>

#include "assets/materials/materials.hpp"

namespace vicus::assets {
namespace {

/// Each picture is made once for all tests.
const std::map<std::string, Image>& pictures() {
  static const std::map<std::string, Image> all = [] {
    std::map<std::string, Image> images;
    city::Diagnostics diagnostics;
    for (const std::string& name : builtinMaterialNames())
      images[name] = materialImage(builtinMaterial(name), diagnostics);
    EXPECT_TRUE(diagnostics.messages.empty());
    return images;
  }();
  return all;
}

const uint8_t* texel(const Image& image, int x, int y) {
  return image.rgba.data() + 4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x));
}

/// Mean sRGB values of the covered texels of a part of a picture.
std::array<double, 3> meanColour(const Image& image, int x0, int y0, int x1, int y1) {
  std::array<double, 3> sum{};
  double n = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const uint8_t* t = texel(image, x, y);
      if (t[3] == 0) continue;
      for (size_t c = 0; c < 3; ++c) sum[c] += t[c];
      n += 1;
    }
  for (double& v : sum) v /= n;
  return sum;
}

std::array<double, 3> meanColour(const Image& image) {
  return meanColour(image, 0, 0, image.width, image.height);
}

double brightness(const std::array<double, 3>& c) {
  return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/// Mean step of green from column x to the next (`across`) or from row to row.
double meanStep(const Image& image, int at, bool across) {
  const int n = across ? image.height : image.width;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const uint8_t* a = across ? texel(image, at, k) : texel(image, k, at);
    const uint8_t* b = across ? texel(image, (at + 1) % image.width, k) : texel(image, k, (at + 1) % image.height);
    sum += std::abs(a[1] * (a[3] / 255) - b[1] * (b[3] / 255));
  }
  return sum / n;
}

TEST(MaterialsBuiltin, AllNamesThatScenesRelyOnAreThere) {
  const std::vector<std::string> names = builtinMaterialNames();
  EXPECT_THAT(names, testing::IsSupersetOf({"plaster",
                                            "limewash",
                                            "brick",
                                            "brick-dark",
                                            "rubble",
                                            "ashlar",
                                            "flint",
                                            "timber",
                                            "oak",
                                            "planks",
                                            "tile",
                                            "slate",
                                            "thatch",
                                            "lead",
                                            "cobbles",
                                            "earth",
                                            "grass",
                                            "field",
                                            "garden",
                                            "bank",
                                            "water",
                                            "glass",
                                            "lead-glass",
                                            "door",
                                            "shutter",
                                            "bark",
                                            "leaves",
                                            "leaves-dark",
                                            "iron",
                                            "wool",
                                            "concrete",
                                            "facade-limestone",
                                            "facade-plaster",
                                            "facade-brick",
                                            "facade-plaster-shutters"}));
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
}

TEST(MaterialsBuiltin, NamesGoRound) {
  for (const std::string& name : builtinMaterialNames()) {
    const city::Material m = builtinMaterial(name);
    EXPECT_EQ(m.name, name);
    EXPECT_EQ(m.source, "builtin:" + name);
    EXPECT_TRUE(m.repeat);
    EXPECT_GT(m.metresPerRepeat.x, 0);
    EXPECT_LE(m.metresPerRepeat.y, 8);
    EXPECT_GE(m.specular, 0);
    EXPECT_LE(m.specular, 1);
    EXPECT_GE(m.tintVariation, 0);
    EXPECT_LE(m.tintVariation, 1);
  }
}

TEST(MaterialsBuiltin, TextureCoordinatesOfFacadesAndLeavesAreInRepeats) {
  for (const char* name : {"facade-limestone", "facade-plaster", "facade-brick", "facade-plaster-shutters", "leaves"})
    EXPECT_EQ(builtinMaterial(name).metresPerRepeat, glm::vec2(1)) << name;
}

TEST(MaterialsBuiltin, UnknownNameGivesPlaster) {
  EXPECT_EQ(builtinMaterial("porphyry"), builtinMaterial("plaster"));
  EXPECT_EQ(builtinMaterial(""), builtinMaterial("plaster"));
}

TEST(MaterialsBuiltin, UnknownSourceSaysSoAndShowsPlaster) {
  city::Material m;
  m.name = "wall of the palace";
  m.source = "builtin:porphyry";
  city::Diagnostics diagnostics;
  const Image image = materialImage(m, diagnostics);
  EXPECT_EQ(image.rgba, pictures().at("plaster").rgba);
  ASSERT_EQ(diagnostics.messages.size(), 1U);
  EXPECT_EQ(describe(diagnostics.messages[0]),
            "builtin:porphyry: wall of the palace: there is no built-in texture of this name; plaster is shown");
  EXPECT_FALSE(diagnostics.hasErrors());
}

TEST(MaterialsBuiltin, PicturesHaveTextureSizes) {
  for (const auto& [name, image] : pictures()) {
    EXPECT_TRUE(image.width == 512 || image.width == 256) << name;
    EXPECT_EQ(image.width, image.height) << name;
    EXPECT_EQ(image.rgba.size(), static_cast<size_t>(image.width * image.height * 4)) << name;
  }
}

TEST(MaterialsBuiltin, NoSeamStandsOut) {
  for (const auto& [name, image] : pictures())
    for (const bool across : {true, false}) {
      // Pictures of one opening stand alone; under their arches nothing goes on.
      if (name.ends_with("-arched") || name == "window-tracery" || name == "portal") continue;
      const int n = across ? image.width : image.height;
      double largest = 0;
      for (int at = 0; at + 1 < n; ++at) largest = std::max(largest, meanStep(image, at, across));
      EXPECT_LE(meanStep(image, n - 1, across), largest)
          << name << (across ? " from right to left" : " from top to bottom");
    }
}

TEST(MaterialsBuiltin, TheSameTwice) {
  city::Diagnostics diagnostics;
  for (const char* name : {"brick", "thatch", "leaves", "cobbles", "timber", "facade-limestone"})
    EXPECT_EQ(materialImage(builtinMaterial(name), diagnostics).rgba, pictures().at(name).rgba) << name;
}

// These two use small pictures only: the thread sanitizer runs them.
TEST(MaterialsBuiltin, TheSameInParallel) {
  std::vector<city::Material> materials;
  for (const char* name : {"iron", "wool", "glass", "shutter", "wool", "water"})
    materials.push_back(builtinMaterial(name));
  city::Diagnostics diagnostics;
  const std::vector<Image> images = materialImages(materials, diagnostics);
  ASSERT_EQ(images.size(), materials.size());
  for (size_t i = 0; i < images.size(); ++i)
    EXPECT_EQ(images[i].rgba, materialImage(materials[i], diagnostics).rgba) << materials[i].name;
}

TEST(MaterialsBuiltin, ParallelDiagnosticsComeInOrder) {
  std::vector<city::Material> materials(8);
  for (size_t i = 0; i < materials.size(); ++i) materials[i].source = "builtin:no-such-" + std::to_string(i);
  city::Diagnostics diagnostics;
  EXPECT_EQ(materialImages(materials, diagnostics).size(), 8U);
  ASSERT_EQ(diagnostics.messages.size(), 8U);
  for (size_t i = 0; i < 8; ++i) EXPECT_EQ(diagnostics.messages[i].file, materials[i].source);
  EXPECT_TRUE(materialImages({}, diagnostics).empty());
}

TEST(MaterialsBuiltin, OnlyLeavesAreCutOut) {
  for (const auto& [name, image] : pictures()) {
    size_t open = 0;
    for (size_t i = 3; i < image.rgba.size(); i += 4) {
      EXPECT_TRUE(image.rgba[i] == 0 || image.rgba[i] == 255);
      open += image.rgba[i] == 0;
    }
    const double share = static_cast<double>(open) / (image.width * image.height);
    if (name.starts_with("leaves")) {
      EXPECT_GT(share, 0.3) << name;
      EXPECT_LT(share, 0.65) << name;
    } else {
      EXPECT_EQ(open, 0U) << name;
    }
  }
}

TEST(MaterialsBuiltin, LeavesKeepClearOfTheBorderAndBleedTheirGreen) {
  for (const char* name : {"leaves", "leaves-dark"}) {
    const Image& image = pictures().at(name);
    for (int k = 0; k < 512; ++k)
      for (const uint8_t* t : {texel(image, k, 0), texel(image, k, 511), texel(image, 0, k), texel(image, 511, k)})
        EXPECT_EQ(t[3], 0) << name;
    const std::array<double, 3> green = meanColour(image);
    std::array<double, 3> hidden{};
    double n = 0;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
      if (image.rgba[i + 3] != 0) continue;
      for (size_t c = 0; c < 3; ++c) hidden[c] += image.rgba[i + c];
      n += 1;
    }
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(hidden[c] / n, green[c], 12) << name << " channel " << c;
  }
}

TEST(MaterialsBuiltin, ColoursAreThoseOfOldThings) {
  for (const auto& [name, image] : pictures()) {
    const std::array<double, 3> c = meanColour(image);
    EXPECT_GT(brightness(c), 35) << name;
    EXPECT_LT(brightness(c), 228) << name;
    // Nothing is gaudy: sRGB chroma of the mean.
    EXPECT_LT(std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]}), 75) << name;
  }
  const auto mean = [](const char* name) { return meanColour(pictures().at(name)); };
  for (const char* red : {"brick", "brick-dark", "tile"}) {
    EXPECT_GT(mean(red)[0], mean(red)[1] + 10) << red;
    EXPECT_GT(mean(red)[1], mean(red)[2]) << red;
  }
  for (const char* green : {"grass", "leaves", "leaves-dark"}) {
    EXPECT_GT(mean(green)[1], mean(green)[0]) << green;
    EXPECT_GT(mean(green)[1], mean(green)[2] + 10) << green;
  }
  EXPECT_LT(brightness(mean("glass")), 90);
  EXPECT_LT(brightness(mean("brick-dark")), brightness(mean("brick")) - 10);
  EXPECT_LT(brightness(mean("leaves-dark")), brightness(mean("leaves")) - 10);
  EXPECT_GT(brightness(mean("limewash")), brightness(mean("plaster")));
}

TEST(MaterialsBuiltin, NothingIsClipped) {
  for (const auto& [name, image] : pictures()) {
    size_t ends = 0;
    for (size_t i = 0; i < image.rgba.size(); i += 4)
      for (size_t c = 0; c < 3; ++c) ends += image.rgba[i + c] == 0 || image.rgba[i + c] == 255;
    EXPECT_LT(static_cast<double>(ends), 0.001 * static_cast<double>(image.rgba.size())) << name;
  }
}

TEST(MaterialsBuiltin, NoPatchStandsOutInRepeats) {
  // Means of 4 × 4 parts: at a distance these are what shows the repeat. The bound is 9 % of the mean, about what the
  // eye lets pass in a wall of ten repeats.
  for (const char* name :
       {"plaster", "limewash", "brick", "brick-dark", "rubble", "ashlar", "flint", "oak", "tile", "slate", "thatch",
        "cobbles", "earth", "grass", "field", "bank", "water", "wool", "concrete"}) {
    const Image& image = pictures().at(name);
    const double all = brightness(meanColour(image));
    const int part = image.width / 4;
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x) {
        const double here = brightness(meanColour(image, x * part, y * part, (x + 1) * part, (y + 1) * part));
        EXPECT_NEAR(here / all, 1, 0.09) << name << " part " << x << ", " << y;
      }
  }
}

TEST(MaterialsBuiltin, SurfacesAreNotFlat) {
  for (const auto& [name, image] : pictures()) {
    double sum = 0;
    for (int at = 0; at < image.width; ++at) sum += meanStep(image, at, true);
    EXPECT_GT(sum / image.width, name == "glass" || name == "water" ? 0.05 : 1.0) << name;
  }
}

TEST(MaterialsBuiltin, FacadeWallsMatchTheirPlainMaterial) {
  const std::pair<const char*, const char*> pairs[] = {
      {"facade-brick", "brick"}, {"facade-plaster", "plaster"}, {"facade-limestone", "ashlar"}};
  for (const auto& [facade, plain] : pairs) {
    // Below the window there is only wall.
    const std::array<double, 3> wall = meanColour(pictures().at(facade), 0, 0, 512, 100),
                                same = meanColour(pictures().at(plain));
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(wall[c], same[c], 9) << facade << " channel " << c;
  }
}

TEST(MaterialsBuiltin, FacadesHaveADarkWindowInTheMiddle) {
  for (const char* name : {"facade-limestone", "facade-plaster", "facade-brick", "facade-plaster-shutters"}) {
    const Image& image = pictures().at(name);
    EXPECT_LT(brightness(meanColour(image, 170, 170, 342, 400)), brightness(meanColour(image, 0, 0, 512, 100)) - 12)
        << name;
  }
}

}  // namespace
}  // namespace vicus::assets
