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

TEST(LimitSlope, WearsCliffsDownAndLeavesTheRest) {
  city::HeightField f = fieldOver(plan(0, 0, 480, 240), 12);
  double sum = 0;
  for (int row = 0; row < f.size.y; ++row)
    for (int column = 0; column < f.size.x; ++column) {
      const float h = (column < f.size.x / 2 ? 0.0f : 20.0f) + 0.01f * static_cast<float>(row);
      f.at(column, row) = h, sum += static_cast<double>(h);
    }
  f.at(3, 3) = NAN;
  const float far = f.at(0, 5);
  limitSlope(f, 0.3);
  double steepest = 0, after = 0;
  for (int row = 0; row < f.size.y; ++row)
    for (int column = 0; column < f.size.x; ++column) {
      const auto h = static_cast<double>(f.at(column, row));
      if (std::isnan(h)) continue;
      after += h;
      if (column > 0 && !std::isnan(f.at(column - 1, row)))
        steepest = std::max(steepest, std::abs(h - static_cast<double>(f.at(column - 1, row))) / 12);
    }
  EXPECT_LT(steepest, 0.3 * 1.05);
  EXPECT_NEAR(after, sum - 0.03, 0.05) << "what one side loses the other gains";
  EXPECT_EQ(f.at(0, 5), far);
  EXPECT_TRUE(std::isnan(f.at(3, 3)));
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

/// A virtual raster over dem.asc in the same folder that states what an ESRI grid cannot: a CRS and a unit.
std::string stating(const std::string& crs, const std::string& unit) {
  return "<VRTDataset rasterXSize=\"4\" rasterYSize=\"3\"><SRS>" + crs +
         "</SRS><GeoTransform>600000, 10, 0, 6500030, 0, -10</GeoTransform><VRTRasterBand dataType=\"Float32\" "
         "band=\"1\">" +
         (unit.empty() ? "" : "<UnitType>" + unit + "</UnitType>") +
         "<SimpleSource><SourceFilename relativeToVRT=\"1\">dem.asc</SourceFilename><SourceBand>1</SourceBand>"
         "</SimpleSource></VRTRasterBand></VRTDataset>";
}

TEST(ReadElevation, UnitsOfHeight) {
  const TemporaryFolder folder;
  folder.write("dem.asc", grid(4, 3, std::vector<double>(12, 1000)));
  struct Case {
    const char *crs, *unit, *wanted;
    double metres;
  };
  for (const Case& c :
       {Case{"EPSG:2154", "", "", 1000}, Case{"EPSG:2154", "ft", "", 304.8}, Case{"EPSG:2154", "dm", "", 100},
        Case{"EPSG:2154", "", "dm", 100}, Case{"EPSG:2154", "", "cm", 10}, Case{"EPSG:2154", "ft", "m", 1000},
        Case{"EPSG:2154", "", "us-ft", 1000 * 1200.0 / 3937},
        // The vertical part of a compound CRS: NAVD 88 in feet of the US survey.
        Case{"EPSG:2154+6360", "", "", 1000 * 1200.0 / 3937}, Case{"EPSG:2154+5720", "", "", 1000}}) {
    LoadOptions options;
    options.terrainUnit = c.wanted;
    const LoadResult r = load(folder.write("dem.vrt", stating(c.crs, c.unit)), options);
    ASSERT_TRUE(r.city && r.city->terrain) << c.crs << c.unit << messagesOf(r.diagnostics);
    EXPECT_NEAR(static_cast<double>(r.city->terrain->at(1, 1)) + r.city->origin.z, c.metres, 1e-3)
        << c.crs << " " << c.unit << " " << c.wanted;
    EXPECT_EQ(r.city->crs, "EPSG:2154");
  }
}

TEST(ReadElevation, DegreesBecomeMetres) {
  const TemporaryFolder folder;
  // 0.01° of latitude are 1.11 km, of longitude at 45° north 0.79 km; a plane that rises to the north.
  std::vector<double> heights;
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 50; ++column) heights.push_back(300 - 2 * row);
  std::string text = grid(50, 50, heights);
  text.replace(text.find("xllcorner 600000"), 16, "xllcorner 7.2")
      .replace(text.find("yllcorner 6500000"), 17, "yllcorner 45.0");
  text.replace(text.find("cellsize 10"), 11, "cellsize 0.0002");
  LoadOptions options;
  options.crs = "EPSG:4326";
  const LoadResult r = load(folder.write("dem.asc", text), options);
  ASSERT_TRUE(r.city && r.city->terrain) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->crs, "EPSG:32632");
  const city::HeightField& f = *r.city->terrain;
  EXPECT_NEAR(f.extent().y, 1111, 40);
  EXPECT_NEAR(f.extent().x, 789, 60);
  // 2 m for each 0.0002°, which are 22.2 m.
  const glm::dvec2 middle = f.origin + f.extent() / 2.0;
  const auto south = f.heightAt(middle.x, middle.y - 200), north = f.heightAt(middle.x, middle.y + 200);
  ASSERT_TRUE(south && north);
  EXPECT_NEAR(*north - *south, 400 * 2 / 22.22, 0.5);
}

