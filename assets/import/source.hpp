/// What the readers hand over: the content of one file, before it becomes part of a city.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "assets/import/polygon.hpp"
#include "city/city.hpp"

namespace vicus::assets {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A building as its outline on the plan. Coordinates in the source's CRS until they are projected.
struct Footprint {
  std::string id;              ///< as messages name it
  std::vector<Polygon> parts;  ///< of any winding, perhaps broken
  double height = kUnknown;    ///< metres from the ground to the eaves
  double ground = kUnknown;    ///< altitude of the ground, metres
  city::Attributes attributes;
};

enum class SurfaceKind : uint8_t { Unknown, Wall, Roof, Ground, Window, Door, Other };

/// A flat polygon in space: outer ring, then holes; indices into the building's points.
struct Surface {
  SurfaceKind kind = SurfaceKind::Unknown;
  uint32_t shell = 0;  ///< surfaces of one shell bound one volume
  std::vector<std::vector<uint32_t>> rings;
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

/// The content of one file.
struct Source {
  std::string file;
  std::string crs;      ///< WKT; empty: the file states none
  bool metric = false;  ///< the format says metres, where the file states no CRS
  std::vector<Footprint> footprints;
  std::vector<SurfaceBuilding> buildings;
  Tin tin;
};

}  // namespace vicus::assets
