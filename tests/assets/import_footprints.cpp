#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "assets/import/columns.hpp"
#include "assets/import/extrude.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using city::BuildingGeometry;
using city::PlaneKind;
using testing::HasSubstr;

/// Coordinates of a polygon near (600 000, 6 500 000) from rings of points given relative to it.
std::string polygon(const std::vector<std::vector<glm::dvec2>>& rings) {
  std::string out = "[";
  for (size_t r = 0; r < rings.size(); ++r) {
    out += r ? ",[" : "[";
    for (size_t i = 0; i <= rings[r].size(); ++i) {
      const glm::dvec2 p = rings[r][i % rings[r].size()] + glm::dvec2(600000, 6500000);
      char text[64];
      std::snprintf(text, sizeof text, "%s[%.6f,%.6f]", i ? "," : "", p.x, p.y);
      out += text;
    }
    out += "]";
  }
  return out + "]";
}

LoadResult loadFeatures(const std::vector<std::string>& features, const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return load(folder.write("town.geojson", geoJson(features)), options);
}

/// The same with bare walls and roofs without eaves, whose areas are known.
LoadResult loadBare(const std::vector<std::string>& features) {
  const TemporaryFolder folder;
  folder.write("town.geojson", geoJson(features));
  return load(folder.write("town.toml", "[[sources]]\nfile = \"town.geojson\"\n[[styles]]\nrules = \"bare\"\n"));
}

const std::vector<glm::dvec2> kL{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}};
const std::vector<glm::dvec2> kHole{{2, 2}, {5, 2}, {5, 5}, {2, 5}};
constexpr double kLArea = 20 * 8 + 8 * 12, kHoleArea = 9;

TEST(Footprints, LShapeWithCourtyardHasItsAreaAndVolume) {
  const LoadResult r = loadBare({feature("Polygon", polygon({kL, kHole}), R"({"height": 10})")});
  const BuildingGeometry& g = onlyBuilding(r);
  const double foundation = 0.5;  // the least that walls reach below the ground
  EXPECT_NEAR(planAreaOf(g, PlaneKind::Roof), kLArea - kHoleArea, 1e-2);
  EXPECT_NEAR(areaOf(g, PlaneKind::Wall), (80 + 12) * (10 + foundation), 1e-3);
  // Under the roof there is something between nothing and a prism as high as the ridge.
  const double underRoof = volumeAbove(g, -foundation) - (kLArea - kHoleArea) * (10 + foundation);
  EXPECT_GT(underRoof, 0.2 * (kLArea - kHoleArea));
  EXPECT_LT(underRoof, (kLArea - kHoleArea) * (static_cast<double>(g.bounds.max.z) - 10));
  EXPECT_TRUE(windingAgreesWithNormals(g));
  EXPECT_EQ(g.occluders.size(), 10u);
  EXPECT_EQ(g.footprint.size(), 2u);
}

TEST(Footprints, WindingOfTheFileDoesNotMatter) {
  const LoadResult there = loadBare({feature("Polygon", polygon({kL, kHole}), R"({"height": 10})")});
  std::vector<glm::dvec2> l = kL, hole = kHole;
  std::reverse(l.begin(), l.end());
  std::reverse(hole.begin(), hole.end());
  const LoadResult back = loadBare({feature("Polygon", polygon({l, hole}), R"({"height": 10})")});
  EXPECT_NEAR(volumeAbove(onlyBuilding(there), 0), volumeAbove(onlyBuilding(back), 0), 1e-3);
  EXPECT_TRUE(windingAgreesWithNormals(onlyBuilding(back)));
}

TEST(Footprints, PointsInLineAndRepeatedOnesMakeNoWallsOfTheirOwn) {
  const LoadResult r = loadFeatures(
      {feature("Polygon", polygon({{{0, 0}, {0, 0}, {5, 0.001}, {10, 0}, {20, 0}, {20, 10}, {20, 10}, {0, 10}}}),
               R"({"height": 6})")});
  EXPECT_EQ(onlyBuilding(r).occluders.size(), 4u);
}

