#include "assets/import/terrain.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "city/random.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

city::Aabb plan(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0}, {x1, y1, 0}};
}

TEST(FieldOver, CoversTheExtentWithWholeMultiples) {
  const city::HeightField f = fieldOver(plan(-7, 3, 41, 22), 4);
  EXPECT_EQ(f.origin, glm::dvec2(-8, 0));
  EXPECT_GE(f.origin.x + f.extent().x, 41);
  EXPECT_GE(f.origin.y + f.extent().y, 22);
}

TEST(FieldOver, IsNeverTooLargeNorTooSmall) {
  for (const double side : {0.0, 1e-9, 1.0, 1e3, 1e5, 1e7}) {
    const city::HeightField f = fieldOver(plan(0, 0, side, side / 3), 0.5);
    EXPECT_GE(f.size.x, 2) << side;
    EXPECT_GE(f.size.y, 2) << side;
    EXPECT_LE(f.size.x, kLargestField) << side;
    EXPECT_LE(f.size.y, kLargestField) << side;
  }
}

TEST(FillByMembrane, KeepsWhatIsKnownAndStaysInItsRange) {
  city::HeightField f = fieldOver(plan(0, 0, 100, 80), 1);
  city::Random random(3);
  std::vector<std::pair<size_t, float>> known;
  for (int i = 0; i < 60; ++i) {
    const size_t at = random.below(static_cast<uint32_t>(f.heights.size()));
    f.heights[at] = static_cast<float>(random.uniform(10, 8858));
    known.emplace_back(at, f.heights[at]);
  }
  EXPECT_GT(fillByMembrane(f), 0u);
  for (const auto& [at, h] : known) EXPECT_EQ(f.heights[at], h);
  for (const float h : f.heights) {
    EXPECT_GE(h, 10 - 1e-2f);
    EXPECT_LE(h, 8858 + 1e-2f);
  }
}

TEST(FillByMembrane, NothingKnownNothingFilled) {
  city::HeightField f = fieldOver(plan(0, 0, 10, 10), 1);
  EXPECT_EQ(fillByMembrane(f), 0u);
  EXPECT_TRUE(std::isnan(f.heights[0]));
}

TEST(FillByMembrane, OneKnownSampleMakesAPlain) {
  city::HeightField f = fieldOver(plan(0, 0, 33, 17), 1);
  f.at(5, 5) = 42;
  fillByMembrane(f);
  for (const float h : f.heights) EXPECT_NEAR(h, 42, 1e-4);
}

TEST(RasteriseTin, IsExactOnAPlaneAndLeavesTheOutsideEmpty) {
  Tin tin;
  const auto z = [](double x, double y) { return 3 + 0.25 * x - 0.5 * y; };
  for (const auto& p : {glm::dvec2(0, 0), glm::dvec2(20, 0), glm::dvec2(20, 20), glm::dvec2(0, 20)})
    tin.points.emplace_back(p, z(p.x, p.y));
  tin.triangles = {{0, 1, 2}, {0, 2, 3}};
  city::HeightField f = fieldOver(plan(-10, -10, 30, 30), 1);
  EXPECT_EQ(rasteriseTin(tin, f), 21u * 21u);
  for (int row = 0; row < f.size.y; ++row)
    for (int column = 0; column < f.size.x; ++column) {
      const glm::dvec2 p = f.origin + f.spacing * glm::dvec2(column, row);
      const bool inside = p.x >= 0 && p.x <= 20 && p.y >= 0 && p.y <= 20;
      if (inside)
        EXPECT_NEAR(f.at(column, row), z(p.x, p.y), 1e-5);
      else
        EXPECT_TRUE(std::isnan(f.at(column, row)));
    }
}

TEST(RasteriseTin, UprightAndEmptyTrianglesCoverNothing) {
  Tin tin;
  tin.points = {{0, 0, 0}, {0, 0, 8848}, {10, 0, 0}, {5, 0, 3}};
  tin.triangles = {{0, 1, 2}, {0, 0, 0}, {0, 2, 3}};
  city::HeightField f = fieldOver(plan(-10, -10, 20, 20), 1);
  EXPECT_EQ(rasteriseTin(tin, f), 0u);
}

TEST(FieldThrough, PassesThroughItsPoints) {
  const std::vector<glm::dvec3> points{{0, 0, 10}, {120, 0, 30}, {0, 120, 20}, {NAN, 0, 5}};
  const city::HeightField f = fieldThrough(points, plan(-50, -50, 170, 170), 12);
  EXPECT_NEAR(*f.heightAt(0, 0), 10, 1e-6);
  EXPECT_NEAR(*f.heightAt(120, 0), 30, 1e-6);
  EXPECT_NEAR(*f.heightAt(0, 120), 20, 1e-6);
  EXPECT_GE(f.minHeight, 10 - 1e-3f);
  EXPECT_LE(f.maxHeight, 30 + 1e-3f);
}

TEST(GroundUnder, FindsLowestHighestAndMeanOfASlope) {
  city::HeightField f = fieldOver(plan(0, 0, 40, 40), 2);
  for (int row = 0; row < f.size.y; ++row)
    for (int column = 0; column < f.size.x; ++column) f.at(column, row) = static_cast<float>(column);  // 1 m in 2
  const std::vector<glm::dvec2> square{{10, 10}, {20, 10}, {20, 20}, {10, 20}};
  const GroundUnder g = groundUnder(f, square);
  ASSERT_TRUE(g.known);
  EXPECT_DOUBLE_EQ(g.lowest, 5);
  EXPECT_DOUBLE_EQ(g.highest, 10);
  EXPECT_DOUBLE_EQ(g.mean, 7.5);
}

