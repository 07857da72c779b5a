#include "scenegraph/texture_classes.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "city/random.hpp"

namespace vicus::scenegraph {
namespace {

constexpr uint64_t kPlenty = 1ull << 40;

assets::Image filled(int width, int height, std::array<uint8_t, 4> colour) {
  assets::Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i) image.rgba.insert(image.rgba.end(), colour.begin(), colour.end());
  return image;
}

TEST(PlanTextures, NothingNeedsNothing) {
  const TexturePlan plan = planTextures({}, kPlenty);
  EXPECT_TRUE(plan.classes.empty());
  EXPECT_EQ(plan.bytes, 0u);
}

TEST(PlanTextures, EachDemandHasALayerOfItsOwn) {
  std::vector<TextureDemand> demands;
  city::Random random(3);
  for (int i = 0; i < 100; ++i) demands.push_back({1 + static_cast<int>(random.below(4000)), random.below(2) == 0});
  for (const uint64_t budget : {uint64_t{0}, uint64_t{1} << 20, uint64_t{64} << 20, kPlenty}) {
    const TexturePlan plan = planTextures(demands, budget);
    EXPECT_LE(plan.classes.size(), kMostTextureClasses);
    std::vector<std::vector<bool>> taken;
    for (const TextureClass& c : plan.classes) {
      EXPECT_EQ(c.size & (c.size - 1), 0) << "a power of two";
      taken.emplace_back(c.layers, false);
    }
    for (size_t i = 0; i < demands.size(); ++i) {
      const TexturePlace& place = plan.places[i];
      EXPECT_EQ(plan.classes[place.textureClass].repeat, demands[i].repeat);
      EXPECT_FALSE(taken[place.textureClass][place.layer]) << "layer used twice";
      taken[place.textureClass][place.layer] = true;
    }
  }
}

TEST(PlanTextures, WithoutNeedNothingIsMadeSmaller) {
  const TextureDemand demands[] = {{300, true}, {512, true}, {2048, true}, {64, false}};
  const TexturePlan plan = planTextures(demands, kPlenty);
  EXPECT_EQ(plan.halvings, 0);
  for (size_t i = 0; i < 4; ++i) EXPECT_GE(plan.classes[plan.places[i].textureClass].size, demands[i].size);
}

TEST(PlanTextures, HalvesUntilTheBudgetHolds) {
  const std::vector<TextureDemand> demands(10, {1024, true});
  const uint64_t budget = 10 * layerBytes(256);
  const TexturePlan plan = planTextures(demands, budget);
  EXPECT_EQ(plan.classes[0].size, 256);
  EXPECT_EQ(plan.halvings, 2);
  EXPECT_LE(plan.bytes, budget);
}

TEST(PlanTextures, ABudgetThatNothingFitsEndsAtOnePixel) {
  const std::vector<TextureDemand> demands(3, {1024, true});
  EXPECT_EQ(planTextures(demands, 0).classes[0].size, 1);
}

TEST(LayerBytes, CountsAllLevels) {
  EXPECT_EQ(layerBytes(1), 4u);
  EXPECT_EQ(layerBytes(4), 4u * (16 + 4 + 1));
}

TEST(MipLevels, OneColourStaysThatColour) {
  // 188 in sRGB is 0.503 of full light, whose square root is 0.709.
  const auto levels = mipLevels(filled(5, 3, {188, 188, 188, 255}), 8);
  ASSERT_EQ(levels.size(), 4u);
  for (const auto& level : levels)
    for (size_t i = 0; i < level.size(); ++i) EXPECT_NEAR(level[i], i % 4 == 3 ? 255 : 181, 1);
}

TEST(MipLevels, AveragesLightNotNumbers) {
  assets::Image image = filled(2, 1, {255, 255, 255, 255});
  for (int k = 0; k < 3; ++k) image.rgba[static_cast<size_t>(k)] = 0;
  const auto levels = mipLevels(image, 2);
  EXPECT_NEAR(levels[1][0], 255 * std::sqrt(0.5), 1);
}

TEST(MipLevels, SeeThroughPixelsLendNoColour) {
  assets::Image image = filled(2, 1, {0, 255, 0, 255});
  image.rgba = {255, 0, 0, 0, 0, 255, 0, 255};
  const auto levels = mipLevels(image, 2);
  EXPECT_EQ(levels[1][0], 0);
  EXPECT_EQ(levels[1][1], 255);
}

TEST(MipLevels, LeavesDoNotThinOut) {
  assets::Image image = filled(64, 64, {80, 120, 40, 255});
  city::Random random(9);
  for (size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = random.below(10) < 3 ? 255 : 0;
  const auto levels = mipLevels(image, 64);
  for (size_t level = 0; level < 4; ++level) {
    double covered = 0;
    for (size_t i = 3; i < levels[level].size(); i += 4) covered += levels[level][i] >= 128;
    EXPECT_NEAR(covered / (static_cast<double>(levels[level].size()) / 4), 0.3, 0.06) << "level " << level;
  }
}

TEST(MipLevels, AnEmptyPictureIsGrey) {
  const auto levels = mipLevels({}, 2);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0][0], levels[0][1]);
  EXPECT_EQ(levels[0][3], 255);
}

TEST(OverSurroundings, IsLevelWhereNothingStandsOut) {
  const std::vector<uint8_t> level(4 * 8 * 8, 90), coarse(4 * 2 * 2, 90);
  for (const uint8_t v : overSurroundings(level, 8, coarse, 2)) EXPECT_EQ(v, 128);
}

TEST(OverSurroundings, KeepsWhatStandsOut) {
  std::vector<uint8_t> level(4 * 8 * 8, 90);
  level[0] = 45, level[5] = 255;
  const auto out = overSurroundings(level, 8, std::vector<uint8_t>(4 * 2 * 2, 90), 2);
  EXPECT_EQ(out[0], 64);
  EXPECT_EQ(out[5], 255) << "no brighter than twice";
}

TEST(HasHoles, OnlyWhereAlphaIsLow) {
  EXPECT_FALSE(hasHoles(filled(2, 2, {1, 2, 3, 255})));
  EXPECT_FALSE(hasHoles({}));
  EXPECT_TRUE(hasHoles(filled(2, 2, {1, 2, 3, 0})));
}

}  // namespace
}  // namespace vicus::scenegraph
