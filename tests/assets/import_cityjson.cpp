#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "assets/import/projection.hpp"
#include "assets/import/read_cityjson.hpp"
#include "assets/import/surfaces.hpp"
#include "cityjson_text.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using city::BuildingGeometry;
using city::PlaneKind;
using testing::HasSubstr;

/// Walls and roof of the box, outward; the floor is not drawn.
void expectBox(const BuildingGeometry& g) {
  EXPECT_NEAR(areaOf(g, PlaneKind::Wall), 2 * (10 + 8) * 6, 1e-2);
  EXPECT_NEAR(areaOf(g, PlaneKind::Roof), 80, 1e-2);
  EXPECT_NEAR(volumeAbove(g, static_cast<double>(g.bounds.min.z)), 480, 1e-2);
  EXPECT_TRUE(windingAgreesWithNormals(g));
}

TEST(CityJson, ACubeIsABuildingAtItsOwnAltitude) {
  const LoadResult r =
      loadText(cityJson(object("b", "Building", solid({kGround, kSouth, kEast, kNorth, kWest, kTop})), kBox));
  const BuildingGeometry& g = onlyBuilding(r);
  expectBox(g);
  EXPECT_EQ(r.city->crs, "EPSG:2154");
  EXPECT_DOUBLE_EQ(r.city->origin.z + r.city->buildings.instances[0].position.z, 100);
  EXPECT_EQ(g.occluders.size(), 4u);
  for (const city::OccluderLine& line : g.occluders) {
    EXPECT_NEAR(line.bottom, 0, 1e-6);
    EXPECT_NEAR(line.top, 6, 1e-6);
  }
  EXPECT_EQ(r.diagnostics.messages.size(), 0u) << messagesOf(r.diagnostics);
}

TEST(CityJson, SemanticsGiveTheKinds) {
  const std::string semantics =
      R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"WallSurface"},{"type":"RoofSurface"}],"values":[[0,1,1,1,1,2]]})";
  const LoadResult r = loadText(
      cityJson(object("b", "Building", solid({kGround, kSouth, kEast, kNorth, kWest, kTop}, semantics)), kBox));
  expectBox(onlyBuilding(r));
}

TEST(CityJson, TurnsWhatIsWoundInward) {
  // All of it, and then only one wall of it.
  const LoadResult all = loadText(cityJson(
      object("b", "Building",
             solid({"[[0,1,2,3]]", "[[4,5,1,0]]", "[[5,6,2,1]]", "[[6,7,3,2]]", "[[7,4,0,3]]", "[[7,6,5,4]]"})),
      kBox));
  expectBox(onlyBuilding(all));
  EXPECT_THAT(messagesOf(all.diagnostics), HasSubstr("1 building has surfaces wound the wrong way round"));
  const LoadResult one =
      loadText(cityJson(object("b", "Building", solid({kGround, "[[4,5,1,0]]", kEast, kNorth, kWest, kTop})), kBox));
  expectBox(onlyBuilding(one));
  // Without its floor, as a multi-surface.
  const LoadResult open = loadText(
      cityJson(object("b", "Building",
                      geometry("MultiSurface", "2",
                               join({"[[4,5,1,0]]", "[[5,6,2,1]]", "[[6,7,3,2]]", "[[7,4,0,3]]", "[[7,6,5,4]]"}))),
               kBox));
  expectBox(onlyBuilding(open));
}

TEST(CityJson, ALoneWallIsSeenFromBothSides) {
  const LoadResult r = loadText(cityJson(object("b", "Building", geometry("MultiSurface", "2", join({kSouth}))), kBox));
  EXPECT_NEAR(areaOf(onlyBuilding(r), PlaneKind::Wall), 2 * 60, 1e-3);
}

TEST(CityJson, AWallWithAHole) {
  const LoadResult r = loadText(
      cityJson(object("b", "Building", solid({kGround, "[[0,1,5,4],[8,11,10,9]]", kEast, kNorth, kWest, kTop})), kBox));
  EXPECT_NEAR(areaOf(onlyBuilding(r), PlaneKind::Wall), 2 * (10 + 8) * 6 - 4, 1e-2);
  EXPECT_EQ(onlyBuilding(r).occluders.size(), 3u) << "a wall with a hole hides nothing for sure";
}

