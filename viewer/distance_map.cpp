#include "viewer/distance_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "viewer/surroundings.hpp"

namespace vicus::viewer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFar = 1e12;  ///< squared cells: stands for "none" where infinities would give NaN

/// Lower envelope of the parabolas (q − v)² + f[v] over one line of cells, in place.
void transformLine(std::vector<double>& f, std::vector<int>& vertex, std::vector<double>& from,
                   std::vector<double>& out) {
  const int n = static_cast<int>(f.size());
  const auto at = [&](int i) { return f[static_cast<size_t>(i)]; };
  int k = 0;
  vertex[0] = 0, from[0] = -kInfinity, from[1] = kInfinity;
  for (int q = 1; q < n; ++q) {
    const auto crossing = [&](int v) { return (at(q) + q * q - at(v) - v * v) / (2.0 * (q - v)); };
    while (crossing(vertex[static_cast<size_t>(k)]) <= from[static_cast<size_t>(k)]) --k;
    const double s = crossing(vertex[static_cast<size_t>(k)]);
    ++k;
    vertex[static_cast<size_t>(k)] = q, from[static_cast<size_t>(k)] = s, from[static_cast<size_t>(k) + 1] = kInfinity;
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (from[static_cast<size_t>(k) + 1] < q) ++k;
    const int v = vertex[static_cast<size_t>(k)];
    out[static_cast<size_t>(q)] = (q - v) * (q - v) + at(v);
  }
  std::swap(f, out);
}

