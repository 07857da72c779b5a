/// Geomorphs: vertices move from the coarser mesh to their own height as the error grows.
///
/// Based on: Duchaineau et al. 1997, §6.3, who move vertices with time; here their way follows the projected error, so
/// that the wanted error holds throughout.
#include "terrain/roam_impl.hpp"

#include <algorithm>

namespace vicus::terrain {

void Roam::Impl::morph() {
  for (size_t i = 0; i < reweigh.size(); ++i) {
    const uint32_t d = reweigh[i];
    if (!diamonds[d].split) continue;
    const float weight = eye.band < 1 ? weightNeeded(d) : 1;
    if (weight == diamonds[d].weight) continue;
    diamonds[d].weight = weight;
    for (const uint32_t parent : diamonds[d].parent)
      if (parent != kNone) reweigh.push_back(parent);
    group.clear();
    group.push_back(d);
    while (!group.empty()) {  // a centre's height moves those of the splits around it
      const uint32_t at = group.back();
      group.pop_back();
      if (diamonds[at].marked) continue;
      diamonds[at].marked = true;
      work.push_back(at);
      for (const uint32_t child : diamonds[at].child)
        if (child != kNone && diamonds[child].split && !diamonds[child].marked) group.push_back(child);
    }
  }
  reweigh.clear();
  for (const uint32_t d : work) {
    diamonds[d].marked = false;
    const float height = morphedHeight(d);
    RoamMesh::Vertex& vertex = mesh->vertices[vertexOf(d)];
    if (height == vertex.height) continue;
    vertex.height = height;
    touchedVertices.push_back(vertexOf(d));
    ++operations.morphs;
  }
  work.clear();
}

float Roam::Impl::weightNeeded(uint32_t d) const {
  const Diamond& here = diamonds[d];
  if (here.pressed) return 1;  // its triangles' places in samples are not halved where they are pressed together
  float weight = 0;
  for (const Side& t : here.side)
    if (t.present) weight = std::max(weight, t.weight);
  if (here.splitChildren > 0)
    for (const uint32_t child : here.child)
      if (child != kNone && diamonds[child].split) weight = std::max(weight, diamonds[child].weight);
  return weight;
}

float Roam::Impl::morphedHeight(uint32_t d) const {
  const Diamond& here = diamonds[d];
  const float own = vertexHeights[vertexOf(d)];
  float below = here.weight;
  if (below >= 1) return own;
  float height = below * own;
  uint32_t id = 2 * d + (here.side[0].present ? 0U : 1U);
  while (below < 1) {
    const uint32_t parent = diamonds[id >> 1].parent[id & 1];
    const float above = parent == kNone ? 1 : std::max(diamonds[parent].weight, below);
    if (above > below) height += (above - below) * heightInTriangle(id, here.centre);
    below = above;
    if (parent == kNone) break;
    id = 2 * parent + (side(id).childIndex >> 1);
  }
  return height;
}

float Roam::Impl::displacement(uint32_t id) const {
  float most = 0;
  for (const uint32_t v : verticesOf(diamonds[id >> 1], id & 1))
    most = std::max(most, std::abs(mesh->vertices[v].height - vertexHeights[v]));
  return most;
}

float Roam::Impl::heightInTriangle(uint32_t id, glm::ivec2 at) const {
  const Diamond& d = diamonds[id >> 1];
  const auto places = cornersOf(d, id & 1);
  const auto vertices = verticesOf(d, id & 1);
  const float za = vertexHeights[vertices[0]], zb = vertexHeights[vertices[1]], zp = vertexHeights[vertices[2]];
  const glm::vec2 ab(places[1] - places[0]), fromMiddle(at - d.centre), up(places[2] - d.centre);
  const float along = glm::dot(fromMiddle, ab) / glm::dot(ab, ab), rise = glm::dot(fromMiddle, up) / glm::dot(up, up);
  const float middle = (za + zb) / 2;
  return middle + along * (zb - za) + rise * (zp - middle);
}

}  // namespace vicus::terrain
