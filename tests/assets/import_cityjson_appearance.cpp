// Appearances, templates, levels of detail and text sequences of CityJSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "import_files.hpp"

namespace vicus::assets {
namespace {

using testing::HasSubstr;

constexpr const char* kHead =
    R"({"type":"CityJSON","version":"2.0","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/2154"},)"
    R"("transform":{"scale":[0.001,0.001,0.001],"translate":[600000,6500000,100]},)";
const std::string kVertices =
    R"([[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000]])";
const std::string kBox = "[[[0,3,2,1]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]]]";

/// A file of one byte is a picture as far as finding it goes.
std::string loadable(const TemporaryFolder& folder, const std::string& rest) {
  folder.write("wall.jpg", "x");
  return folder.write("town.city.json", kHead + rest + "}");
}

const city::Material& materialOf(const city::City& city, const city::Plane& plane) {
  return city.materials.at(plane.baseTexture);
}

TEST(CityJsonAppearance, TexturesKeepTheirCoordinates) {
  const TemporaryFolder folder;
  const LoadResult r = load(loadable(
      folder,
      R"("appearance":{"textures":[{"type":"JPG","image":"wall.jpg"}],"vertices-texture":[[0.1,0.2],[0.9,0.2],[0.9,0.7],[0.1,0.7]]},)"
      R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[)" +
          kBox +
          R"(],"texture":{"photos":{"values":[[[[null]],[[0,0,1,2,3]],[[null]],[[null]],[[null]],[[null]]]]}}}]}},"vertices":)" +
          kVertices));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  const city::City& city = *r.city;
  const city::BuildingGeometry& g = city.buildingTypes.at(0);
  size_t textured = 0;
  for (const city::Plane& plane : g.planes) {
    if (!materialOf(city, plane).source.ends_with("wall.jpg")) continue;
    ++textured;
    EXPECT_LT(plane.normal.y, -0.99f) << "the southern wall";
    EXPECT_FALSE(materialOf(city, plane).repeat);
    for (uint32_t i = plane.cut.first; i < plane.cut.end(); ++i) {
      const city::Vertex& v = g.vertices[g.indices[i]];
      // x from −5 to 5 and z from 0 to 6 about the building's own origin.
      const float u = (v.position.x + 5) / 10, w = v.position.z / 6;
      EXPECT_NEAR(v.uv.x, 0.1f + 0.8f * u, 1e-4f);
      if (v.position.z >= 0) {
        EXPECT_NEAR(v.uv.y, 0.2f + 0.5f * w, 1e-4f);
      }
    }
  }
  EXPECT_EQ(textured, 1u);
}

TEST(CityJsonAppearance, ColoursAndMissingPictures) {
  const TemporaryFolder folder;
  const LoadResult r = load(loadable(
      folder,
      R"("appearance":{"materials":[{"name":"red","diffuseColor":[1,0,0]}],"textures":[{"type":"PNG","image":"gone.png"}],"vertices-texture":[[0,0]]},)"
      R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[)" +
          kBox +
          R"(],"material":{"m":{"value":0}},"texture":{"t":{"values":[[[[null]],[[0,0,0,0,0]],[[null]],[[null]],[[null]],[[null]]]]}}}]}},"vertices":)" +
          kVertices));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 picture is not beside the file (the first: \"gone.png\")"));
  const auto red = std::find_if(r.city->materials.begin(), r.city->materials.end(),
                                [](const city::Material& m) { return m.name == "red"; });
  ASSERT_NE(red, r.city->materials.end());
  EXPECT_EQ(red->tint, glm::vec3(1, 0, 0));
  for (const city::Plane& plane : r.city->buildingTypes.at(0).planes) EXPECT_EQ(materialOf(*r.city, plane).name, "red");
}

TEST(CityJsonAppearance, TemplatesStandAtTheirReferencePoints) {
  const TemporaryFolder folder;
  const std::string object =
      R"("ID":{"type":"Building","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[REF],"transformationMatrix":[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})";
  const auto instance = [&](const std::string& id, const std::string& reference) {
    std::string text = object;
    text.replace(text.find("ID"), 2, id);
    text.replace(text.find("REF"), 3, reference);
    return text;
  };
  const LoadResult r = load(folder.write(
      "town.city.json",
      kHead + std::string(R"("CityObjects":{)") + instance("a", "0") + "," + instance("b", "1") + "," +
          instance("c", "7") +
          R"(},"vertices":[[0,0,0],[50000,0,0]],"geometry-templates":{"templates":[{"type":"Solid","lod":"2","boundaries":[)" +
          kBox +
          R"(]}],"vertices-templates":[[0,0,0],[10,0,0],[10,8,0],[0,8,0],[0,0,6],[10,0,6],[10,8,6],[0,8,6]]}})"));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  ASSERT_EQ(r.city->buildings.size(), 2u);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("c: the reference point 7 of a template is out of range"));
  const glm::dvec3 apart = r.city->buildings.instances[1].position - r.city->buildings.instances[0].position;
  EXPECT_NEAR(std::abs(apart.x), 50, 1e-6);
  for (const city::BuildingGeometry& g : r.city->buildingTypes)
    EXPECT_NEAR(boundsOfSurfaces(g).size().x, 20, 1e-3) << "stretched twofold by its matrix";
}

