#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <cmath>
#include <nlohmann/json.hpp>

#include "assets/scene/scene_description.hpp"
#include "assets/scene/suggest.hpp"
#include "assets/scene/write_scene.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using testing::HasSubstr;

std::string complaints(const std::string& text) {
  city::Diagnostics d;
  EXPECT_FALSE(parseScene(text, "town.toml", d)) << text;
  return messagesOf(d);
}

/// Two houses of 8 × 6 m in Lambert-93, one of them a church.
std::string houses() {
  return geoJson(
      {feature("Polygon", "[[[700000,6600000],[700008,6600000],[700008,6600006],[700000,6600006],[700000,6600000]]]",
               R"({"hoch":7,"usage":"Church"})"),
       feature("Polygon", "[[[700020,6600000],[700028,6600000],[700028,6600006],[700020,6600006],[700020,6600000]]]",
               R"({"hoch":9,"usage":"house"})")});
}

TEST(Suggest, DistancesCountLettersAndSwaps) {
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("terrian", "terrain"), 1u) << "a swap of neighbours";
  EXPECT_EQ(editDistance("", "abc"), 3u);
  const std::string known[] = {"sources", "terrain", "views"};
  EXPECT_EQ(nearest("source", known), "sources");
  EXPECT_EQ(nearest("terain", known), "terrain");
  EXPECT_EQ(nearest("elephant", known), "");
}

TEST(SceneDescription, EverythingIsRead) {
  city::Diagnostics d;
  const auto scene = parseScene(R"(
name = "Town"
crs = "EPSG:2154"
folder = "data"
[terrain]
files = ["a.tif", "b.tif"]
unit = "dm"
[[sources]]
file = "houses.shp"
height_column = "hoch"
lod = 2
default_height = 4
[[sources.styles]]
where = [{ attribute = "usage", equals = "church" }, { attribute = "built", below = 1700 }]
facade = "facade-limestone"
roof = "slate"
[[monuments]]
name = "Venus"
file = "venus.gltf"
lonlat = [2.5, 48.8]
heading = 90
height = 2.5
[[views]]
name = "square"
position = [700000, 6600000]
heading = 45
[[tours]]
name = "walk"
[[tours.keys]]
time = 0
position = [1, 2]
[[tours.keys]]
time = 10
position = [3, 4]
altitude = 100
[knobs]
"roam.pixel_error" = 2.5
cull_map = false
[avatars]
count = 12
characters = ["knight.glb"]
[environment]
sun_azimuth = 180
)",
                                "/scenes/town.toml", d);
  ASSERT_TRUE(scene) << messagesOf(d);
  EXPECT_EQ(scene->folder, "/scenes/data");
  EXPECT_EQ(scene->terrain.files.size(), 2u);
  EXPECT_EQ(scene->terrain.unit, "dm");
  ASSERT_EQ(scene->sources.size(), 1u);
  EXPECT_EQ(scene->sources[0].heightColumn, "hoch");
  EXPECT_EQ(scene->sources[0].lod, 2);
  ASSERT_EQ(scene->sources[0].styles.size(), 1u);
  EXPECT_EQ(scene->sources[0].styles[0].where.size(), 2u);
  EXPECT_EQ(scene->sources[0].styles[0].roof, Finish::Slate);
  ASSERT_EQ(scene->monuments.size(), 1u);
  EXPECT_TRUE(scene->monuments[0].place.degrees);
  EXPECT_NEAR(scene->monuments[0].heading, M_PI / 2, 1e-12);
  ASSERT_EQ(scene->tours.size(), 2u);
  EXPECT_EQ(scene->tours[1].keys[1].place.altitude, 100);
  ASSERT_EQ(scene->knobs.size(), 2u);
  EXPECT_THAT(scene->knobs[0].text + " " + scene->knobs[1].text, HasSubstr("cull_map=off"));
  EXPECT_EQ(scene->avatars.count, 12u);
}