TEST(CityJson, MultiSolidsAndCompositeSurfaces) {
  const std::string box = join({kGround, kSouth, kEast, kNorth, kWest, kTop});
  for (const char* type : {"MultiSolid", "CompositeSolid"})
    expectBox(
        onlyBuilding(loadText(cityJson(object("b", "Building", geometry(type, "2.2", "[[" + box + "]]")), kBox))));
  expectBox(onlyBuilding(loadText(cityJson(object("b", "Building", geometry("CompositeSurface", "1.3", box)), kBox))));
}

TEST(CityJson, TheHighestLevelOfDetailThatCanBeUsed) {
  const std::string broken = geometry("Solid", "3", "[[[[0,1,99]]]]");
  const std::string lower = geometry("MultiSurface", "1", join({kTop}));
  const LoadResult r = loadText(cityJson(
      object("b", "Building", lower + "," + broken + "," + solid({kGround, kSouth, kEast, kNorth, kWest, kTop})),
      kBox));
  expectBox(onlyBuilding(r));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("b: vertex index 99 is out of range (0 to 11)"));
}

TEST(CityJson, ABuildingAndItsPartsAreOneInstance) {
  const std::string vertices = kBox.substr(0, kBox.size() - 1) +
                               ",[20000,0,0],[30000,0,0],[30000,8000,0],[20000,8000,0],[20000,0,6000],[30000,0,6000],["
                               "30000,8000,6000],[20000,8000,6000]]";
  const std::string second = solid({"[[12,15,14,13]]", "[[12,13,17,16]]", "[[13,14,18,17]]", "[[14,15,19,18]]",
                                    "[[15,12,16,19]]", "[[16,17,18,19]]"});
  const LoadResult r = loadText(
      cityJson(object("house", "Building", "", R"(,"children":["wing","tower"],"attributes":{"name":"Hall"})") + "," +
                   object("wing", "BuildingPart", solid({kGround, kSouth, kEast, kNorth, kWest, kTop}),
                          R"(,"parents":["house"])") +
                   "," + object("tower", "BuildingPart", second, R"(,"parents":["house"])"),
               vertices));
  const BuildingGeometry& g = onlyBuilding(r);
  EXPECT_EQ(r.city->buildings.size(), 1u);
  EXPECT_EQ(g.name, "house");
  EXPECT_NEAR(areaOf(g, PlaneKind::Roof), 160, 1e-2);
  EXPECT_THAT(r.city->attributes[0], testing::Contains(testing::Pair("name", "Hall")));
}

TEST(CityJson, CirclesOfParentsEnd) {
  const LoadResult r = loadText(cityJson(
      object("a", "BuildingPart", solid({kGround, kSouth, kEast, kNorth, kWest, kTop}), R"(,"parents":["b"])") + "," +
          object("b", "BuildingPart", geometry("MultiSurface", "2", join({kTop})), R"(,"parents":["a"])"),
      kBox));
  EXPECT_TRUE(r.city);
}

TEST(CityJson, AFootprintWithAHeightIsExtruded) {
  const LoadResult r = loadText(cityJson(object("b", "Building", geometry("MultiSurface", "0", "[[[0,1,2,3]]]"),
                                                R"(,"attributes":{"height":{"value":"7.5"}})"),
                                         kBox));
  const BuildingGeometry& g = onlyBuilding(r);
  EXPECT_NEAR(g.levels[0].top, 7.5, 1e-6);
  EXPECT_DOUBLE_EQ(r.city->origin.z + r.city->buildings.instances[0].position.z, 100);
}

TEST(CityJson, StoreysTimesTheirOwnHeight) {
  const LoadResult r =
      loadText(cityJson(object("b", "Building", geometry("MultiSurface", "0", "[[[0,1,2,3]]]"),
                               R"(,"attributes":{"numberOfFloors":{"value":2},"floorHeight":{"value":"3.5"}})"),
                        kBox));
  EXPECT_NEAR(onlyBuilding(r).levels[0].top, 7, 1e-6);
}

TEST(CityJson, AttributesKeepTheirSources) {
  const LoadResult r = loadText(cityJson(
      object(
          "b", "Building", solid({kGround, kSouth, kEast, kNorth, kWest, kTop}),
          R"(,"attributes":{"material":{"value":"dressed stone","sources":[{"name":"Atlas, sheet 11"}]},"year":1841})"),
      kBox));
  EXPECT_THAT(r.city->attributes.at(0),
              testing::IsSupersetOf({testing::Pair("material.value", "dressed stone"),
                                     testing::Pair("material.sources.name", "Atlas, sheet 11"),
                                     testing::Pair("year", "1841")}));
  EXPECT_TRUE(std::any_of(r.city->materials.begin(), r.city->materials.end(),
                          [](const city::Material& m) { return m.source == "builtin:facade-limestone"; }));
}

