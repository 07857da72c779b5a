#include "city/instance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vicus::city {
namespace {

uint32_t spreadBits(uint32_t v) {
  v = (v | v << 8) & 0x00ff00ffU;
  v = (v | v << 4) & 0x0f0f0f0fU;
  v = (v | v << 2) & 0x33333333U;
  return (v | v << 1) & 0x55555555U;
}

uint32_t gatherBits(uint32_t v) {
  v &= 0x55555555U;
  v = (v | v >> 1) & 0x33333333U;
  v = (v | v >> 2) & 0x0f0f0f0fU;
  v = (v | v >> 4) & 0x00ff00ffU;
  return (v | v >> 8) & 0x0000ffffU;
}

/// Cell of a grid of `cells` to a side at t (0 … 1 within the grid); outside and NaN clamp.
uint32_t cellOf(double t, uint32_t cells) {
  const double c = std::floor(t * cells);
  if (!(c > 0)) return 0;
  return static_cast<uint32_t>(std::min(c, static_cast<double>(cells - 1)));
}

/// Morton index at the finest level: 16 bits a side, the top bits being the tile's.
uint32_t fineIndex(const TileGrid& grid, const glm::dvec3& p) {
  constexpr uint32_t kCells = 1u << 16;
  const double side = grid.tileSize * grid.size;
  return mortonIndex(cellOf((p.x - grid.origin.x) / side, kCells), cellOf((p.y - grid.origin.y) / side, kCells));
}

/// Recursively splits the run [first, end) of sorted Morton keys by the two bits below `shift`.
class TreeBuilder {
 public:
  TreeBuilder(InstanceSet& set, const std::vector<uint32_t>& keys, uint32_t leafSize)
      : set_(set), keys_(keys), leafSize_(std::max(leafSize, 1u)) {}

  void build() {
    if (set_.instances.empty()) return;
    set_.nodes.emplace_back();
    fill(0, {0, static_cast<uint32_t>(set_.instances.size())}, 32);
  }

 private:
  void fill(size_t index, Range run, int shift) {
    set_.nodes[index].instances = run;
    Range quadrants[4];
    int used = 0;
    // Skip levels at which everything falls into one quadrant: they would only add tests.
    while (run.count > leafSize_ && shift > 0 && used < 2) {
      shift -= 2;
      used = split(run, shift, quadrants);
    }
    if (used < 2) {  // a leaf: few enough instances, or all at one place
      Aabbf box;
      for (uint32_t i = run.first; i < run.end(); ++i) box.extend(set_.bounds[i]);
      set_.nodes[index].bounds = box;
      return;
    }
    const size_t firstChild = set_.nodes.size();
    set_.nodes[index].firstChild = static_cast<uint32_t>(firstChild);
    set_.nodes[index].childCount = static_cast<uint32_t>(used);
    set_.nodes.resize(firstChild + static_cast<size_t>(used));
    Aabbf box;
    for (int q = 0; q < used; ++q) {
      const size_t child = firstChild + static_cast<size_t>(q);
      fill(child, quadrants[q], shift);
      box.extend(set_.nodes[child].bounds);
    }
    set_.nodes[index].bounds = box;
  }

  int split(Range run, int shift, Range (&out)[4]) const {
    int used = 0;
    uint32_t from = run.first;
    while (from < run.end()) {
      const uint32_t quadrant = keys_[from] >> shift;
      uint32_t to = from;
      while (to < run.end() && keys_[to] >> shift == quadrant) ++to;
      out[used++] = {from, to - from};
      from = to;
    }
    return used;
  }

  InstanceSet& set_;
  const std::vector<uint32_t>& keys_;
  uint32_t leafSize_;
};

}  // namespace

uint32_t mortonIndex(uint32_t column, uint32_t row) {
  return spreadBits(column) | spreadBits(row) << 1;
}

uint32_t TileGrid::tileAt(double x, double y) const {
  const double side = tileSize * size;
  return mortonIndex(cellOf((x - origin.x) / side, size), cellOf((y - origin.y) / side, size));
}