TEST(SceneDescription, ErrorsNameLineColumnAndWhatWasMeant) {
  EXPECT_THAT(complaints("name = \"a\"\n\n[terain]\n"),
              HasSubstr("town.toml: line 3, column 2: the key terain is not known in a scene description; did you mean "
                        "terrain?"));
  EXPECT_THAT(complaints("[[sources]]\nfile = \"a\"\nheigth_column = \"h\""),
              HasSubstr("line 3, column 1: the key heigth_column is not known in this entry of sources; did you mean "
                        "height_column?"));
  EXPECT_THAT(complaints("[[sources]]\ncrs = \"EPSG:1\""), HasSubstr("this entry of sources lacks file"));
  EXPECT_THAT(complaints("name = 5"), HasSubstr("line 1, column 8: name is a text in quotes, not integer"));
  EXPECT_THAT(complaints("[terrain]\nunit = \"fet\""),
              HasSubstr("unit is one of m, dm, cm, ft, us-ft; did you mean ft?"));
  EXPECT_THAT(complaints("[[styles]]\nroof = \"slat\""), HasSubstr("did you mean slate?"));
  EXPECT_THAT(complaints("[[sources]]\nfile = \"a\"\nlod = 11"), HasSubstr("lod is 11; it goes from 0 to 10"));
  EXPECT_THAT(complaints("[[monuments]]\nfile = \"a\""), HasSubstr("lacks its place"));
  EXPECT_THAT(complaints("[[monuments]]\nfile = \"a\"\nposition = [1, 2, 3]"),
              HasSubstr("position is a list of 2 numbers"));
  EXPECT_THAT(complaints("[[monuments]]\nfile = \"a\"\nposition = [nan, 2]"),
              HasSubstr("position is a list of 2 numbers"));
  EXPECT_THAT(complaints("[[tours]]\nname = \"t\""), HasSubstr("a tour has keys"));
  EXPECT_THAT(complaints("name = \"a"), HasSubstr("town.toml: line 1, column"));
  EXPECT_THAT(complaints(std::string(5000, '[')), HasSubstr("line 1"));
}

TEST(SceneDescription, ColumnsStylesViewsAndLightReachTheCity) {
  const TemporaryFolder folder;
  folder.write("houses.geojson", houses());
  const std::string file = folder.write("town.toml", R"(
name = "Town"
crs = "EPSG:2154"
[[sources]]
file = "houses.geojson"
height_column = "hoch"
[[styles]]
where = [{ attribute = "usage", contains = "CHURCH" }]
facade = "facade-brick"
[[views]]
name = "gate"
position = [700010, 6600000]
above_ground = 2
[knobs]
"viewer.fov" = 50
[environment]
sun_elevation = 30
)");
  const LoadResult r = load(file);
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->name, "Town");
  ASSERT_EQ(r.city->buildings.size(), 2u);
  float tallest = 0;
  for (const city::BuildingGeometry& g : r.city->buildingTypes) tallest = std::max(tallest, g.occluders.at(0).top);
  EXPECT_FLOAT_EQ(tallest, 9);
  size_t brick = 0;
  for (const city::Material& m : r.city->materials) brick += m.source == "builtin:facade-brick";
  EXPECT_EQ(brick, 1u);
  ASSERT_EQ(r.city->tours.size(), 1u);
  const glm::dvec3 eye = r.city->tours[0].keys.at(0).position + r.city->origin;
  EXPECT_NEAR(eye.x, 700010, 1e-6);
  EXPECT_NEAR(eye.y, 6600000, 1e-6);
  EXPECT_NEAR(r.city->environment.sunElevation, M_PI / 6, 1e-12);
  ASSERT_EQ(r.settings.size(), 1u);
  EXPECT_EQ(r.settings[0].text, "viewer.fov=50");
}

TEST(SceneDescription, TheSunByDateStandsWhereItDoesInTheCitysPlace) {
  const TemporaryFolder folder;
  folder.write("houses.geojson", houses());
  const auto sunOf = [&](const std::string& environment) {
    const std::string file = folder.write(
        "town.toml", "crs = \"EPSG:2154\"\n[[sources]]\nfile = \"houses.geojson\"\n[environment]\n" + environment);
    LoadResult r = load(file);
    EXPECT_TRUE(r.city) << messagesOf(r.diagnostics);
    return r.city ? r.city->environment : city::Environment{};
  };
  // (700 000, 6 600 000) in Lambert-93 is 3° E 46.5° N.
  const city::Environment summer = sunOf("date = 2024-06-20\ntime = 12:00:00");
  EXPECT_NEAR(glm::degrees(summer.sunElevation), 90 - 46.5 + 23.44, 0.1);
  EXPECT_NEAR(glm::degrees(summer.sunAzimuth), 180, 2);
  // Its mean solar noon is twelve minutes before UTC's.
  const city::Environment clock = sunOf("date = 2024-06-20\ntime = 13:48:00\nutc_offset = 2");
  EXPECT_NEAR(clock.sunAzimuth, summer.sunAzimuth, 1e-3);
  const city::Environment south = sunOf("date = 2024-06-20\nlonlat = [3, -46.5]");
  EXPECT_NEAR(glm::degrees(south.sunElevation), 90 - 46.5 - 23.44, 0.1);
  EXPECT_NEAR(std::remainder(glm::degrees(south.sunAzimuth), 360.0), 0, 2);
}

