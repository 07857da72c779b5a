#include "city/watertight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace vicus::city {
namespace {

using Corner = uint32_t;  ///< index of a welded position

/// Positions, each once.
class Weld {
 public:
  /// The corner at or within `kWeldDistance` of p, a new one where there is none.
  Corner at(glm::vec3 p) {
    // Most buildings have few corners: looking at each costs less than looking into 27 cells.
    if (positions.size() <= kFew) {
      for (size_t i = 0; i < positions.size(); ++i)
        if (glm::distance(positions[i], p) <= kWeldDistance) return static_cast<Corner>(i);
      positions.push_back(p);
      if (positions.size() > kFew)
        for (size_t i = 0; i < positions.size(); ++i)
          cells_.emplace(keyOf(glm::ivec3(glm::floor(positions[i] / kCell))), static_cast<Corner>(i));
      return static_cast<Corner>(positions.size() - 1);
    }
    const glm::ivec3 cell(glm::floor(p / kCell));
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto [first, end] = cells_.equal_range(keyOf(cell + glm::ivec3(x, y, z)));
          for (auto it = first; it != end; ++it)
            if (glm::distance(positions[it->second], p) <= kWeldDistance) return it->second;
        }
    const auto corner = static_cast<Corner>(positions.size());
    positions.push_back(p);
    cells_.emplace(keyOf(cell), corner);
    return corner;
  }

  std::vector<glm::vec3> positions;

 private:
  static constexpr float kCell = 2 * kWeldDistance;
  static constexpr size_t kFew = 96;
  static uint64_t keyOf(glm::ivec3 cell) {
    const auto part = [](int v) { return static_cast<uint64_t>(static_cast<uint32_t>(v)) & 0x1fffffU; };
    return part(cell.x) | part(cell.y) << 21U | part(cell.z) << 42U;
  }
  std::unordered_multimap<uint64_t, Corner> cells_;
};

uint64_t edgeKey(Corner a, Corner b) {
  return static_cast<uint64_t>(a) << 32U | b;
}

/// Corners by their place along each axis: finds those near an edge.
class CornersByAxis {
 public:
  CornersByAxis(std::span<const glm::vec3> positions, const std::vector<Corner>& corners) : positions_(positions) {
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      auto& sorted = sorted_[static_cast<size_t>(axis)];
      sorted = corners;
      std::sort(sorted.begin(), sorted.end(), [&](Corner a, Corner b) {
        return std::pair(positions_[a][axis], a) < std::pair(positions_[b][axis], b);
      });
    }
  }

  /// Corners on a → b but not at its ends, from a on.
  std::vector<Corner> on(Corner a, Corner b) const {
    const glm::vec3 from = positions_[a], along = positions_[b] - from;
    const float length2 = glm::dot(along, along);
    std::span<const Corner> fewest;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
      const auto& sorted = sorted_[static_cast<size_t>(axis)];
      const float low = std::min(from[axis], positions_[b][axis]) - kWeldDistance;
      const float high = std::max(from[axis], positions_[b][axis]) + kWeldDistance;
      const auto first =
          std::partition_point(sorted.begin(), sorted.end(), [&](Corner c) { return positions_[c][axis] < low; });
      const auto end = std::partition_point(first, sorted.end(), [&](Corner c) { return positions_[c][axis] <= high; });
      if (axis == 0 || static_cast<size_t>(end - first) < fewest.size()) fewest = {first, end};
    }
    std::vector<std::pair<float, Corner>> found;
    for (const Corner c : fewest) {
      if (c == a || c == b) continue;
      const float t = glm::dot(positions_[c] - from, along) / length2;
      if (t > 0 && t < 1 && glm::distance(from + t * along, positions_[c]) <= kWeldDistance) found.emplace_back(t, c);
    }
    std::sort(found.begin(), found.end());
    std::vector<Corner> out;
    for (const auto& [t, c] : found) out.push_back(c);
    return out;
  }

 private:
  std::span<const glm::vec3> positions_;
  std::array<std::vector<Corner>, 3> sorted_;
};

/// The vertex at `corner` on the edge from a to b.
Vertex between(const Vertex& a, const Vertex& b, glm::vec3 position) {
  const glm::vec3 along = b.position - a.position;
  const float t = glm::dot(position - a.position, along) / glm::dot(along, along);
  Vertex v = a;
  v.position = position;
  v.uv = glm::mix(a.uv, b.uv, t);
  return v;
}

/// Whether the triangle turns the way that its first vertex's normal says: others are not drawn from outside.
bool facesOut(const std::vector<Vertex>& vertices, uint32_t a, uint32_t b, uint32_t c) {
  const glm::vec3 p = vertices[a].position;
  return glm::dot(glm::cross(vertices[b].position - p, vertices[c].position - p), unpackNormal(vertices[a].normal)) > 0;
}

