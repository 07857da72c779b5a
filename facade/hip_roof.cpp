// Roof over a straight skeleton (Laycock and Day 2003): a hip that is a triangle becomes a gable when its tip moves
// along the ridge into the wall's plane; the slopes on both sides stay in their planes.
#include "facade/hip_roof.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::facade {
namespace {

using glm::dvec2;
using glm::dvec3;

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// The ridge's foot on the wall where the tip of a triangular hip goes, with its height over the eaves (as a distance);
/// nothing where it would leave the wall's middle or grow too high.
std::optional<dvec3> gableTip(const Ring& ring, uint32_t edge) {
  const size_t n = ring.size();
  const dvec2 a = ring[edge], b = ring[(edge + 1) % n];
  const dvec2 before = glm::normalize(a - ring[(edge + n - 1) % n]), after = glm::normalize(ring[(edge + 2) % n] - b);
  const dvec2 along = glm::normalize(b - a);
  // Distances to the neighbouring eaves grow from both ends of the wall; the tip is where they are equal.
  const double fromA = cross(before, along), fromB = cross(along, after);
  const double sum = fromA + fromB, length = glm::length(b - a);
  if (!(fromA > 0.3 && fromB > 0.3)) return std::nullopt;
  const double s = length * fromB / sum;
  if (s < 0.2 * length || s > 0.8 * length) return std::nullopt;
  return dvec3(a + s * along, s * fromA);
}

}  // namespace

std::optional<HipRoof> hipRoof(std::span<const Ring> rings, std::span<const std::vector<uint8_t>> gables,
                               double tangent, double highest) {
  std::optional<Skeleton> skeleton = straightSkeleton(rings);
  if (!skeleton) return std::nullopt;
  std::vector<SkeletonFace>& faces = skeleton->faces;
  std::vector<uint8_t> upright(faces.size(), 0);
  for (size_t f = 0, first = 0; f < faces.size(); ++f) {
    SkeletonFace& face = faces[f];
    if (face.edge == 0) first = f;
    if (!gables[face.ring][face.edge] || face.polygon.size() != 3) continue;
    const size_t n = rings[face.ring].size();
    SkeletonFace& before = faces[first + (face.edge + n - 1) % n];
    SkeletonFace& after = faces[first + (face.edge + 1) % n];
    // The tip must belong to these three alone: elsewhere the ridge bends there.
    const dvec3 tip = face.polygon[2];
    const auto isTip = [&](const dvec3& p) { return glm::length(p - tip) < 1e-6; };
    size_t holders = 0;
    for (const SkeletonFace& other : faces)
      holders += static_cast<size_t>(std::count_if(other.polygon.begin(), other.polygon.end(), isTip));
    if (holders != 3 || n < 4 || before.polygon.size() < 4 || after.polygon.size() < 4) continue;
    const auto moved = gableTip(rings[face.ring], face.edge);
    if (!moved || moved->z > 1.6 * skeleton->reach) continue;
    for (SkeletonFace* shared : {&face, &before, &after})
      for (dvec3& p : shared->polygon)
        if (isTip(p)) p = *moved;
    upright[f] = 1;
  }

  double reach = 0;
  for (const SkeletonFace& face : faces)
    for (const dvec3& p : face.polygon) reach = std::max(reach, p.z);
  const double rise = reach > 0 ? std::min(tangent, highest / reach) : 0;
  HipRoof roof;
  roof.height = rise * reach;
  roof.reach = reach;
  for (size_t f = 0; f < faces.size(); ++f) {
    RoofPiece piece{faces[f].ring, faces[f].edge, upright[f] != 0, std::move(faces[f].polygon)};
    for (dvec3& p : piece.polygon) p.z *= rise;
    roof.pieces.push_back(std::move(piece));
  }
  return roof;
}

}  // namespace vicus::facade
