// Based on: the divergence theorem for the sign of a shell's volume; Newell's normal of a nearly flat polygon
// (Sutherland, Sproull, Schumacker 1974).
#include "assets/import/shells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "assets/import/polygon.hpp"
#include "city/aabb.hpp"

namespace vicus::assets {

glm::dvec3 newell(const std::vector<glm::dvec3>& points, const std::vector<uint32_t>& ring) {
  glm::dvec3 sum(0);
  const glm::dvec3 o = points[ring[0]];
  for (size_t i = 1; i + 1 < ring.size(); ++i) sum += glm::cross(points[ring[i]] - o, points[ring[i + 1]] - o);
  return sum / 2.0;
}

namespace {

/// Surfaces smaller than this cannot be seen: m².
constexpr double kSmallestSurface = 1e-4;
struct PointHash {
  size_t operator()(const glm::dvec3& p) const {
    const std::hash<double> h;
    return (h(p.x) * 31 + h(p.y)) * 0x9e3779b97f4a7c15ULL ^ h(p.z);
  }
};

/// Does a point of the outer ring lie more than 2 cm off the plane through their middle?
bool isBent(const Face& face, const std::vector<glm::dvec3>& points) {
  constexpr double kFlat = 0.02;
  glm::dvec3 middle(0);
  for (const uint32_t i : face.rings[0]) middle += points[i];
  middle /= static_cast<double>(face.rings[0].size());
  return std::any_of(face.rings[0].begin(), face.rings[0].end(),
                     [&](uint32_t i) { return std::abs(glm::dot(points[i] - middle, face.normal)) > kFlat; });
}

}  // namespace

std::vector<Face> facesOf(const SurfaceBuilding& building, std::vector<glm::dvec3>& points, SurfaceReport& report) {
  std::unordered_map<glm::dvec3, uint32_t, PointHash> first;
  std::vector<uint32_t> merged;
  for (const glm::dvec3& p : building.points) {
    const auto [found, isNew] = first.emplace(snapped(p), static_cast<uint32_t>(points.size()));
    if (isNew) points.push_back(snapped(p));
    merged.push_back(found->second);
  }
  std::vector<Face> faces;
  for (const Surface& s : building.surfaces) {
    Face face;
    face.kind = s.kind, face.shell = s.shell, face.material = s.material, face.solid = s.solid;
    const bool textured = !s.uvs.empty();
    for (size_t r = 0; r < s.rings.size(); ++r) {
      const std::vector<uint32_t>& ring = s.rings[r];
      std::vector<uint32_t> kept;
      std::vector<glm::vec2> uvs;
      for (size_t k = 0; k < ring.size(); ++k) {
        if (!kept.empty() && kept.back() == merged[ring[k]]) continue;
        kept.push_back(merged[ring[k]]);
        if (r < s.uvs.size() && k < s.uvs[r].size()) uvs.push_back(s.uvs[r][k]);
      }
      while (kept.size() > 1 && kept.front() == kept.back()) {
        kept.pop_back();
        if (!uvs.empty()) uvs.pop_back();
      }
      if (kept.size() >= 3) {
        face.rings.push_back(std::move(kept));
        if (textured)
          face.uvs.push_back(uvs.size() == face.rings.back().size() ? std::move(uvs) : std::vector<glm::vec2>());
      } else if (face.rings.empty()) {
        break;
      }
    }
    if (!face.rings.empty()) {
      face.areaVector = newell(points, face.rings[0]);
      const double outer = glm::length(face.areaVector);
      if (outer >= kSmallestSurface) {
        face.normal = face.areaVector / outer;
        double holes = 0;
        for (size_t r = 1; r < face.rings.size(); ++r) {
          const glm::dvec3 hole = newell(points, face.rings[r]);
          holes += glm::length(hole);
          // Holes run against their outline, whatever the file does: what adjoins them follows from it.
          if (glm::dot(hole, face.areaVector) <= 0) continue;
          std::reverse(face.rings[r].begin(), face.rings[r].end());
          if (r < face.uvs.size()) std::reverse(face.uvs[r].begin(), face.uvs[r].end());
        }
        face.areaVector = face.normal * std::max(0.0, outer - holes);
        face.bent = isBent(face, points);
        if (face.bent) ++report.bent;
        faces.push_back(std::move(face));
        continue;
      }
    }
    ++report.leftOut;
  }
  return faces;
}

namespace {

void turn(Face& face) {
  for (auto& ring : face.rings) std::reverse(ring.begin(), ring.end());
  for (auto& ring : face.uvs) std::reverse(ring.begin(), ring.end());
  face.areaVector = -face.areaVector, face.normal = -face.normal;
}

}  // namespace

void windOutward(std::vector<Face>& faces, const std::vector<glm::dvec3>& points, SurfaceReport& report) {
  struct Use {
    size_t face;
    bool forward;
  };
  std::map<std::pair<uint32_t, std::pair<uint32_t, uint32_t>>, std::vector<Use>> edges;
  const auto forEachEdge = [](const Face& f, const auto& visit) {
    for (const auto& ring : f.rings)
      for (size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  };
  for (size_t f = 0; f < faces.size(); ++f)
    forEachEdge(faces[f], [&](uint32_t a, uint32_t b) {
      edges[{faces[f].shell, {std::min(a, b), std::max(a, b)}}].push_back({f, a < b});
    });

  std::vector<int> side(faces.size(), 0);  // 0 unseen, 1 as it came, -1 to be turned
  for (size_t seed = 0; seed < faces.size(); ++seed) {
    if (side[seed] != 0) continue;
    std::vector<size_t> component{seed};
    side[seed] = 1;
    bool closed = true;
    for (size_t next = 0; next < component.size(); ++next) {
      const size_t f = component[next];
      forEachEdge(faces[f], [&](uint32_t a, uint32_t b) {
        const auto& uses = edges.at({faces[f].shell, {std::min(a, b), std::max(a, b)}});
        // Where more than two meet, or one face meets itself, nothing follows.
        if (uses.size() != 2 || uses[0].face == uses[1].face) {
          closed = closed && uses.size() != 1;
          return;
        }
        const Use& own = uses[0].face == f ? uses[0] : uses[1];
        const Use& other = uses[0].face == f ? uses[1] : uses[0];
        if (side[other.face] != 0) return;
        side[other.face] = own.forward == other.forward ? -side[f] : side[f];
        component.push_back(other.face);
      });
    }
    city::Aabb box;
    double area = 0;
    for (const size_t f : component) {
      for (const uint32_t i : faces[f].rings[0]) box.extend(points[i]);
      area += glm::length(faces[f].areaVector);
    }
    double volume = 0;
    for (const size_t f : component)
      volume += side[f] * glm::dot(points[faces[f].rings[0][0]] - box.centre(), faces[f].areaVector) / 3;
    // An open sheet encloses nothing; a box without its floor still encloses about a sixth of area × size.
    const double least = closed ? 0 : 0.01 * area * glm::length(box.size());
    if (std::abs(volume) <= least) {
      for (const size_t f : component) {
        side[f] = 1;
        Face& face = faces[f];
        const bool roof = face.kind == SurfaceKind::Roof;
        if (roof && face.normal.z < 0) turn(face);
        face.bothSides = !roof;
      }
      continue;
    }
    if (volume < 0)
      for (const size_t f : component) side[f] = -side[f];
    // What is open at its top is a terrace behind its parapet as often as a tower without a roof: its surfaces, wound
    // outward, sum up to the lid that is missing. Either is seen from within and from without.
    glm::dvec3 sum(0);
    for (const size_t f : component) sum += static_cast<double>(side[f]) * faces[f].areaVector;
    if (!closed && sum.z < -0.01 * area)
      for (const size_t f : component) faces[f].bothSides = true;
  }
  for (size_t f = 0; f < faces.size(); ++f)
    if (side[f] < 0) turn(faces[f]), ++report.turned;
}

}  // namespace vicus::assets
