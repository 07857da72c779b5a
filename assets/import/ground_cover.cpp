/// The rasterising and the distances are GDAL's (GDALRasterizeGeometries, GDALComputeProximity).
#include "assets/import/ground_cover.hpp"

#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "assets/import/assembly.hpp"
#include "assets/import/gdal_messages.hpp"

namespace vicus::assets {
namespace {

using city::Ground;

constexpr int kMostCells = 2048;       ///< to a side
constexpr double kNeighbourhood = 60;  ///< metres: what counts as about a place
constexpr double kDense =
    0.2;  ///< built share from which it is town; Périgueux's centre has 0.4 to 0.7, its suburbs 0.1
constexpr double kPavedEdge = 1.2;    ///< metres beside a wall
constexpr double kWidestStreet = 14;  ///< metres from a wall to the middle of a square's edge
constexpr double kGarden = 12;

struct Closer {
  void operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }
};

/// One-band rasters in memory; null where GDAL has no room.
std::unique_ptr<GDALDataset, Closer> memoryRaster(glm::ivec2 size, GDALDataType type) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  return std::unique_ptr<GDALDataset, Closer>(driver ? driver->Create("", size.x, size.y, 1, type, nullptr) : nullptr);
}

/// The building's outline with its holes, in the city's frame.
std::unique_ptr<OGRPolygon> outlineOf(const city::BuildingGeometry& type, const city::Instance& instance) {
  const double c = std::cos(static_cast<double>(instance.heading)), s = std::sin(static_cast<double>(instance.heading));
  auto polygon = std::make_unique<OGRPolygon>();
  for (const auto& ring : type.footprint) {
    OGRLinearRing line;
    for (const glm::vec2& p : ring)
      line.addPoint(instance.position.x + c * static_cast<double>(p.x) - s * static_cast<double>(p.y),
                    instance.position.y + s * static_cast<double>(p.x) + c * static_cast<double>(p.y));
    line.closeRings();
    polygon->addRing(&line);
  }
  return polygon;
}

/// Share of built cells in a square window of `reach` cells about each cell, by summed areas.
std::vector<float> builtShare(const std::vector<uint8_t>& built, glm::ivec2 size, int reach) {
  const auto stride = static_cast<size_t>(size.x) + 1;
  std::vector<uint32_t> sums(stride * (static_cast<size_t>(size.y) + 1), 0);
  for (int row = 0; row < size.y; ++row)
    for (int column = 0; column < size.x; ++column) {
      const size_t at = (static_cast<size_t>(row) + 1) * stride + static_cast<size_t>(column) + 1;
      sums[at] = built[static_cast<size_t>(row) * static_cast<size_t>(size.x) + static_cast<size_t>(column)] +
                 sums[at - 1] + sums[at - stride] - sums[at - stride - 1];
    }
  std::vector<float> share(built.size());
  for (int row = 0; row < size.y; ++row)
    for (int column = 0; column < size.x; ++column) {
      const auto r0 = static_cast<size_t>(std::max(row - reach, 0)),
                 r1 = static_cast<size_t>(std::min(row + reach + 1, size.y));
      const auto c0 = static_cast<size_t>(std::max(column - reach, 0)),
                 c1 = static_cast<size_t>(std::min(column + reach + 1, size.x));
      const uint32_t sum =
          sums[r1 * stride + c1] - sums[r0 * stride + c1] - sums[r1 * stride + c0] + sums[r0 * stride + c0];
      share[static_cast<size_t>(row) * static_cast<size_t>(size.x) + static_cast<size_t>(column)] =
          static_cast<float>(sum) / static_cast<float>((r1 - r0) * (c1 - c0));
    }
  return share;
}

Ground coverOf(double distance, double density) {
  if (density >= kDense) {
    if (distance <= kPavedEdge) return Ground::Paving;
    return distance <= kWidestStreet ? Ground::Street : Ground::Grass;
  }
  if (distance <= kPavedEdge) return Ground::Earth;
  return distance <= kGarden ? Ground::Garden : Ground::Grass;
}

}  // namespace

std::optional<city::GroundCover> guessGroundCover(const city::City& city) {
  if (!city.terrain || city.terrain->empty() || city.buildings.empty()) return std::nullopt;
  const GdalMessages quiet;

  city::GroundCover cover;
  const glm::dvec2 extent = city.terrain->extent();
  cover.origin = city.terrain->origin;
  cover.spacing = std::max(1.0, std::max(extent.x, extent.y) / kMostCells);
  cover.size = glm::max(glm::ivec2(glm::ceil(extent / cover.spacing)), glm::ivec2(1));

  // Where buildings stand. Row 0 of the raster is the south, as in the cover.
  const auto built = memoryRaster(cover.size, GDT_Byte), distances = memoryRaster(cover.size, GDT_Float32);
  if (!built || !distances) return std::nullopt;
  double cellToPlan[6] = {cover.origin.x, cover.spacing, 0, cover.origin.y, 0, cover.spacing};
  built->SetGeoTransform(cellToPlan);
  std::vector<std::unique_ptr<OGRPolygon>> outlines;
  std::vector<OGRGeometryH> handles;
  for (const city::Instance& instance : city.buildings.instances) {
    const city::BuildingGeometry& type = city.buildingTypes[instance.geometry];
    if (type.footprint.empty()) continue;
    outlines.push_back(outlineOf(type, instance));
    handles.push_back(OGRGeometry::ToHandle(outlines.back().get()));
  }
  if (handles.empty()) return std::nullopt;
  const std::vector<double> ones(handles.size(), 1.0);
  int band = 1;
  if (GDALRasterizeGeometries(GDALDataset::ToHandle(built.get()), 1, &band, static_cast<int>(handles.size()),
                              handles.data(), nullptr, nullptr, ones.data(), nullptr, nullptr, nullptr) != CE_None)
    return std::nullopt;
  if (GDALComputeProximity(GDALRasterBand::ToHandle(built->GetRasterBand(1)),
                           GDALRasterBand::ToHandle(distances->GetRasterBand(1)), nullptr, nullptr, nullptr) != CE_None)
    return std::nullopt;

  const size_t cells = static_cast<size_t>(cover.size.x) * static_cast<size_t>(cover.size.y);
  std::vector<uint8_t> builtCells(cells);
  std::vector<float> distanceCells(cells);
  const auto readAll = [&](GDALDataset& raster, void* out, GDALDataType type) {
    return raster.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, cover.size.x, cover.size.y, out, cover.size.x, cover.size.y,
                                             type, 0, 0, nullptr) == CE_None;
  };
  if (!readAll(*built, builtCells.data(), GDT_Byte) || !readAll(*distances, distanceCells.data(), GDT_Float32))
    return std::nullopt;

  const std::vector<float> share = builtShare(builtCells, cover.size, static_cast<int>(kNeighbourhood / cover.spacing));
  cover.kinds.resize(cells);
  for (size_t i = 0; i < cells; ++i)
    cover.kinds[i] = coverOf(static_cast<double>(distanceCells[i]) * cover.spacing, static_cast<double>(share[i]));
  return cover;
}