TEST(Footprints, RectangleGetsAGableRoofAlongItsLongSide) {
  const LoadResult r =
      loadBare({feature("Polygon", polygon({{{0, 0}, {20, 0}, {20, 8}, {0, 8}}}), R"({"height": 6})")});
  const BuildingGeometry& g = onlyBuilding(r);
  int roofs = 0, gables = 0;
  float ridge = 0;
  for (const city::Plane& p : g.planes) {
    roofs += p.kind == PlaneKind::Roof;
    gables += p.kind == PlaneKind::Gable;
    const bool fits = p.kind == PlaneKind::Gable  ? std::abs(p.normal.x) > 0.99f  // they look along the long side
                      : p.kind == PlaneKind::Roof ? p.normal.z > 0.8f
                                                  : true;
    EXPECT_TRUE(fits);
  }
  ridge = g.bounds.max.z - 6;
  EXPECT_EQ(roofs, 2);
  EXPECT_EQ(gables, 2);
  EXPECT_GE(ridge, 4 * std::tan(glm::radians(25.0f)) - 1e-3f);
  EXPECT_LE(ridge, 4 * std::tan(glm::radians(30.0f)) + 1e-3f);
  // A box and a prism over it.
  EXPECT_NEAR(volumeAbove(g, -0.5), 20 * 8 * 6.5 + 20 * 8 * static_cast<double>(ridge) / 2, 0.05);
}

TEST(Footprints, RidgesOfATerraceRunAlongTheStreet) {
  std::vector<std::string> features;
  for (int i = 0; i < 3; ++i)  // deeper than wide
    features.push_back(feature("Polygon", polygon({{{i * 6.0, 0}, {i * 6.0 + 6, 0}, {i * 6.0 + 6, 12}, {i * 6.0, 12}}}),
                               R"({"height": 6})"));
  const LoadResult r = loadFeatures(features);
  for (const BuildingGeometry& g : r.city->buildingTypes)
    for (const city::Plane& p : g.planes)
      EXPECT_TRUE(p.kind != PlaneKind::Gable || std::abs(p.normal.x) > 0.99f) << g.name;
}

TEST(Footprints, RoofsOfLargeHallsStayLow) {
  const LoadResult r =
      loadBare({feature("Polygon", polygon({{{0, 0}, {80, 0}, {80, 60}, {0, 60}}}), R"({"height": 6})")});
  EXPECT_NEAR(onlyBuilding(r).bounds.max.z, 6 + facade::kHighestRoof, 1e-3);
}

TEST(Footprints, HexagonGetsAPyramidOfItsOwnVolume) {
  std::vector<glm::dvec2> hexagon;
  for (int i = 0; i < 6; ++i) hexagon.emplace_back(5 * std::cos(i * M_PI / 3), 5 * std::sin(i * M_PI / 3));
  const LoadResult r = loadBare({feature("Polygon", polygon({hexagon}), R"({"height": 6})")});
  const BuildingGeometry& g = onlyBuilding(r);
  const double base = 1.5 * std::sqrt(3.0) * 25, rise = static_cast<double>(g.bounds.max.z) - 6;
  EXPECT_GT(rise, 1.5);
  EXPECT_NEAR(volumeAbove(g, -0.5), base * 6.5 + base * rise / 3, 0.2);
}

TEST(Footprints, BowTieIsRepairedAndNamed) {
  const LoadResult r =
      loadFeatures({feature("Polygon", polygon({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}), R"({"height": 5})")});
  EXPECT_EQ(r.city->buildings.size(), 1u);
  EXPECT_THAT(messagesOf(r.diagnostics),
              HasSubstr("1 footprint crossed or touched itself and was repaired: feature 0"));
}

TEST(Footprints, WhatHasNoAreaIsLeftOutByNameAndTheRestIsThere) {
  const LoadResult r = loadFeatures({feature("Polygon", polygon({{{0, 0}, {5, 0}, {10, 0}}}), R"({"height": 5})"),
                                     feature("Polygon", polygon({kL}), R"({"height": 5})"),
                                     feature("Point", "[600000,6500000]", R"({"height": 5})")});
  EXPECT_EQ(r.city->buildings.size(), 1u);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("feature 0: left out: its outline encloses no area"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("a POINT is no footprint"));
}

TEST(Footprints, MissingHeightsAreSixMetresAndCounted) {
  const LoadResult r = loadFeatures({feature("Polygon", polygon({kL}), R"({"HAUTEUR": null})"),
                                     feature("Polygon", polygon({{{50, 0}, {60, 0}, {60, 9}}}), R"({"HAUTEUR": 4})")});
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("1 building has no height and became 6 m high: feature 0"));
  for (const BuildingGeometry& g : r.city->buildingTypes)
    EXPECT_NEAR(g.levels[0].top, g.name == "feature 0" ? 6 : 4, 1e-6);
}

