#include "city/height_field.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::city {
namespace {

/// The triangle of the full-detail surface at a position: its cell, the place within it and its plane.
struct Surface {
  double height;
  double slopeX, slopeY;  // metres of rise for each cell
};

std::optional<Surface> surfaceAt(const HeightField& field, double x, double y) {
  if (field.empty() || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  const double gx = std::clamp((x - field.origin.x) / field.spacing.x, 0.0, static_cast<double>(field.size.x - 1));
  const double gy = std::clamp((y - field.origin.y) / field.spacing.y, 0.0, static_cast<double>(field.size.y - 1));
  const int column = std::min(static_cast<int>(gx), field.size.x - 2);
  const int row = std::min(static_cast<int>(gy), field.size.y - 2);
  const double u = gx - column, v = gy - row;
  const double sw = static_cast<double>(field.at(column, row)), se = static_cast<double>(field.at(column + 1, row));
  const double nw = static_cast<double>(field.at(column, row + 1)),
               ne = static_cast<double>(field.at(column + 1, row + 1));

  Surface s{};
  if ((column + row) % 2 == 0) {  // diagonal from south-west to north-east
    s = u >= v ? Surface{sw + u * (se - sw) + v * (ne - se), se - sw, ne - se}
               : Surface{sw + u * (ne - nw) + v * (nw - sw), ne - nw, nw - sw};
  } else {  // from north-west to south-east
    s = u + v <= 1 ? Surface{sw + u * (se - sw) + v * (nw - sw), se - sw, nw - sw}
                   : Surface{ne - (1 - u) * (ne - nw) - (1 - v) * (ne - se), ne - nw, ne - se};
  }
  if (!std::isfinite(s.height)) return std::nullopt;
  return s;
}

}  // namespace

std::optional<double> HeightField::heightAt(double x, double y) const {
  const auto s = surfaceAt(*this, x, y);
  if (!s) return std::nullopt;
  return s->height;
}

glm::dvec3 HeightField::normalAt(double x, double y) const {
  const auto s = surfaceAt(*this, x, y);
  if (!s) return {0, 0, 1};
  return glm::normalize(glm::dvec3(-s->slopeX / spacing.x, -s->slopeY / spacing.y, 1));
}

void HeightField::updateRange() {
  minHeight = maxHeight = 0;
  bool any = false;
  for (const float h : heights) {
    if (!std::isfinite(h)) continue;
    minHeight = any ? std::min(minHeight, h) : h;
    maxHeight = any ? std::max(maxHeight, h) : h;
    any = true;
  }
}

Aabb HeightField::bounds() const {
  if (empty()) return {};
  const glm::dvec2 end = origin + extent();
  return {{origin.x, origin.y, static_cast<double>(minHeight)}, {end.x, end.y, static_cast<double>(maxHeight)}};
}

uint64_t HeightField::triangleCount() const {
  uint64_t count = 0;
  for (int row = 0; row + 1 < size.y; ++row)
    for (int column = 0; column + 1 < size.x; ++column) {
      const bool sw = std::isfinite(at(column, row)), se = std::isfinite(at(column + 1, row));
      const bool nw = std::isfinite(at(column, row + 1)), ne = std::isfinite(at(column + 1, row + 1));
      if ((column + row) % 2 == 0)
        count += static_cast<uint64_t>(sw && se && ne) + static_cast<uint64_t>(sw && ne && nw);
      else
        count += static_cast<uint64_t>(sw && se && nw) + static_cast<uint64_t>(se && ne && nw);
    }
  return count;
}

}  // namespace vicus::city
