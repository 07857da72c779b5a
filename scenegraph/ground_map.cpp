#include "scenegraph/ground_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <future>
#include <limits>

#include "city/random.hpp"
#include "scenegraph/terrain_mesh.hpp"

namespace vicus::scenegraph {
namespace {

/// Linear albedo, and the detail that goes with it.
struct Paint {
  glm::vec3 albedo;
  float detail;
};

/// In the order of city::Ground.
constexpr std::array<Paint, city::kGroundKinds> kPaints = {{
    {{0.124f, 0.136f, 0.064f}, 0.0f},   // grass
    {{0.190f, 0.180f, 0.075f}, 0.25f},  // field
    {{0.200f, 0.150f, 0.100f}, 0.5f},   // earth
    {{0.230f, 0.200f, 0.165f}, 1.0f},   // street
    {{0.290f, 0.270f, 0.240f}, 1.0f},   // paving
    {{0.118f, 0.122f, 0.060f}, 0.1f},   // garden
    {{0.165f, 0.150f, 0.085f}, 0.5f},   // bank
    {{0.070f, 0.075f, 0.055f}, 0.5f},   // water's bed
}};
constexpr Paint kRock = {{0.210f, 0.190f, 0.160f}, 0.5f};

float lattice(int x, int y, uint32_t seed) {
  const uint32_t h = city::hash32(city::hash32(static_cast<uint32_t>(x), static_cast<uint32_t>(y)), seed);
  return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

/// Value noise in 0 … 1 with features about one unit wide, along a line from west to east: the lattice is looked up
/// only where the line enters another cell.
class RowNoise {
 public:
  RowNoise(float wavelength, uint32_t seed, float y) : scale_(1 / wavelength), seed_(seed) {
    const float row = std::floor(y * scale_);
    t_ = smooth(y * scale_ - row);
    row_ = static_cast<int>(row);
  }
  float operator()(float x) {
    const float column = std::floor(x * scale_);
    if (const int cell = static_cast<int>(column); cell != column_) {
      west_ = cell == column_ + 1 ? east_ : onLine(cell);
      east_ = onLine(cell + 1);
      column_ = cell;
    }
    return glm::mix(west_, east_, smooth(x * scale_ - column));
  }

 private:
  static float smooth(float t) { return t * t * (3.0f - 2.0f * t); }
  float onLine(int column) const {
    return glm::mix(lattice(column, row_, seed_), lattice(column, row_ + 1, seed_), t_);
  }
  float scale_, t_ = 0, west_ = 0, east_ = 0;
  uint32_t seed_;
  int row_ = 0, column_ = std::numeric_limits<int>::min() / 2;
};

Paint mixed(const Paint& a, const Paint& b, float t) {
  return {glm::mix(a.albedo, b.albedo, t), glm::mix(a.detail, b.detail, t)};
}

size_t cellAt(const city::GroundCover& cover, glm::dvec2 p) {
  const glm::dvec2 cell = (p - cover.origin) / cover.spacing;
  const int column = std::clamp(static_cast<int>(std::floor(cell.x)), 0, cover.size.x - 1);
  const int row = std::clamp(static_cast<int>(std::floor(cell.y)), 0, cover.size.y - 1);
  return static_cast<size_t>(row) * static_cast<size_t>(cover.size.x) + static_cast<size_t>(column);
}

city::Ground kindAt(const city::GroundCover& cover, glm::dvec2 p) {
  return cover.kinds[cellAt(cover, p)];
}

constexpr double kLook = 0.35;   ///< how far from a place its paint is looked up, cells
constexpr double kRagged = 0.9;  ///< width of the band in which noise moves a place, cells and at least metres

/// For each cell of the cover whether all that a place in it can look up is of one kind.
std::vector<uint8_t> plainCells(const city::GroundCover& cover) {
  const int reach = static_cast<int>(std::ceil(kLook + kRagged / 2 * std::max(cover.spacing, 1.0) / cover.spacing));
  std::vector<uint8_t> alongRows(cover.kinds.size()), plain(cover.kinds.size());
  const auto at = [&](int column, int row) {
    return static_cast<size_t>(row) * static_cast<size_t>(cover.size.x) + static_cast<size_t>(column);
  };
  for (int row = 0; row < cover.size.y; ++row)
    for (int column = 0; column < cover.size.x; ++column) {
      bool same = true;
      for (int c = std::max(column - reach, 0); c <= std::min(column + reach, cover.size.x - 1); ++c)
        same &= cover.kinds[at(c, row)] == cover.kinds[at(column, row)];
      alongRows[at(column, row)] = same;
    }
  for (int row = 0; row < cover.size.y; ++row)
    for (int column = 0; column < cover.size.x; ++column) {
      bool same = true;
      for (int r = std::max(row - reach, 0); r <= std::min(row + reach, cover.size.y - 1); ++r)
        same &= alongRows[at(column, r)] && cover.kinds[at(column, r)] == cover.kinds[at(column, row)];
      plain[at(column, row)] = same;
    }
  return plain;
}

/// The cover's paint about a place: four looks about it, at a place that noise (-0.5 to 0.5) has moved a little.
Paint coverAt(const city::GroundCover& cover, glm::dvec2 p, glm::dvec2 ragged) {
  const glm::dvec2 at = p + ragged * (kRagged * std::max(cover.spacing, 1.0));
  Paint sum{glm::vec3(0), 0};
  const double reach = kLook * cover.spacing;
  for (const glm::dvec2 offset : {glm::dvec2(-1, -0.4), glm::dvec2(0.4, -1), glm::dvec2(1, 0.4), glm::dvec2(-0.4, 1)}) {
    const Paint& paint = kPaints[static_cast<size_t>(kindAt(cover, at + reach * offset)) % kPaints.size()];
    sum.albedo += 0.25f * paint.albedo;
    sum.detail += 0.25f * paint.detail;
  }
  return sum;
}

/// The field's normals at every sample, or every few where the field is finer than the map, so that painting looks up
/// instead of searching.
struct Normals {
  int stride = 1;  ///< samples
  glm::ivec2 size{0};
  std::vector<glm::vec3> at;
};

Normals normalsOf(const city::HeightField& field, int mapSize) {
  Normals normals;
  normals.stride = std::max(1, std::min(field.size.x, field.size.y) / mapSize);
  normals.size = (field.size - 2) / normals.stride + 2;
  for (int r = 0; r < normals.size.y; ++r)
    for (int c = 0; c < normals.size.x; ++c)
      normals.at.push_back(sampleNormal(field, std::min(c * normals.stride, field.size.x - 1),
                                        std::min(r * normals.stride, field.size.y - 1)));
  return normals;
}

/// The normal at a place, between the nearest.
glm::vec3 normalAt(const city::HeightField& field, const Normals& normals, glm::dvec2 p) {
  const glm::dvec2 cell = (p - field.origin) / (field.spacing * static_cast<double>(normals.stride));
  const int column = std::clamp(static_cast<int>(cell.x), 0, normals.size.x - 2);
  const int row = std::clamp(static_cast<int>(cell.y), 0, normals.size.y - 2);
  const glm::vec2 t(glm::clamp(cell - glm::dvec2(column, row), 0.0, 1.0));
  const glm::vec3* at =
      normals.at.data() + static_cast<size_t>(row) * static_cast<size_t>(normals.size.x) + static_cast<size_t>(column);
  const glm::vec3 south = glm::mix(at[0], at[1], t.x),
                  north = glm::mix(at[normals.size.x], at[normals.size.x + 1], t.x);
  return glm::normalize(glm::mix(south, north, t.y));
}

/// Light on a pixel over that on open level ground, which the shaders give it.
glm::vec3 lightOn(const glm::vec3& normal, const GroundShade& shade, const Light& light, size_t pixel,
                  bool sunFromMaps) {
  const bool shaded = shade.size > 0;
  const float sunPart = shaded ? static_cast<float>(shade.sun[pixel]) / 255 : 1,
              skyPart = shaded ? static_cast<float>(shade.sky[pixel]) / 255 : 1;
  const glm::vec3 sun = light.sun * std::max(glm::dot(normal, light.sunDirection), 0.0f);
  const glm::vec3 sky = glm::mix(light.bounce, light.sky, 0.5f + 0.5f * normal.z);
  const glm::vec3 level =
      light.sun * (std::max(light.sunDirection.z, 0.0f) * (sunFromMaps ? sunPart : 1.0f)) + light.sky;
  return (sun * sunPart + sky * skyPart) / level;
}

/// What all rows of a map are painted from.
struct Painting {
  const city::HeightField& field;
  const city::GroundCover* cover;  ///< may be null
  std::vector<uint8_t> plain;      ///< for each cell of the cover
  Normals normals;
  const GroundShade& shade;
  const Light& light;
  bool sunFromMaps = false;
};

void paintRow(GroundMap& map, const Painting& from, int row) {
  const city::HeightField& field = from.field;
  const glm::dvec2 step = field.extent() / static_cast<double>(map.size);
  const double y = step.y * (row + 0.5);
  const auto noiseOf = [&](float wavelength, uint32_t seed) {
    return RowNoise(wavelength, seed, static_cast<float>(y));
  };
  RowNoise broadNoise = noiseOf(47, 1), fineNoise = noiseOf(6.1f, 2), meadowNoise = noiseOf(160, 3);
  RowNoise warmNoise = noiseOf(19, 4);
  // The cover's edges are ragged the same way wherever its picture begins.
  const double originX = from.cover ? field.origin.x - from.cover->origin.x : 0;
  const double originY = from.cover ? field.origin.y - from.cover->origin.y : 0;
  RowNoise raggedX(2.3f, 11, static_cast<float>(y + originY)), raggedY(2.3f, 12, static_cast<float>(y + originY));
  for (int column = 0; column < map.size; ++column) {
    const double eastward = step.x * (column + 0.5);
    const glm::dvec2 p = field.origin + glm::dvec2(eastward, y);
    const auto x = static_cast<float>(eastward);
    const float broad = broadNoise(x), fine = fineNoise(x);
    Paint paint;
    if (from.cover) {
      const size_t cell = cellAt(*from.cover, p);
      const auto coverX = static_cast<float>(eastward + originX);
      paint = from.plain[cell] ? kPaints[static_cast<size_t>(from.cover->kinds[cell]) % kPaints.size()]
                               : coverAt(*from.cover, p, glm::dvec2(raggedX(coverX) - 0.5f, raggedY(coverX) - 0.5f));
    } else {
      const float meadow = glm::smoothstep(0.45f, 0.62f, 0.7f * meadowNoise(x) + 0.3f * broad);
      paint = mixed(kPaints[static_cast<size_t>(city::Ground::Grass)],
                    kPaints[static_cast<size_t>(city::Ground::Field)], 0.6f * meadow);
    }
    const glm::vec3 normal = normalAt(field, from.normals, p);
    const float steep = glm::smoothstep(0.12f, 0.35f, 1 - normal.z + 0.08f * (fine - 0.5f));
    paint = mixed(paint, kRock, 0.85f * steep);
    const float mottled = 1 + 0.28f * (broad - 0.5f) + 0.22f * (fine - 0.5f);
    const float warm = 0.10f * (warmNoise(x) - 0.5f);
    const size_t pixel = static_cast<size_t>(row) * static_cast<size_t>(map.size) + static_cast<size_t>(column);
    const glm::vec3 albedo = paint.albedo * mottled * glm::vec3(1 + warm, 1, 1 - warm) *
                             lightOn(normal, from.shade, from.light, pixel, from.sunFromMaps);
    uint8_t* out = map.rgba.data() + 4 * pixel;
    for (int k = 0; k < 3; ++k)
      out[k] = static_cast<uint8_t>(255 * std::sqrt(std::clamp(albedo[k], 0.0f, 1.0f)) + 0.5f);
    out[3] = static_cast<uint8_t>(255 * std::clamp(paint.detail, 0.0f, 1.0f) + 0.5f);
  }
}

}  // namespace

glm::vec4 countrysideTexel() {
  const Paint paint =
      mixed(kPaints[static_cast<size_t>(city::Ground::Grass)], kPaints[static_cast<size_t>(city::Ground::Field)], 0.3f);
  return {glm::sqrt(paint.albedo), 0};
}

int groundMapSize(glm::dvec2 extent, int largest) {
  const double pixels = std::clamp(2 * std::max(extent.x, extent.y), 64.0, 65536.0);
  const auto size = static_cast<int>(std::bit_ceil(static_cast<unsigned>(pixels)));
  return std::clamp(size, 64, std::max(largest, 64));
}

GroundMap paintGroundMap(const city::HeightField& field, const city::GroundCover* cover, int size,
                         const GroundShade& shade, const Light& light, bool sunFromMaps) {
  assert(shade.size == 0 || shade.size == size);
  GroundMap map;
  if (field.empty()) return map;
  if (cover && (cover->size.x < 1 || cover->size.y < 1)) cover = nullptr;
  map.size = size;
  map.rgba.resize(4 * static_cast<size_t>(size) * static_cast<size_t>(size));
  Painting from{field, cover, {}, normalsOf(field, size), shade, light, sunFromMaps};
  if (cover) from.plain = plainCells(*cover);
  const auto paintRows = [&](int first, int stride) {
    for (int row = first; row < size; row += stride) paintRow(map, from, row);
  };
  constexpr int kWorkers = 4;
  std::vector<std::future<void>> workers;
  for (int w = 1; w < kWorkers; ++w) workers.push_back(std::async(std::launch::async, paintRows, w, kWorkers));
  paintRows(0, kWorkers);
  for (auto& worker : workers) worker.get();
  return map;
}

}  // namespace vicus::scenegraph
