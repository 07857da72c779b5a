#include "walking/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicus::walking {
using city::City;

bool touchesSquare(const city::Aabbf& box, glm::dvec2 centre, double halfSide) {
  return !box.empty() && static_cast<double>(box.min.x) <= centre.x + halfSide &&
         static_cast<double>(box.max.x) >= centre.x - halfSide &&
         static_cast<double>(box.min.y) <= centre.y + halfSide && static_cast<double>(box.max.y) >= centre.y - halfSide;
}

bool triangleCovers(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 point) {
  const auto side = [&](glm::dvec2 u, glm::dvec2 v) {
    return (v.x - u.x) * (point.y - u.y) - (v.y - u.y) * (point.x - u.x);
  };
  const double ab = side(a, b), bc = side(b, c), ca = side(c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec2 turned(glm::dvec2 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// Calls `visit(index)` for every instance of the set whose bounds touch the square, in ascending order.
template <typename Visit>
void forEachWithin(const city::InstanceSet& set, glm::dvec2 centre, double halfSide, const Visit& visit) {
  if (set.nodes.empty()) return;
  std::vector<uint32_t> open{0};
  while (!open.empty()) {
    const city::BoundsNode& node = set.nodes[open.back()];
    open.pop_back();
    if (!touchesSquare(node.bounds, centre, halfSide)) continue;
    for (uint32_t k = node.childCount; k > 0; --k) open.push_back(node.firstChild + k - 1);
    if (node.childCount > 0) continue;
    for (uint32_t i = node.instances.first; i < node.instances.end(); ++i)
      if (touchesSquare(set.bounds[i], centre, halfSide)) visit(i);
  }
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0;
  return glm::distance(p, a + t * along);
}

/// Distance to a polygon's outline, negative inside (even-odd over all rings).
double signedDistance(const std::vector<std::vector<glm::dvec2>>& rings, glm::dvec2 p) {
  double nearest = kInfinity;
  bool inside = false;
  for (const auto& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      nearest = std::min(nearest, distanceToSegment(p, a, b));
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
  return inside ? -nearest : nearest;
}

/// Level of the water that covers the point; −infinity on dry land.
double waterLevelAt(const City& city, glm::dvec2 p) {
  double level = -kInfinity;
  for (const city::WaterBody& body : city.water)
    for (size_t t = 0; t + 2 < body.indices.size(); t += 3)
      if (body.level > level && triangleCovers(body.points[body.indices[t]], body.points[body.indices[t + 1]],
                                               body.points[body.indices[t + 2]], p))
        level = body.level;
  return level;
}

/// Ground of the buildings about a point; 0 where there are none.
double groundOfBuildings(const City& city, glm::dvec2 p) {
  constexpr double kReach = 60, kSoftness = 25;
  double sum = 0, weights = 0;
  forEachWithin(city.buildings, p, kReach, [&](uint32_t i) {
    const glm::dvec3& at = city.buildings.instances[i].position;
    const glm::dvec2 apart = glm::dvec2(at) - p;
    const double weight = 1 / (glm::dot(apart, apart) + kSoftness);
    sum += weight * at.z, weights += weight;
  });
  if (weights > 0) return sum / weights;
  double nearest = kInfinity, ground = 0;
  for (const city::Instance& i : city.buildings.instances) {
    const double d = glm::distance(glm::dvec2(i.position), p);
    if (d < nearest) nearest = d, ground = i.position.z;
  }
  return ground;
}

}  // namespace

std::vector<std::vector<glm::dvec2>> footprintOf(const City& city, const city::Instance& building) {
  const city::BuildingGeometry& type = city.buildingTypes[building.geometry];
  std::vector<std::vector<glm::dvec2>> rings;
  const auto place = [&](glm::dvec2 local) {
    return glm::dvec2(building.position) + turned(local, static_cast<double>(building.heading));
  };
  for (const auto& ring : type.footprint) {
    if (ring.size() < 3) continue;
    std::vector<glm::dvec2>& out = rings.emplace_back();
    for (const glm::vec2& p : ring) out.push_back(place(glm::dvec2(p)));
  }
  if (!rings.empty() || type.bounds.empty()) return rings;
  const glm::dvec2 min(glm::vec2(type.bounds.min)), max(glm::vec2(type.bounds.max));
  rings.push_back({place(min), place({max.x, min.y}), place(max), place({min.x, max.y})});
  return rings;
}

std::vector<uint32_t> instancesWithin(const city::InstanceSet& set, glm::dvec2 centre, double halfSide) {
  std::vector<uint32_t> found;
  forEachWithin(set, centre, halfSide, [&](uint32_t i) { found.push_back(i); });
  return found;
}

double clearance(const City& city, glm::dvec2 point, double reach) {
  double nearest = reach;
  forEachWithin(city.buildings, point, reach, [&](uint32_t i) {
    nearest = std::min(nearest, signedDistance(footprintOf(city, city.buildings.instances[i]), point));
  });
  return nearest;
}

double dryGroundAt(const City& city, glm::dvec2 point) {
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return 0;
  const auto terrain = city.terrain ? city.terrain->heightAt(point.x, point.y) : std::nullopt;
  return terrain ? *terrain : groundOfBuildings(city, point);
}

double groundAt(const City& city, glm::dvec2 point) {
  const double ground = dryGroundAt(city, point);
  if (!std::isfinite(point.x) || !std::isfinite(point.y)) return ground;
  return std::max(ground, waterLevelAt(city, point));
}

double highestWithin(const City& city, glm::dvec2 centre, double halfSide) {
  double highest = groundAt(city, centre);
  for (const city::InstanceSet* set : {&city.buildings, &city.trees})
    forEachWithin(*set, centre, halfSide,
                  [&](uint32_t i) { highest = std::max(highest, static_cast<double>(set->bounds[i].max.z)); });
  for (const city::Monument& m : city.monuments)
    if (touchesSquare(m.bounds, centre, halfSide)) highest = std::max(highest, static_cast<double>(m.bounds.max.z));
  if (!city.terrain || city.terrain->empty()) return highest;
  // Every sample in the square and one ring about it, so that no triangle over the square is missed.
  const city::HeightField& field = *city.terrain;
  const glm::dvec2 from = (centre - halfSide - field.origin) / field.spacing - 1.0;
  const glm::dvec2 to = (centre + halfSide - field.origin) / field.spacing + 1.0;
  const glm::dvec2 last(field.size - 1);
  const glm::ivec2 first(glm::clamp(glm::floor(from), glm::dvec2(0), last));
  const glm::ivec2 end(glm::clamp(glm::ceil(to), glm::dvec2(0), last));
  for (int row = first.y; row <= end.y; ++row)
    for (int column = first.x; column <= end.x; ++column) {
      const double h = static_cast<double>(field.at(column, row));
      if (std::isfinite(h)) highest = std::max(highest, h);
    }
  return highest;
}

glm::dvec2 densestPoint(const City& city) {
  if (city.buildings.empty() || city.tiles.size() < city.grid.tileCount())
    return city.extent.empty() ? glm::dvec2(0) : glm::dvec2(city.extent.centre());
  const auto size = static_cast<int>(city.grid.size);
  const auto tileAt = [&](int column, int row) -> const city::Tile& {
    return city.tiles[city::mortonIndex(static_cast<uint32_t>(column), static_cast<uint32_t>(row))];
  };
  // Ground under roofs, and of large buildings no more than a house has: warehouses do not make a town.
  constexpr double kHouse = 200;  // square metres
  std::vector<double> built(city.tiles.size(), 0);
  for (size_t t = 0; t < city.tiles.size(); ++t)
    for (uint32_t i = city.tiles[t].instances.first; i < city.tiles[t].instances.end(); ++i) {
      const glm::dvec3 box(city.buildings.bounds[i].size());
      built[t] += std::min(box.x * box.y, kHouse);
    }
  const auto builtAt = [&](int column, int row) {
    return built[city::mortonIndex(static_cast<uint32_t>(column), static_cast<uint32_t>(row))];
  };
  double most = 0;
  glm::dvec2 sum(0);
  uint32_t count = 1;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const city::Tile& tile = tileAt(column, row);
      if (tile.instances.count == 0) continue;
      // The tile itself counts thrice, so that of two neighbours the fuller one wins.
      double score = 2 * builtAt(column, row);
      for (int y = std::max(row - 1, 0); y <= std::min(row + 1, size - 1); ++y)
        for (int x = std::max(column - 1, 0); x <= std::min(column + 1, size - 1); ++x) score += builtAt(x, y);
      if (score <= most) continue;
      most = score, sum = glm::dvec2(0), count = tile.instances.count;
      for (uint32_t i = tile.instances.first; i < tile.instances.end(); ++i)
        sum += glm::dvec2(city.buildings.instances[i].position);
    }
  return sum / static_cast<double>(count);
}

}  // namespace vicus::walking
