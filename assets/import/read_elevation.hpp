/// Terrain heights from any raster format that GDAL reads.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "city/aabb.hpp"
#include "city/diagnostics.hpp"
#include "city/height_field.hpp"

class GDALDataset;

namespace vicus::assets {

class GdalMessages;

/// An opened raster and where it comes from.
struct ElevationRaster {
  GDALDataset* dataset = nullptr;
  std::string file;
  std::string crs;                      ///< WKT; the file's own or what the user says; empty: unknown
  std::optional<double> metresPerUnit;  ///< of its heights, where the user says it; else as the band says
  std::optional<double> crsHeightUnit;  ///< metres for each unit of its vertical CRS, where it has one
};

/// Samples to a side that the height field of a raster may have: 2^14 + 1, 16 385² take 1 GB and ROAM as much again.
constexpr int kLargestRaster = 16385;

/// Metres for each unit of that name (m, metre, dm, cm, ft, us-ft, …); 1 for names that are not known.
double metresPerUnit(const std::string& unit);

/// Why a raster cannot hold heights (a picture, no place on the earth); empty where it can.
std::string whyNoElevation(GDALDataset& dataset);

/// Extent of a raster in the plan, brought into the CRS `toCrs` (WKT); empty where that cannot be done.
city::Aabb extentOf(const ElevationRaster& raster, const std::string& toCrs);

struct ElevationRequest {
  std::string crs;        ///< WKT of the city's CRS
  city::Aabb extent;      ///< what to cover, in `crs`; empty: all that the rasters cover
  glm::dvec3 toLocal{0};  ///< added to coordinates in `crs`: gives metres from the city's origin
};

/// The rasters as one height field; where they overlap the first one counts. A raster in the city's own CRS keeps its
/// samples, others are resampled; more than kLargestRaster samples to a side are averaged. Small gaps are filled
/// (GDALFillNodata), larger ones stay NaN; both are reported. Nothing where no sample has data.
std::optional<city::HeightField> readElevation(std::span<const ElevationRaster> rasters,
                                               const ElevationRequest& request, GdalMessages& messages,
                                               city::Diagnostics& diagnostics);

}  // namespace vicus::assets