// ---- Rasters ----

/// An ESRI grid of `columns` × `rows` cells of 10 m in Lambert-93 with its south-west corner at (600 000, 6 500 000).
std::string grid(int columns, int rows, const std::vector<double>& heightsFromNorth) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) +
                     "\nxllcorner 600000\nyllcorner 6500000\ncellsize 10\nNODATA_value -9999\n";
  for (size_t i = 0; i < heightsFromNorth.size(); ++i)
    text += std::to_string(heightsFromNorth[i]) + ((i + 1) % static_cast<size_t>(columns) ? " " : "\n");
  return text;
}

TEST(ReadElevation, KeepsTheSamplesOfARasterInTheCitysOwnCrs) {
  const TemporaryFolder folder;
  std::vector<double> heights;
  for (int i = 0; i < 12; ++i) heights.push_back(100 + i * i);
  LoadOptions options;
  options.crs = "EPSG:2154";
  const LoadResult r = load(folder.write("dem.asc", grid(4, 3, heights)), options);
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->crs, "EPSG:2154");
  EXPECT_TRUE(r.city->buildings.empty());
  ASSERT_TRUE(r.city->terrain);
  const city::HeightField& f = *r.city->terrain;
  EXPECT_EQ(f.size, glm::ivec2(4, 3));
  EXPECT_EQ(f.spacing, glm::dvec2(10));
  // Row 0 is the southernmost; samples lie at the middle of cells.
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      EXPECT_FLOAT_EQ(f.at(column, row), static_cast<float>(heights[static_cast<size_t>((2 - row) * 4 + column)]));
  EXPECT_DOUBLE_EQ(r.city->origin.x + f.origin.x, 600005);
  EXPECT_DOUBLE_EQ(r.city->origin.y + f.origin.y, 6500005);
}

TEST(ReadElevation, FillsSmallGapsAndSaysSo) {
  const TemporaryFolder folder;
  std::vector<double> heights(100, 50);
  heights[55] = heights[56] = -9999;
  LoadOptions options;
  options.crs = "EPSG:2154";
  const LoadResult r = load(folder.write("dem.asc", grid(10, 10, heights)), options);
  ASSERT_TRUE(r.city && r.city->terrain);
  for (const float h : r.city->terrain->heights) EXPECT_NEAR(h, 50, 1e-3);
  EXPECT_NE(messagesOf(r.diagnostics).find("2 samples without data were filled"), std::string::npos)
      << messagesOf(r.diagnostics);
}

TEST(ReadElevation, LeavesTheSeaEmpty) {
  const TemporaryFolder folder;
  std::vector<double> heights(60 * 60, -9999);
  for (int row = 0; row < 60; ++row)
    for (int column = 0; column < 20; ++column) heights[static_cast<size_t>(row * 60 + column)] = 12;
  LoadOptions options;
  options.crs = "EPSG:2154";
  const LoadResult r = load(folder.write("dem.asc", grid(60, 60, heights)), options);
  ASSERT_TRUE(r.city && r.city->terrain);
  EXPECT_TRUE(std::isnan(r.city->terrain->at(50, 30)));
  EXPECT_FALSE(std::isnan(r.city->terrain->at(10, 30)));
  ASSERT_EQ(r.diagnostics.leftOut.size(), 1u);
  EXPECT_EQ(r.diagnostics.leftOut[0].what, "terrain samples");
}

TEST(ReadElevation, NeedsACrsAndSaysHowToGiveIt) {
  const TemporaryFolder folder;
  const LoadResult r = load(folder.write("dem.asc", grid(2, 2, {1, 2, 3, 4})));
  EXPECT_FALSE(r.city);
  EXPECT_NE(messagesOf(r.diagnostics).find("states no CRS: give one with --crs"), std::string::npos)
      << messagesOf(r.diagnostics);
}

TEST(ReadElevation, BuildingsStandOnIt) {
  const TemporaryFolder folder;
  // A slope of 1 in 10 to the east, 400 m wide.
  std::vector<double> heights;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) heights.push_back(200 + column);
  LoadOptions options;
  options.crs = "EPSG:2154";
  options.elevation = {folder.write("dem.asc", grid(40, 40, heights))};
  const LoadResult r =
      load(folder.write(
               "town.geojson",
               geoJson({feature("Polygon", "[[[600200,6500200],[600220,6500200],[600220,6500210],[600200,6500210]]]",
                                R"({"height": 8})")})),
           options);
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  ASSERT_EQ(r.city->buildings.size(), 1u);
  ASSERT_TRUE(r.city->terrain);
  const city::Instance& i = r.city->buildings.instances[0];
  const city::BuildingGeometry& g = r.city->buildingTypes[0];
  EXPECT_NEAR(i.position.z + r.city->origin.z, 200 + 20.5, 1e-3) << "the mean of the ground along the outline";
  // Walls reach below the lowest ground under them.
  EXPECT_LT(i.position.z + static_cast<double>(g.bounds.min.z),
            *r.city->terrain->heightAt(i.position.x - 10, i.position.y));
  EXPECT_NEAR(g.levels[0].top, 8, 1e-6);
}

}  // namespace
}  // namespace vicus::assets
