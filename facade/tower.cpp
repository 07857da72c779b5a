#include "facade/tower.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::facade {
namespace {

using glm::dvec2;

Ring square(dvec2 middle, dvec2 along, double size) {
  const dvec2 u = along * (size / 2), v = dvec2(-u.y, u.x);
  return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

}  // namespace

std::optional<Ring> endTower(const Ring& outline, double size) {
  dvec2 u(1, 0);
  double longest = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const dvec2 d = outline[(i + 1) % outline.size()] - outline[i];
    if (const double length = glm::length(d); length > longest) longest = length, u = d / length;
  }
  if (u.x < 0) u = -u;
  const dvec2 v(-u.y, u.x);
  double west = INFINITY, east = -INFINITY, low = INFINITY, high = -INFINITY;
  for (const dvec2& p : outline) {
    west = std::min(west, glm::dot(p, u)), east = std::max(east, glm::dot(p, u));
    low = std::min(low, glm::dot(p, v)), high = std::max(high, glm::dot(p, v));
  }
  // Across, the middle of what stands at that end.
  double endLow = INFINITY, endHigh = -INFINITY;
  for (const dvec2& p : outline)
    if (glm::dot(p, u) < west + 0.1 * (east - west))
      endLow = std::min(endLow, glm::dot(p, v)), endHigh = std::max(endHigh, glm::dot(p, v));
  const double s = std::min({size, 0.9 * (high - low), 0.9 * (east - west)});
  if (!(s >= 1)) return std::nullopt;
  constexpr double kOut = 0.5;
  return square(u * (west - kOut + s / 2) + v * ((endLow + endHigh) / 2), u, s);
}

std::vector<Ring> cornerTurrets(const Ring& outline, std::span<const uint8_t> party, double size) {
  std::vector<Ring> turrets;
  const size_t n = outline.size();
  for (size_t i = 0; i < n; ++i) {
    const size_t before = (i + n - 1) % n;
    if (party[before] || party[i]) continue;
    const dvec2 a = outline[i] - outline[before], b = outline[(i + 1) % n] - outline[i];
    if (!(std::min(glm::length(a), glm::length(b)) > 1.5 * size)) continue;
    const dvec2 u = glm::normalize(a), v = glm::normalize(b);
    constexpr double kSine20 = 0.342;
    if (!(u.x * v.y - u.y * v.x > 0) || std::abs(glm::dot(u, v)) > kSine20) continue;
    turrets.push_back(square(outline[i], u, size));
  }
  return turrets;
}

}  // namespace vicus::facade
