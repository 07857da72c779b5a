/// A city while it is put together from its sources, and the words that the steps of this share.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/extrude.hpp"
#include "assets/import/polygon.hpp"
#include "assets/import/read_elevation.hpp"
#include "assets/import/source.hpp"
#include "assets/import/styles_in_use.hpp"
#include "assets/import/terrain.hpp"
#include "assets/load_city.hpp"
#include "city/city.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets {

class GdalMessages;

struct Assembly {
  city::City city;
  city::CityParts parts;
  const LoadOptions& options;
  city::Diagnostics& diagnostics;
  std::vector<city::Material> materials;  ///< own ones of the sources; entry i has the number ownMaterial(i)
  StylesInUse styles;
};

/// A footprint on its way into the city; positions in metres from the city's origin.
struct Outline {
  const Footprint* footprint = nullptr;
  const Source* source = nullptr;
  bool repaired = false;  ///< it crossed or touched itself
  std::string problem;    ///< why it, or a part of it, was lost
  std::vector<Extrusion::Part> parts;
  double ground = kUnknown;  ///< as its source says, metres above the city's origin
  GroundUnder under;
};

/// Solids that have no height (all their points within 10 cm of one level) become footprints of their sources, whose
/// heights come from their attributes; says which.
void footprintsFromFlatSolids(std::vector<Source>& sources, city::Diagnostics& diagnostics);

/// Cleans all footprints and reports what was repaired and what cannot be
/// used.
std::vector<Outline> cleanFootprints(const std::vector<Source>& sources, glm::dvec3 origin,
                                     city::Diagnostics& diagnostics);

/// The terrain, from the best that there is. `box` is the plan of all buildings, from the origin; `crs` the city's.
void makeTerrain(Assembly& a, const std::vector<Source>& sources, const std::vector<Outline>& outlines,
                 std::span<const ElevationRaster> rasters, const std::string& crs, const city::Aabb& box,
                 GdalMessages& messages);

/// Buildings from footprints; empties the outlines' parts.
void addFootprints(Assembly& a, std::vector<Outline>& outlines);
/// Buildings from surfaces, with the sources' materials.
void addSurfaceBuildings(Assembly& a, const std::vector<Source>& sources);
/// Seas, lakes and rivers, whose beds sink into the terrain: before anything is put on it. `box` as above.
void addWaters(Assembly& a, const std::vector<Source>& sources, const city::Aabb& box);
/// Meshes in their places, streets, free-standing walls, trees; then, once the city has its tiles, what covers its
/// ground.
void addSurroundings(Assembly& a, std::vector<Source>& sources, const city::Aabb& box);
void paintGroundCover(city::City& city, const std::vector<Source>& sources);

/// Enters a source's materials into the assembly; gives the number of each. Beyond kMostOwnMaterials they become
/// plaster, which is reported.
std::vector<city::MaterialId> addMaterials(Assembly& a, const Source& source);

/// "17, 33, 41 and 12 more".
std::string list(const std::vector<std::string>& names);
std::string counted(size_t count, const char* one, const char* many);
/// "12.34 m"; and "6" or "6.5".
std::string metres(double v);
std::string shortNumber(double v);
/// A seed from a name.
uint32_t seedOf(std::string_view text);
/// Value of the first attribute that has one of the names; empty where there is none.
std::string_view attribute(const city::Attributes& attributes, std::initializer_list<std::string_view> names);
/// The differences between what a source says of the ground and the terrain that its buildings stand on.
void reportGaps(const std::string& file, std::vector<double> gaps, const char* what, city::Diagnostics& diagnostics);

}  // namespace vicus::assets
