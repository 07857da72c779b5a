#include "assets/import/read_elevation.hpp"

#include <gdal_alg.h>
#include <gdal_priv.h>
#include <gdal_utils.h>
#include <gdalwarper.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "assets/import/gdal_messages.hpp"
#include "assets/import/polygon.hpp"
#include "assets/import/projection.hpp"
#include "assets/import/terrain.hpp"

namespace vicus::assets {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
/// Gaps are filled from samples at most this many steps away; wider ones are sea or the end of the survey.
constexpr double kFillSteps = 10;
/// Altitudes beyond are no heights on this planet but marks that the file does not declare: metres.
constexpr double kLargestAltitude = 20000;

struct CloseDataset {
  void operator()(GDALDataset* d) const { GDALClose(d); }
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// A raster as it would lie in the city's CRS.
struct Placement {
  city::Aabb extent;
  glm::dvec2 pixel{0};
  bool aligned = false;  ///< its own rows and columns run east and north already
  glm::dvec2 corner{0};  ///< north-west corner where aligned
};

std::optional<Placement> place(const ElevationRaster& raster, const std::string& toCrs) {
  GDALDataset& d = *raster.dataset;
  Placement out;
  double g[6];
  const bool hasGrid = d.GetGeoTransform(g) == CE_None;
  if (hasGrid && g[2] == 0 && g[4] == 0 && g[1] > 0 && g[5] < 0 && crsName(raster.crs) == crsName(toCrs)) {
    out.aligned = true;
    out.pixel = {g[1], -g[5]};
    out.corner = {g[0], g[3]};
    out.extent.extend(glm::dvec3(g[0], g[3], 0));
    out.extent.extend(glm::dvec3(g[0] + g[1] * d.GetRasterXSize(), g[3] + g[5] * d.GetRasterYSize(), 0));
    return out;
  }
  CPLStringList options;
  if (!raster.crs.empty()) options.SetNameValue("SRC_SRS", raster.crs.c_str());
  options.SetNameValue("DST_SRS", toCrs.c_str());
  void* transformer = GDALCreateGenImgProjTransformer2(&d, nullptr, options.List());
  if (!transformer) return std::nullopt;
  int columns = 0, rows = 0;
  double box[4] = {0, 0, 0, 0};
  const CPLErr error = GDALSuggestedWarpOutput2(&d, GDALGenImgProjTransform, transformer, g, &columns, &rows, box, 0);
  GDALDestroyGenImgProjTransformer(transformer);
  if (error != CE_None || !(g[1] > 0)) return std::nullopt;
  out.pixel = {g[1], std::abs(g[5])};
  out.extent.extend(glm::dvec3(box[0], box[1], 0));
  out.extent.extend(glm::dvec3(box[2], box[3], 0));
  return out;
}

/// Metres for each unit of a raster's heights: what the user says, else what its band says, else its vertical CRS, else
/// 1.
double unitOf(const ElevationRaster& raster) {
  if (raster.metresPerUnit) return *raster.metresPerUnit;
  const std::string stated = raster.dataset->GetRasterBand(1)->GetUnitType();
  return stated.empty() ? raster.crsHeightUnit.value_or(1) : metresPerUnit(stated);
}

/// Warps one raster onto the field's samples; nothing where GDAL fails.
std::vector<float> warp(const ElevationRaster& raster, const std::string& toCrs, glm::dvec2 first, glm::dvec2 spacing,
                        glm::ivec2 size, const char* method) {
  const glm::dvec2 low = first - 0.5 * spacing, high = low + spacing * glm::dvec2(size);
  const auto text = [](double v) { return std::string(CPLSPrintf("%.17g", v)); };
  CPLStringList arguments;
  for (const std::string& a : {std::string("-of"),
                               std::string("MEM"),
                               std::string("-ot"),
                               std::string("Float32"),
                               std::string("-dstnodata"),
                               std::string("nan"),
                               std::string("-r"),
                               std::string(method),
                               std::string("-t_srs"),
                               toCrs,
                               std::string("-te"),
                               text(low.x),
                               text(low.y),
                               text(high.x),
                               text(high.y),
                               std::string("-ts"),
                               std::to_string(size.x),
                               std::to_string(size.y),
                               std::string("-et"),
                               std::string("0.05"),
                               std::string("-q")})
    arguments.AddString(a.c_str());
  if (!raster.crs.empty()) {
    arguments.AddString("-s_srs");
    arguments.AddString(raster.crs.c_str());
  }
  const std::unique_ptr<GDALWarpAppOptions, decltype(&GDALWarpAppOptionsFree)> options(
      GDALWarpAppOptionsNew(arguments.List(), nullptr), &GDALWarpAppOptionsFree);
  GDALDatasetH sources[] = {raster.dataset};
  int usage = FALSE;
  const Dataset warped(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, sources, options.get(), &usage)));
  std::vector<float> out;
  if (!warped) return out;
  const auto width = static_cast<size_t>(size.x), height = static_cast<size_t>(size.y);
  std::vector<float> fromNorth(width * height, kNan);
  if (warped->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, size.x, size.y, fromNorth.data(), size.x, size.y, GDT_Float32,
                                         0, 0) != CE_None)
    return out;
  GDALRasterBand& band = *raster.dataset->GetRasterBand(1);
  int hasScale = FALSE, hasOffset = FALSE;
  const double scale = band.GetScale(&hasScale), offset = band.GetOffset(&hasOffset);
  const double unit = unitOf(raster);
  out.resize(fromNorth.size());
  for (size_t row = 0; row < height; ++row)
    for (size_t column = 0; column < width; ++column) {
      const auto raw = static_cast<double>(fromNorth[(height - 1 - row) * width + column]);
      const double h = unit * (raw * (hasScale ? scale : 1) + (hasOffset ? offset : 0));
      out[row * width + column] = std::abs(h) <= kLargestAltitude ? static_cast<float>(h) : kNan;
    }
  return out;
}

