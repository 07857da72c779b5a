#include "scenegraph/ground_shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vicus::scenegraph {
namespace {

/// A square mask over the field; triangles on the plan set the pixels whose centres they cover.
class Mask {
 public:
  Mask(int pixels, const city::HeightField& field)
      : side(pixels),
        covered(static_cast<size_t>(pixels) * static_cast<size_t>(pixels), 0),
        origin_(field.origin),
        perMetre_(static_cast<double>(pixels) / field.extent()) {}

  glm::vec2 toPixels(const glm::dvec2& p) const { return glm::vec2((p - origin_) * perMetre_); }

  /// Corners in pixels, in either order.
  void add(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
    const auto cross = [](glm::vec2 u, glm::vec2 v) { return u.x * v.y - u.y * v.x; };
    if (cross(b - a, c - a) < 0) std::swap(b, c);
    const glm::vec2 lo = glm::min(glm::min(a, b), c), hi = glm::max(glm::max(a, b), c);
    const auto limit = static_cast<float>(side - 1);
    if (!(hi.x >= 0 && hi.y >= 0 && lo.x <= limit + 1 && lo.y <= limit + 1)) return;
    const int x0 = static_cast<int>(std::max(lo.x, 0.0f)), x1 = static_cast<int>(std::min(hi.x, limit));
    const int y0 = static_cast<int>(std::max(lo.y, 0.0f)), y1 = static_cast<int>(std::min(hi.y, limit));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const glm::vec2 p = glm::vec2(x, y) + 0.5f;
        if (cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0)
          covered[static_cast<size_t>(y) * static_cast<size_t>(side) + static_cast<size_t>(x)] = 1;
      }
  }

  int side;
  std::vector<uint8_t> covered;

 private:
  glm::dvec2 origin_, perMetre_;
};

/// How far the shadow of something `above` metres over the ground moves on the plan.
glm::dvec2 shadowOffset(const glm::vec3& towardSun, double above) {
  return glm::dvec2(-glm::vec2(towardSun) / towardSun.z) * std::max(above, 0.0);
}

struct Masks {
  Mask shadow, crownShadow;  ///< at twice the map's resolution
  Mask roofs;                ///< seen from above
};

/// Adds triangles of a geometry that stands at `position`.
void addTriangles(Masks& masks, const glm::vec3& towardSun, const std::vector<city::Vertex>& vertices,
                  std::span<const uint32_t> indices, const glm::dvec3& position, float heading) {
  const double c = std::cos(static_cast<double>(heading)), s = std::sin(static_cast<double>(heading));
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    std::array<glm::vec2, 3> shadow, roof;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p(vertices[indices[i + k]].position);
      const glm::dvec2 at = glm::dvec2(position) + glm::dvec2(c * p.x - s * p.y, s * p.x + c * p.y);
      shadow[k] = masks.shadow.toPixels(at + shadowOffset(towardSun, p.z));
      roof[k] = masks.roofs.toPixels(at);
    }
    masks.shadow.add(shadow[0], shadow[1], shadow[2]);
    masks.roofs.add(roof[0], roof[1], roof[2]);
  }
}

/// The plain surfaces of a building type: enough for its outline.
std::vector<uint32_t> plainTriangles(const city::BuildingGeometry& g) {
  std::vector<uint32_t> out;
  for (const city::Plane& plane : g.planes)
    out.insert(out.end(), g.indices.begin() + plane.flat.first, g.indices.begin() + plane.flat.end());
  return out;
}

/// A crown as an ellipsoid over the upper three quarters of the tree: its shadow is an ellipse.
void addCrown(Masks& masks, const glm::vec3& towardSun, const city::Aabbf& bounds, const glm::dvec3& position) {
  if (bounds.empty()) return;
  const double height = static_cast<double>(bounds.max.z), halfHeight = 0.375 * height;
  const double radius = 0.4 * static_cast<double>(std::min(bounds.size().x, bounds.size().y));
  const glm::dvec2 middle = glm::dvec2(position) + shadowOffset(towardSun, height - halfHeight);
  const glm::dvec2 reach = shadowOffset(towardSun, halfHeight);
  const double length = glm::length(reach);
  const glm::dvec2 along = length > 1e-9 ? reach / length : glm::dvec2(1, 0), across(-along.y, along.x);
  constexpr int kCorners = 10;
  const auto corner = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    return masks.crownShadow.toPixels(middle + std::hypot(radius, length) * std::cos(angle) * along +
                                      radius * std::sin(angle) * across);
  };
  for (int i = 1; i + 1 < kCorners; ++i) masks.crownShadow.add(corner(0), corner(i), corner(i + 1));
}

