#include "terrain/mesh_check.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace vicus::terrain {
namespace {

using Place = glm::ivec2;

int64_t cross(Place u, Place v) {
  return int64_t{u.x} * v.y - int64_t{u.y} * v.x;
}

bool inPicture(const city::ViewState& view, const glm::dvec3& position) {
  const glm::dvec3 p = position - view.eye;
  const double depth = glm::dot(p, view.forward), tanY = std::tan(view.verticalFov / 2);
  return depth >= view.nearDistance && depth <= view.farDistance && std::abs(glm::dot(p, view.up)) <= depth * tanY &&
         std::abs(glm::dot(p, view.right)) <= depth * tanY * view.aspect();
}

/// Calls `visit(column, row, height of the triangle there)` for the samples in a triangle and on its edges.
template <typename Visit>
void forSamples(const std::array<RoamMesh::Vertex, 3>& t, const Visit& visit) {
  const Place a = t[0].sample, b = t[1].sample, c = t[2].sample;
  const auto area = static_cast<double>(cross(b - a, c - a));
  if (area <= 0) return;
  for (int y = std::min({a.y, b.y, c.y}); y <= std::max({a.y, b.y, c.y}); ++y)
    for (int x = std::min({a.x, b.x, c.x}); x <= std::max({a.x, b.x, c.x}); ++x) {
      const Place p(x, y);
      const int64_t wa = cross(b - p, c - p), wb = cross(c - p, a - p), wc = cross(a - p, b - p);
      if (wa < 0 || wb < 0 || wc < 0) continue;
      visit(x, y,
            (static_cast<double>(wa) * static_cast<double>(t[0].height) +
             static_cast<double>(wb) * static_cast<double>(t[1].height) +
             static_cast<double>(wc) * static_cast<double>(t[2].height)) /
                area);
    }
}

}  // namespace

void MeshBuffers::apply(const RoamFrame& frame) {
  assert(held.revision + 1 == frame.revision && "a frame was left out");
  held.revision = frame.revision;
  held.vertices.resize(frame.mesh->vertices.size());
  held.triangles.resize(frame.triangleCount);
  for (const uint32_t slot : frame.changedVertices) held.vertices[slot] = frame.mesh->vertices[slot];
  for (const uint32_t slot : frame.changedTriangles) held.triangles[slot] = frame.mesh->triangles[slot];
}

MeshFaults findFaults(const city::HeightField& field, const RoamMesh& mesh) {
  MeshFaults faults;
  const auto index = [&](Place p) {
    return static_cast<uint64_t>(p.y) * static_cast<uint64_t>(field.size.x) + static_cast<uint64_t>(p.x);
  };
  std::unordered_map<uint64_t, std::unordered_map<uint64_t, uint32_t>> directed;  // from → to → count
  for (const auto& t : mesh.triangles) {
    std::array<Place, 3> p{};
    for (size_t k = 0; k < 3; ++k) {
      const RoamMesh::Vertex& v = mesh.vertices[t[k]];
      p[k] = v.sample;
      const float true_ = field.at(v.sample.x, v.sample.y);
      faults.twisted += std::isfinite(true_) && true_ != v.height;
    }
    const int64_t area = cross(p[1] - p[0], p[2] - p[0]);
    faults.flipped += area <= 0;
    faults.coveredArea += static_cast<double>(area) / 2;
    for (size_t k = 0; k < 3; ++k) faults.cracks += ++directed[index(p[k])][index(p[(k + 1) % 3])] > 1;
  }
  // An edge without a triangle on its other side is the mesh's border: there no vertex may lie between its ends.
  for (const auto& [from, ends] : directed)
    for (const auto& [to, count] : ends) {
      const auto other = directed.find(to);
      if (other != directed.end() && other->second.contains(from)) continue;
      const auto columns = static_cast<uint64_t>(field.size.x);
      const Place a(static_cast<int>(from % columns), static_cast<int>(from / columns));
      const Place b(static_cast<int>(to % columns), static_cast<int>(to / columns));
      const int steps = std::gcd(std::abs(b.x - a.x), std::abs(b.y - a.y));
      for (int i = 1; i < steps; ++i) faults.cracks += directed.contains(index(a + (b - a) / steps * i));
    }
  return faults;
}

MeasuredError measureError(const city::HeightField& field, const RoamMesh& mesh, const city::ViewState* view) {
  MeasuredError result;
  const double scale = view ? city::pixelsPerUnitSlope(*view) : 0;
  std::vector<uint8_t> covered(field.heights.size(), 0);
  double metresSquared = 0, pixelsSquared = 0;
  uint64_t counted = 0, seen = 0;
  for (const auto& t : mesh.triangles) {
    const std::array corners{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    forSamples(corners, [&](int x, int y, double height) {
      const auto ground = static_cast<double>(field.at(x, y));
      if (!std::isfinite(ground)) return;
      covered[static_cast<size_t>(y) * static_cast<size_t>(field.size.x) + static_cast<size_t>(x)] = 1;
      const double metres = std::abs(ground - height);
      result.largestMetres = std::max(result.largestMetres, metres);
      metresSquared += metres * metres;
      ++counted;
      if (!view) return;
      const glm::dvec2 place = field.origin + field.spacing * glm::dvec2(x, y);
      if (!inPicture(*view, glm::dvec3(place, ground)) && !inPicture(*view, glm::dvec3(place, height))) return;
      const double pixels = metres == 0 ? 0 : metres * scale / glm::length(glm::dvec3(place, height) - view->eye);
      result.largestPixels = std::max(result.largestPixels, pixels);
      pixelsSquared += pixels * pixels;
      ++seen;
    });
  }
  if (counted > 0) result.rmsMetres = std::sqrt(metresSquared / static_cast<double>(counted));
  if (seen > 0) result.rmsPixels = std::sqrt(pixelsSquared / static_cast<double>(seen));

  // A sample belongs to ground where one of the full-detail triangles around it has data at all corners.
  const auto finite = [&](int x, int y) { return std::isfinite(field.at(x, y)); };
  std::vector<uint8_t> ground(field.heights.size(), 0);
  const auto add = [&](Place a, Place b, Place c) {
    if (!finite(a.x, a.y) || !finite(b.x, b.y) || !finite(c.x, c.y)) return;
    for (const Place p : {a, b, c})
      ground[static_cast<size_t>(p.y) * static_cast<size_t>(field.size.x) + static_cast<size_t>(p.x)] = 1;
  };
  for (int y = 0; y + 1 < field.size.y; ++y)
    for (int x = 0; x + 1 < field.size.x; ++x) {
      const Place sw(x, y), se(x + 1, y), nw(x, y + 1), ne(x + 1, y + 1);
      if ((x + y) % 2 == 0)
        add(sw, se, ne), add(sw, ne, nw);
      else
        add(sw, se, nw), add(se, ne, nw);
    }
  for (size_t i = 0; i < ground.size(); ++i) {
    result.samples += ground[i];
    result.uncovered += ground[i] != 0 && covered[i] == 0;
  }
  return result;
}

}  // namespace vicus::terrain
