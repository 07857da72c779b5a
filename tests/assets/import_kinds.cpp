// OpenStreetMap, CityGML, meshes and tilesets: small files written here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>

#include "assets/import/apart.hpp"
#include "assets/import/read_mesh.hpp"
#include "import_files.hpp"

namespace vicus::assets {
namespace {

using testing::HasSubstr;

// ---- OpenStreetMap ----

/// An OSM file of ways over a grid of nodes 0.0001° apart (11 m north, 7.3 m east at 48.9°).
class OsmFile {
 public:
  std::string way(const std::vector<std::pair<int, int>>& corners, const std::string& tags, bool closed = true) {
    std::string out = "<way id=\"" + std::to_string(++ways_) + "\" version=\"1\">";
    std::vector<int> ids;
    for (const auto& [x, y] : corners) ids.push_back(node(x, y));
    if (closed) ids.push_back(ids.front());
    for (const int id : ids) out += "<nd ref=\"" + std::to_string(id) + "\"/>";
    text_ += out + tags + "</way>";
    return out;
  }
  void tree(int x, int y) { nodes_ += nodeText(++ids_, x, y, "<tag k=\"natural\" v=\"tree\"/>"); }
  std::string text() const { return "<?xml version='1.0'?><osm version=\"0.6\">" + nodes_ + text_ + "</osm>"; }