TEST(Footprints, StoreysServeWhereHeightsAreMissing) {
  const LoadResult r = loadFeatures({feature("Polygon", polygon({kL}), R"({"height": null, "building:levels": "4"})")});
  EXPECT_NEAR(onlyBuilding(r).levels[0].top, 4 * kStoreyHeight, 1e-6);
}

TEST(Footprints, ANamedColumnIsUsedAndAMissingOneIsAnError) {
  LoadOptions options;
  options.heightColumn = "z9";
  const LoadResult named = loadFeatures({feature("Polygon", polygon({kL}), R"({"height": 5, "z9": 11.5})")}, options);
  EXPECT_NEAR(onlyBuilding(named).levels[0].top, 11.5, 1e-6);
  const LoadResult missing = loadFeatures({feature("Polygon", polygon({kL}), R"({"height": 5})")}, options);
  EXPECT_TRUE(missing.diagnostics.hasErrors());
  EXPECT_THAT(messagesOf(missing.diagnostics),
              HasSubstr("there is no column z9 for the height; the columns are height"));
}

TEST(Footprints, AMultipolygonIsOneBuilding) {
  const std::string parts =
      "[" + polygon({{{0, 0}, {10, 0}, {10, 8}, {0, 8}}}) + "," + polygon({{{30, 0}, {40, 0}, {40, 8}, {30, 8}}}) + "]";
  const LoadResult r = loadFeatures({feature("MultiPolygon", parts, R"({"height": 6})")});
  EXPECT_EQ(r.city->buildings.size(), 1u);
  EXPECT_EQ(onlyBuilding(r).footprint.size(), 2u);
  EXPECT_EQ(onlyBuilding(r).occluders.size(), 8u);
}

TEST(Footprints, EqualFootprintsShareOneGeometry) {
  std::vector<std::string> features;
  for (int i = 0; i < 200; ++i)
    features.push_back(feature("Polygon",
                               polygon({{{i * 20.0, 0}, {i * 20.0 + 8, 0}, {i * 20.0 + 8, 6}, {i * 20.0, 6}}}),
                               R"({"height": 7})"));
  const LoadResult r = loadFeatures(features);
  EXPECT_EQ(r.city->buildings.size(), 200u);
  EXPECT_LE(r.city->buildingTypes.size(), 8u) << "at most eight variants of a type";
}

TEST(Footprints, BetweenNeighboursOnlyTheHigherWallShows) {
  const LoadResult r =
      loadFeatures({feature("Polygon", polygon({{{0, 0}, {10, 0}, {10, 8}, {0, 8}}}), R"({"height": 12})"),
                    feature("Polygon", polygon({{{10, 0}, {20, 0}, {20, 8}, {10, 8}}}), R"({"height": 8})")});
  ASSERT_EQ(r.city->buildingTypes.size(), 2u);
  for (const BuildingGeometry& g : r.city->buildingTypes) {
    const bool higher = g.name == "feature 0";
    int walls = 0, party = 0;
    for (const city::Plane& p : g.planes) {
      if (p.kind != PlaneKind::Wall) continue;
      ++walls;
      if (p.normal.x * (higher ? 1.0f : -1.0f) < 0.9f) continue;
      ++party;
      EXPECT_EQ(p.externalGeometry.count + p.externalOpenings.count, 0u) << "no windows between neighbours";
      for (uint32_t i = p.cut.first; i < p.cut.end(); ++i)
        EXPECT_GT(g.vertices[g.indices[i]].position.z, 8 - 0.31f - 0.25f);
    }
    EXPECT_EQ(walls, higher ? 4 : 3);
    EXPECT_EQ(party, higher ? 1 : 0);
  }
}

TEST(Footprints, AttributesStay) {
  const LoadResult r = loadFeatures({feature("Polygon", polygon({kL}), R"({"height": 5, "architecte": "Abadie"})")});
  const city::Instance& i = r.city->buildings.instances[0];
  ASSERT_LT(i.attributes, r.city->attributes.size());
  EXPECT_THAT(r.city->attributes[i.attributes], testing::Contains(testing::Pair("architecte", "Abadie")));
}

TEST(Footprints, GroundAltitudesMakeTheTerrain) {
  std::vector<std::string> features;
  for (int i = 0; i < 10; ++i)
    features.push_back(feature("Polygon",
                               polygon({{{i * 40.0, 0}, {i * 40.0 + 8, 0}, {i * 40.0 + 8, 6}, {i * 40.0, 6}}}),
                               R"({"height": 7, "altitude_s": )" + std::to_string(100 + 5 * i) + "}"));
  const LoadResult r = loadFeatures(features);
  ASSERT_TRUE(r.city && r.city->terrain) << messagesOf(r.diagnostics);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("terrain interpolated from the ground heights of 10 buildings"));
  EXPECT_NEAR(r.city->terrain->minHeight + r.city->origin.z, 100, 0.01);
  EXPECT_NEAR(r.city->terrain->maxHeight + r.city->origin.z, 145, 0.01);
  for (const city::Instance& i : r.city->buildings.instances)
    EXPECT_NEAR(i.position.z, *r.city->terrain->heightAt(i.position.x, i.position.y), 1.0);
}

