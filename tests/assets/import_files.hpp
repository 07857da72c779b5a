/// Files for the import tests: written where nobody else writes, or the real ones where they are at hand.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "assets/load_city.hpp"

namespace vicus::assets {

/// A folder of its own for each test, gone afterwards.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            ("vicus-" + std::string(info->test_suite_name()) + "-" + info->name() + "-" + std::to_string(getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path() const { return path_; }
  /// Writes a file and gives its path.
  std::string write(const std::string& name, std::string_view content) const {
    const std::filesystem::path file = path_ / name;
    std::ofstream(file, std::ios::binary) << content;
    return file.string();
  }

 private:
  std::filesystem::path path_;
};

/// Path of a real data set; empty where it is not at hand (then the test skips itself).
inline std::string realData(const std::string& name) {
  const char* folder = std::getenv("VICUS_DATA");
  const std::filesystem::path path = std::filesystem::path(folder ? folder : "../shared/data") / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

inline LoadResult load(const std::string& file, const LoadOptions& options = {}) {
  const std::string inputs[] = {file};
  return loadCity(inputs, options);
}

/// All messages and reasons for what was left out, one a line.
inline std::string messagesOf(const city::Diagnostics& d) {
  std::string out;
  for (const city::Diagnostic& m : d.messages) out += describe(m) + "\n";
  for (const city::LeftOut& l : d.leftOut) out += l.what + " " + std::to_string(l.count) + ": " + l.why + "\n";
  return out;
}

/// The building of a file that holds one.
inline const city::BuildingGeometry& onlyBuilding(const LoadResult& r) {
  EXPECT_TRUE(r.city) << messagesOf(r.diagnostics);
  EXPECT_EQ(r.city->buildingTypes.size(), 1u) << messagesOf(r.diagnostics);
  return r.city->buildingTypes.at(0);
}

/// Calls `visit(first index)` for each triangle of walls, roofs and what goes into them; what sticks out closes
/// nothing.
template <class F>
void forEachClosingTriangle(const city::BuildingGeometry& g, F&& visit) {
  const auto over = [&](city::Range range) {
    for (uint32_t i = range.first; i + 2 < range.end(); i += 3) visit(i);
  };
  for (const city::Plane& plane : g.planes) {
    over(plane.cut);
    for (uint32_t i = plane.externalOpenings.first; i < plane.externalOpenings.end(); ++i)
      over(g.externalOpenings[i].indices);
  }
}

/// Volume under a building's surfaces above `floor`, m³: right where they are wound outward and close all but the
/// floor.
inline double volumeAbove(const city::BuildingGeometry& g, double floor) {
  double volume = 0;
  forEachClosingTriangle(g, [&](uint32_t i) {
    glm::dvec3 p[3];
    for (uint32_t k = 0; k < 3; ++k) p[k] = glm::dvec3(g.vertices[g.indices[i + k]].position) - glm::dvec3(0, 0, floor);
    volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
  });
  return volume;
}

/// Bounds of walls and roofs without what sticks out of them.
inline city::Aabbf boundsOfSurfaces(const city::BuildingGeometry& g) {
  city::Aabbf box;
  forEachClosingTriangle(g, [&](uint32_t i) {
    for (uint32_t k = 0; k < 3; ++k) box.extend(g.vertices[g.indices[i + k]].position);
  });
  return box;
}

/// Area of all planes of a kind, m².
inline double areaOf(const city::BuildingGeometry& g, city::PlaneKind kind) {
  double area = 0;
  for (const city::Plane& plane : g.planes) {
    if (plane.kind != kind) continue;
    for (uint32_t i = plane.cut.first; i + 2 < plane.cut.end(); i += 3) {
      const glm::dvec3 a(g.vertices[g.indices[i]].position), b(g.vertices[g.indices[i + 1]].position),
          c(g.vertices[g.indices[i + 2]].position);
      area += glm::length(glm::cross(b - a, c - a)) / 2;
    }
  }
  return area;
}

/// The same seen from above, m².
inline double planAreaOf(const city::BuildingGeometry& g, city::PlaneKind kind) {
  double area = 0;
  for (const city::Plane& plane : g.planes) {
    if (plane.kind != kind) continue;
    for (uint32_t i = plane.cut.first; i + 2 < plane.cut.end(); i += 3) {
      const glm::dvec3 a(g.vertices[g.indices[i]].position), b(g.vertices[g.indices[i + 1]].position),
          c(g.vertices[g.indices[i + 2]].position);
      area += glm::cross(b - a, c - a).z / 2;
    }
  }
  return area;
}

/// Every triangle turns the way that its vertices' normals say.
inline bool windingAgreesWithNormals(const city::BuildingGeometry& g) {
  for (uint32_t i = 0; i + 2 < g.fullDetail.count; i += 3) {
    const city::Vertex &a = g.vertices[g.indices[i]], &b = g.vertices[g.indices[i + 1]],
                       &c = g.vertices[g.indices[i + 2]];
    const glm::vec3 cross = glm::cross(b.position - a.position, c.position - a.position);
    if (glm::dot(cross, city::unpackNormal(a.normal)) <= 0) return false;
  }
  return true;
}

/// A GeoJSON collection in metres (RGF93 / Lambert-93) from features given as text.
inline std::string geoJson(const std::vector<std::string>& features) {
  std::string out =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::2154"}},"features":[)";
  for (size_t i = 0; i < features.size(); ++i) out += (i ? "," : "") + features[i];
  return out + "]}";
}

/// A feature from the coordinates of a Polygon or MultiPolygon and its properties, both as JSON text.
inline std::string feature(const std::string& type, const std::string& coordinates, const std::string& properties) {
  return R"({"type":"Feature","geometry":{"type":")" + type + R"(","coordinates":)" + coordinates +
         R"(},"properties":)" + properties + "}";
}

}  // namespace vicus::assets
