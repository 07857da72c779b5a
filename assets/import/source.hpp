/// What the readers hand over: the content of one file, before it becomes part of a city.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assets/import/polygon.hpp"
#include "assets/import/style_rules.hpp"
#include "city/city.hpp"
#include "facade/rules.hpp"

namespace vicus::assets {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr uint32_t kNoMaterial = 0xffffffffU;

/// What a file paints its surfaces with: a picture, or a colour alone.
struct SourceMaterial {
  std::string name;
  std::string image;    ///< path; empty: the colour alone
  glm::vec3 colour{1};  ///< linear, multiplies the picture
  bool repeat = true;   ///< false: the picture is clamped at its edges

  bool operator==(const SourceMaterial&) const = default;
};

/// One outline of a building and what rises over it. Heights in metres above the ground.
struct FootprintPart {
  Polygon polygon;           ///< of any winding, perhaps broken
  double height = kUnknown;  ///< to the eaves; unknown: the building's
  double top = kUnknown;     ///< to the ridge; where it is known and `height` is not, the eaves follow from the roof
  double bottom = 0;         ///< 0: stands on the ground, else hangs above it
  std::optional<facade::RoofKind> roof;  ///< the form that the source states
  double roofHeight = kUnknown;          ///< from eaves to ridge
};

/// A building as its outline on the plan. Coordinates in the source's CRS until they are projected.
struct Footprint {
  std::string id;  ///< as messages name it
  std::vector<FootprintPart> parts;
  double height = kUnknown;  ///< metres from the ground to the eaves
  double ground = kUnknown;  ///< altitude of the ground, metres
  city::Attributes attributes;
};

enum class SurfaceKind : uint8_t { Unknown, Wall, Roof, Ground, Window, Door, Other };

/// A flat polygon in space: outer ring, then holes; indices into the building's points.
struct Surface {
  SurfaceKind kind = SurfaceKind::Unknown;
  uint32_t shell = 0;  ///< surfaces of one shell bound one volume
  bool solid = false;  ///< that volume is a solid: nothing of its shell ought to be missing
  std::vector<std::vector<uint32_t>> rings;
  uint32_t material = kNoMaterial;          ///< index into Source::materials
  std::vector<std::vector<glm::vec2>> uvs;  ///< a texture coordinate for each point of a ring; empty: none, or as the
                                            ///< other rings say
};

/// A building as its surfaces.
struct SurfaceBuilding {
  std::string id;
  std::vector<glm::dvec3> points;
  std::vector<Surface> surfaces;
  double ground = kUnknown;  ///< altitude of the ground, metres; unknown: its lowest point's
  city::Attributes attributes;
};

/// Terrain as triangles.
struct Tin {
  std::vector<glm::dvec3> points;
  std::vector<glm::uvec3> triangles;
};

/// A mesh in its place: a statue, a bridge, a tower.
struct PlacedMesh {
  std::string id;
  city::TriangleMesh mesh;  ///< metres, z up; Vertex::material is an index into Source::materials
  glm::dvec3 position{0};   ///< in the source's CRS; z in metres
  bool onGround = true;     ///< z counts from the ground; else it is an altitude
  double heading = 0;       ///< radians counter-clockwise
  city::Attributes attributes;
};

struct StreetLine {
  std::string name;
  city::StreetKind kind = city::StreetKind::Street;
  double width = 4;  ///< metres
  std::vector<glm::dvec2> points;
};

/// A wall or a fence that stands alone.
struct WallLine {
  std::string id;
  double height = 2, thickness = 0.4;  ///< metres
  std::vector<glm::dvec2> points;
};

struct WaterArea {
  std::string name;
  std::vector<Polygon> parts;
};

struct CoverArea {
  city::Ground kind = city::Ground::Grass;
  std::vector<Polygon> parts;
};

struct TreePoint {
  glm::dvec2 position{0};
  double height = kUnknown;  ///< metres
  bool needles = false;
};

/// What stands and lies between the buildings.
struct Surroundings {
  std::vector<StreetLine> streets;
  std::vector<WallLine> walls;
  std::vector<WaterArea> water;
  std::vector<CoverArea> cover;
  std::vector<TreePoint> trees;
  std::vector<std::vector<glm::dvec2>> coast;  ///< lines with the land on their left
};

/// The content of one file.
struct Source {
  std::string file;
  std::string crs;      ///< WKT; empty: the file states none
  bool metric = false;  ///< the format says metres, where the file states no CRS
  double zUnit = 1;     ///< metres for each unit of the altitudes
  std::vector<Footprint> footprints;
  std::vector<SurfaceBuilding> buildings;
  Tin tin;
  std::vector<PlacedMesh> meshes;
  Surroundings surroundings;
  std::vector<SourceMaterial> materials;
  std::vector<StyleRule> styles;  ///< the first that fits a building decides its finishes
  double defaultHeight = 6;       ///< metres, of buildings that state none
};

}  // namespace vicus::assets
