#include "assets/materials/pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace vicus::assets::pattern {
namespace {

constexpr Size kSize{96, 64};

double meanOf(const Field& f) {
  double sum = 0;
  for (const float v : f.texels) sum += v;
  return sum / static_cast<double>(f.texels.size());
}

double rmsOf(const Field& f) {
  double sum = 0;
  for (const float v : f.texels) sum += double{v} * v;
  return std::sqrt(sum / static_cast<double>(f.texels.size()));
}

/// Largest step between neighbours, inside and over the seam.
std::pair<float, float> steps(const Field& f) {
  float inside = 0, seam = 0;
  for (int y = 0; y < f.size.height; ++y)
    for (int x = 0; x < f.size.width; ++x) {
      const auto at = [&](int px, int py) {
        return f[static_cast<size_t>(wrapped(py, f.size.height) * f.size.width + wrapped(px, f.size.width))];
      };
      const float right = std::abs(at(x + 1, y) - at(x, y)), up = std::abs(at(x, y + 1) - at(x, y));
      float& sideways = x + 1 == f.size.width ? seam : inside;
      sideways = std::max(sideways, right);
      float& upwards = y + 1 == f.size.height ? seam : inside;
      upwards = std::max(upwards, up);
    }
  return {inside, seam};
}

TEST(MaterialsPattern, WrappedGoesRoundEitherWay) {
  EXPECT_EQ(wrapped(-1, 8), 7);
  EXPECT_EQ(wrapped(8, 8), 0);
  EXPECT_EQ(wrapped(-17, 8), 7);
  EXPECT_EQ(wrapped(3, 8), 3);
}

TEST(MaterialsPattern, NoiseHasTheStatedRmsAndNoSeam) {
  const Field f = noise({256, 256}, {32, 32}, 7);
  EXPECT_NEAR(meanOf(f), 0, 0.05);
  EXPECT_NEAR(rmsOf(f), 0.5, 0.05);
  const auto [inside, seam] = steps(f);
  EXPECT_LE(seam, inside);
}

TEST(MaterialsPattern, OctavesKeepTheRms) {
  for (const float gain : {0.4F, 0.6F, 0.8F})
    EXPECT_NEAR(rmsOf(fbm({256, 256}, {12, 12}, 5, gain, 3)), 0.5, 0.1) << gain;
}

TEST(MaterialsPattern, OctavesFinerThanTwoTexelsAreLeftOut) {
  const Field few = fbm(kSize, {8, 8}, 3, 0.5F, 5), many = fbm(kSize, {8, 8}, 12, 0.5F, 5);
  EXPECT_EQ(few.texels, many.texels);
}

TEST(MaterialsPattern, OneCellOfNoiseIsFlat) {
  const Field f = noise(kSize, {1, 1}, 9);
  const auto [inside, seam] = steps(f);
  EXPECT_LT(inside, 1e-5F);
  EXPECT_LT(seam, 1e-5F);
}

TEST(MaterialsPattern, BlurKeepsTheMeanAndLessensTheRms) {
  const Field f = grain(kSize, 11), soft = blurred(f, 3);
  EXPECT_NEAR(meanOf(soft), meanOf(f), 1e-4);
  EXPECT_LT(rmsOf(soft), 0.3 * rmsOf(f));
  EXPECT_EQ(blurred(f, 0).texels, f.texels);
}

TEST(MaterialsPattern, DisplacedByNothingIsTheSame) {
  const Field f = grain(kSize, 12), still(kSize);
  EXPECT_EQ(displaced(f, still, still, 40).texels, f.texels);
}

TEST(MaterialsPattern, DisplacedByWholeTexelsIsAShiftThatWraps) {
  const Field f = grain(kSize, 13), one(kSize, 1), none(kSize);
  const Field moved = displaced(f, one, none, 5);
  for (int x = 0; x < kSize.width; ++x)
    EXPECT_FLOAT_EQ(moved[static_cast<size_t>(x)], f[static_cast<size_t>((x + 5) % kSize.width)]);
}

TEST(MaterialsPattern, VoronoiUsesEveryCellAndItsEdgesTile) {
  const Cells cells = voronoi({256, 256}, {8, 8}, 0.8F, 0, 21);
  EXPECT_EQ(cells.count, 64U);
  std::set<uint32_t> ids;
  Field edge({256, 256});
  for (size_t i = 0; i < cells.texels.size(); ++i) {
    ids.insert(cells[i].id);
    edge[i] = cells[i].edge;
    EXPECT_GE(cells[i].edge, 0) << i;
  }
  EXPECT_EQ(ids.size(), 64U);
  // The distance to an edge changes by no more than the way gone, over the seam too (an edge between two texels adds
  // nothing: it lies at 0).
  const auto [inside, seam] = steps(edge);
  EXPECT_LE(inside, 1.01F);
  EXPECT_LE(seam, 1.01F);
}

TEST(MaterialsPattern, VoronoiOfOneCellDoesNotDivideByZero) {
  for (const CellTexel& t : voronoi(kSize, {1, 1}, 1, 3, 22).texels) {
    EXPECT_TRUE(std::isfinite(t.edge));
    EXPECT_EQ(t.id, 0U);
  }
}

TEST(MaterialsPattern, CoursesFillTheTextureOnce) {
  const Cells bond = courses(kSize, englishBond(kSize, 8, 4, 31), 0, 0, 32);
  // Four courses of 4 stretchers, four of 8 headers.
  EXPECT_EQ(bond.count, 48U);
  std::vector<int> area(bond.count);
  for (const CellTexel& t : bond.texels) {
    ++area[t.id];
    EXPECT_GE(t.across, 0);
    EXPECT_LE(t.across, 1);
    EXPECT_GE(t.up, 0);
    EXPECT_LE(t.up, 1);
  }
  for (const int a : area) EXPECT_GT(a, 0);
  // A header is half a stretcher, within the joints' irregularity of about a texel.
  EXPECT_NEAR(area[0], 24 * 8, 2 * 8);
  EXPECT_NEAR(area[4], 12 * 8, 2 * 8);
}

TEST(MaterialsPattern, CornersAreRounded) {
  const Cells bond = courses(kSize, runningBond(kSize, 2, 2, 0.5F, 0, 33), 6, 0, 34);
  EXPECT_LT(bond[0].edge, 0) << "the corner of the first block";
  const Cells sharp = courses(kSize, runningBond(kSize, 2, 2, 0.5F, 0, 33), 0, 0, 34);
  EXPECT_FLOAT_EQ(sharp[0].edge, 0.5F);
}

TEST(MaterialsPattern, ShiftedCoursesWrapTheirLastBlock) {
  const Cells bond = courses(kSize, runningBond(kSize, 2, 2, 0.5F, 0, 35), 0, 0, 36);
  const size_t upper = static_cast<size_t>(kSize.width) * 40;
  EXPECT_EQ(bond[upper].id, bond[upper + 95].id) << "one block over the seam";
  EXPECT_NE(bond[0].id, bond[95].id);
}

TEST(MaterialsPattern, AStrokeOverTheSeamCoversAsMuchAsOneInside) {
  const auto covered = [](glm::vec2 from) {
    double sum = 0;
    overStroke(kSize, from, from + glm::vec2(9, 14), 3, 1, [&](size_t i, float cover, float t) {
      EXPECT_LT(i, kSize.texels());
      EXPECT_GT(cover, 0);
      EXPECT_LE(cover, 1);
      EXPECT_GE(t, 0);
      EXPECT_LE(t, 1);
      sum += double{cover};
    });
    return sum;
  };
  const double inside = covered({40.25F, 20.5F});
  EXPECT_NEAR(covered({92.25F, 58.5F}), inside, 1e-3);
  EXPECT_NEAR(covered({-3.75F, -5.5F}), inside, 1e-3);
}

TEST(MaterialsPattern, AStrokeOfNoLengthIsADot) {
  int texels = 0;
  overStroke(kSize, {10, 10}, {10, 10}, 2, 2, [&](size_t, float, float) { ++texels; });
  EXPECT_GE(texels, 4);
  EXPECT_LE(texels, 12);
}

TEST(MaterialsPattern, FlatSurfacesKeepTheirColour) {
  const Surface flat = paint(kSize, [](int, int, size_t) { return Texel{srgb(0x8a6040), 3}; });
  const Image image = finish(flat, {1, 1, 4});
  for (size_t i = 0; i < kSize.texels(); ++i) {
    EXPECT_NEAR(image.rgba[4 * i], 0x8a, 1);
    EXPECT_NEAR(image.rgba[4 * i + 1], 0x60, 1);
    EXPECT_NEAR(image.rgba[4 * i + 2], 0x40, 1);
    EXPECT_EQ(image.rgba[4 * i + 3], 255);
  }
}

TEST(MaterialsPattern, LightComesFromTheUpperLeft) {
  // A round hill: its upper left side is brighter than its lower right.
  const Surface hill = paint({64, 64}, [](int x, int y, size_t) {
    const glm::vec2 d(static_cast<float>(x) - 31.5F, static_cast<float>(y) - 31.5F);
    return Texel{glm::vec3(0.3F), glm::max(0.0F, 20 - 0.05F * glm::dot(d, d))};
  });
  const Image image = finish(hill, {0.5F, 0, 4});
  const auto red = [&](int x, int y) { return image.rgba[4 * static_cast<size_t>(y * 64 + x)]; };
  EXPECT_GT(red(25, 38), red(38, 25) + 20);
}

TEST(MaterialsPattern, UncoveredTexelsTakeTheirNeighboursColour) {
  Surface card{{32, 32}, std::vector<Texel>(1024, Texel{srgb(0xff00ff), 0}), std::vector<uint8_t>(1024, 0)};
  drawLeaf(card, {{16, 16}, 12, 8, 0, srgb(0x608040), 0});
  const Image image = finish(card, {0, 0, 2});
  int covered = 0;
  for (size_t i = 0; i < 1024; ++i) {
    covered += image.rgba[4 * i + 3] == 255;
    EXPECT_TRUE(image.rgba[4 * i + 3] == 0 || image.rgba[4 * i + 3] == 255);
    EXPECT_GT(image.rgba[4 * i + 1], image.rgba[4 * i]) << "green everywhere, never the magenta below";
  }
  EXPECT_GT(covered, 30);
  EXPECT_LT(covered, 120);
}

TEST(MaterialsPattern, RectanglesAreCutToTheTexture) {
  Surface surface{kSize, std::vector<Texel>(kSize.texels()), {}};
  int calls = 0;
  repaint(surface, {-5, 60, 4, 90}, [&](int x, int y, const Texel& t, int edge) {
    EXPECT_LT(x, 4);
    EXPECT_GE(y, 60);
    EXPECT_GE(edge, 0);
    ++calls;
    return t;
  });
  EXPECT_EQ(calls, 4 * 4);
}

}  // namespace
}  // namespace vicus::assets::pattern
