#include "assets/import/face_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "assets/import/polygon.hpp"

namespace vicus::assets {
namespace {

/// Texture coordinates over a face's plane: those of its own points where they are asked for, else those of the affine
/// map that fits them best.
class TextureMap {
 public:
  /// Pairs of a place in the plane (metres) and its texture coordinate; none: there is no texture.
  TextureMap(std::vector<std::pair<glm::dvec2, glm::vec2>> known) : known_(std::move(known)) {
    // Least squares about the mean: uv = mean + (a, b) · (q − middle).
    for (const auto& [q, uv] : known_) middle_ += q, mean_ += glm::dvec2(uv);
    const auto n = static_cast<double>(std::max<size_t>(known_.size(), 1));
    middle_ /= n, mean_ /= n;
    double xx = 0, xy = 0, yy = 0;
    glm::dvec2 xu(0), yu(0);
    for (const auto& [q, uv] : known_) {
      const glm::dvec2 d = q - middle_, e = glm::dvec2(uv) - mean_;
      xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
      xu += d.x * e, yu += d.y * e;
      at_[{q.x, q.y}] = uv;
    }
    const double det = xx * yy - xy * xy;
    if (std::abs(det) > 1e-12) alongX_ = (yy * xu - xy * yu) / det, alongY_ = (xx * yu - xy * xu) / det;
  }
  bool any() const { return !known_.empty(); }
  glm::vec2 at(glm::dvec2 q) const {
    const auto found = at_.find({q.x, q.y});
    if (found != at_.end()) return found->second;
    return glm::vec2(mean_ + alongX_ * (q.x - middle_.x) + alongY_ * (q.y - middle_.y));
  }

 private:
  std::vector<std::pair<glm::dvec2, glm::vec2>> known_;
  std::map<std::pair<double, double>, glm::vec2> at_;
  glm::dvec2 middle_{0}, mean_{0}, alongX_{0}, alongY_{0};
};

}  // namespace

FaceMesh meshOf(const Face& face, const Axes& axes, const std::vector<glm::dvec3>& points, SurfaceReport& report) {
  const glm::dvec3 o = points[face.rings[0][0]];
  const auto flat = [&](const glm::dvec3& p) { return glm::dvec2(glm::dot(p - o, axes.u), glm::dot(p - o, axes.v)); };
  FaceMesh mesh;
  Polygon polygon;
  std::vector<std::vector<uint32_t>> rings = face.rings;
  std::vector<std::pair<glm::dvec2, glm::vec2>> exactUvs, snappedUvs;
  for (size_t r = 0; r < rings.size(); ++r) {
    Ring ring;
    for (size_t k = 0; k < rings[r].size(); ++k) {
      ring.push_back(flat(points[rings[r][k]]));
      if (r >= face.uvs.size() || face.uvs[r].empty()) continue;
      exactUvs.emplace_back(ring.back(), face.uvs[r][k]);
      snappedUvs.emplace_back(snapped(ring.back()), face.uvs[r][k]);
    }
    if ((signedArea(ring) > 0) != (r == 0)) {
      std::reverse(ring.begin(), ring.end());
      std::reverse(rings[r].begin(), rings[r].end());
    }
    polygon.rings.push_back(std::move(ring));
  }
  const auto lifted = [&](glm::dvec2 q) { return o + axes.u * q.x + axes.v * q.y; };
  if (isPlainlyValid(polygon)) {
    Triangulation cut = triangulate(polygon);
    if (!cut.triangles.empty()) {
      for (const auto& ring : rings)
        for (const uint32_t i : ring) mesh.positions.push_back(points[i]);
      for (size_t i = mesh.positions.size(); i < cut.points.size(); ++i)
        mesh.positions.push_back(lifted(cut.points[i]));
      if (const TextureMap map(std::move(exactUvs)); map.any())
        for (const glm::dvec2& q : cut.points) mesh.uvs.push_back(map.at(q));
      mesh.triangles = std::move(cut.triangles);
      return mesh;
    }
  }

  // Repaired in its plane; points that it had keep their place in space, new ones lie in the plane.
  std::map<std::pair<double, double>, glm::dvec3> known;
  for (const auto& ring : rings)
    for (const uint32_t i : ring) {
      const glm::dvec2 q = snapped(flat(points[i]));
      known.emplace(std::pair(q.x, q.y), points[i]);
    }
  const TextureMap map(std::move(snappedUvs));
  const CleanedPolygons cleaned = cleanPolygon(polygon);
  if (cleaned.repaired) ++report.repaired;
  for (const Polygon& p : cleaned.polygons) {
    const auto base = static_cast<uint32_t>(mesh.positions.size());
    const Triangulation cut = triangulate(p);
    if (cut.triangles.empty()) continue;
    for (const uint32_t t : cut.triangles) mesh.triangles.push_back(base + t);
    for (const glm::dvec2& q : cut.points) {
      const auto found = known.find({q.x, q.y});
      mesh.positions.push_back(found != known.end() ? found->second : lifted(q));
      if (map.any()) mesh.uvs.push_back(map.at(q));
    }
  }
  return mesh;
}

}  // namespace vicus::assets
