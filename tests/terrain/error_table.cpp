#include "terrain/error_table.hpp"

#include <gtest/gtest.h>

#include "terrain/patch_grid.hpp"
#include "tests/terrain/fields.hpp"

namespace vicus::terrain {
namespace {

using city::HeightField;

TEST(PatchGrid, CoversFieldsOfAnySize) {
  EXPECT_EQ(patchGridFor({1025, 1025}).side, 1024);
  EXPECT_EQ(patchGridFor({401, 401}).side, 512);
  EXPECT_EQ(patchGridFor({2, 2}).side, 1);
  EXPECT_EQ(patchGridFor({2, 300}).count, glm::ivec2(1, 299));
  EXPECT_TRUE(patchGridFor({1, 300}).empty());
  EXPECT_TRUE(patchGridFor({0, 0}).empty());
  for (int width = 2; width < 70; ++width)
    for (int height = 2; height < 70; ++height) {
      const PatchGrid grid = patchGridFor({width, height});
      EXPECT_GE(grid.span().x, grid.cells.x);
      EXPECT_GE(grid.span().y, grid.cells.y);
      EXPECT_LE(4 * grid.span().x * grid.span().y, 7 * grid.cells.x * grid.cells.y) << width << " × " << height;
    }
}

TEST(PatchGrid, DiamondsAlternateAsTheFieldsDiagonals) {
  const PatchGrid grid = patchGridFor({9, 9});
  EXPECT_EQ(diamondAt(grid, {4, 4}).u, glm::ivec2(4, 4));
  EXPECT_EQ(diamondAt(grid, {2, 2}).u, glm::ivec2(2, 2));
  EXPECT_EQ(diamondAt(grid, {6, 2}).u, glm::ivec2(2, -2));
  EXPECT_EQ(diamondAt(grid, {4, 0}).u, glm::ivec2(4, 0));
  EXPECT_EQ(diamondAt(grid, {0, 3}).u, glm::ivec2(0, 1));
}

TEST(ErrorCode, RoundsUpByAtMostAStep) {
  EXPECT_EQ(decodeError(encodeError(0)), 0);
  EXPECT_EQ(decodeError(encodeError(1e-9F)), 0x1p-13F);
  EXPECT_EQ(decodeError(kNoGround), 0);
  EXPECT_NE(encodeError(1e30F), kNoGround);
  for (float metres = 2e-4F; metres < 2e5F; metres *= 1.0173F) {
    const float stored = decodeError(encodeError(metres));
    EXPECT_GE(stored, metres);
    EXPECT_LE(stored, metres * (1 + 0x1p-11F));
    EXPECT_EQ(decodeError(encodeError(stored)), stored);
  }
}

/// The same error by asking every sample whether it lies in the triangle.
double errorBySearch(const HeightField& field, glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  const auto cross = [](glm::ivec2 u, glm::ivec2 v) { return int64_t{u.x} * v.y - int64_t{u.y} * v.x; };
  const int64_t area = cross(b - a, c - a);
  if (area <= 0) return 0;
  double most = 0;
  for (int y = 0; y < field.size.y; ++y)
    for (int x = 0; x < field.size.x; ++x) {
      const glm::ivec2 p(x, y);
      const int64_t wa = cross(b - p, c - p), wb = cross(c - p, a - p), wc = cross(a - p, b - p);
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double plane = (static_cast<double>(wa) * static_cast<double>(field.at(a.x, a.y)) +
                            static_cast<double>(wb) * static_cast<double>(field.at(b.x, b.y)) +
                            static_cast<double>(wc) * static_cast<double>(field.at(c.x, c.y))) /
                           static_cast<double>(area);
      most = std::max(most, std::abs(static_cast<double>(field.at(x, y)) - plane));
    }
  return most;
}

TEST(ErrorTable, HoldsTheLargestErrorOverAllSamplesOfEachTriangle) {
  for (const glm::ivec2 size :
       {glm::ivec2(17, 17), glm::ivec2(33, 17), glm::ivec2(26, 26), glm::ivec2(2, 9), glm::ivec2(23, 31)}) {
    HeightField field = makeLandscape(33, Landscape::Cliffs);
    HeightField part;
    part.size = size;
    part.heights.resize(static_cast<size_t>(size.x) * static_cast<size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) part.at(x, y) = field.at(x, y);
    const ErrorTable table = buildErrorTable(part);
    const glm::ivec2 span = table.patches.span();
    for (int y = 0; y <= span.y; ++y)
      for (int x = 0; x <= span.x; ++x) {
        if ((x | y) % table.patches.side == 0) continue;
        const glm::ivec2 centre(x, y);
        const DiamondShape shape = diamondAt(table.patches, centre);
        for (const int sign : {1, -1}) {
          const glm::ivec2 apex = centre + sign * shape.v;
          if (apex.x < 0 || apex.y < 0 || apex.x > span.x || apex.y > span.y) continue;
          const auto pressed = [&](glm::ivec2 p) { return glm::min(p, table.patches.cells); };
          const double expected =
              errorBySearch(part, pressed(centre - sign * shape.u), pressed(centre + sign * shape.u), pressed(apex));
          const float stored =
              decodeError(table.codes[2 * static_cast<size_t>(y * (span.x + 1) + x) + canonicalSide(sign * shape.v)]);
          EXPECT_NEAR(static_cast<double>(stored), expected, 1e-3 + 5e-4 * expected)
              << x << ", " << y << " of " << size.x << " × " << size.y;
        }
      }
  }
}

TEST(ErrorTable, DoesNotDependOnThreads) {
  const HeightField field = makeLandscape(200, Landscape::Hills);
  const ErrorTable one = buildErrorTable(field, {}, 1);
  for (const unsigned threads : {2U, 3U, 16U}) EXPECT_EQ(buildErrorTable(field, {}, threads).codes, one.codes);
}

TEST(ErrorTable, LeavesOutWhatHasNoData) {
  HeightField field = makeLandscape(17, Landscape::Hills);
  for (int y = 0; y < 17; ++y)
    for (int x = 8; x < 17; ++x) field.at(x, y) = std::numeric_limits<float>::quiet_NaN();
  const ErrorTable table = buildErrorTable(field);
  ASSERT_EQ(table.filled.size(), field.heights.size());
  for (const float h : table.filled) EXPECT_TRUE(std::isfinite(h));
  const auto code = [&](int x, int y, uint32_t side) {
    return table.codes[2 * static_cast<size_t>(y * 17 + x) + side];
  };
  EXPECT_EQ(code(12, 4, 0), kNoGround);
  EXPECT_NE(code(4, 4, 0), kNoGround);
  // The patch itself reaches over the edge of the data: its outline may be wrong by as much as its longest side.
  EXPECT_GE(decodeError(code(8, 8, 0)), 16 * std::sqrt(2.0) * field.spacing.x);
}

TEST(ErrorTable, IsEmptyWithoutGround) {
  HeightField field;
  EXPECT_TRUE(buildErrorTable(field).patches.empty());
  field.size = {5, 5};
  field.heights.assign(25, std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(buildErrorTable(field).patches.empty());
}

}  // namespace
}  // namespace vicus::terrain
