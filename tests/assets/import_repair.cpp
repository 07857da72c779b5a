// What is wrong with real buildings, and what becomes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cityjson_text.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using city::BuildingGeometry;
using city::PlaneKind;
using testing::HasSubstr;
using testing::Not;

double volumeOf(const BuildingGeometry& g) {
  return volumeAbove(g, static_cast<double>(g.bounds.min.z));
}

LoadResult loadShape(const std::string& geometry, const std::string& vertices, const std::string& more = "") {
  return loadText(cityJson(object("b", "Building", geometry, more), vertices));
}

std::string multiSurface(const std::vector<std::string>& surfaces) {
  return geometry("MultiSurface", "2", join(surfaces));
}

constexpr double kWalls = 2 * (10 + 8) * 6;

/// The box with one corner of its top half a metre higher.
const std::string kBentBox =
    "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6500],[0,8000,6000]]";

TEST(Repair, AFaceThatIsNotFlatKeepsAllItsCorners) {
  const LoadResult r = loadShape(solid({kGround, kSouth, kEast, kNorth, kWest, kTop}), kBentBox);
  const BuildingGeometry& g = onlyBuilding(r);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 building has surfaces that are not flat to 2 cm"));
  EXPECT_NEAR(planAreaOf(g, PlaneKind::Roof), 80, 1e-2);
  EXPECT_NEAR(g.bounds.max.z, 6.5, 1e-3);
  // By one diagonal or by the other.
  EXPECT_GT(volumeOf(g), 480 + 40 * 0.5 / 3 - 0.1);
  EXPECT_LT(volumeOf(g), 480 + 80 * 0.5 / 3 + 0.1);
  EXPECT_TRUE(windingAgreesWithNormals(g));
}

TEST(Repair, ASolidWithoutHeightIsAFootprint) {
  const std::string flat =
      "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0]]";
  const LoadResult r =
      loadShape(solid({kGround, kSouth, kEast, kNorth, kWest, kTop}), flat, R"(,"attributes":{"measuredHeight":9})");
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 solid has no height and became footprints: b"));
  EXPECT_NEAR(onlyBuilding(r).levels[0].top, 9, 1e-6);
  EXPECT_NEAR(planAreaOf(onlyBuilding(r), PlaneKind::Roof), 80, 1e-2) << "its bottom and its top are one outline";
}

/// The box with a terrace sunk by 1 m behind a parapet.
const std::string kTerraceBox =
    "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000],"
    "[1000,1000,6000],[9000,1000,6000],[9000,7000,6000],[1000,7000,6000],"
    "[1000,1000,5000],[9000,1000,5000],[9000,7000,5000],[1000,7000,5000]]";
const std::vector<std::string> kParapet{"[[13,12,8,9]]", "[[14,13,9,10]]", "[[15,14,10,11]]", "[[12,15,11,8]]"};

TEST(Repair, HolesWoundLikeTheirOutlineTurnNothing) {
  for (const char* rim : {"[[4,5,6,7],[8,9,10,11]]", "[[4,5,6,7],[11,10,9,8]]"}) {
    std::vector<std::string> surfaces{kGround, kSouth, kEast, kNorth, kWest, rim, "[[12,13,14,15]]"};
    surfaces.insert(surfaces.end(), kParapet.begin(), kParapet.end());
    for (const std::string& shape : {solid(surfaces), multiSurface(surfaces)}) {
      const LoadResult r = loadShape(shape, kTerraceBox);
      const BuildingGeometry& g = onlyBuilding(r);
      EXPECT_NEAR(planAreaOf(g, PlaneKind::Roof), 80, 1e-2) << "the terrace is seen from above";
      EXPECT_NEAR(volumeOf(g), 480 - 48, 1e-2);
      EXPECT_TRUE(windingAgreesWithNormals(g));
      EXPECT_EQ(r.diagnostics.messages.size(), 0u) << messagesOf(r.diagnostics);
    }
  }
}

TEST(Repair, WhatIsOpenAtItsTopIsSeenFromBothSides) {
  const LoadResult r = loadShape(multiSurface({kGround, kSouth, kEast, kNorth, kWest}), kBox);
  EXPECT_NEAR(areaOf(onlyBuilding(r), PlaneKind::Wall), 2 * kWalls, 1e-2);
  const LoadResult roofed = loadShape(multiSurface({kTop, kSouth, kEast, kNorth, kWest}), kBox);
  EXPECT_NEAR(areaOf(onlyBuilding(roofed), PlaneKind::Wall), kWalls, 1e-2);
}

