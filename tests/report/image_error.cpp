#include "report/image_error.hpp"

#include <cmath>
#include <limits>

#include "pictures.hpp"

namespace vicus::report {
namespace {

using testing::flat;
using testing::town;

TEST(PixelError, APictureAgainstItself) {
  const PixelError error = pixelError(town(40, 30), town(40, 30));
  EXPECT_EQ(error.rmse, 0);
  EXPECT_EQ(error.largest, 0);
  EXPECT_EQ(error.psnr, std::numeric_limits<double>::infinity());
}

TEST(PixelError, AShiftOfAllValuesByOne) {
  const PixelError error = pixelError(flat(40, 30, {10, 20, 30}), flat(40, 30, {11, 21, 31}));
  EXPECT_NEAR(error.rmse, 1.0 / 255, 1e-7);
  EXPECT_NEAR(error.psnr, 20 * std::log10(255.0), 1e-4);  // 48.13 dB
  EXPECT_NEAR(error.largest, 1.0 / 255, 1e-7);
}

TEST(PixelError, OneChannelOfOnePixel) {
  auto changed = flat(10, 10, {0, 0, 0});
  changed.rgb[17] = 255;
  EXPECT_NEAR(pixelError(flat(10, 10, {0, 0, 0}), changed).rmse, std::sqrt(1.0 / 300), 1e-6);
}

TEST(PixelError, OtherSizesAreNaN) {
  EXPECT_TRUE(std::isnan(pixelError(town(8, 8), town(8, 9)).rmse));
  EXPECT_TRUE(std::isnan(pixelError({}, {}).psnr));
}

TEST(Ssim, APictureAgainstItselfIsOne) {
  EXPECT_NEAR(ssim(town(40, 30), town(40, 30)), 1, 1e-6);
}

TEST(Ssim, FlatPicturesByHand) {
  // No structure: only the luminance term (2 a b + C1) / (a² + b² + C1) remains, C1 = (0.01 · 255)².
  const double a = 100, b = 120, c1 = 2.55 * 2.55;
  EXPECT_NEAR(ssim(flat(20, 20, {100, 100, 100}), flat(20, 20, {120, 120, 120})),
              (2 * a * b + c1) / (a * a + b * b + c1), 2e-4);
}

TEST(Ssim, WorseWithMoreDistortion) {
  EXPECT_GT(ssim(town(40, 30), town(40, 30, 1)), ssim(town(40, 30), town(40, 30, 3)));
  EXPECT_LT(ssim(town(40, 30), town(40, 30, 1)), 0.95);
}

TEST(Ssim, SmallerThanItsWindow) {
  EXPECT_NEAR(ssim(town(5, 3), town(5, 3)), 1, 1e-5);
}

TEST(FindShift, FindsOnePixel) {
  const Shift shift = findShift(town(60, 40), town(60, 40, 1));
  EXPECT_EQ(shift.x, 1);
  EXPECT_EQ(shift.y, 0);
  EXPECT_EQ(shift.rmseThere, 0);
  EXPECT_GT(shift.rmseHere, 0.05);
}

TEST(FindShift, FindsItUnderNoise) {
  auto moved = town(60, 40, -2);
  city::Random random(3);
  for (uint8_t& v : moved.rgb) v = static_cast<uint8_t>(v + random.below(8));
  EXPECT_EQ(findShift(town(60, 40), moved).x, -2);
}

TEST(FindShift, NothingWhereNothingMoved) {
  EXPECT_EQ(findShift(town(60, 40), town(60, 40)).x, 0);
  const Shift brighter = findShift(flat(60, 40, {50, 50, 50}), flat(60, 40, {60, 60, 60}));
  EXPECT_EQ(brighter.x, 0);
  EXPECT_EQ(brighter.y, 0);
  EXPECT_EQ(findShift(town(4, 4), town(4, 4, 1)).x, 0);
}

TEST(Popping, IsTheLargestJump) {
  const std::vector<double> differences{0.10, 0.11, 0.12, 0.20, 0.19};
  EXPECT_NEAR(popping(differences).jump, 0.08, 1e-12);
  EXPECT_EQ(popping(differences).frame, 3U);
}

TEST(Popping, AConstantErrorDoesNotPop) {
  EXPECT_EQ(popping(std::vector<double>{0.3, 0.3, 0.3}).jump, 0);
  EXPECT_EQ(popping(std::vector<double>{0.3}).jump, 0);
  EXPECT_EQ(popping({}).jump, 0);
  EXPECT_EQ(popping(std::vector<double>{0.3, NAN, 0.3}).jump, 0);
}

}  // namespace
}  // namespace vicus::report
