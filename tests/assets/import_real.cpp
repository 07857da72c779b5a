// Real data, counted by other means than the importer's: table sizes and plain walks over the JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/import/read_elevation.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

nlohmann::json readJson(const std::string& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

/// City objects of the given types that have no parent.
size_t rootObjects(const std::string& file, const std::set<std::string>& types) {
  size_t count = 0;
  const nlohmann::json root = readJson(file);
  for (const auto& [id, object] : root["CityObjects"].items())
    count += types.contains(object["type"].get<std::string>()) && !object.contains("parents");
  return count;
}

/// What every imported city must be like.
void expectSound(const LoadResult& r, size_t buildings) {
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_FALSE(r.diagnostics.hasErrors()) << messagesOf(r.diagnostics);
  const city::City& c = *r.city;
  EXPECT_EQ(c.buildings.size(), buildings) << messagesOf(r.diagnostics);
  for (size_t i = 0; i < c.buildings.size(); ++i) {
    const city::Instance& instance = c.buildings.instances[i];
    ASSERT_LT(instance.geometry, c.buildingTypes.size());
    ASSERT_LT(instance.attributes, c.attributes.size());
    const city::BuildingGeometry& g = c.buildingTypes[instance.geometry];
    EXPECT_GT(g.fullDetailTriangles(), 0u) << g.name;
    EXPECT_TRUE(windingAgreesWithNormals(g)) << g.name;
    EXPECT_LT(std::abs(instance.position.x) + std::abs(instance.position.y), 2e4) << g.name;
    for (const city::Vertex& v : g.vertices) ASSERT_LT(v.material, c.materials.size());
  }
}

/// Walls of extruded footprints reach into the ground at both ends of each.
void expectOnTheGround(const city::City& c) {
  ASSERT_TRUE(c.terrain);
  for (const city::Instance& instance : c.buildings.instances) {
    const city::BuildingGeometry& g = c.buildingTypes[instance.geometry];
    float lowest = 0;
    for (const city::OccluderLine& line : g.occluders) lowest = std::min(lowest, line.bottom);
    for (const city::OccluderLine& line : g.occluders)
      for (const glm::vec2& end : {line.a, line.b}) {
        const auto ground = c.terrain->heightAt(instance.position.x + static_cast<double>(end.x),
                                                instance.position.y + static_cast<double>(end.y));
        if (line.bottom > lowest) continue;  // a part that hangs, a wall over a neighbour's
        const double foot = instance.position.z + static_cast<double>(line.bottom);
        EXPECT_LT(foot, ground.value_or(foot + 1)) << g.name;
      }
  }
}

TEST(RealData, Perigueux) {
  const std::string file = realData("perigueux/bdnb_perigeux8.shp");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  // A shapefile's index has 100 bytes of header and 8 for each record.
  const size_t records = (std::filesystem::file_size(realData("perigueux/bdnb_perigeux8.shx")) - 100) / 8;
  EXPECT_EQ(records, 10381u);
  const LoadResult r = load(file);
  expectSound(r, records);
  expectOnTheGround(*r.city);
  ASSERT_TRUE(r.city->terrain);
  EXPECT_NEAR(r.city->terrain->minHeight + r.city->origin.z, 78, 1);
  EXPECT_NEAR(r.city->terrain->maxHeight + r.city->origin.z, 189.1, 1);
}

TEST(RealData, TheHague) {
  const std::string file = realData("denhaag/DenHaag_01.city.json");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  const LoadResult r = load(file);
  EXPECT_EQ(rootObjects(file, {"Building"}), 844u);
  expectSound(r, 844);
  EXPECT_EQ(r.city->crs, "EPSG:28992");
  ASSERT_TRUE(r.city->terrain);
}

TEST(RealData, Delfshaven) {
  const std::string file = realData("delfshaven/3-20-DELFSHAVEN.city.json");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  EXPECT_EQ(rootObjects(file, {"Building"}), 853u);
  expectSound(load(file), 853);
}

TEST(RealData, JerusalemAsFootprintsAndWithRoofs) {
  for (const char* name : {"jerusalem/2d_cityjson_with_terrain.json", "jerusalem/3d_cityjson_hip_test.json"}) {
    const std::string file = realData(name);
    if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
    EXPECT_EQ(rootObjects(file, {"Building", "Archway"}), 766u);
    const LoadResult r = load(file);
    expectSound(r, 766);
    ASSERT_TRUE(r.city->terrain);
    // The triangulated terrain spans 745 to 781 m.
    EXPECT_NEAR(r.city->terrain->minHeight + r.city->origin.z, 745, 1);
    EXPECT_NEAR(r.city->terrain->maxHeight + r.city->origin.z, 781, 1);
  }
}

TEST(RealData, Lyon) {
  const std::string file = realData("lyon/buildings_lyon1.geojson");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  const size_t features = readJson(file)["features"].size();
  EXPECT_EQ(features, 2576u);
  const LoadResult r = load(file);
  expectSound(r, features);
  expectOnTheGround(*r.city);
}

TEST(RealData, MonacoOnItsHills) {
  const std::string file = realData("monaco/monaco-latest.osm.pbf");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  LoadOptions options;
  options.elevation = {realData("monaco/N43E007.hgt.zip")};
  const LoadResult r = load(file, options);
  // ogr2ogr counts 1 207 polygons with a value of building other than no, and one building:part without an outline.
  expectSound(r, 1208);
  expectOnTheGround(*r.city);
  ASSERT_TRUE(r.city->terrain);
  EXPECT_GT(r.city->terrain->maxHeight, 500);
}

TEST(RealData, Elevation) {
  if (realData("dem").empty()) GTEST_SKIP() << "the real data sets are not here";
  struct Case {
    const char* name;
    double lowest, highest;  ///< of the file, metres (gdalinfo -stats)
  };
  for (const Case& c : {Case{"dem/SainteHelens.dem", 682, 2543}, Case{"dem/bigtujunga.tif", 311, 2294},
                        Case{"dem/malta_dtm_40.tif", -6.5, 251.3}, Case{"dem/mt_rainier_90m.tif", 250, 4390}}) {
    const LoadResult r = load(realData(c.name));
    ASSERT_TRUE(r.city && r.city->terrain) << messagesOf(r.diagnostics);
    EXPECT_LE(r.city->terrain->size.x, kLargestRaster);
    EXPECT_LE(r.city->terrain->size.y, kLargestRaster);
    EXPECT_GE(r.city->terrain->minHeight + r.city->origin.z, c.lowest - 1) << c.name;
    EXPECT_LE(r.city->terrain->maxHeight + r.city->origin.z, c.highest + 1) << c.name;
    EXPECT_GT(r.city->terrain->maxHeight - r.city->terrain->minHeight, 0.9 * (c.highest - c.lowest)) << c.name;
  }
}

/// Whatever is wrong with a file, loading it ends, and says something where nothing came of it.
TEST(RealData, MalformedFilesAreSurvived) {
  const std::string folder = realData("malformed");
  if (folder.empty()) GTEST_SKIP() << "the real data sets are not here";
  size_t files = 0;
  for (const char* part : {"cityjson", "rasterio", "osm"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(folder) / part)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || extension == ".md" || extension.empty()) continue;
      ++files;
      const LoadResult r = load(entry.path().string());
      EXPECT_TRUE(r.city || r.diagnostics.hasErrors()) << entry.path();
    }
  EXPECT_GT(files, 20u);
}

}  // namespace
}  // namespace vicus::assets