TEST(Footprints, WithoutGroundAltitudesTheCityIsFlat) {
  const LoadResult r = loadFeatures({feature("Polygon", polygon({kL}), R"({"height": 5})")});
  EXPECT_FALSE(r.city->terrain);
  EXPECT_EQ(r.city->buildings.instances[0].position.z, 0);
}

TEST(Footprints, DegreesBecomeTheUtmZoneOfTheirCentre) {
  const TemporaryFolder folder;
  // 0.001° of latitude are 111.1 m.
  const LoadResult r = load(folder.write(
      "wgs84.geojson",
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":5},"geometry":{"type":"Polygon",
          "coordinates":[[[3.0,45.0],[3.001,45.0],[3.001,45.001],[3.0,45.001],[3.0,45.0]]]}}]})"));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->crs, "EPSG:32631");
  const glm::vec3 size = boundsOfSurfaces(r.city->buildingTypes[0]).size();
  EXPECT_NEAR(size.y, 111.1, 0.2);
  EXPECT_NEAR(size.x, 78.8, 0.2);
}

/// A city far from its CRS's origin is the same city: every vertex, every position.
TEST(Footprints, ShiftedByTenMillionMetresNothingChanges) {
  const std::vector<std::string> features{
      feature("Polygon", polygon({kL, kHole}), R"({"height": 10, "ground": 100})"),
      feature("Polygon", polygon({{{33.333333, 0.1}, {41.2, 0.3}, {40.7, 9.9}, {32.9, 9.7}}}),
              R"({"height": 6.6, "ground": 103})"),
      feature("Polygon", polygon({{{60, 60}, {71, 62}, {64, 74}}}), R"({"height": 5.1, "ground": 99})")};
  LoadOptions far;
  far.shift = {1e7, -1e7, 5000};
  const LoadResult a = loadFeatures(features), b = loadFeatures(features, far);
  ASSERT_TRUE(a.city && b.city);
  EXPECT_EQ(b.city->origin - a.city->origin, far.shift);
  ASSERT_EQ(a.city->buildings.size(), b.city->buildings.size());
  for (size_t i = 0; i < a.city->buildings.size(); ++i) {
    const glm::dvec3 d = a.city->buildings.instances[i].position - b.city->buildings.instances[i].position;
    EXPECT_LT(glm::length(d), 1e-3) << i;
    const auto& va = a.city->buildingTypes[a.city->buildings.instances[i].geometry].vertices;
    const auto& vb = b.city->buildingTypes[b.city->buildings.instances[i].geometry].vertices;
    ASSERT_EQ(va.size(), vb.size());
    for (size_t k = 0; k < va.size(); ++k) EXPECT_LT(glm::length(va[k].position - vb[k].position), 1e-3f);
  }
  ASSERT_TRUE(a.city->terrain && b.city->terrain);
  EXPECT_EQ(a.city->terrain->heights, b.city->terrain->heights);
}

TEST(Footprints, NoCrsWithDegreesAsksForOne) {
  const TemporaryFolder folder;
  // A CSV with well-known text has no CRS of its own.
  const std::string file =
      folder.write("bare.csv", "WKT,height\n\"POLYGON((3 45,3.001 45,3.001 45.001,3 45.001,3 45))\",5\n");
  const LoadResult without = load(file);
  EXPECT_FALSE(without.city);
  EXPECT_THAT(messagesOf(without.diagnostics), HasSubstr("states no CRS, and its coordinates look like degrees"));
  EXPECT_THAT(messagesOf(without.diagnostics), HasSubstr("--crs"));
  LoadOptions options;
  options.crs = "EPSG:4326";
  EXPECT_TRUE(load(file, options).city);
}

TEST(Footprints, SameInputSameCity) {
  const std::vector<std::string> features{
      feature("Polygon", polygon({kL, kHole}), R"({"height": 10})"),
      feature("Polygon", polygon({{{30, 0}, {40, 0}, {35, 9}}}), R"({"height": 4})")};
  const LoadResult a = loadFeatures(features), b = loadFeatures(features);
  ASSERT_EQ(a.city->buildingTypes.size(), b.city->buildingTypes.size());
  for (size_t i = 0; i < a.city->buildingTypes.size(); ++i)
    EXPECT_EQ(a.city->buildingTypes[i].vertices, b.city->buildingTypes[i].vertices);
}

