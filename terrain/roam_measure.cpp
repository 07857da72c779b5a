/// What the mesh says of itself: heights, errors, and whether its links hold.
#include "terrain/roam_impl.hpp"

#include <algorithm>

namespace vicus::terrain {

std::optional<double> Roam::Impl::heightWithin(uint32_t d, uint32_t first, uint32_t count, const glm::dvec2& at) const {
  const Diamond* here = &diamonds[d];
  while (true) {
    // Of triangles around one point, that which has the place farthest inside.
    std::optional<uint32_t> best;
    double most = 0;
    glm::dvec3 bestWeights(0);
    const auto consider = [&](uint32_t id) {
      const glm::dvec3 weights = weightsIn(id, at);
      const double least = std::min({weights.x, weights.y, weights.z});
      if (best && !(least > most)) return;
      best = id, most = least, bestWeights = weights;
    };
    if (here->split)
      for (uint32_t k = 0; k < 4; ++k) {
        if (here->child[k] != kNone) consider(2 * here->child[k] + sideToward(here->child[k], d));
      }
    else
      for (uint32_t s = first; s < first + count; ++s) consider(2 * d + s);
    if (!best) return std::nullopt;
    if (here->split) {
      d = *best >> 1, first = *best & 1, count = 1;
      here = &diamonds[d];
      if (here->split) continue;
    }
    if (!side(*best).ground) return std::nullopt;
    const auto vertices = verticesOf(diamonds[*best >> 1], *best & 1);
    double height = 0;
    for (int i = 0; i < 3; ++i)
      height += bestWeights[i] * static_cast<double>(mesh->vertices[vertices[static_cast<size_t>(i)]].height);
    return height;
  }
}

glm::dvec3 Roam::Impl::weightsIn(uint32_t id, const glm::dvec2& at) const {
  const auto places = cornersOf(diamonds[id >> 1], id & 1);
  const glm::dvec2 a(sampleAt(places[0])), b(sampleAt(places[1])), p(sampleAt(places[2]));
  const auto cross = [](const glm::dvec2& u, const glm::dvec2& v) { return u.x * v.y - u.y * v.x; };
  const double area = cross(b - a, p - a);
  if (area == 0) return glm::dvec3(-1e300);
  return glm::dvec3(cross(b - at, p - at), cross(p - at, a - at), cross(a - at, b - at)) / area;
}

std::string Roam::Impl::broken() const {
  const auto name = [](uint32_t id) {
    return "side " + std::to_string(id & 1) + " of diamond " + std::to_string(id >> 1);
  };
  size_t leaves = 0, inQueues = 0, inFrustum = 0;
  for (uint32_t d = 0; d < diamonds.size(); ++d) {
    const Diamond& here = diamonds[d];
    if (here.marked) return "diamond " + std::to_string(d) + " is still marked";
    if (here.split && started) {
      const float needed = eye.band < 1 ? weightNeeded(d) : 1;
      if (here.weight != needed) return "diamond " + std::to_string(d) + " has another weight than it needs";
      if (mesh->vertices[vertexOf(d)].height != morphedHeight(d))
        return "the centre of diamond " + std::to_string(d) + " is not at its height";
    }
    uint32_t splitChildren = 0;
    for (uint32_t k = 0; k < 4; ++k) {
      if (here.child[k] == kNone) continue;
      if (!here.split) return "diamond " + std::to_string(d) + " is not split and has a child";
      splitChildren += diamonds[here.child[k]].split;
      const Side& t = side(2 * here.child[k] + sideToward(here.child[k], d));
      if (!t.present || t.childIndex != k) return "a child of diamond " + std::to_string(d) + " does not lead back";
    }
    if (splitChildren != here.splitChildren) return "diamond " + std::to_string(d) + " miscounts its split children";
    for (uint32_t s = 0; s < 2; ++s) {
      const uint32_t id = 2 * d + s;
      const Side& t = here.side[s];
      if (!t.present) {
        if (here.split && missingParent(here, s).diamond != kNone) return name(id) + " is missing under a split";
        continue;
      }
      if (!isRoot(d) && (here.parent[s] == kNone || !diamonds[here.parent[s]].split))
        return name(id) + " has no split parent";
      if (t.wanted && !here.split) return name(id) + " is wanted and not split";
      const bool leaf = started && !here.split && t.ground;
      if (leaf != (t.slot != kNone)) return name(id) + (leaf ? " is not drawn" : " is drawn");
      leaves += leaf;
      inFrustum += leaf && t.planes != kOutside;
      if (leaf && drawn[t.slot].owner != id) return name(id) + " does not own its slot";
      if (leaf && mesh->triangles[t.slot] != verticesOf(here, s)) return name(id) + " has other vertices in its slot";
      inQueues += t.wanted || t.bucket > 0;
    }
    if (!here.split) continue;
    if (here.reason < kBecauseOfChild ? !here.side[here.reason].wanted
                                      : here.child[here.reason - kBecauseOfChild] == kNone ||
                                            !diamonds[here.child[here.reason - kBecauseOfChild]].split)
      return "diamond " + std::to_string(d) + " is split for a reason that does not hold";
    size_t steps = 0;
    for (uint32_t at = d; at != kNone; at = reasonOf(diamonds[at]))
      if (++steps > diamonds.size()) return "diamond " + std::to_string(d) + " rests on itself";
  }
  size_t queued = 0;
  for (uint32_t b = 0; b < 256; ++b)
    for (const bool wanted : {false, true})
      for (uint32_t id = (wanted ? standing : wanting).first(b); id != BucketQueue::kEnd; id = side(id).queue.next) {
        if (++queued > inQueues || !side(id).present || side(id).wanted != wanted || side(id).bucket != b)
          return name(id) + " is in a queue that it does not belong to";
      }
  if (queued != inQueues) return "the queues hold sides that are gone";
  if (leaves != drawn.size() || leaves != mesh->triangles.size())
    return "the index buffer holds triangles that are gone";
  if (inFrustum != visible) return "triangles in the frustum are miscounted";
  return {};
}

RoamErrors Roam::errors() const {
  const Impl& roam = *impl_;
  RoamErrors errors;
  double area = 0, metresSquared = 0, pixelsSquared = 0;
  Batch batch;
  for (size_t i = 0; i < roam.drawn.size(); ++i) {
    const uint32_t id = roam.drawn[i].owner;
    if (roam.side(id).planes != kOutside) {
      roam.addToBatch(batch, id);
      batch.error[batch.count - 1] += roam.displacement(id);
    }
    if (batch.count < Batch::kLanes && i + 1 < roam.drawn.size()) continue;
    const Batch::Lanes ratios = roam.ratiosOf(batch);
    for (size_t l = 0; l < batch.count; ++l) {
      const auto metres = static_cast<double>(batch.error[l]);
      const double pixels =
          metres > 0 ? std::min(static_cast<double>(ratios[l]) * roam.eye.pixelsPerRatio, roam.statedPixels) : 0;
      const double abx = static_cast<double>(batch.b[0][l] - batch.a[0][l]),
                   aby = static_cast<double>(batch.b[1][l] - batch.a[1][l]);
      const double apx = static_cast<double>(batch.apex[0][l] - batch.a[0][l]),
                   apy = static_cast<double>(batch.apex[1][l] - batch.a[1][l]);
      const double weight = std::abs(abx * apy - aby * apx);
      area += weight;
      metresSquared += weight * metres * metres;
      pixelsSquared += weight * pixels * pixels;
      errors.largestMetres = std::max(errors.largestMetres, metres);
      errors.largestPixels = std::max(errors.largestPixels, pixels);
    }
    batch.count = 0;
  }
  if (area > 0) {
    errors.rmsMetres = std::sqrt(metresSquared / area);
    errors.rmsPixels = std::sqrt(pixelsSquared / area);
  }
  return errors;
}

std::optional<double> Roam::heightAt(double x, double y) const {
  const Impl& roam = *impl_;
  if (roam.patches.empty() || !std::isfinite(x) || !std::isfinite(y)) return std::nullopt;
  const glm::dvec2 at = (glm::dvec2(x, y) - roam.field->origin) / roam.field->spacing;
  if (at.x < 0 || at.y < 0 || at.x > roam.patches.cells.x || at.y > roam.patches.cells.y) return std::nullopt;
  const glm::ivec2 patch = glm::min(glm::ivec2(at) / roam.patches.side, roam.patches.count - 1);
  return roam.heightWithin(static_cast<uint32_t>(patch.y * roam.patches.count.x + patch.x), 0, 2, at);
}

}  // namespace vicus::terrain
