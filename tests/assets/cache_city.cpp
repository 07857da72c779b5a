#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assets/cache/city_codec.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

/// A small city with something in every list.
CachedCity fullCity() {
  CachedCity out;
  city::City& c = out.city;
  c.name = "Città";
  c.origin = {1e7 + 0.125, -3, 78};
  c.crs = "EPSG:2154";
  c.materials = {{"stone", "builtin:ashlar", {2, 3}, {0.5f, 0.6f, 0.7f}, 0.25f, 0.125f, false}};
  city::BuildingBuilder builder("house");
  builder.beginLevel(0, 3);
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0);
  builder.beginFlat();
  builder.addQuad({0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, 0);
  builder.beginExternalGeometry(0.25f);
  builder.addBox({1, 0, 1}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, 0}, {1, 1, 0.25f}, 0);
  builder.beginExternalOpening(0.2f);
  builder.addQuad({1, 0.2f, 1}, {2, 0.2f, 1}, {2, 0.2f, 2}, {1, 0.2f, 2}, 0);
  builder.addOccluder({{0, 0}, {4, 0}, 0, 3});
  builder.setFootprint({{{0, 0}, {4, 0}, {4, 4}}});
  c.buildingTypes.push_back(builder.finish());
  c.treeTypes.push_back({"oak", {c.buildingTypes[0].vertices, c.buildingTypes[0].indices}, c.buildingTypes[0].bounds});
  c.meshes = c.treeTypes;
  c.meshes[0].name = "castle";
  city::Monument monument;
  monument.name = "keep", monument.position = {3, 4, 5}, monument.heading = 0.5f, monument.attributes = 0;
  c.monuments = {monument};
  city::HeightField field;
  field.origin = {-5, -6}, field.spacing = {2, 3}, field.size = {2, 2};
  field.heights = {1, std::numeric_limits<float>::quiet_NaN(), -2, 4};
  field.updateRange();
  c.terrain = field;
  c.groundCover = city::GroundCover{{1, 2}, 4, {2, 1}, {city::Ground::Street, city::Ground::Bank}};
  c.water = {{"Wensum", -1.5, {{0, 0}, {9, 0}, {9, 9}}, {0, 1, 2}}};
  city::StreetGraph streets;
  streets.nodes = {{{0, 0, 0}}, {{9, 9, 1}}};
  streets.edges = {{0, 1, 6, city::StreetKind::HighStreet, "High Street"}};
  c.streets = streets;
  c.tours = {{"street", {{0, {1, 2, 3}, 0.1, 0.2}, {5, {4, 5, 6}, 0.3, 0.4}}, true}};
  c.attributes = {{{"source", "Atlas"}, {"year", "1841"}}};
  c.environment = {1, 0.5, 900};
  city::CityParts parts;
  city::Instance instance;
  instance.position = {2, 3, 4}, instance.heading = 1, instance.seed = 77, instance.attributes = 0;
  parts.buildings = {instance, instance};
  parts.trees = {instance};
  finishCity(c, std::move(parts));
  out.diagnostics.warn("file", "feature 3", "repaired");
  out.diagnostics.error("file", "", "broken");
  out.diagnostics.leftOut = {{"buildings", 2, "no area"}};
  return out;
}