/// Fills gaps of up to kFillSteps with the library's inverse-distance fill.
void fillGaps(std::vector<float>& heights, glm::ivec2 size) {
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  if (!memory) return;
  const Dataset d(memory->Create("", size.x, size.y, 1, GDT_Float32, nullptr));
  if (!d) return;
  GDALRasterBand& band = *d->GetRasterBand(1);
  band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  if (band.RasterIO(GF_Write, 0, 0, size.x, size.y, heights.data(), size.x, size.y, GDT_Float32, 0, 0) != CE_None)
    return;
  if (GDALFillNodata(&band, nullptr, kFillSteps, 0, 0, nullptr, nullptr, nullptr) != CE_None) return;
  std::vector<float> filled(heights.size());
  if (band.RasterIO(GF_Read, 0, 0, size.x, size.y, filled.data(), size.x, size.y, GDT_Float32, 0, 0) == CE_None)
    heights = std::move(filled);
}

uint64_t countMissing(const std::vector<float>& heights) {
  return static_cast<uint64_t>(
      std::count_if(heights.begin(), heights.end(), [](float h) { return !std::isfinite(h); }));
}

std::string percent(uint64_t part, size_t whole) {
  return CPLSPrintf("%.1f %%", 100.0 * static_cast<double>(part) / static_cast<double>(std::max<size_t>(whole, 1)));
}

}  // namespace

double metresPerUnit(const std::string& unit) {
  std::string lower;
  for (const char c : unit) lower.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
  if (lower == "ft" || lower == "foot" || lower == "feet" || lower == "international foot") return 0.3048;
  if (lower == "us survey foot" || lower == "us-ft" || lower == "foot_us" || lower == "ftus") return 1200.0 / 3937.0;
  if (lower == "dm" || lower == "decimetre" || lower == "decimeter") return 0.1;
  if (lower == "cm" || lower == "centimetre" || lower == "centimeter") return 0.01;
  if (lower == "mm") return 0.001;
  if (lower == "km") return 1000;
  return 1;
}

std::string whyNoElevation(GDALDataset& dataset) {
  if (dataset.GetRasterCount() < 1) return "it has no raster band";
  double g[6];
  if (dataset.GetGeoTransform(g) != CE_None && dataset.GetGCPCount() == 0)
    return "it does not say where on the earth it lies";
  if (dataset.GetRasterCount() >= 3 && dataset.GetRasterBand(1)->GetRasterDataType() == GDT_Byte)
    return "it is a picture, not heights";
  return {};
}

city::Aabb extentOf(const ElevationRaster& raster, const std::string& toCrs) {
  const auto placement = place(raster, toCrs);
  return placement ? placement->extent : city::Aabb{};
}