 private:
  static std::string nodeText(int id, int x, int y, const std::string& tags) {
    return "<node id=\"" + std::to_string(id) + "\" version=\"1\" lat=\"" + std::to_string(48.9 + y * 1e-4) +
           "\" lon=\"" + std::to_string(2.3 + x * 1e-4) + "\">" + tags + "</node>";
  }
  /// Ids increase through the file, as the format demands.
  int node(int x, int y) {
    const auto [found, isNew] = known_.emplace(std::pair(x, y), ids_ + 1);
    if (isNew) nodes_ += nodeText(++ids_, x, y, "");
    return found->second;
  }
  std::string nodes_, text_;
  std::map<std::pair<int, int>, int> known_;
  int ids_ = 0, ways_ = 0;
};

std::string tag(const std::string& key, const std::string& value) {
  return "<tag k=\"" + key + "\" v=\"" + value + "\"/>";
}

TEST(OpenStreetMap, HeightsRoofsAndPartsFollowTheMapsRules) {
  const TemporaryFolder folder;
  OsmFile osm;
  osm.way({{0, 0}, {2, 0}, {2, 2}, {0, 2}},
          tag("building", "yes") + tag("height", "12 m") + tag("roof:shape", "flat") + tag("start_date", "1650"));
  osm.way({{5, 0}, {7, 0}, {7, 2}, {5, 2}}, tag("building", "house") + tag("building:levels", "3") +
                                                tag("roof:shape", "gabled") + tag("roof:height", "4"));
  osm.way({{10, 0}, {12, 0}, {12, 2}, {10, 2}},
          tag("building", "yes") + tag("height", "10") + tag("roof:shape", "pyramidal") + tag("roof:height", "3"));
  // An outline with two parts that fill it: a low nave and a tower.
  osm.way({{20, 0}, {24, 0}, {24, 2}, {20, 2}}, tag("building", "church") + tag("height", "40"));
  osm.way({{20, 0}, {23, 0}, {23, 2}, {20, 2}},
          tag("building:part", "yes") + tag("height", "8") + tag("roof:shape", "flat"));
  osm.way({{23, 0}, {24, 0}, {24, 2}, {23, 2}},
          tag("building:part", "yes") + tag("height", "30") + tag("min_height", "5") + tag("roof:shape", "flat"));
  osm.way({{30, 0}, {31, 0}, {31, 1}, {30, 1}}, tag("building", "no"));
  const LoadResult r = load(folder.write("town.osm", osm.text()));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  ASSERT_EQ(r.city->buildings.size(), 4u) << messagesOf(r.diagnostics);
  std::vector<float> tops;
  for (const city::BuildingGeometry& g : r.city->buildingTypes) tops.push_back(boundsOfSurfaces(g).max.z);
  std::sort(tops.begin(), tops.end());
  EXPECT_NEAR(tops[0], 10, 1e-3) << "the pyramid's tip, not its eaves";
  EXPECT_NEAR(tops[1], 12, 1e-3);
  EXPECT_NEAR(tops[2], 13, 1e-3) << "three levels of 3 m and the roof over them";
  EXPECT_NEAR(tops[3], 30, 1e-3) << "the parts stand in the outline's place";
  for (const city::BuildingGeometry& g : r.city->buildingTypes) {
    EXPECT_TRUE(windingAgreesWithNormals(g)) << g.name;
    if (g.height < 29) continue;
    size_t hanging = 0;
    for (const city::OccluderLine& o : g.occluders) hanging += std::abs(o.bottom - 5) < 1e-3f;
    EXPECT_GE(hanging, 3u) << "the tower's walls begin 5 m up";
    EXPECT_GT(areaOf(g, city::PlaneKind::Floor), 50) << "and it has an underside";
  }
  bool dated = false;
  for (const city::Attributes& a : r.city->attributes)
    for (const auto& [key, value] : a) dated = dated || (key == "start_date" && value == "1650");
  EXPECT_TRUE(dated);
}

TEST(OpenStreetMap, RoofsThatAreSimplifiedAreNamed) {
  const TemporaryFolder folder;
  OsmFile osm;
  int x = 0;
  for (const char* shape : {"onion", "round", "onion", "gabled", "crosspitched"}) {
    osm.way({{x, 0}, {x + 2, 0}, {x + 2, 2}, {x, 2}},
            tag("building", "yes") + tag("height", "9") + tag("roof:shape", shape));
    x += 4;
  }
  const LoadResult r = load(folder.write("town.osm", osm.text()));
  EXPECT_THAT(messagesOf(r.diagnostics),
              HasSubstr("roofs that are simplified: 1 crosspitched as what suits the outline, "
                        "2 onion as domes, 1 round as gambrels"));
}

TEST(OpenStreetMap, StreetsWaterTreesAndWallsAreContent) {
  const TemporaryFolder folder;
  OsmFile osm;
  osm.way({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, tag("building", "yes") + tag("height", "8"));
  osm.way({{-5, 4}, {0, 4}, {5, 4}}, tag("highway", "residential") + tag("name", "Rue Haute") + tag("width", "7.5"),
          false);
  osm.way({{0, 4}, {0, 8}}, tag("highway", "footway"), false);
  osm.way({{0, 10}, {5, 10}}, tag("highway", "primary") + tag("tunnel", "yes"), false);
  osm.way({{8, 0}, {12, 0}, {12, 4}, {8, 4}}, tag("natural", "water"));
  osm.way({{-8, 0}, {-8, 6}}, tag("barrier", "city_wall") + tag("height", "9"), false);
  osm.tree(3, 3);
  osm.tree(4, 3);
  const LoadResult r = load(folder.write("town.osm", osm.text()));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  const city::City& c = *r.city;
  ASSERT_TRUE(c.streets);
  // Long pieces get nodes between; both streets meet in one node.
  std::set<std::string> names;
  for (const auto& e : c.streets->edges) names.insert(e.name);
  EXPECT_THAT(names, testing::UnorderedElementsAre("Rue Haute", ""));
  EXPECT_FLOAT_EQ(c.streets->edges[0].width, 7.5f);
  std::vector<int> degree(c.streets->nodes.size(), 0);
  for (const auto& e : c.streets->edges) ++degree[e.a], ++degree[e.b];
  EXPECT_EQ(std::count(degree.begin(), degree.end(), 3), 1) << "a junction";
  EXPECT_EQ(c.water.size(), 1u);
  EXPECT_EQ(c.trees.size(), 2u);
  ASSERT_FALSE(c.monuments.empty()) << "the wall, a mesh for each square that it crosses";
  for (const city::Monument& wall : c.monuments) EXPECT_NEAR(c.meshes[wall.mesh].bounds.max.z, 9, 1e-3);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("streets in tunnels 1"));
  for (const city::MeshGeometry& mesh : c.treeTypes)
    for (const city::Vertex& v : mesh.mesh.vertices) ASSERT_LT(v.material, c.materials.size());
}

// ---- CityGML ----

std::string posList(const std::vector<glm::ivec3>& corners) {
  std::string out;
  for (const glm::ivec3& c : corners)
    out += std::to_string(600000 + c.x) + " " + std::to_string(6500000 + c.y) + " " + std::to_string(100 + c.z) + " ";
  return out;
}

std::string polygon(const std::string& id, std::vector<glm::ivec3> corners) {
  corners.push_back(corners.front());
  return "<gml:surfaceMember><gml:Polygon gml:id=\"" + id + "\"><gml:exterior><gml:LinearRing gml:id=\"" + id +
         "r\"><gml:posList srsDimension=\"3\">" + posList(corners) +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}

std::string boundary(const std::string& kind, const std::string& surfaces) {
  return "<bldg:boundedBy><bldg:" + kind + "><bldg:lod2MultiSurface><gml:MultiSurface>" + surfaces +
         "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:" + kind + "></bldg:boundedBy>";
}

std::string cityGml(const std::string& version, const std::string& appearance) {
  const std::string base = "http://www.opengis.net/citygml/";
  const auto space = [&](const std::string& prefix, const std::string& part) {
    return " xmlns:" + prefix + "=\"" + base + part + version + "\"";
  };
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?><core:CityModel xmlns:core=\"" + base + version +
         "\" xmlns:gml=\"http://www.opengis.net/gml\"" + space("bldg", "building/") + space("app", "appearance/") +
         space("gen", "generics/") +
         "><gml:boundedBy><gml:Envelope srsName=\"EPSG:2154\" srsDimension=\"3\"><gml:lowerCorner>600000 6500000 "
         "100</gml:lowerCorner><gml:upperCorner>600010 6500008 106</gml:upperCorner></gml:Envelope></gml:boundedBy>" +
         appearance + "<core:cityObjectMember><bldg:Building gml:id=\"b1\">" +
         "<bldg:yearOfConstruction>1650</bldg:yearOfConstruction>" +
         boundary("GroundSurface", polygon("g", {{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}})) +
         boundary("WallSurface", polygon("s", {{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {0, 0, 6}}) +
                                     polygon("e", {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, {10, 0, 6}}) +
                                     polygon("n", {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}}) +
                                     polygon("w", {{0, 8, 0}, {0, 0, 0}, {0, 0, 6}, {0, 8, 6}})) +
         boundary("RoofSurface", polygon("r", {{0, 0, 6}, {10, 0, 6}, {10, 8, 6}, {0, 8, 6}})) +
         "</bldg:Building></core:cityObjectMember></core:CityModel>";
}

TEST(CityGml, VersionsOneAndTwoGiveTheSameBox) {
  const TemporaryFolder folder;
  for (const char* version : {"1.0", "2.0"}) {
    const LoadResult r = load(folder.write(std::string("town") + version[0] + ".gml", cityGml(version, "")));
    ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
    ASSERT_EQ(r.city->buildings.size(), 1u);
    const city::BuildingGeometry& g = r.city->buildingTypes.at(0);
    EXPECT_NEAR(areaOf(g, city::PlaneKind::Wall), 2 * (10 + 8) * 6, 1e-2);
    EXPECT_NEAR(areaOf(g, city::PlaneKind::Roof), 80, 1e-2);
    EXPECT_TRUE(windingAgreesWithNormals(g));
    EXPECT_EQ(r.city->crs, "EPSG:2154");
    EXPECT_NEAR(r.city->origin.z + r.city->buildings.instances[0].position.z, 100, 1e-9);
  }
}

TEST(CityGml, PicturesLieWhereTheirCoordinatesSay) {
  const TemporaryFolder folder;
  folder.write("wall.jpg", "x");
  const std::string appearance =
      "<app:appearanceMember><app:Appearance><app:theme>photos</app:theme><app:surfaceDataMember>"
      "<app:ParameterizedTexture><app:imageURI>wall.jpg</app:imageURI><app:wrapMode>none</app:wrapMode>"
      "<app:target uri=\"#s\"><app:TexCoordList><app:textureCoordinates ring=\"#sr\">0.1 0.2 0.9 0.2 0.9 0.7 0.1 0.7 "
      "0.1 0.2</app:textureCoordinates></app:TexCoordList></app:target></app:ParameterizedTexture>"
      "</app:surfaceDataMember></app:Appearance></app:appearanceMember>";
  const LoadResult r = load(folder.write("town.gml", cityGml("2.0", appearance)));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  const city::BuildingGeometry& g = r.city->buildingTypes.at(0);
  size_t textured = 0;
  for (const city::Plane& plane : g.planes) {
    if (!r.city->materials.at(plane.baseTexture).source.ends_with("wall.jpg")) continue;
    ++textured;
    EXPECT_LT(plane.normal.y, -0.99f);
    for (uint32_t i = plane.cut.first; i < plane.cut.end(); ++i) {
      const city::Vertex& v = g.vertices[g.indices[i]];
      EXPECT_NEAR(v.uv.x, 0.1f + 0.8f * (v.position.x + 5) / 10, 1e-4f);
    }
  }
  EXPECT_EQ(textured, 1u) << messagesOf(r.diagnostics);
}

// ---- Meshes ----

TEST(Meshes, ReadersThatAskForTooMuchAreEnded) {
  ApartLimits limits;
  limits.bytes = uint64_t{64} << 20;
  std::string why;
  const auto greedy = runApart(
      [] {
        std::string bytes;
        for (int i = 0; i < 40; ++i) bytes.append(size_t{32} << 20, 'x');
        return std::string("read");
      },
      limits, why);
  EXPECT_FALSE(greedy);
  EXPECT_THAT(why, HasSubstr("asked for more memory than there is"));
  EXPECT_EQ(runApart([] { return std::string("read"); }, {}, why), "read");
}

TEST(Meshes, StandOnTheirFeetAtTheirHeight) {
  const TemporaryFolder folder;
  // A tetrahedron, y up, its foot 1 unit under the file's origin.
  const std::string file =
      folder.write("statue.obj", "v -1 -1 -1\nv 1 -1 -1\nv 0 -1 1\nv 0 3 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  city::Diagnostics d;
  const auto mesh = readMesh(file, {"", 1, 2.0}, d);
  ASSERT_TRUE(mesh) << messagesOf(d);
  EXPECT_EQ(mesh->mesh.triangleCount(), 4u);
  city::Aabbf box;
  for (const city::Vertex& v : mesh->mesh.vertices) box.extend(v.position);
  EXPECT_NEAR(box.min.z, 0, 1e-6);
  EXPECT_NEAR(box.max.z, 2, 1e-6);
  EXPECT_NEAR(box.min.x + box.max.x, 0, 1e-6);
  EXPECT_NEAR(box.max.x - box.min.x, 1, 1e-6) << "scaled as a whole";
}

TEST(Meshes, ThoseWithoutTrianglesSayWhy) {
  const TemporaryFolder folder;
  city::Diagnostics d;
  EXPECT_FALSE(readMesh(folder.write("empty.obj", "v 0 0 0\n"), {}, d));
  EXPECT_FALSE(readMesh(folder.write("broken.gltf", "{\"asset\":"), {}, d));
  EXPECT_EQ(d.messages.size(), 2u) << messagesOf(d);
  EXPECT_THAT(messagesOf(d), HasSubstr("broken.gltf: byte 10: the mesh cannot be read"));
}

TEST(Meshes, AMonumentStandsOnTheGroundWhereTheSceneSays) {
  const TemporaryFolder folder;
  folder.write("statue.obj", "v -1 0 -1\nv 1 0 -1\nv 0 0 1\nv 0 3 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  folder.write(
      "houses.geojson",
      geoJson({feature("Polygon",
                       "[[[700000,6600000],[700008,6600000],[700008,6600006],[700000,6600006],[700000,6600000]]]",
                       R"({"height":7})")}));
  const LoadResult r = load(folder.write("town.toml", R"(
crs = "EPSG:2154"
[[sources]]
file = "houses.geojson"
[[monuments]]
name = "Statue"
file = "statue.obj"
position = [700020, 6600003]
heading = 90
)"));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  ASSERT_EQ(r.city->monuments.size(), 1u);
  const city::Monument& m = r.city->monuments[0];
  EXPECT_NEAR(m.position.x + r.city->origin.x, 700020, 1e-6);
  EXPECT_NEAR(m.position.y + r.city->origin.y, 6600003, 1e-6);
  EXPECT_NEAR(m.bounds.min.z, 0, 1e-3f) << "a city without terrain is flat at 0";
  EXPECT_EQ(r.city->materials.size() > m.mesh, true);
}

TEST(Meshes, VenusInItsPlace) {
  const std::string file = realData("venus/venus.gltf");
  if (file.empty()) GTEST_SKIP() << "the real data sets are not here";
  city::Diagnostics d;
  const auto mesh = readMesh(file, {"", 1, 2.0}, d);
  ASSERT_TRUE(mesh) << messagesOf(d);
  EXPECT_TRUE(d.messages.empty()) << messagesOf(d);
  EXPECT_GT(mesh->mesh.triangleCount(), 10000u);
  size_t pictures = 0;
  for (const SourceMaterial& m : mesh->materials) pictures += m.image.ends_with("Venus_C_Venus_O_Material_u1_v1.jpg");
  EXPECT_EQ(pictures, 1u);
}

// ---- 3D Tiles ----

template <typename T>
void append(std::string& out, std::initializer_list<T> values) {
  for (const T v : values) {
    char bytes[sizeof v];
    std::memcpy(bytes, &v, sizeof v);
    out.append(bytes, sizeof v);
  }
}

/// Two triangles of two batches as b3dm: y up, so that the file's −z is north.
std::string batchedModel() {
  std::string bin;
  append<float>(bin, {0, 0, 0, 10, 0, 0, 0, 6, 0, 20, 0, 0, 30, 0, 0, 20, 6, 0});
  append<float>(bin, {0, 0, 0, 1, 1, 1});
  append<uint16_t>(bin, {0, 1, 2, 3, 4, 5});
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"_BATCHID":1},"indices":2}]}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"},{"bufferView":1,"componentType":5126,"count":6,"type":"SCALAR"},{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24},{"buffer":0,"byteOffset":96,"byteLength":12}],"buffers":[{"byteLength":108}]})";
  while (json.size() % 4) json += ' ';
  std::string glb = "glTF";
  append<uint32_t>(glb, {2, static_cast<uint32_t>(12 + 8 + json.size() + 8 + bin.size())});
  append<uint32_t>(glb, {static_cast<uint32_t>(json.size()), 0x4E4F534A});
  glb += json;
  append<uint32_t>(glb, {static_cast<uint32_t>(bin.size()), 0x004E4942});
  glb += bin;
  const std::string features = R"({"BATCH_LENGTH":2})", batches = R"({"name":["mill","barn"]})";
  std::string b3dm = "b3dm";
  append<uint32_t>(b3dm, {1, static_cast<uint32_t>(28 + features.size() + batches.size() + glb.size()),
                          static_cast<uint32_t>(features.size()), 0, static_cast<uint32_t>(batches.size()), 0});
  return b3dm + features + batches + glb;
}