TEST(Repair, ASolidWithoutOneWallIsClosed) {
  const std::vector<std::string> withoutEast{kGround, kSouth, kNorth, kWest, kTop};
  const LoadResult r = loadShape(solid(withoutEast), kBox);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 solid was not closed; what was missing was filled in: b"));
  EXPECT_NEAR(areaOf(onlyBuilding(r), PlaneKind::Wall), kWalls, 1e-2);
  EXPECT_NEAR(volumeOf(onlyBuilding(r)), 480, 1e-2);
  EXPECT_TRUE(windingAgreesWithNormals(onlyBuilding(r)));
  // A shed may be open at one side.
  const LoadResult shed = loadShape(multiSurface(withoutEast), kBox);
  EXPECT_THAT(messagesOf(shed.diagnostics), Not(HasSubstr("not closed")));
  EXPECT_NEAR(areaOf(onlyBuilding(shed), PlaneKind::Wall), kWalls - 48, 1e-2);
}

TEST(Repair, AMissingRoofThatIsNotFlatBecomesTriangles) {
  const LoadResult r = loadShape(solid({kGround, kSouth, kEast, kNorth, kWest}), kBentBox);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 solid was not closed"));
  EXPECT_NEAR(planAreaOf(onlyBuilding(r), PlaneKind::Roof), 80, 1e-2);
  EXPECT_TRUE(windingAgreesWithNormals(onlyBuilding(r)));
}

TEST(Repair, AMissingRoofLeavesTheCourtyardOpen) {
  const std::string court =
      "[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000],"
      "[3000,3000,0],[6000,3000,0],[6000,5000,0],[3000,5000,0],"
      "[3000,3000,6000],[6000,3000,6000],[6000,5000,6000],[3000,5000,6000]]";
  const LoadResult r = loadShape(solid({"[[0,3,2,1],[8,9,10,11]]", kSouth, kEast, kNorth, kWest, "[[9,8,12,13]]",
                                        "[[10,9,13,14]]", "[[11,10,14,15]]", "[[8,11,15,12]]"}),
                                 court);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 solid was not closed; what was missing"));
  EXPECT_NEAR(planAreaOf(onlyBuilding(r), PlaneKind::Roof), 80 - 6, 1e-2);
  EXPECT_NEAR(volumeOf(onlyBuilding(r)), (80 - 6) * 6, 1e-2);
}

TEST(Repair, ASolidOfWhichMostIsMissingStaysAsItIs) {
  const LoadResult r = loadShape(solid({kSouth}), kBox);
  EXPECT_THAT(messagesOf(r.diagnostics), Not(HasSubstr("what was missing was filled in")));
  EXPECT_NEAR(areaOf(onlyBuilding(r), PlaneKind::Wall), 2 * 60, 1e-3);
}

std::string square(double x, double y) {
  std::string out = "[[";
  for (const glm::dvec2 d : {glm::dvec2(0, 0), {9, 0}, {9, 7}, {0, 7}, {0, 0}}) {
    char text[64];
    std::snprintf(text, sizeof text, "%s[%.3f,%.3f]", out.size() > 2 ? "," : "", x + d.x, y + d.y);
    out += text;
  }
  return out + "]]";
}

TEST(Repair, MistypedCoordinatesAreLeftOutByName) {
  std::vector<std::string> features;
  for (int i = 0; i < 6; ++i)
    features.push_back(feature("Polygon", square(600000 + 20 * i, 6500000), R"({"height":5})"));
  // 6 500 000 with one digit changed, and a corner with one.
  features.push_back(feature("Polygon", square(600000, 6800000), R"({"height":5})"));
  features.push_back(
      feature("Polygon", "[[[600000,6500020],[600010,6500020],[600010,6500030],[660000,6500030]]]", R"({"height":5})"));
  const TemporaryFolder folder;
  const LoadResult r = load(folder.write("town.geojson", geoJson(features)));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->buildings.size(), 6u);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("2 buildings reach up to 300 km from the middle of all"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("left out: feature 6, feature 7"));
  for (const city::Instance& i : r.city->buildings.instances) EXPECT_LT(glm::length(glm::dvec2(i.position)), 200);
  // Two villages 4 km apart are both meant.
  features.resize(6);
  for (int i = 0; i < 3; ++i)
    features.push_back(feature("Polygon", square(600000 + 20 * i, 6504000), R"({"height":5})"));
  EXPECT_EQ(load(folder.write("villages.geojson", geoJson(features))).city->buildings.size(), 9u);
}

TEST(Repair, OneColourUnderManyNamesTellsNothing) {
  std::string objects, materials;
  for (int i = 0; i < 12; ++i) {
    const std::string n = std::to_string(i);
    objects += (i ? "," : "") +
               object("b" + n, "Building",
                      solid({kGround, kSouth, kEast, kNorth, kWest, kTop}, R"(,"material":{"m":{"value":)" + n + "}}"));
    materials += (i ? "," : "") + (R"({"name":"m)" + n + R"(","diffuseColor":[0.5,0,0]})");
  }
  std::string text = cityJson(objects, kBox);
  text.insert(1, R"("appearance":{"materials":[)" + materials + "]},");
  const LoadResult r = loadText(text);
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("all surfaces of a kind have one colour, which is not used"));
  for (const city::Material& m : r.city->materials) EXPECT_NE(m.name.substr(0, 1), "m") << m.name;
}

}  // namespace
}  // namespace vicus::assets