TEST(CityJson, TerrainIsGriddedAndBuildingsReachIt) {
  // Ground 1 m below the box, 60 m wide; the box's walls are lengthened to it.
  const std::string vertices = kBox.substr(0, kBox.size() - 1) +
                               ",[-30000,-30000,-1000],[30000,-30000,-1000],[30000,30000,-1000],[-30000,30000,-1000]]";
  const LoadResult r =
      loadText(cityJson(object("b", "Building", solid({kGround, kSouth, kEast, kNorth, kWest, kTop})) + "," +
                            object("t", "TINRelief", geometry("CompositeSurface", "1", "[[[12,13,14]],[[12,14,15]]]")),
                        vertices));
  ASSERT_TRUE(r.city && r.city->terrain) << messagesOf(r.diagnostics);
  EXPECT_NEAR(r.city->terrain->minHeight + r.city->origin.z, 99, 1e-4);
  EXPECT_NEAR(r.city->terrain->maxHeight + r.city->origin.z, 99, 1e-4);
  EXPECT_EQ(r.city->buildings.size(), 1u);
  const BuildingGeometry& g = onlyBuilding(r);
  EXPECT_NEAR(g.bounds.min.z, -1.3, 1e-3);
  EXPECT_NEAR(areaOf(g, PlaneKind::Wall), 2 * (10 + 8) * 7.3, 1e-2);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("b: hangs 1.00 m above the terrain"));
}