TEST(LoadCity, SaysWhatIsWrongWithItsInputs) {
  const TemporaryFolder folder;
  EXPECT_THAT(messagesOf(load((folder.path() / "nothing.shp").string()).diagnostics),
              HasSubstr("there is no such file"));
  EXPECT_THAT(messagesOf(load(folder.write("text.txt", "hello")).diagnostics),
              HasSubstr("is of no kind that can be read"));
  EXPECT_THAT(
      messagesOf(load(folder.write("empty.geojson", R"({"type":"FeatureCollection","features":[]})")).diagnostics),
      HasSubstr("holds no building footprints"));
  LoadOptions options;
  options.crs = "EPSG:nonsense";
  EXPECT_THAT(messagesOf(loadFeatures({feature("Polygon", polygon({kL}), "{}")}, options).diagnostics),
              HasSubstr("the CRS EPSG:nonsense is not known"));
  EXPECT_FALSE(loadCity({}, {}).city);
}

TEST(LoadCity, NumbersOfHousesAreChecked) {
  for (const char* input : {"norvic:0", "norvic:", "norvic:-5", "norvic:1000001", "norvic:12x", "norvic:1e3"}) {
    const LoadResult r = load(input);
    EXPECT_FALSE(r.city) << input;
    EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("whole number from 1 to 1000000")) << input;
  }
  const std::string two[] = {"norvic", "other.shp"};
  EXPECT_THAT(messagesOf(loadCity(two, {}).diagnostics), HasSubstr("a built-in scene stands alone"));
}

TEST(Columns, NumbersInText) {
  EXPECT_DOUBLE_EQ(numberIn("12.5 m"), 12.5);
  EXPECT_DOUBLE_EQ(numberIn("ca. 7,5"), 7.5);
  EXPECT_DOUBLE_EQ(numberIn("-3"), -3);
  EXPECT_TRUE(std::isnan(numberIn("unknown")));
  EXPECT_TRUE(std::isnan(numberIn("")));
}

TEST(Columns, TheUsualNames) {
  const auto known = [](const char* name, std::span<const std::string_view> names) {
    const std::string columns[] = {name};
    return columnsNamed(columns, names).size() == 1;
  };
  for (const char* name : {"height", "hauteur", "HAUTEUR", "measuredHeight"}) EXPECT_TRUE(known(name, heightNames()));
  for (const char* name : {"levels", "story_ht_", "NB_ETAGES"}) EXPECT_TRUE(known(name, storeyNames())) << name;
  for (const char* name : {"Z_MIN_SOL", "altitude_s", "altitude_minimale_sol"})
    EXPECT_TRUE(known(name, groundNames())) << name;
  for (const char* name : {"Z_MAX_TOIT", "Z_MIN_TOIT"}) EXPECT_TRUE(known(name, roofNames())) << name;
}

TEST(Footprints, AltitudesOfRoofAndGroundGiveTheHeight) {
  const LoadResult r = loadFeatures({feature(
      "Polygon", polygon({kL}), R"({"Z_MIN_SOL": 200, "Z_MAX_SOL": 204, "Z_MIN_TOIT": 212, "Z_MAX_TOIT": 215})")});
  EXPECT_NEAR(onlyBuilding(r).levels[0].top, 10, 1e-6) << "eaves over the ground half way up the slope";
  EXPECT_EQ(r.city->origin.z, 202);
  const LoadResult ridge =
      loadFeatures({feature("Polygon", polygon({kL}), R"({"Z_MIN_SOL": 200, "Z_MAX_TOIT": 215})")});
  EXPECT_NEAR(onlyBuilding(ridge).levels[0].top, 15, 1e-6);
  const LoadResult storeys = loadFeatures({feature("Polygon", polygon({kL}), R"({"story_ht_": 4})")});
  EXPECT_NEAR(onlyBuilding(storeys).levels[0].top, 12, 1e-6);
}

TEST(Columns, NamesInTheOrderOfPreference) {
  const std::vector<std::string> columns{"H_MAX", "Hauteur", "measured_height", "name"};
  EXPECT_EQ(columnsNamed(columns, heightNames()), (std::vector<size_t>{2, 1, 0}));
}

}  // namespace
}  // namespace vicus::assets
