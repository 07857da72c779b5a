/// One file of a scene, whatever it is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assets/import/read_elevation.hpp"
#include "assets/import/source.hpp"
#include "assets/scene/scene_description.hpp"
#include "city/diagnostics.hpp"

class GDALDataset;

namespace vicus::assets {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};

/// What a file holds. Rasters stay open in `datasets`.
struct FileContent {
  std::vector<Source> sources;
  std::vector<std::unique_ptr<GDALDataset, CloseDataset>> datasets;
  std::vector<ElevationRaster> rasters;
  city::Diagnostics diagnostics;
};

/// Reads a file by what it is: CityJSON, CityGML, 3D Tiles, OpenStreetMap, any OGR vector format, a GDAL raster, or a
/// mesh. `source.file` is the path that is opened. `fallbackCrs` (WKT) is that of files that state none;
/// `heightUnit` that of a raster's heights ("ft"), empty: as it says. Called from several threads at once.
FileContent readFile(const SceneSource& source, const std::string& fallbackCrs, const std::string& heightUnit = {});

/// Reads a file that can only be elevation.
FileContent readElevationFile(const std::string& file, const SceneTerrain& terrain, const std::string& fallbackCrs);

/// Reads the mesh of a monument; its source has the CRS `crs` (WKT) and the one mesh at the monument's place.
FileContent readMonument(const SceneMonument& monument, const std::string& path, const std::string& crs);

/// Files that a file of this kind names and that are read with it: buffers of glTF, materials of OBJ, tiles.
std::vector<std::string> filesNamedIn(const std::string& file);

}  // namespace vicus::assets