TEST(CityJson, WhatIsNoBuildingIsLeftOutByNameAndUnknownTypesAreShown) {
  const std::string box = solid({kGround, kSouth, kEast, kNorth, kWest, kTop});
  const LoadResult r = loadText(cityJson(
      object("r", "CityFurniture", geometry("MultiSurface", "1", join({kGround}))) + "," + object("a", "+Archway", box),
      kBox));
  EXPECT_EQ(r.city->buildings.size(), 1u);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("CityFurniture 1: objects of this type are not shown"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 objects of the type +Archway"));
}

TEST(CityJson, ErrorsNameThePlace) {
  const auto messages = [](const std::string& text) { return messagesOf(loadText(text).diagnostics); };
  EXPECT_THAT(messages("{\"type\":\"CityJSON\",\n \"version\": 2.0, }"), HasSubstr("line 2, column"));
  EXPECT_THAT(messages("{\"type\":\"CityJSON\",\n \"version\": 2.0, }"), HasSubstr("this is not JSON"));
  EXPECT_THAT(messages("[1,2]"), HasSubstr("this is not CityJSON"));
  EXPECT_THAT(messages(R"({"type":"CityJSON","version":"2.0"})"), HasSubstr("CityObjects: there are no city objects"));
  EXPECT_THAT(messages(R"({"type":"CityJSON","version":"2.0","CityObjects":{}})"),
              HasSubstr("there is no list of vertices"));
  EXPECT_THAT(messages(cityJson(object("b", "Building", solid({kTop})), "[[0,0,0],\"x\"]")), HasSubstr("vertex 1"));
  EXPECT_THAT(messages(cityJson(object("b", "Building", geometry("Blob", "2", "[]")), kBox)),
              HasSubstr("b: the geometry type Blob is not known"));
  EXPECT_THAT(messages(cityJson(object("b", "Building", geometry("Solid", "2", "[[[5]]]")), kBox)), HasSubstr("b: "));
  EXPECT_THAT(messages(cityJson(object("b", "Building", solid({kTop})), kBox, R"({"referenceSystem":"EPSG:9999999"})")),
              HasSubstr("the CRS EPSG:9999999 is not known; give one with --crs"));
  EXPECT_THAT(messages(cityJson(object("b", "Building", solid({kTop})), kBox, "{}")),
              HasSubstr("states no CRS: taken as metres of its own; give one with --crs"));
}

TEST(CityJson, OneBrokenBuildingDoesNotHideTheOthers) {
  const LoadResult r =
      loadText(cityJson(object("bad", "Building", solid({"[[0,1,-1]]"})) + "," +
                            object("good", "Building", solid({kGround, kSouth, kEast, kNorth, kWest, kTop})) + "," +
                            object("flat", "Building", geometry("MultiSurface", "2", "[[[0,1,0,1]]]")),
                        kBox));
  EXPECT_EQ(onlyBuilding(r).name, "good");
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("building bad 1: it has no geometry that can be used"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("building flat 1: none of its surfaces can be drawn"));
}

TEST(CityJson, RecognisedWhereverItsTypeStands) {
  EXPECT_TRUE(isCityJson(R"({"vertices": [], "type" : "CityJSON"})"));
  EXPECT_FALSE(isCityJson(R"({"type": "FeatureCollection", "name": "CityJSON"})"));
  EXPECT_FALSE(isCityJson(""));
}

TEST(Projection, KnowsTheSpellingsOfEpsgNames) {
  for (const char* name :
       {"EPSG:2154", "epsg:2154", " EPSG:2154 ", "urn:ogc:def:crs:EPSG::2154", "urn:ogc:def:crs:EPSG:6.9:2154",
        "https://www.opengis.net/def/crs/EPSG/0/2154", "http://www.opengis.net/def/crs/EPSG/0/2154"})
    EXPECT_EQ(crsName(crsFromText(name)), "EPSG:2154") << name;
  EXPECT_EQ(crsName(crsFromText("EPSG:7415")), "EPSG:28992") << "without its vertical part";
  for (const char* name : {"", "EPSG:", "EPSG:x", "nonsense", "/etc/passwd", "https://example.org/crs"})
    EXPECT_EQ(crsFromText(name), "") << name;
}

TEST(CityJson, DeepNestingIsNoDanger) {
  EXPECT_FALSE(loadText(std::string(200000, '[')).city);
  std::string deep = R"({"type":"CityJSON","version":"2.0","vertices":[],"CityObjects":)";
  for (int i = 0; i < 100000; ++i) deep += R"({"a":)";
  EXPECT_FALSE(loadText(deep).city);
}

// ---- Occluder lines ----

SurfaceBuilding wall(const std::vector<glm::dvec3>& points) {
  SurfaceBuilding b;
  b.points = points;
  // A wall and its reverse a metre behind it bound a volume, so that the front is drawn once.
  const auto n = static_cast<uint32_t>(points.size());
  for (const glm::dvec3& p : points) b.points.push_back(p + glm::dvec3(0, 1, 0));
  Surface front, back;
  std::vector<uint32_t> ring, reverse;
  for (uint32_t i = 0; i < n; ++i) ring.push_back(i), reverse.push_back(n + n - 1 - i);
  front.rings = {ring}, back.rings = {reverse};
  b.surfaces = {front, back};
  for (uint32_t i = 0; i < n; ++i) {
    Surface side;
    const uint32_t j = (i + 1) % n;
    side.rings = {{i, n + i, n + j, j}};
    b.surfaces.push_back(side);
  }
  return b;
}

/// The occluder line of the front wall (y = 0), if it has one.
std::optional<city::OccluderLine> frontLine(const std::vector<glm::dvec3>& points) {
  SurfaceReport report;
  const auto g = buildFromSurfaces(wall(points), "wall", {}, report);
  EXPECT_TRUE(g);
  for (const city::OccluderLine& line : g->occluders)
    if (line.a.y == 0 && line.b.y == 0) return line;
  return std::nullopt;
}

TEST(Occluders, GableWallHidesUpToItsEaves) {
  const auto line = frontLine({{0, 0, 0}, {8, 0, 0}, {8, 0, 5}, {4, 0, 9}, {0, 0, 5}});
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->bottom, 0, 1e-6);
  EXPECT_NEAR(line->top, 5, 1e-6);
}

TEST(Occluders, SteppedFootCountsFromItsHighestStep) {
  const auto line = frontLine({{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {8, 0, 2}, {8, 0, 6}, {0, 0, 6}});
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->bottom, 2, 1e-6);
  EXPECT_NEAR(line->top, 6, 1e-6);
}

TEST(Occluders, ATriangleHidesNothingOverItsWholeWidth) {
  EXPECT_FALSE(frontLine({{0, 0, 0}, {8, 0, 0}, {4, 0, 6}}));
}

}  // namespace
}  // namespace vicus::assets