glm::uvec2 TileGrid::cell(uint32_t tile) const {
  return {gatherBits(tile), gatherBits(tile >> 1)};
}

glm::dvec2 TileGrid::centre(uint32_t tile) const {
  return origin + tileSize * (glm::dvec2(cell(tile)) + 0.5);
}

TileGrid tileGridFor(const Aabb& extent) {
  TileGrid grid;
  if (extent.empty()) return grid;
  constexpr double kLargestTileOf16 = 128, kSmallestTile = 8;
  const double side = std::max(extent.max.x - extent.min.x, extent.max.y - extent.min.y);
  grid.size = side > 16 * kLargestTileOf16 * (1 + 1e-9) ? 32 : 16;
  // A hair larger than the extent, so that its far edge still falls into the last tile.
  grid.tileSize = std::max(side * (1 + 1e-9) / grid.size, kSmallestTile);
  grid.origin = glm::dvec2(extent.centre()) - 0.5 * grid.tileSize * grid.size;
  return grid;
}

Aabbf instanceBounds(const Instance& instance, const Aabbf& local) {
  if (local.empty()) {
    Aabb point;
    point.extend(instance.position);
    return outward(point);
  }
  const double c = std::cos(static_cast<double>(instance.heading)), s = std::sin(static_cast<double>(instance.heading));
  const glm::dvec3 centre = glm::dvec3(local.min) * 0.5 + glm::dvec3(local.max) * 0.5;
  const glm::dvec3 half = glm::dvec3(local.max) * 0.5 - glm::dvec3(local.min) * 0.5;
  const glm::dvec3 worldCentre =
      instance.position + glm::dvec3(c * centre.x - s * centre.y, s * centre.x + c * centre.y, centre.z);
  // The graphics card turns and adds in float: allow for its rounding, a few units in the last place of the largest
  // term.
  const double slack = 4e-7 * (glm::length(half) + glm::length(centre) + 1);
  const glm::dvec3 worldHalf(std::abs(c) * half.x + std::abs(s) * half.y + slack,
                             std::abs(s) * half.x + std::abs(c) * half.y + slack, half.z + slack);
  return outward({worldCentre - worldHalf, worldCentre + worldHalf});
}

InstanceSet buildInstanceSet(std::vector<Instance> instances, std::span<const Aabbf> geometryBounds,
                             const TileGrid& grid, uint32_t leafSize, size_t* dropped) {
  const auto bad = [&](const Instance& i) {
    return i.geometry >= geometryBounds.size() || !std::isfinite(i.position.x + i.position.y + i.position.z) ||
           !std::isfinite(i.heading);
  };
  const size_t droppedCount = std::erase_if(instances, bad);
  if (dropped) *dropped = droppedCount;

  std::vector<uint32_t> unsortedKeys(instances.size()), order(instances.size());
  for (size_t i = 0; i < instances.size(); ++i) unsortedKeys[i] = fineIndex(grid, instances[i].position);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return unsortedKeys[a] < unsortedKeys[b]; });

  InstanceSet set;
  std::vector<uint32_t> keys;
  set.instances.reserve(instances.size());
  set.bounds.reserve(instances.size());
  keys.reserve(instances.size());
  for (const uint32_t i : order) {
    set.instances.push_back(instances[i]);
    set.bounds.push_back(instanceBounds(instances[i], geometryBounds[instances[i].geometry]));
    keys.push_back(unsortedKeys[i]);
  }
  TreeBuilder(set, keys, leafSize).build();
  return set;
}

std::vector<Range> tileRuns(const InstanceSet& set, const TileGrid& grid) {
  std::vector<Range> runs(grid.tileCount());
  for (uint32_t i = 0; i < set.instances.size(); ++i) {
    const glm::dvec3& p = set.instances[i].position;
    Range& run = runs[grid.tileAt(p.x, p.y)];
    if (run.count == 0) run.first = i;
    ++run.count;
  }
  return runs;
}

}  // namespace vicus::city