TEST(Tilesets, EachBatchIsABuilding) {
  const TemporaryFolder folder;
  folder.write("tile.b3dm", batchedModel());
  const LoadResult r = load(folder.write(
      "tileset.json",
      R"({"asset":{"version":"1.0"},"geometricError":100,"root":{"boundingVolume":{"sphere":[0,0,0,100]},"geometricError":0,"refine":"REPLACE","transform":[1,0,0,0,0,1,0,0,0,0,1,0,100,200,0,1],"content":{"uri":"tile.b3dm"}}})"));
  ASSERT_TRUE(r.city) << messagesOf(r.diagnostics);
  ASSERT_EQ(r.city->buildings.size(), 2u) << messagesOf(r.diagnostics);
  std::set<std::string> names;
  for (const city::Attributes& a : r.city->attributes)
    for (const auto& [key, value] : a) names.insert(value);
  EXPECT_EQ(names, (std::set<std::string>{"mill", "barn"}));
  for (const city::Instance& i : r.city->buildings.instances) {
    const glm::dvec3 p = i.position + r.city->origin;
    EXPECT_NEAR(p.y, 200, 1);
    EXPECT_NEAR(r.city->buildingTypes[i.geometry].height, 6, 0.01);
  }
}

TEST(Tilesets, OneThatNamesItselfEnds) {
  const TemporaryFolder folder;
  const LoadResult r = load(folder.write(
      "tileset.json",
      R"({"asset":{},"geometricError":1,"root":{"content":{"uri":"tileset.json"},"children":[{"content":{"uri":"gone.b3dm"}},{"content":{"uri":"http://else.where/a.b3dm"}}]}})"));
  EXPECT_FALSE(r.city);
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("named twice"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("gone.b3dm: the tile's content cannot be read"));
  EXPECT_THAT(messagesOf(r.diagnostics), HasSubstr("only files beside the tileset are read"));
}

}  // namespace
}  // namespace vicus::assets