TEST(SceneDescription, DatesThatAreNoneAreToldWithTheirPlace) {
  EXPECT_THAT(complaints("[environment]\ndate = \"1390-08-24\""),
              HasSubstr("line 2, column 8: date is a date like 1390-08-24, without quotes, not string"));
  EXPECT_THAT(complaints("[environment]\ndate = 2024-01-01\ntime = 14"), HasSubstr("time is a time like 14:30:00"));
  EXPECT_THAT(complaints("[environment]\ntime = 14:30:00"), HasSubstr("line 2, column 8: a time needs a date"));
  EXPECT_THAT(complaints("[environment]\ndate = 2024-01-01\nsun_elevation = 5"), HasSubstr("one is enough"));
  EXPECT_THAT(complaints("[environment]\ndate = 2024-01-01\nlonlat = [0, 91]"), HasSubstr("longitude (-180 to 180)"));
  EXPECT_THAT(complaints("[environment]\ndate = 2024-02-31"), HasSubstr("line 2"));
}

TEST(SceneDescription, FilesAreFoundBesideItOrInTheDataFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "data");
  folder.write("data/houses.geojson", houses());
  const std::string file = folder.write("town.toml", "[[sources]]\nfile = \"houses.geojson\"\n");
  EXPECT_THAT(messagesOf(load(file).diagnostics), HasSubstr("houses.geojson: there is no such file"));
  LoadOptions options;
  options.dataFolder = (folder.path() / "data").string();
  EXPECT_TRUE(load(file, options).city);
}

TEST(SceneDescription, AChangedDescriptionIsNoticedByTheCache) {
  const TemporaryFolder folder;
  folder.write("houses.geojson", houses());
  LoadOptions options;
  options.cacheFolder = (folder.path() / "cache").string();
  const auto town = [&](const std::string& column) {
    return load(
        folder.write("town.toml", "[[sources]]\nfile = \"houses.geojson\"\nheight_column = \"" + column + "\"\n"),
        options);
  };
  EXPECT_FALSE(town("hoch").fromCache);  // its result is dropped, which waits until the cache is written
  EXPECT_TRUE(town("hoch").fromCache);
  EXPECT_FALSE(town("usage").fromCache);
  folder.write("houses.geojson", houses() + " ");
  EXPECT_FALSE(town("usage").fromCache) << "one blank more in the data";
}

TEST(SceneDescription, ADraftCanBeReadAndGivesTheSameCity) {
  const TemporaryFolder folder;
  const std::string inputs[] = {folder.write("houses.geojson", houses())};
  const std::string out = (folder.path() / "town.toml").string();
  const DraftScene draft = draftScene(inputs, {}, out);
  EXPECT_THAT(draft.text, HasSubstr("file = \"houses.geojson\""));
  EXPECT_THAT(draft.text, HasSubstr("hoch = 7"));
  folder.write("town.toml", draft.text);
  const LoadResult again = load(out);
  ASSERT_TRUE(again.city) << messagesOf(again.diagnostics);
  EXPECT_EQ(again.city->buildings.size(), 2u);
  EXPECT_EQ(again.city->crs, "EPSG:2154");
  EXPECT_EQ(again.city->tours.size(), 1u);
}

/// A town of two houses in a folder, whose rules lie beside its description.
struct OwnRules {
  TemporaryFolder folder;
  OwnRules() {
    std::filesystem::create_directories(folder.path() / "data");
    folder.write("data/houses.geojson", houses());
    rules("2.5");
  }
  void rules(const std::string& storey) const {
    folder.write("own.rules", "param storey = " + storey +
                                  " m (2 .. 4)\n"
                                  "House => Extrude(house.height, Comp(side: Wall))\n"
                                  "Wall => RepeatY(storey, AttachScope(block, 0.1, 10, 20, oak))\n");
  }
  std::string scene(const std::string& parameters) const {
    return folder.write("town.toml",
                        "folder = \"data\"\n[[sources]]\nfile = \"houses.geojson\"\n"
                        "height_column = \"hoch\"\n[[styles]]\nrules = \"own.rules\"\n" +
                            parameters);
  }
  static size_t blocks(const LoadResult& loaded) {
    size_t count = 0;
    for (const city::BuildingGeometry& g : loaded.city->buildingTypes) count += g.externalGeometry.size();
    return count;
  }
};

