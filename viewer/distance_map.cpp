#include "viewer/distance_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "walking/surroundings.hpp"

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

constexpr double kBuiltIn = 0.7;  ///< enclosure of a street: houses on both sides, sky at its ends

double enclosureAt(const DistanceMap& map, size_t cell) {
  return map.enclosure.empty() ? 1 : static_cast<double>(map.enclosure[cell]);
}

/// How good a cell is to begin or end a walk on: 2 a street between houses, 1 near a house, 0 anything else.
int worth(const DistanceMap& map, size_t cell) {
  constexpr double kNarrow = 1.8, kWide = 9;  // metres to the nearest house
  const double d = static_cast<double>(map.distance[cell]);
  if (d < kNarrow || d > kWide) return 0;
  return enclosureAt(map, cell) >= kBuiltIn ? 2 : 1;
}

/// Price of a metre. It falls towards the middle of a street and rises again in the open and at the town's edge, so
/// that a way neither hugs walls nor leaves the town. Tuned on Périgueux and The Hague.
double price(const DistanceMap& map, size_t cell) {
  constexpr double kHug = 2.5, kOpen = 7, kMostOpen = 10, kEdge = 3;
  const double d = static_cast<double>(map.distance[cell]);
  const double open = std::clamp((d - kOpen) / kOpen, 0.0, kMostOpen);
  const double edge = kEdge * std::max(0.0, kBuiltIn - enclosureAt(map, cell)) / kBuiltIn;
  return 1 + (kHug / d) * (kHug / d) + open * open + edge;
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
      const double reached = cost + length * price(map, n);
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
      if (worth(map, cell) == 2) ++street;
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

/// The cell that is dearest to reach among those that are worth most.
uint32_t farthest(const DistanceMap& map, const Cheapest& ways, uint32_t start) {
  uint32_t best = start;
  int most = -1;
  for (uint32_t cell = 0; cell < ways.cost.size(); ++cell) {
    if (!std::isfinite(ways.cost[cell])) continue;
    const int w = worth(map, cell);
    if (w > most || (w == most && ways.cost[cell] > ways.cost[best])) best = cell, most = w;
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

void findEnclosure(DistanceMap& map) {
  constexpr int kDirections = 16, kBlock = 4;  // one answer for a block of 4 × 4 cells: a few metres
  constexpr double kReach = 40;                // metres
  map.enclosure.assign(map.distance.size(), 0);
  const auto cellAt = [&](glm::dvec2 p) { return glm::ivec2(glm::floor((p - map.origin) / map.cell + 0.5)); };
  const auto inside = [&](glm::ivec2 c) { return c.x >= 0 && c.y >= 0 && c.x < map.size.x && c.y < map.size.y; };
  // Steps along a direction as far as nothing can stand in the way.
  const auto meets = [&](glm::dvec2 from, glm::dvec2 direction) {
    for (double t = 0; t < kReach;) {
      const glm::ivec2 c = cellAt(from + t * direction);
      if (!inside(c)) return false;
      const double d = static_cast<double>(map.distance[map.index(c)]);
      if (d < map.cell) return true;
      t += std::max(d - map.cell, map.cell);
    }
    return false;
  };
  for (int row = 0; row < map.size.y; row += kBlock)
    for (int column = 0; column < map.size.x; column += kBlock) {
      const glm::ivec2 middle = glm::min(glm::ivec2(column, row) + kBlock / 2, map.size - 1);
      int met = 0;
      for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / kDirections;
        met += meets(map.centre(middle), {std::cos(angle), std::sin(angle)});
      }
      for (int y = row; y < std::min(row + kBlock, map.size.y); ++y)
        for (int x = column; x < std::min(column + kBlock, map.size.x); ++x)
          map.enclosure[map.index({x, y})] = static_cast<float>(met) / kDirections;
    }
}

DistanceMap distanceToFootprints(const city::City& city, glm::dvec2 centre, double halfSide, double cell) {
  DistanceMap map;
  map.cell = cell;
  map.size = glm::ivec2(1 + static_cast<int>(std::ceil(2 * halfSide / cell)));
  map.origin = centre - 0.5 * cell * glm::dvec2(map.size - 1);
  std::vector<uint8_t> occupied(static_cast<size_t>(map.size.x) * static_cast<size_t>(map.size.y), 0);
  for (const uint32_t i : walking::instancesWithin(city.buildings, centre, halfSide + cell))
    rasterise(walking::footprintOf(city, city.buildings.instances[i]), map, occupied);
  map.distance = distanceTransform(occupied, map.size);
  for (float& d : map.distance) d *= static_cast<float>(cell);
  findEnclosure(map);
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