std::optional<city::HeightField> readElevation(std::span<const ElevationRaster> rasters,
                                               const ElevationRequest& request, GdalMessages& messages,
                                               city::Diagnostics& diagnostics) {
  std::vector<std::pair<const ElevationRaster*, Placement>> placed;
  city::Aabb whole;
  for (const ElevationRaster& r : rasters) {
    const auto p = place(r, request.crs);
    if (!p) {
      const std::string failure = messages.take();
      diagnostics.error(r.file, "", "cannot be brought into the city's CRS: " + failure);
      continue;
    }
    placed.emplace_back(&r, *p);
    whole.extend(p->extent);
  }
  if (placed.empty()) return std::nullopt;
  const std::string& file = placed[0].first->file;

  // What the rasters cover of what is asked for.
  city::Aabb box = whole;
  if (!request.extent.empty()) {
    const glm::dvec2 low = glm::max(glm::dvec2(whole.min), glm::dvec2(request.extent.min));
    const glm::dvec2 high = glm::min(glm::dvec2(whole.max), glm::dvec2(request.extent.max));
    if (!(low.x < high.x && low.y < high.y)) {
      diagnostics.error(file, "", "covers no part of the city");
      return std::nullopt;
    }
    box = {glm::dvec3(low, 0), glm::dvec3(high, 0)};
  }

  // Samples lie at the centres of pixels: those of the finest raster, or every few where there would be too many.
  const Placement* finest = &placed[0].second;
  for (const auto& [raster, p] : placed)
    if (p.pixel.x * p.pixel.y < finest->pixel.x * finest->pixel.y) finest = &p;
  glm::dvec2 spacing = finest->pixel;
  const glm::dvec2 side(box.size());
  const double times = std::max({1.0, side.x / spacing.x / kLargestRaster, side.y / spacing.y / kLargestRaster});
  spacing *= times;
  const bool native = finest->aligned && placed.size() == 1 && times == 1;
  glm::dvec2 first = glm::dvec2(box.min) + 0.5 * spacing;
  glm::ivec2 size = glm::max(glm::ivec2(glm::floor(side / spacing + 1e-6)), 2);
  if (native) {
    // The file's own pixels: whole columns from its western and whole rows from its northern edge.
    const double west = std::round((box.min.x - finest->corner.x) / spacing.x);
    const double south = std::round((finest->corner.y - box.min.y) / spacing.y);
    first = {finest->corner.x + (west + 0.5) * spacing.x, finest->corner.y - (south - 0.5) * spacing.y};
  }
  size = glm::min(size, kLargestRaster);

  city::HeightField field;
  field.spacing = spacing;
  field.size = size;
  field.origin = glm::dvec2(snapped(glm::dvec2(first + glm::dvec2(request.toLocal))));
  field.heights.assign(static_cast<size_t>(size.x) * static_cast<size_t>(size.y), kNan);
  for (const auto& [raster, p] : placed) {
    const bool coarser = spacing.x > 1.5 * p.pixel.x || spacing.y > 1.5 * p.pixel.y;
    const std::vector<float> heights = warp(*raster, request.crs, first, spacing, size,
                                            native    ? "near"
                                            : coarser ? "average"
                                                      : "bilinear");
    const std::string failure = messages.take();
    if (!failure.empty()) diagnostics.error(raster->file, "band 1", failure);
    for (size_t i = 0; i < heights.size(); ++i)
      if (!std::isfinite(field.heights[i])) field.heights[i] = heights[i];
  }
  const uint64_t missing = countMissing(field.heights);
  if (missing == field.heights.size()) {
    diagnostics.error(file, "band 1", "no sample has a height");
    return std::nullopt;
  }
  if (times > 1)
    diagnostics.warn(file, "",
                     CPLSPrintf("resampled from %.4g m to %.4g m, so that the terrain has at most %d samples to a side",
                                finest->pixel.x, spacing.x, kLargestRaster));
  if (missing > 0) {
    fillGaps(field.heights, size);
    const uint64_t left = countMissing(field.heights);
    if (missing > left)
      diagnostics.warn(file, "band 1",
                       std::to_string(missing - left) + " samples without data were filled from their surroundings (" +
                           percent(missing - left, field.heights.size()) + ")");
    if (left > 0)
      diagnostics.leftOut.push_back(
          {"terrain samples", left, file + " has no data there (" + percent(left, field.heights.size()) + ")"});
  }
  for (float& h : field.heights) h = static_cast<float>(static_cast<double>(h) + request.toLocal.z);
  field.updateRange();
  return field;
}

}  // namespace vicus::assets