namespace {

std::unique_ptr<OGRGeometry> shapeOf(const std::vector<Polygon>& parts, glm::dvec2 origin) {
  auto shape = std::make_unique<OGRMultiPolygon>();
  for (const Polygon& part : parts) {
    OGRPolygon polygon;
    for (const Ring& ring : part.rings) {
      OGRLinearRing line;
      for (const glm::dvec2& p : ring) line.addPoint(p.x - origin.x, p.y - origin.y);
      line.closeRings();
      polygon.addRing(&line);
    }
    shape->addGeometry(&polygon);
  }
  return shape;
}

/// The strip that a street covers.
std::unique_ptr<OGRGeometry> shapeOf(const StreetLine& street, glm::dvec2 origin) {
  OGRLineString line;
  for (const glm::dvec2& p : street.points) line.addPoint(p.x - origin.x, p.y - origin.y);
  return std::unique_ptr<OGRGeometry>(line.Buffer(street.width / 2, 4));
}

/// Grass everywhere, over the terrain's extent.
city::GroundCover plainCover(const city::HeightField& terrain) {
  city::GroundCover cover;
  cover.origin = terrain.origin;
  cover.spacing = std::max(1.0, std::max(terrain.extent().x, terrain.extent().y) / kMostCells);
  cover.size = glm::max(glm::ivec2(glm::ceil(terrain.extent() / cover.spacing)), glm::ivec2(1));
  cover.kinds.assign(static_cast<size_t>(cover.size.x) * static_cast<size_t>(cover.size.y), Ground::Grass);
  return cover;
}

}  // namespace

void paintGroundCover(city::City& city, const std::vector<Source>& sources) {
  city.groundCover = guessGroundCover(city);
  const bool painted = std::any_of(sources.begin(), sources.end(), [](const Source& s) {
    return !s.surroundings.cover.empty() || !s.surroundings.streets.empty();
  });
  if (!painted || !city.terrain || city.terrain->empty()) return;
  const GdalMessages quiet;
  if (!city.groundCover) city.groundCover = plainCover(*city.terrain);
  city::GroundCover& cover = *city.groundCover;
  const auto raster = memoryRaster(cover.size, GDT_Byte);
  if (!raster) return;
  double cellToPlan[6] = {cover.origin.x, cover.spacing, 0, cover.origin.y, 0, cover.spacing};
  raster->SetGeoTransform(cellToPlan);

  // Areas first, then the streets over them; 0 leaves what was guessed.
  std::vector<std::unique_ptr<OGRGeometry>> shapes;
  std::vector<OGRGeometryH> handles;
  std::vector<double> values;
  const auto add = [&](std::unique_ptr<OGRGeometry> shape, Ground kind) {
    if (!shape || shape->IsEmpty()) return;
    handles.push_back(OGRGeometry::ToHandle(shape.get()));
    values.push_back(1 + static_cast<double>(kind));
    shapes.push_back(std::move(shape));
  };
  const glm::dvec2 origin(city.origin);
  for (const Source& s : sources)
    for (const CoverArea& area : s.surroundings.cover) add(shapeOf(area.parts, origin), area.kind);
  for (const Source& s : sources)
    for (const StreetLine& street : s.surroundings.streets)
      add(shapeOf(street, origin), street.kind == city::StreetKind::Lane ? Ground::Paving : Ground::Street);
  int band = 1;
  if (handles.empty() ||
      GDALRasterizeGeometries(GDALDataset::ToHandle(raster.get()), 1, &band, static_cast<int>(handles.size()),
                              handles.data(), nullptr, nullptr, values.data(), nullptr, nullptr, nullptr) != CE_None)
    return;
  std::vector<uint8_t> cells(cover.kinds.size());
  if (raster->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, cover.size.x, cover.size.y, cells.data(), cover.size.x,
                                         cover.size.y, GDT_Byte, 0, 0, nullptr) != CE_None)
    return;
  for (size_t i = 0; i < cells.size(); ++i)
    if (cells[i] > 0) cover.kinds[i] = static_cast<Ground>(cells[i] - 1);
}

}  // namespace vicus::assets