TEST(CityJsonAppearance, TheWantedLevelOfDetail) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "town.city.json",
      kHead + std::string(R"("CityObjects":{"b":{"type":"Building","attributes":{"height":4},"geometry":[)") +
          R"({"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]},)" +
          R"({"type":"Solid","lod":"2.2","boundaries":[)" + kBox + R"(]}]}},"vertices":)" + kVertices + "}");
  LoadOptions options;
  const LoadResult fine = load(file, options);
  ASSERT_TRUE(fine.city);
  EXPECT_NEAR(fine.city->buildingTypes.at(0).height, 6, 1e-3);
  options.lod = 0;
  const LoadResult coarse = load(file, options);
  ASSERT_TRUE(coarse.city);
  EXPECT_GT(coarse.city->buildingTypes.at(0).occluders.at(0).top, 3.9f);
  EXPECT_LT(coarse.city->buildingTypes.at(0).occluders.at(0).top, 4.1f) << "extruded to its attribute";
}

TEST(CityJsonAppearance, TextSequences) {
  const TemporaryFolder folder;
  std::string text = kHead + std::string(R"("CityObjects":{},"vertices":[]})") + "\n";
  for (int k = 0; k < 40; ++k) {
    text += R"({"type":"CityJSONFeature","id":"b)" + std::to_string(k) + R"(","CityObjects":{"b)" + std::to_string(k) +
            R"(":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[)" + kBox +
            R"(]}]}},"vertices":)" + kVertices + "}\n";
  }
  text += "{\"type\":\"CityJSONFeature\", broken\n";
  const LoadResult r = load(folder.write("town.city.jsonl", text));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->buildings.size(), 40u);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("line 42, column 28: this is not JSON"));
}

TEST(CityJsonAppearance, AFeatureAloneSaysWhatIsMissing) {
  const TemporaryFolder folder;
  const LoadResult r =
      load(folder.write("one.city.jsonl", R"({"type":"CityJSONFeature","id":"b","CityObjects":{},"vertices":[]})"));
  EXPECT_FALSE(r.city);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("without the line before it"));
}

TEST(CityJsonAppearance, TheTwoTexturedBuildingsOfDelfshaven) {
  const std::string file = realData("delfshaven/two-buildings-textures/twobuildings_t.json");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  const LoadResult r = load(file);
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->buildings.size(), 2u);
  size_t photographs = 0;
  for (const city::Material& m : r.city->materials) photographs += m.source.ends_with(".jpg");
  EXPECT_EQ(photographs, 14u) << "all pictures in the folder are used";
}

}  // namespace
}  // namespace vicus::assets
