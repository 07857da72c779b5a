/// A town of boxes whose visible set can be found exactly, for the tests and benchmarks of the cull map.
///
/// Square blocks of 68 m, 12 m of street between them; twelve plots of 17 × 17 m along each block's edge, houses 12 m
/// deep and 8 to 22 m high, 8 % of the plots empty, 1.5 % with a tower of 30 to 60 m.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "city/city.hpp"
#include "city/random.hpp"
#include "city/view_state.hpp"

namespace vicus::test {

constexpr double kBlockPitch = 80;

/// The next number in [0, 1) of a stream.
inline float nextUnit(uint32_t& state) {
  state = city::hash32(state + 0x9e3779b9U);
  return static_cast<float>(state >> 8) * (1.0f / 16777216.0f);
}

struct BoxCity {
  city::City city;
  int blocks = 0;   ///< to a side
  double side = 0;  ///< metres
};

inline city::BuildingGeometry boxBuilding(glm::vec3 size) {
  city::BuildingGeometry g;
  g.bounds = {glm::vec3(0), size};
  g.height = size.z;
  const glm::vec2 corners[] = {{0, 0}, {size.x, 0}, {size.x, size.y}, {0, size.y}};
  for (size_t k = 0; k < 4; ++k) g.occluders.push_back({corners[k], corners[(k + 1) % 4], 0, size.z});
  return g;
}

inline BoxCity makeBoxCity(uint32_t count) {
  BoxCity out;
  out.blocks = static_cast<int>(std::ceil(std::sqrt(count / (12 * 0.92))));
  out.side = out.blocks * kBlockPitch;
  city::CityParts parts;
  for (int by = 0; by < out.blocks; ++by)
    for (int bx = 0; bx < out.blocks; ++bx)
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          if ((i > 0 && i < 3 && j > 0 && j < 3) || parts.buildings.size() >= count) continue;
          uint32_t s = city::hash32(static_cast<uint32_t>(by) * 73856093u ^ static_cast<uint32_t>(bx) * 19349663u ^
                                    static_cast<uint32_t>(j * 4 + i) * 83492791u);
          if (nextUnit(s) < 0.08f) continue;
          float height = 8 + 14 * nextUnit(s);
          if (nextUnit(s) < 0.015f) height = 30 + 30 * nextUnit(s);
          glm::dvec2 min(bx * kBlockPitch + 6 + i * 17, by * kBlockPitch + 6 + j * 17), max = min + 17.0;
          if (i == 0)
            max.x -= 5;
          else if (i == 3)
            min.x += 5;
          if (j == 0 && i > 0 && i < 3)
            max.y -= 5;
          else if (j == 3 && i > 0 && i < 3)
            min.y += 5;
          city::Instance& instance = parts.buildings.emplace_back();
          instance.position = glm::dvec3(min, 0);
          instance.geometry = static_cast<uint32_t>(out.city.buildingTypes.size());
          out.city.buildingTypes.push_back(boxBuilding({glm::vec2(max - min), height}));
        }
  city::finishCity(out.city, std::move(parts));
  return out;
}

/// Eye 1.7 m above the middle of streets near the town's middle, swinging by 40° about the street's axis.
inline std::vector<city::ViewState> streetViews(const BoxCity& town, glm::ivec2 size, int count = 60) {
  std::vector<city::ViewState> views;
  const int middle = town.blocks / 2;
  for (int k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) / count, swing = 0.7 * std::sin(25 * t);
    const bool north = k < count / 2;
    const double along = (middle - 3) * kBlockPitch + (north ? t : t - 0.5) * 12 * kBlockPitch;
    const glm::dvec3 eye =
        north ? glm::dvec3(middle * kBlockPitch, along, 1.7) : glm::dvec3(along, (middle + 1) * kBlockPitch, 1.7);
    city::ViewState view = city::makeView({eye, north ? 1.5708 + swing : swing, 0, 0}, 1.0472, size);
    view.nearDistance = 0.5;
    views.push_back(view);
  }
  return views;
}