/// Fills a polygon (even-odd) into the raster, and every cell that its outline passes.
void rasterise(const std::vector<std::vector<glm::dvec2>>& rings, const DistanceMap& map,
               std::vector<uint8_t>& occupied) {
  const auto toCells = [&](glm::dvec2 p) { return (p - map.origin) / map.cell; };
  double low = kInfinity, high = -kInfinity;
  for (const auto& ring : rings)
    for (const glm::dvec2& p : ring) low = std::min(low, toCells(p).y), high = std::max(high, toCells(p).y);
  const int firstRow = std::max(0, static_cast<int>(std::ceil(std::max(low, 0.0))));
  const int lastRow = static_cast<int>(std::floor(std::min(high, static_cast<double>(map.size.y - 1))));
  std::vector<double> crossings;
  for (int row = firstRow; row <= lastRow; ++row) {
    crossings.clear();
    for (const auto& ring : rings)
      for (size_t i = 0; i < ring.size(); ++i) {
        const glm::dvec2 a = toCells(ring[i]), b = toCells(ring[(i + 1) % ring.size()]);
        if ((a.y > row) != (b.y > row)) crossings.push_back(a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    std::sort(crossings.begin(), crossings.end());
    for (size_t c = 0; c + 1 < crossings.size(); c += 2) {
      const int from = static_cast<int>(std::ceil(std::max(crossings[c], 0.0)));
      const int to = static_cast<int>(std::floor(std::min(crossings[c + 1], static_cast<double>(map.size.x - 1))));
      for (int column = from; column <= to; ++column) occupied[map.index({column, row})] = 1;
    }
  }
  for (const auto& ring : rings)
    for (size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = toCells(ring[i]), b = toCells(ring[(i + 1) % ring.size()]);
      const int steps = 1 + static_cast<int>(2 * glm::distance(a, b));  // two samples a cell
      for (int s = 0; s <= steps; ++s) {
        const glm::ivec2 c(glm::floor(a + (b - a) * (static_cast<double>(s) / steps) + 0.5));
        if (c.x >= 0 && c.y >= 0 && c.x < map.size.x && c.y < map.size.y) occupied[map.index(c)] = 1;
      }
    }
}

constexpr glm::ivec2 kNeighbours[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

/// Where one walks in a town rather than about it or along its walls: metres to the nearest building.
bool streetLike(double distance) {
  return distance >= 1.8 && distance <= 9;
}

/// Price of a metre at a distance from the nearest building. It falls towards the middle of a street and rises again in
/// the open, so that a way neither hugs walls nor leaves the town. Tuned on Périgueux's medieval centre.
double price(double distance) {
  constexpr double kHug = 2.5, kOpen = 9, kMostOpen = 10;
  const double open = std::clamp((distance - kOpen) / kOpen, 0.0, kMostOpen);
  return 1 + (kHug / distance) * (kHug / distance) + open * open;
}

struct Cheapest {
  std::vector<double> cost;      ///< infinity where not reached
  std::vector<uint32_t> before;  ///< previous cell on the cheapest way
};

Cheapest cheapestFrom(const DistanceMap& map, uint32_t start, double keepClear) {
  Cheapest out;
  out.cost.assign(map.distance.size(), kInfinity);
  out.before.assign(map.distance.size(), start);
  using Entry = std::pair<double, uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  out.cost[start] = 0;
  open.emplace(0, start);
  while (!open.empty()) {
    const auto [cost, cell] = open.top();
    open.pop();
    if (cost > out.cost[cell]) continue;
    const glm::ivec2 at(static_cast<int>(cell) % map.size.x, static_cast<int>(cell) / map.size.x);
    for (const glm::ivec2 step : kNeighbours) {
      const glm::ivec2 next = at + step;
      if (next.x < 0 || next.y < 0 || next.x >= map.size.x || next.y >= map.size.y) continue;
      const size_t n = map.index(next);
      const double d = static_cast<double>(map.distance[n]);
      if (d < keepClear) continue;
      const double length = map.cell * std::sqrt(static_cast<double>(step.x * step.x + step.y * step.y));
      const double reached = cost + length * price(d);
      if (reached >= out.cost[n]) continue;
      out.cost[n] = reached, out.before[n] = cell;
      open.emplace(reached, static_cast<uint32_t>(n));
    }
  }
  return out;
}

/// A cell of the connected piece with the most street; nothing (size of the map) where no cell is free.
size_t cellOfLargestPiece(const DistanceMap& map, double keepClear) {
  const size_t cells = map.distance.size();
  std::vector<uint8_t> seen(cells, 0);
  std::vector<uint32_t> open;
  size_t best = cells;
  uint64_t most = 0;
  for (size_t seed = 0; seed < cells; ++seed) {
    if (seen[seed] || static_cast<double>(map.distance[seed]) < keepClear) continue;
    uint64_t street = 1;
    seen[seed] = 1;
    open.assign(1, static_cast<uint32_t>(seed));
    while (!open.empty()) {
      const uint32_t cell = open.back();
      open.pop_back();
      if (streetLike(static_cast<double>(map.distance[cell]))) ++street;
      const glm::ivec2 at(static_cast<int>(cell) % map.size.x, static_cast<int>(cell) / map.size.x);
      for (const glm::ivec2 step : kNeighbours) {
        const glm::ivec2 next = at + step;
        if (next.x < 0 || next.y < 0 || next.x >= map.size.x || next.y >= map.size.y) continue;
        const size_t n = map.index(next);
        if (seen[n] || static_cast<double>(map.distance[n]) < keepClear) continue;
        seen[n] = 1;
        open.push_back(static_cast<uint32_t>(n));
      }
    }
    if (street > most) most = street, best = seed;
  }
  return best;
}

/// The cell that is dearest to reach, street before anything else.
uint32_t farthest(const DistanceMap& map, const Cheapest& ways, uint32_t start) {
  uint32_t best = start;
  bool bestIsStreet = false;
  for (uint32_t cell = 0; cell < ways.cost.size(); ++cell) {
    if (!std::isfinite(ways.cost[cell])) continue;
    const bool street = streetLike(static_cast<double>(map.distance[cell]));
    if (street > bestIsStreet || (street == bestIsStreet && ways.cost[cell] > ways.cost[best]))
      best = cell, bestIsStreet = street;
  }
  return best;
}

}  // namespace

std::vector<float> distanceTransform(const std::vector<uint8_t>& occupied, glm::ivec2 size) {
  const auto width = static_cast<size_t>(std::max(size.x, 0)), height = static_cast<size_t>(std::max(size.y, 0));
  std::vector<double> squared(width * height);
  for (size_t i = 0; i < squared.size(); ++i) squared[i] = occupied[i] ? 0 : kFar;
  const size_t longest = std::max(width, height);
  std::vector<double> line, out, from(longest + 1);
  std::vector<int> vertex(longest);
  const auto transform = [&](size_t first, size_t stride, size_t count) {
    line.resize(count), out.resize(count);
    for (size_t i = 0; i < count; ++i) line[i] = squared[first + i * stride];
    transformLine(line, vertex, from, out);
    for (size_t i = 0; i < count; ++i) squared[first + i * stride] = line[i];
  };
  for (size_t row = 0; row < height; ++row) transform(row * width, 1, width);
  for (size_t column = 0; column < width; ++column) transform(column, width, height);
  std::vector<float> distance(squared.size());
  for (size_t i = 0; i < squared.size(); ++i)
    distance[i] =
        squared[i] < kFar / 2 ? static_cast<float>(std::sqrt(squared[i])) : std::numeric_limits<float>::infinity();
  return distance;
}

DistanceMap distanceToFootprints(const city::City& city, glm::dvec2 centre, double halfSide, double cell) {
  DistanceMap map;
  map.cell = cell;
  map.size = glm::ivec2(1 + static_cast<int>(std::ceil(2 * halfSide / cell)));
  map.origin = centre - 0.5 * cell * glm::dvec2(map.size - 1);
  std::vector<uint8_t> occupied(static_cast<size_t>(map.size.x) * static_cast<size_t>(map.size.y), 0);
  for (const uint32_t i : buildingsWithin(city, centre, halfSide + cell))
    rasterise(footprintOf(city, city.buildings.instances[i]), map, occupied);
  map.distance = distanceTransform(occupied, map.size);
  for (float& d : map.distance) d *= static_cast<float>(cell);
  return map;
}

std::vector<glm::dvec2> ridgeWay(const DistanceMap& map, double keepClear) {
  const size_t piece = cellOfLargestPiece(map, keepClear);
  if (piece == map.distance.size()) return {};
  // The longest cheapest way, found as in a tree: the farthest cell from anywhere, then the farthest from that.
  const auto anywhere = static_cast<uint32_t>(piece);
  const uint32_t start = farthest(map, cheapestFrom(map, anywhere, keepClear), anywhere);
  const Cheapest ways = cheapestFrom(map, start, keepClear);
  std::vector<glm::dvec2> way;
  for (uint32_t cell = farthest(map, ways, start);; cell = ways.before[cell]) {
    way.push_back(map.centre({static_cast<int>(cell) % map.size.x, static_cast<int>(cell) / map.size.x}));
    if (cell == start) break;
  }
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace vicus::viewer