TEST(SceneDescription, RulesLieBesideItAndTakeParameters) {
  const OwnRules town;
  const LoadResult usual = load(town.scene(""));
  ASSERT_TRUE(usual.city) << messagesOf(usual.diagnostics);
  EXPECT_EQ(messagesOf(usual.diagnostics), "");
  EXPECT_EQ(OwnRules::blocks(usual), 4u * 3 + 4u * 4) << "7 and 9 m in storeys of about 2.5 m";
  ASSERT_EQ(usual.rulesFiles.size(), 1u);
  EXPECT_TRUE(usual.rulesFiles[0].ends_with("own.rules"));
  const LoadResult higher = load(town.scene("parameters = { storey = 3.5 }\n"));
  ASSERT_TRUE(higher.city) << messagesOf(higher.diagnostics);
  EXPECT_EQ(OwnRules::blocks(higher), 4u * 2 + 4u * 3);
}

TEST(SceneDescription, ParametersAreChecked) {
  const OwnRules town;
  const auto complaint = [&](const std::string& text) {
    const LoadResult loaded = load(town.scene(text));
    EXPECT_FALSE(loaded.city) << text;
    return messagesOf(loaded.diagnostics);
  };
  EXPECT_THAT(complaint("parameters = { story = 3 }\n"),
              HasSubstr("line 7, column 16: the rules have no parameter story; did you mean storey?"));
  EXPECT_THAT(complaint("parameters = { storey = 31 }\n"), HasSubstr("storey is 31; it goes from 2 to 4 m"));
  EXPECT_THAT(complaint("parameters = { storey = \"high\" }\n"), HasSubstr("storey is a number, not string"));
  EXPECT_THAT(complaint("[[sources.styles]]\nparameters = { storey = 3 }\n"),
              HasSubstr("parameters belong to rules: name these, too"));
}

TEST(SceneDescription, TheCacheSeesTheContentOfRules) {
  const OwnRules town;
  LoadOptions options;
  options.cacheFolder = (town.folder.path() / "cache").string();
  const std::string scene = town.scene("");
  const LoadResult cold = load(scene, options);
  cold.cached.wait();
  EXPECT_TRUE(load(scene, options).fromCache);
  town.rules("4");
  const LoadResult changed = load(scene, options);
  changed.cached.wait();
  EXPECT_FALSE(changed.fromCache);
  EXPECT_LT(OwnRules::blocks(changed), OwnRules::blocks(cold));
}

/// The keys of docs/scene.schema.json are those that the parser knows: a description with every key of the schema has
/// no unknown one.
TEST(SceneDescription, TheSchemaKnowsTheSameKeys) {
  std::ifstream stream("docs/scene.schema.json");
  ASSERT_TRUE(stream) << "run from the repository's root";
  const nlohmann::json schema = nlohmann::json::parse(stream);
  const auto unknownKeys = [](const std::string& text) {
    city::Diagnostics d;
    parseScene(text, "town.toml", d);
    std::string out;
    for (const city::Diagnostic& m : d.messages)
      if (m.message.find("is not known in") != std::string::npos) out += m.message + "\n";
    return out;
  };
  const auto propertiesOf = [&](const nlohmann::json& node) {
    const nlohmann::json& inner = node.contains("items") ? node["items"] : node;
    return inner.contains("$ref") ? schema["$defs"][inner["$ref"].get<std::string>().substr(8)] : inner;
  };
  for (const auto& [key, node] : schema["properties"].items()) {
    EXPECT_EQ(unknownKeys(key + " = 1"), "");
    if (key == "knobs") continue;
    const nlohmann::json inner = propertiesOf(node);
    if (!inner.contains("properties")) continue;
    const bool list = node.contains("items");
    for (const auto& [name, ignored] : inner["properties"].items())
      EXPECT_EQ(unknownKeys((list ? "[[" : "[") + key + (list ? "]]" : "]") + "\n" + name + " = 1"), "")
          << key << "." << name;
  }
  // And the other way round: the examples use only what the schema has.
  for (const auto& entry : std::filesystem::directory_iterator("examples")) {
    if (entry.path().extension() != ".toml") continue;
    const toml::table table = toml::parse_file(entry.path().string());
    for (auto&& [key, node] : table) {
      ASSERT_TRUE(schema["properties"].contains(std::string(key.str()))) << entry.path() << " " << key.str();
      const nlohmann::json inner = propertiesOf(schema["properties"][std::string(key.str())]);
      if (key == "knobs" || !node.is_array() || !inner.contains("properties")) continue;
      for (const toml::node& item : *node.as_array())
        for (auto&& [name, ignored] : *item.as_table())
          EXPECT_TRUE(inner["properties"].contains(std::string(name.str()))) << entry.path() << " " << name.str();
    }
  }
}

}  // namespace
}  // namespace vicus::assets