/// Circling 120 m up, looking 25° down.
inline std::vector<city::ViewState> flyoverViews(const BoxCity& town, glm::ivec2 size, int count = 60) {
  std::vector<city::ViewState> views;
  for (int k = 0; k < count; ++k) {
    const double t = 2 * std::numbers::pi * k / count;
    const glm::dvec2 eye = town.side * (0.5 + 0.3 * glm::dvec2(std::cos(t), std::sin(t)));
    views.push_back(city::makeView({{eye, 120}, t + 1.9, -0.436, 0}, 1.0472, size));
  }
  return views;
}

/// An item buffer of the bounding boxes of a city's buildings, drawn by the processor: which have a pixel.
inline std::vector<bool> visibleBoxes(const city::City& city, const city::ViewState& view) {
  const int width = view.viewport.x, height = view.viewport.y;
  std::vector<float> depth(static_cast<size_t>(width) * static_cast<size_t>(height), 0.0f);
  std::vector<uint32_t> items(depth.size(), city::kNone);
  const double up = std::tan(view.verticalFov / 2), right = up * view.aspect();
  // Corners of a box by bit: x, y, z; faces counter-clockwise from outside.
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (uint32_t item = 0; item < city.buildings.size(); ++item) {
    const city::Aabbf& box = city.buildings.bounds[item];
    for (const auto& face : kFaces) {
      // Into the eye's frame: x right, y up, z forward.
      std::vector<glm::dvec3> polygon;
      for (const int c : face) {
        const glm::dvec3 p =
            glm::dvec3(c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z) -
            view.eye;
        polygon.emplace_back(glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward));
      }
      const glm::dvec3 normal = glm::cross(polygon[1] - polygon[0], polygon[2] - polygon[0]);
      if (glm::dot(normal, polygon[0]) >= 0) continue;
      const auto clipBy = [&](auto distance) {
        std::vector<glm::dvec3> out;
        for (size_t i = 0; i < polygon.size(); ++i) {
          const glm::dvec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
          const double da = distance(a), db = distance(b);
          if (da >= 0) out.push_back(a);
          if ((da >= 0) != (db >= 0)) out.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon = std::move(out);
      };
      clipBy([&](glm::dvec3 p) { return p.z - view.nearDistance; });
      clipBy([&](glm::dvec3 p) { return right * p.z - p.x; });
      clipBy([&](glm::dvec3 p) { return right * p.z + p.x; });
      clipBy([&](glm::dvec3 p) { return up * p.z - p.y; });
      clipBy([&](glm::dvec3 p) { return up * p.z + p.y; });
      if (polygon.size() < 3) continue;
      // 1 / depth is linear on the screen: normal · (x, y, 1) / (normal · p0).
      const double plane = glm::dot(normal, polygon[0]);
      std::vector<glm::dvec2> screen;
      double low = height, high = 0;
      for (const glm::dvec3& p : polygon) {
        screen.emplace_back((p.x / p.z / right + 1) / 2 * width, (p.y / p.z / up + 1) / 2 * height);
        low = std::min(low, screen.back().y), high = std::max(high, screen.back().y);
      }
      for (int y = std::max(0, static_cast<int>(std::ceil(low - 0.5))); y < height && y + 0.5 <= high; ++y) {
        double from = width, to = 0;
        for (size_t i = 0; i < screen.size(); ++i) {
          const glm::dvec2 a = screen[i], b = screen[(i + 1) % screen.size()];
          if ((a.y <= y + 0.5) == (b.y <= y + 0.5)) continue;
          const double x = a.x + (b.x - a.x) * ((y + 0.5 - a.y) / (b.y - a.y));
          from = std::min(from, x), to = std::max(to, x);
        }
        const double v = ((y + 0.5) / height * 2 - 1) * up;
        for (int x = std::max(0, static_cast<int>(std::ceil(from - 0.5))); x < width && x + 0.5 <= to; ++x) {
          const double h = ((x + 0.5) / width * 2 - 1) * right;
          const auto inverse = static_cast<float>((normal.x * h + normal.y * v + normal.z) / plane);
          const size_t pixel = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
          if (inverse > depth[pixel]) depth[pixel] = inverse, items[pixel] = item;
        }
      }
    }
  }
  std::vector<bool> visible(city.buildings.size(), false);
  for (const uint32_t item : items)
    if (item != city::kNone) visible[item] = true;
  return visible;
}

}  // namespace vicus::test