TEST(CityCodec, RoundTripIsBitExact) {
  const CachedCity city = fullCity();
  const std::string bytes = encodeCity(city);
  const auto back = decodeCity(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(encodeCity(*back), bytes);
  // Encoding again would not notice a list that was never written.
  const city::City &a = city.city, &b = back->city;
  EXPECT_EQ(b.name, a.name);
  EXPECT_EQ(b.origin, a.origin);
  EXPECT_EQ(b.crs, a.crs);
  EXPECT_EQ(b.extent, a.extent);
  EXPECT_EQ(b.materials, a.materials);
  ASSERT_EQ(b.buildingTypes.size(), 1u);
  EXPECT_EQ(b.buildingTypes[0].vertices, a.buildingTypes[0].vertices);
  EXPECT_EQ(b.buildingTypes[0].externalOpenings.size(), 1u);
  EXPECT_EQ(b.buildingTypes[0].footprint, a.buildingTypes[0].footprint);
  EXPECT_EQ(b.buildings.size(), 2u);
  EXPECT_EQ(b.trees.size(), 1u);
  EXPECT_EQ(b.monuments.at(0).bounds, a.monuments[0].bounds);
  EXPECT_EQ(b.tiles.size(), a.tiles.size());
  EXPECT_TRUE(std::isnan(b.terrain.value().heights.at(1)));
  EXPECT_EQ(b.groundCover.value().kinds, a.groundCover->kinds);
  EXPECT_EQ(b.water.at(0).indices, a.water[0].indices);
  EXPECT_EQ(b.streets.value().edges.at(0).name, "High Street");
  EXPECT_TRUE(b.tours.at(0).jumps);
  EXPECT_EQ(b.attributes, a.attributes);
  EXPECT_EQ(b.environment.hazeDistance, 900);
  EXPECT_EQ(messagesOf(back->diagnostics), messagesOf(city.diagnostics));
}

TEST(CityCodec, EmptyOptionsStayEmpty) {
  const auto back = decodeCity(encodeCity({}));
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->city.terrain || back->city.streets || back->city.groundCover);
}

TEST(CityCodec, CutOffAnywhereGivesNothing) {
  const std::string bytes = encodeCity(fullCity());
  for (size_t size = 0; size < bytes.size(); size += 1 + size / 40)
    EXPECT_FALSE(decodeCity(std::string_view(bytes).substr(0, size))) << size;
  EXPECT_FALSE(decodeCity(bytes + "x"));
}

TEST(CityCodec, RandomDamageNeverReadsTooFar) {
  const std::string bytes = encodeCity(fullCity());
  for (size_t at = 0; at < bytes.size(); at += 7) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
    decodeCity(damaged);  // what comes of it does not matter; the sanitizers watch
  }
}

TEST(LoadCity, FromTheCacheIsTheSameCity) {
  const TemporaryFolder folder;
  std::vector<std::string> features;
  for (int i = 0; i < 20; ++i) {
    const std::string x = std::to_string(600000 + 20 * i), right = std::to_string(600012 + 20 * i);
    features.push_back(feature(
        "Polygon", "[[[" + x + ",6500000],[" + right + ",6500000],[" + right + ",6500009],[" + x + ",6500009]]]",
        R"({"height": 6, "ground": )" + std::to_string(50 + i) + "}"));
  }
  const std::string file = folder.write("town.geojson", geoJson(features));
  LoadOptions options;
  options.cacheFolder = (folder.path() / "cache").string();
  const LoadResult cold = load(file, options);
  cold.cached.wait();  // it is written while the city is shown
  const LoadResult warm = load(file, options);
  ASSERT_TRUE(cold.city && warm.city);
  EXPECT_FALSE(cold.fromCache);
  EXPECT_TRUE(warm.fromCache);
  EXPECT_EQ(encodeCity({*cold.city, cold.diagnostics}), encodeCity({*warm.city, warm.diagnostics}));

  // Another option is another scene; other content is made anew.
  LoadOptions shifted = options;
  shifted.shift.x = 1e6;
  EXPECT_FALSE(load(file, shifted).fromCache);
  EXPECT_TRUE(load(file, options).fromCache);
  features.pop_back();
  folder.write("town.geojson", geoJson(features));
  const LoadResult changed = load(file, options);
  changed.cached.wait();
  EXPECT_FALSE(changed.fromCache);
  EXPECT_EQ(changed.city->buildings.size(), 19u);
  EXPECT_THAT(messagesOf(changed.diagnostics), testing::HasSubstr("made from other data"));
  EXPECT_TRUE(load(file, options).fromCache);
}

}  // namespace
}  // namespace vicus::assets
