#include "report/flip.hpp"

#include <cmath>

#include "pictures.hpp"
#include "viewer/pictures.hpp"

namespace vicus::report {
namespace {

using testing::flat;
using testing::town;

struct Published {
  const char *reference, *test;
  double mean, max;
};

void PrintTo(const Published& pair, std::ostream* out) {
  *out << pair.reference << " against " << pair.test;
}

// ../shared/data/flip/README.md: the authors' own program, version 1.6.
class FlipPublished : public ::testing::TestWithParam<Published> {};

TEST_P(FlipPublished, EqualsTheAuthorsProgram) {
  const auto folder = testing::dataFolder() / "flip";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no FLIP pictures in " << folder;
  std::string error;
  const auto reference = viewer::readPicture(folder / GetParam().reference, error);
  const auto test = viewer::readPicture(folder / GetParam().test, error);
  ASSERT_TRUE(reference && test) << error;
  const FlipResult result = flip(*reference, *test);
  EXPECT_NEAR(result.mean, GetParam().mean, 1e-4);
  EXPECT_NEAR(result.max, GetParam().max, 1e-4);
  // Nine of ten pixels of a_tint.png hold 0.1625: single precision alone moves that mean by 9e-4.
  EXPECT_NEAR(result.exactMean, GetParam().mean, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Pairs, FlipPublished,
                         ::testing::Values(Published{"a.png", "a_blur.png", 0.053906, 0.912977},
                                           Published{"a.png", "a_tint.png", 0.187027, 0.522086},
                                           Published{"a.png", "a_shift.png", 0.026656, 0.773092},
                                           Published{"b.png", "b_shift.png", 0.242991, 0.987869},
                                           Published{"c1.png", "c1_noise.png", 0.064653, 0.252124},
                                           Published{"a.png", "a.png", 0.000002, 0.000067}),
                         [](const auto& pair) { return std::filesystem::path(pair.param.test).stem().string(); });

TEST(Flip, APictureAgainstItselfIsZero) {
  const auto p = town(64, 48);
  const FlipResult result = flip(p, p);
  EXPECT_EQ(result.mean, 0);
  EXPECT_EQ(result.max, 0);
  EXPECT_EQ(result.map.values.size(), 64U * 48U);
}

TEST(Flip, IsSymmetric) {
  const auto a = town(64, 48), b = town(64, 48, 3);
  EXPECT_DOUBLE_EQ(flip(a, b).mean, flip(b, a).mean);
}

TEST(Flip, GreenAgainstBlueIsTheLargestColourDifference) {
  // Flat pictures have no edges, so the colour error alone decides: 1 for the farthest pair of a screen's colours.
  EXPECT_NEAR(flip(flat(32, 32, {0, 255, 0}), flat(32, 32, {0, 0, 255})).mean, 1, 1e-5);
  EXPECT_LT(flip(flat(32, 32, {0, 0, 0}), flat(32, 32, {255, 255, 255})).mean, 1);
}

TEST(Flip, FineNoiseIsForgivenFromFurtherAway) {
  const auto grey = flat(64, 64, {128, 128, 128});
  const auto checks = testing::picture(64, 64, [](int x, int y) -> testing::Pixel {
    const auto v = static_cast<uint8_t>((x + y) % 2 == 0 ? 100 : 156);
    return {v, v, v};
  });
  EXPECT_LT(flip(grey, checks, 120).mean, flip(grey, checks, 20).mean);
}

TEST(Flip, PicturesOfOtherSizesAreNotCompared) {
  EXPECT_TRUE(std::isnan(flip(town(32, 32), town(32, 31)).mean));
  EXPECT_TRUE(flip(town(32, 32), town(32, 31)).map.values.empty());
  EXPECT_TRUE(std::isnan(flip(viewer::Picture{}, viewer::Picture{}).mean));
  EXPECT_TRUE(std::isnan(flip(flipAppearance(town(8, 8), 67), flipAppearance(town(8, 8), 30)).mean));
}

TEST(Flip, OnePixelAndHugeKernels) {
  EXPECT_EQ(flip(flat(1, 1, {9, 8, 7}), flat(1, 1, {9, 8, 7})).mean, 0);
  EXPECT_GT(flip(flat(1, 1, {9, 8, 7}), flat(1, 1, {200, 8, 7}), 1000).mean, 0.1);
}

TEST(ErrorColour, GetsLighterWithTheError) {
  const auto lightness = [](float e) {
    const glm::vec3 c = errorColour(e);
    return 0.2126F * c.r + 0.7152F * c.g + 0.0722F * c.b;
  };
  for (int i = 1; i <= 100; ++i)
    EXPECT_GT(lightness(static_cast<float>(i) / 100), lightness(static_cast<float>(i - 1) / 100)) << i;
  EXPECT_EQ(errorColour(NAN), errorColour(0));
  EXPECT_EQ(errorColour(7), errorColour(1));
  EXPECT_EQ(errorColour(-1), errorColour(0));
}

}  // namespace
}  // namespace vicus::report
