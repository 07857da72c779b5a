/// Priorities and the frustum, and when they have to be looked at again.
///
/// Based on: Duchaineau et al. 1997, §6 (priority queues, frustum culling down the tree, deferral).
#include "terrain/roam_impl.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace vicus::terrain {

void Roam::Impl::evaluate(Batch& batch) {
  Batch::Lanes distances{}, reaches{}, ratios{};
  if (eye.perspective)
    distances = distancesSquared(batch);
  else
    distances.fill(1);
  for (size_t l = 0; l < Batch::kLanes; ++l) {
    reaches[l] = batch.error[l] * batch.error[l] * eye.scaleSquared;
    ratios[l] = reaches[l] / distances[l];
    reaches[l] = std::sqrt(reaches[l]);
    distances[l] = std::sqrt(distances[l]);
  }
  for (size_t l = 0; l < batch.count; ++l) {
    const uint32_t id = batch.side[l];
    Side& t = side(id);
    setWeight(id, t, weightOf(reaches[l], distances[l]));
    const uint32_t bucket = bucketOf(ratios[l]);
    if (bucket != t.bucket) setBucket(id, t, bucket);
    ++t.stamp;
    if (eye.perspective) deferral.put(id, t.stamp, path, slackOf(ratios[l], bucket, distances[l], reaches[l]));
  }
  operations.evaluations += static_cast<uint32_t>(batch.count);
  batch.count = 0;
}

float Roam::Impl::slackOf(float ratioSquared, uint32_t bucket, float distance, float reach) const {
  if (bucket == 0) return distance - reach;
  if (eye.band < 1) {  // below the band it rests; within it, until the weight is a step on
    const float complete = reach * eye.band;
    const float step = kWeightStep * distance * distance * (1 - eye.band) / complete;
    return std::min(distance <= complete ? complete - distance : step, slackInOrder(ratioSquared, bucket, distance));
  }
  return std::min(reach - distance, slackInOrder(ratioSquared, bucket, distance));
}

float Roam::Impl::slackInOrder(float ratioSquared, uint32_t bucket, float distance) const {
  if (!ordered) return std::numeric_limits<float>::infinity();
  const float farther = distance * (std::sqrt(ratioSquared / bucketFloor(bucket)) - 1);
  if (bucket == kLastBucket) return farther;
  const float nearer = distance * (1 - std::sqrt(ratioSquared / bucketFloor(bucket + 1)));
  return std::min(farther, nearer);
}

void Roam::Impl::look(Batch& batch, uint32_t id) {
  Side& t = side(id);
  if (idle(t)) {
    ++t.stamp;
    setWeight(id, t, 0);
    if (t.bucket != 0) setBucket(id, t, 0);
    return;
  }
  addToBatch(batch, id);
  if (batch.count == Batch::kLanes) evaluate(batch);
}

void Roam::Impl::lookAtAll() {
  deferral.clear();
  Batch batch;
  for (uint32_t d = 0; d < diamonds.size(); ++d)
    for (uint32_t s = 0; s < 2; ++s)
      if (diamonds[d].side[s].present) look(batch, 2 * d + s);
  evaluate(batch);
}

void Roam::Impl::lookAtDue() {
  Batch batch;
  deferral.takeDue(path, [&](const Deferral::Entry& due) {
    const Side& t = side(due.item);
    if (!t.present || t.stamp != due.stamp) return;
    look(batch, due.item);
  });
  evaluate(batch);
}

uint8_t Roam::Impl::planesCrossed(uint8_t mask, uint32_t id) {
  const Diamond& d = diamonds[id >> 1];
  const auto places = cornersOf(d, id & 1);
  const auto vertices = verticesOf(d, id & 1);
  return planesCrossed(mask, d.side[id & 1].error, fromEye(places[0], vertices[0]), fromEye(places[1], vertices[1]),
                       fromEye(places[2], vertices[2]));
}

void Roam::Impl::carryFrustumDown() {
  struct Visit {
    uint32_t id;
    uint8_t planes;
  };
  std::vector<Visit> stack;
  Batch batch;
  for (uint32_t id = 0; id < 2 * roots; ++id) stack.push_back({id, eye.allPlanes});
  while (!stack.empty()) {
    const Visit visit = stack.back();
    stack.pop_back();
    const Diamond& d = diamonds[visit.id >> 1];
    const uint32_t s = visit.id & 1;
    Side& t = side(visit.id);
    const uint8_t before = t.planes;
    t.planes = visit.planes == 0 || visit.planes == kOutside ? visit.planes : planesCrossed(visit.planes, visit.id);
    if (t.planes == before && (before == 0 || before == kOutside) && !sideReachesOut(d, s)) continue;
    if ((t.planes == kOutside) != (before == kOutside)) {
      if (t.slot != kNone) visible += t.planes != kOutside ? 1U : 0xffffffffU;
      look(batch, visit.id);
    }
    if (!d.split) continue;
    for (uint32_t k = 2 * s; k < 2 * s + 2; ++k)
      stack.push_back({2 * d.child[k] + sideToward(d.child[k], visit.id >> 1), inherited(d, s)});
  }
  evaluate(batch);
}

double Roam::Impl::largestRatio() const {
  double largest = 1;
  // What waits in the split queue but is split already is not drawn, so lower buckets may hold the largest; and where
  // priorities are not kept to their bucket, any may.
  for (uint32_t bucket = wanting.empty() ? 0 : wanting.highest(); bucket > 0; --bucket) {
    if (ordered && largest > 1) break;
    Batch batch;
    for (uint32_t id = wanting.first(bucket), next = 0; id != BucketQueue::kEnd; id = next) {
      next = side(id).queue.next;
      if (!diamonds[id >> 1].split) addToBatch(batch, id);
      if (batch.count < Batch::kLanes && next != BucketQueue::kEnd) continue;
      const Batch::Lanes ratios = ratiosOf(batch);
      for (size_t l = 0; l < batch.count; ++l) largest = std::max(largest, static_cast<double>(ratios[l]));
      batch.count = 0;
    }
  }
  return largest;
}

Batch::Lanes Roam::Impl::ratiosOf(const Batch& batch) const {
  Batch::Lanes ratios{};
  if (eye.perspective)
    ratios = distancesSquared(batch);
  else
    ratios.fill(1);
  for (size_t l = 0; l < batch.count; ++l) ratios[l] = batch.error[l] * std::sqrt(eye.scaleSquared / ratios[l]);
  return ratios;
}

}  // namespace vicus::terrain