/// Triangle a b c whose edges pass through further vertices, cut at the first of them, and its parts likewise.
void split(std::vector<uint32_t>& out, const std::array<uint32_t, 3>& corners,
           const std::array<std::vector<uint32_t>, 3>& on) {
  for (size_t e = 0; e < 3; ++e) {
    if (on[e].empty()) continue;
    const size_t f = (e + 1) % 3, g = (e + 2) % 3;
    const size_t middle = on[e].size() / 2;
    const uint32_t p = on[e][middle];
    const auto at = on[e].begin() + static_cast<std::ptrdiff_t>(middle);
    split(out, {corners[e], p, corners[g]}, {std::vector(on[e].begin(), at), {}, on[g]});
    split(out, {p, corners[f], corners[g]}, {std::vector(at + 1, on[e].end()), on[f], {}});
    return;
  }
  out.insert(out.end(), corners.begin(), corners.end());
}

}  // namespace

size_t makeWatertight(std::vector<Vertex>& vertices, std::span<std::vector<uint32_t>* const> surfaces) {
  // What faces out now must not be turned over by half a millimetre: then it is a sliver, and is left out.
  std::vector<std::vector<bool>> facedOut;
  for (const std::vector<uint32_t>* surface : surfaces) {
    std::vector<bool>& faced = facedOut.emplace_back();
    for (size_t i = 0; i + 2 < surface->size(); i += 3)
      faced.push_back(facesOut(vertices, (*surface)[i], (*surface)[i + 1], (*surface)[i + 2]));
  }

  Weld weld;
  std::vector<Corner> cornerOf(vertices.size());
  std::vector<bool> welded(vertices.size(), false);
  std::unordered_map<uint64_t, uint32_t> edges;
  size_t indices = 0;
  for (const std::vector<uint32_t>* surface : surfaces) indices += surface->size();
  edges.reserve(indices);
  for (size_t s = 0; s < surfaces.size(); ++s) {
    std::vector<uint32_t>* const surface = surfaces[s];
    std::vector<uint32_t> kept;
    std::vector<bool> keptFaced;
    kept.reserve(surface->size());
    for (size_t i = 0; i + 2 < surface->size(); i += 3) {
      std::array<Corner, 3> c{};
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t v = (*surface)[i + k];
        if (!welded[v]) {
          welded[v] = true;
          cornerOf[v] = weld.at(vertices[v].position);
          vertices[v].position = weld.positions[cornerOf[v]];
        }
        c[k] = cornerOf[v];
      }
      if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
      kept.insert(kept.end(), surface->begin() + static_cast<std::ptrdiff_t>(i),
                  surface->begin() + static_cast<std::ptrdiff_t>(i + 3));
      keptFaced.push_back(facedOut[s][i / 3]);
      for (size_t k = 0; k < 3; ++k) ++edges[edgeKey(c[k], c[(k + 1) % 3])];
    }
    *surface = std::move(kept);
    facedOut[s] = std::move(keptFaced);
  }

  // Only where an edge has no neighbour of its own can a corner of somebody else's lie on it.
  const auto open = [&](Corner a, Corner b) {
    const auto opposite = edges.find(edgeKey(b, a));
    return opposite == edges.end() || opposite->second < edges.at(edgeKey(a, b));
  };
  std::vector<bool> isBorder(weld.positions.size(), false);
  std::vector<Corner> border;
  for (const auto& [key, count] : edges) {
    const auto a = static_cast<Corner>(key >> 32U), b = static_cast<Corner>(key);
    if (!open(a, b)) continue;
    isBorder[a] = isBorder[b] = true;
  }
  for (Corner c = 0; c < isBorder.size(); ++c)
    if (isBorder[c]) border.push_back(c);
  const CornersByAxis near(weld.positions, border);

  size_t splits = 0;
  for (size_t s = 0; s < surfaces.size(); ++s) {
    std::vector<uint32_t>* const surface = surfaces[s];
    std::vector<uint32_t> out;
    out.reserve(surface->size());
    for (size_t i = 0; i + 2 < surface->size(); i += 3) {
      const std::array<uint32_t, 3> triangle = {(*surface)[i], (*surface)[i + 1], (*surface)[i + 2]};
      std::array<std::vector<uint32_t>, 3> on;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t from = triangle[k], to = triangle[(k + 1) % 3], beside = triangle[(k + 2) % 3];
        if (!open(cornerOf[from], cornerOf[to])) continue;
        for (const Corner c : near.on(cornerOf[from], cornerOf[to])) {
          if (c == cornerOf[beside]) continue;  // a sliver's own third corner
          on[k].push_back(static_cast<uint32_t>(vertices.size()));
          vertices.push_back(between(vertices[from], vertices[to], weld.positions[c]));
          ++splits;
        }
      }
      const size_t before = out.size();
      split(out, triangle, on);
      if (!facedOut[s][i / 3]) continue;
      for (size_t t = out.size(); t > before; t -= 3)
        if (!facesOut(vertices, out[t - 3], out[t - 2], out[t - 1])) {
          const auto at = out.begin() + static_cast<std::ptrdiff_t>(t);
          out.erase(at - 3, at);
        }
    }
    *surface = std::move(out);
  }
  return splits;
}

}  // namespace vicus::city