TEST(Coordinates, CompoundAndForeignOnesAreBroughtToMetres) {
  const TemporaryFolder folder;
  const auto town = [&](const std::string& crs) {
    return load(folder.write(
        "town.city.json",
        R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":")" + crs +
            R"("},"transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{"b":{"type":"Building","geometry":)"
            R"([{"type":"Solid","lod":"1","boundaries":[[[[0,3,2,1]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],)"
            R"([[4,5,6,7]]]]}]}},"vertices":[[980000,200000,0],[980100,200000,0],[980100,200100,0],[980000,200100,0],)"
            R"([980000,200000,50],[980100,200000,50],[980100,200100,50],[980000,200100,50]]})"));
  };
  // New York in feet of the survey, heights too: 100 ft are 30.48 m.
  const LoadResult feet = town("EPSG:2263+6360");
  ASSERT_TRUE(feet.city) << messagesOf(feet.diagnostics);
  EXPECT_EQ(feet.city->crs, "EPSG:32618");
  const glm::vec3 size = feet.city->buildingTypes.at(0).bounds.size();
  EXPECT_NEAR(size.z, 50 * 0.3048, 0.01);
  EXPECT_NEAR(std::abs(areaOf(feet.city->buildingTypes[0], city::PlaneKind::Roof)), std::pow(100 * 0.3048, 2), 1);
  // Feet on the plan alone: the heights are in feet too, as nothing else is said.
  const LoadResult plan = town("EPSG:2263");
  ASSERT_TRUE(plan.city) << messagesOf(plan.diagnostics);
  EXPECT_NEAR(plan.city->buildingTypes.at(0).bounds.size().z, 50 * 0.3048, 0.01);
  // The vertical part in metres.
  const LoadResult mixed = town("EPSG:2263+5703");
  ASSERT_TRUE(mixed.city) << messagesOf(mixed.diagnostics);
  EXPECT_NEAR(mixed.city->buildingTypes.at(0).bounds.size().z, 50, 0.01);
}

TEST(Coordinates, RefusalsSayWhatToDo) {
  const TemporaryFolder folder;
  const auto town = [&](const std::string& name, double x, double y, const std::string& crs) {
    const auto at = [&](double dx, double dy) {
      return "[" + std::to_string(x + dx) + "," + std::to_string(y + dy) + "]";
    };
    return folder.write(
        name, R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":")" + crs +
                  R"("}},"features":[)" +
                  feature("Polygon", "[[" + at(0, 0) + "," + at(20, 0) + "," + at(20, 20) + "," + at(0, 0) + "]]",
                          R"({"height":8})") +
                  "]}");
  };
  // Metres in a file that says degrees.
  const LoadResult metres = load(town("metres.geojson", 600000, 6500000, "urn:ogc:def:crs:OGC:1.3:CRS84"));
  EXPECT_FALSE(metres.city);
  EXPECT_NE(messagesOf(metres.diagnostics)
                .find("degrees, but its coordinates reach from 600000.00 m to 600020.00 m: "
                      "give their true CRS with --crs"),
            std::string::npos)
      << messagesOf(metres.diagnostics);
  LoadOptions told;
  told.crs = "EPSG:2154";
  const LoadResult mended = load(town("metres.geojson", 600000, 6500000, "urn:ogc:def:crs:OGC:1.3:CRS84"), told);
  ASSERT_TRUE(mended.city) << messagesOf(mended.diagnostics);
  EXPECT_EQ(mended.city->crs, "EPSG:2154");
  // Two towns that no city holds.
  const std::string two[] = {town("here.geojson", 600000, 6500000, "urn:ogc:def:crs:EPSG::2154"),
                             town("there.geojson", 900000, 6900000, "urn:ogc:def:crs:EPSG::2154")};
  const LoadResult far = loadCity(two, {});
  ASSERT_TRUE(far.city);
  EXPECT_EQ(far.city->buildings.size(), 1u);
  EXPECT_NE(messagesOf(far.diagnostics).find("lies 500 km from " + two[0] + " and is left out: is its CRS right?"),
            std::string::npos)
      << messagesOf(far.diagnostics);
  // A CRS that nobody knows.
  told.crs = "EPSG:999999";
  EXPECT_NE(messagesOf(load(town("here.geojson", 600000, 6500000, "urn:ogc:def:crs:EPSG::2154"), told).diagnostics)
                .find("EPSG:999999"),
            std::string::npos);
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