/// Mean over a square window of 2 · radius + 1 pixels, edges repeated; values 0 to 1 in, 0 to 255 out.
std::vector<uint8_t> blurred(const std::vector<uint8_t>& mask, int side, int radius) {
  const auto row = static_cast<size_t>(side);
  const int window = 2 * radius + 1;
  std::vector<uint16_t> rows(mask.size());
  for (int y = 0; y < side; ++y) {
    const uint8_t* from = mask.data() + static_cast<size_t>(y) * row;
    const auto at = [&](int x) { return int{from[std::clamp(x, 0, side - 1)]}; };
    int sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += at(x);
    for (int x = 0; x < side; ++x) {
      rows[static_cast<size_t>(y) * row + static_cast<size_t>(x)] = static_cast<uint16_t>(sum);
      sum += at(x + radius + 1) - at(x - radius);
    }
  }
  std::vector<uint8_t> out(mask.size());
  std::vector<int> sums(row, 0);
  const auto line = [&](int y) { return rows.data() + static_cast<size_t>(std::clamp(y, 0, side - 1)) * row; };
  for (int y = -radius; y <= radius; ++y)
    for (size_t x = 0; x < row; ++x) sums[x] += line(y)[x];
  for (int y = 0; y < side; ++y) {
    for (size_t x = 0; x < row; ++x)
      out[static_cast<size_t>(y) * row + x] = static_cast<uint8_t>(255 * sums[x] / (window * window));
    for (size_t x = 0; x < row; ++x) sums[x] += line(y + radius + 1)[x] - line(y - radius)[x];
  }
  return out;
}

}  // namespace

GroundShade shadeGround(const city::City& city, const glm::vec3& towardSun, int size) {
  GroundShade shade;
  if (!city.terrain || city.terrain->empty() || size < 1) return shade;
  const city::HeightField& field = *city.terrain;
  constexpr float kLowestSun = 0.05f;  // sine of 3°
  const double pixel = std::max(field.extent().x, field.extent().y) / size;
  if (towardSun.z < kLowestSun || pixel > kCoarsestShade) return shade;

  Masks masks{Mask(2 * size, field), Mask(2 * size, field), Mask(size, field)};
  std::vector<std::vector<uint32_t>> plain(city.buildingTypes.size());
  for (const city::Instance& i : city.buildings.instances) {
    const city::BuildingGeometry& type = city.buildingTypes[i.geometry];
    if (plain[i.geometry].empty()) plain[i.geometry] = plainTriangles(type);
    addTriangles(masks, towardSun, type.vertices, plain[i.geometry], i.position, i.heading);
  }
  for (const city::Monument& m : city.monuments)
    addTriangles(masks, towardSun, city.meshes[m.mesh].mesh.vertices, city.meshes[m.mesh].mesh.indices, m.position,
                 m.heading);
  for (const city::Instance& i : city.trees.instances)
    addCrown(masks, towardSun, city.treeTypes[i.geometry].bounds, i.position);

  shade.size = size;
  const auto side = static_cast<size_t>(size);
  shade.sun.resize(side * side);
  for (size_t y = 0; y < side; ++y)
    for (size_t x = 0; x < side; ++x) {
      const size_t at = 4 * y * side + 2 * x;
      const auto count = [&](const Mask& m) {
        return m.covered[at] + m.covered[at + 1] + m.covered[at + 2 * side] + m.covered[at + 2 * side + 1];
      };
      // Crowns let a third of the sun through.
      const int open = 255 * (4 - count(masks.shadow)) / 4 * (12 - 2 * count(masks.crownShadow)) / 12;
      shade.sun[y * side + x] = static_cast<uint8_t>(open);
    }
  // Walls hide up to half of the sky from the ground at their foot, and nothing 3 m away.
  constexpr double kReach = 3;
  const int radius = std::max(1, static_cast<int>(std::lround(kReach / pixel)));
  shade.sky = blurred(masks.roofs.covered, size, radius);
  for (uint8_t& v : shade.sky) v = static_cast<uint8_t>(255 - v);
  return shade;
}

}  // namespace vicus::scenegraph
