#include "scenegraph/ground_map.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <future>

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
    {{0.105f, 0.150f, 0.045f}, 0.0f},   // grass
    {{0.190f, 0.180f, 0.075f}, 0.25f},  // field
    {{0.200f, 0.150f, 0.100f}, 0.5f},   // earth
    {{0.230f, 0.200f, 0.165f}, 1.0f},   // street
    {{0.290f, 0.270f, 0.240f}, 1.0f},   // paving
    {{0.110f, 0.125f, 0.050f}, 0.1f},   // garden
    {{0.165f, 0.150f, 0.085f}, 0.5f},   // bank
    {{0.070f, 0.075f, 0.055f}, 0.5f},   // water's bed
}};
constexpr Paint kRock = {{0.210f, 0.190f, 0.160f}, 0.5f};

float lattice(int x, int y, uint32_t seed) {
  const uint32_t h = city::hash32(city::hash32(static_cast<uint32_t>(x), static_cast<uint32_t>(y)), seed);
  return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

/// Value noise in 0 … 1 with features about one unit wide.
float noise(glm::vec2 p, uint32_t seed) {
  const glm::vec2 cell = glm::floor(p);
  glm::vec2 t = p - cell;
  t = t * t * (3.0f - 2.0f * t);
  const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
  const float south = glm::mix(lattice(x, y, seed), lattice(x + 1, y, seed), t.x);
  const float north = glm::mix(lattice(x, y + 1, seed), lattice(x + 1, y + 1, seed), t.x);
  return glm::mix(south, north, t.y);
}

Paint mixed(const Paint& a, const Paint& b, float t) {
  return {glm::mix(a.albedo, b.albedo, t), glm::mix(a.detail, b.detail, t)};
}

city::Ground kindAt(const city::GroundCover& cover, glm::dvec2 p) {
  const glm::dvec2 cell = (p - cover.origin) / cover.spacing;
  const int column = std::clamp(static_cast<int>(std::floor(cell.x)), 0, cover.size.x - 1);
  const int row = std::clamp(static_cast<int>(std::floor(cell.y)), 0, cover.size.y - 1);
  return cover.kinds[static_cast<size_t>(row) * static_cast<size_t>(cover.size.x) + static_cast<size_t>(column)];
}

/// The cover's paint about a place: four looks half a cell about it, at a place that noise has moved a little.
Paint coverAt(const city::GroundCover& cover, glm::dvec2 p) {
  const glm::vec2 local(p - cover.origin);
  const glm::vec2 ragged(noise(local / 2.3f, 11) - 0.5f, noise(local / 2.3f, 12) - 0.5f);
  const glm::dvec2 at = p + glm::dvec2(ragged) * (0.9 * std::max(cover.spacing, 1.0));
  Paint sum{glm::vec3(0), 0};
  const double reach = 0.35 * cover.spacing;
  for (const glm::dvec2 offset : {glm::dvec2(-1, -0.4), glm::dvec2(0.4, -1), glm::dvec2(1, 0.4), glm::dvec2(-0.4, 1)}) {
    const Paint& paint = kPaints[static_cast<size_t>(kindAt(cover, at + reach * offset)) % kPaints.size()];
    sum.albedo += 0.25f * paint.albedo;
    sum.detail += 0.25f * paint.detail;
  }
  return sum;
}

/// The field's slope on a coarse grid of normals, so that painting looks up instead of searching.
float flatnessAt(const city::HeightField& field, const std::vector<float>& flatness, glm::dvec2 p) {
  const glm::dvec2 cell = (p - field.origin) / field.spacing;
  const int column = std::clamp(static_cast<int>(cell.x), 0, field.size.x - 2);
  const int row = std::clamp(static_cast<int>(cell.y), 0, field.size.y - 2);
  const glm::vec2 t(glm::clamp(cell - glm::dvec2(column, row), 0.0, 1.0));
  const float* at =
      flatness.data() + static_cast<size_t>(row) * static_cast<size_t>(field.size.x) + static_cast<size_t>(column);
  return glm::mix(glm::mix(at[0], at[1], t.x), glm::mix(at[field.size.x], at[field.size.x + 1], t.x), t.y);
}

/// Part of the light on level ground that reaches a pixel.
glm::vec3 lightThrough(const GroundShade& shade, const Light& light, size_t pixel) {
  if (shade.size == 0) return glm::vec3(1);
  const glm::vec3 sun = light.sun * std::max(light.sunDirection.z, 0.0f);
  const float sunPart = static_cast<float>(shade.sun[pixel]) / 255,
              skyPart = static_cast<float>(shade.sky[pixel]) / 255;
  return (sun * sunPart + light.sky * skyPart) / (sun + light.sky);
}

void paintRow(GroundMap& map, const city::HeightField& field, const city::GroundCover* cover,
              const std::vector<float>& flatness, const GroundShade& shade, const Light& light, int row) {
  const glm::dvec2 step = field.extent() / static_cast<double>(map.size);
  for (int column = 0; column < map.size; ++column) {
    const glm::dvec2 p = field.origin + step * (glm::dvec2(column, row) + 0.5);
    const glm::vec2 local(p - field.origin);
    const float broad = noise(local / 47.0f, 1), fine = noise(local / 6.1f, 2);
    Paint paint;
    if (cover) {
      paint = coverAt(*cover, p);
    } else {
      const float meadow = glm::smoothstep(0.45f, 0.62f, 0.7f * noise(local / 160.0f, 3) + 0.3f * broad);
      paint = mixed(kPaints[static_cast<size_t>(city::Ground::Grass)],
                    kPaints[static_cast<size_t>(city::Ground::Field)], 0.6f * meadow);
    }
    const float steep = glm::smoothstep(0.12f, 0.35f, 1 - flatnessAt(field, flatness, p) + 0.08f * (fine - 0.5f));
    paint = mixed(paint, kRock, 0.85f * steep);
    const float mottled = 1 + 0.28f * (broad - 0.5f) + 0.22f * (fine - 0.5f);
    const float warm = 0.10f * (noise(local / 19.0f, 4) - 0.5f);
    const size_t pixel = static_cast<size_t>(row) * static_cast<size_t>(map.size) + static_cast<size_t>(column);
    const glm::vec3 albedo =
        paint.albedo * mottled * glm::vec3(1 + warm, 1, 1 - warm) * lightThrough(shade, light, pixel);
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
                         const GroundShade& shade, const Light& light) {
  assert(shade.size == 0 || shade.size == size);
  GroundMap map;
  if (field.empty()) return map;
  if (cover && (cover->size.x < 1 || cover->size.y < 1)) cover = nullptr;
  map.size = size;
  map.rgba.resize(4 * static_cast<size_t>(size) * static_cast<size_t>(size));
  std::vector<float> flatness(field.heights.size());
  for (int r = 0; r < field.size.y; ++r)
    for (int c = 0; c < field.size.x; ++c)
      flatness[static_cast<size_t>(r) * static_cast<size_t>(field.size.x) + static_cast<size_t>(c)] =
          sampleNormal(field, c, r).z;
  const auto paintRows = [&](int first, int stride) {
    for (int row = first; row < size; row += stride) paintRow(map, field, cover, flatness, shade, light, row);
  };
  constexpr int kWorkers = 4;
  std::vector<std::future<void>> workers;
  for (int w = 1; w < kWorkers; ++w) workers.push_back(std::async(std::launch::async, paintRows, w, kWorkers));
  paintRows(0, kWorkers);
  for (auto& worker : workers) worker.get();
  return map;
}

}  // namespace vicus::scenegraph
