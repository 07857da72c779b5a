/// Splits and merges of diamonds, and the triangles drawn.
///
/// Based on: Duchaineau et al. 1997, §4 (binary triangle trees, diamonds, forced splits).
#include "terrain/roam_impl.hpp"

#include <algorithm>
#include <cassert>

namespace vicus::terrain {

void Roam::Impl::describe(Diamond& d, uint32_t s) const {
  Side& t = d.side[s];
  if (d.finest) {
    t.error = 0;
    t.ground = true;
  } else {
    const auto centre =
        static_cast<size_t>(d.centre.y >> 1) * static_cast<size_t>(columns) + static_cast<size_t>(d.centre.x >> 1);
    const ErrorCode code = table->codes[2 * centre + canonicalSide(s == 0 ? d.v() : -d.v())];
    t.error = decodeError(code);
    t.ground = code != kNoGround;
  }
  if (d.pressed || (d.finest && !table->filled.empty())) t.ground = t.ground && coversGround(d, s);
}

bool Roam::Impl::coversGround(const Diamond& d, uint32_t s) const {
  const auto corners = cornersOf(d, s);
  const glm::ivec2 a = sampleAt(corners[0]), b = sampleAt(corners[1]), p = sampleAt(corners[2]);
  if (d.finest && !(hasData(a) && hasData(b) && hasData(p))) return false;
  const glm::ivec2 ab = b - a, ap = p - a;
  return int64_t{ab.x} * ap.y != int64_t{ab.y} * ap.x;
}

bool Roam::Impl::reachesOut(const Diamond& d) const {
  const int reach = std::max(std::abs(d.u.x), std::abs(d.u.y));
  return d.centre.x + reach > lastHalf.x || d.centre.y + reach > lastHalf.y;
}

void Roam::Impl::makeRoots() {
  const glm::ivec2 corners = patches.count + 1;
  cornerSlots = static_cast<uint32_t>(corners.x * corners.y);
  const auto cornerSlot = [&](int x, int y) { return static_cast<uint32_t>(y * corners.x + x); };
  vertexHeights.resize(cornerSlots);
  mesh->vertices.resize(cornerSlots);
  for (int y = 0; y < corners.y; ++y)
    for (int x = 0; x < corners.x; ++x) placeVertex(cornerSlot(x, y), sampleAt(2 * patches.side * glm::ivec2(x, y)));
  diamonds.resize(roots);
  vertexHeights.resize(cornerSlots + roots);
  mesh->vertices.resize(cornerSlots + roots);
  for (int y = 0; y < patches.count.y; ++y)
    for (int x = 0; x < patches.count.x; ++x) {
      Diamond& d = diamonds[static_cast<size_t>(y * patches.count.x + x)];
      const int half = patches.side;
      d.centre = half * (2 * glm::ivec2(x, y) + 1);
      const bool rising = (x + y) % 2 == 0;
      d.u = rising ? glm::ivec2(half, half) : glm::ivec2(half, -half);
      d.finest = patches.side == 1;
      d.pressed = reachesOut(d);
      const uint32_t sw = cornerSlot(x, y), se = cornerSlot(x + 1, y), nw = cornerSlot(x, y + 1),
                     ne = cornerSlot(x + 1, y + 1);
      d.corner = rising ? std::array{ne, nw, sw, se} : std::array{se, ne, nw, sw};
      for (uint32_t s = 0; s < 2; ++s) {
        d.side[s].present = true;
        describe(d, s);
      }
    }
}

void Roam::Impl::placeVertex(uint32_t vertex, glm::ivec2 sample) {
  vertexHeights[vertex] = heightOf(sample);
  mesh->vertices[vertex] = {sample, vertexHeights[vertex]};
  touchedVertices.push_back(vertex);
}

void Roam::Impl::putTriangle(uint32_t slot, uint32_t id) {
  Diamond& d = diamonds[id >> 1];
  d.side[id & 1].slot = slot;
  mesh->triangles[slot] = verticesOf(d, id & 1);
  drawn[slot].owner = id;
  if (drawn[slot].touched == mesh->revision) return;
  drawn[slot].touched = mesh->revision;
  touchedSlots.push_back(slot);
}

void Roam::Impl::draw(uint32_t id) {
  Diamond& d = diamonds[id >> 1];
  Side& t = d.side[id & 1];
  if (!t.ground) return;
  t.slot = static_cast<uint32_t>(drawn.size());
  visible += t.planes != kOutside;
  touchedSlots.push_back(t.slot);
  mesh->triangles.push_back(verticesOf(d, id & 1));
  drawn.push_back({id, mesh->revision});
}

void Roam::Impl::undraw(uint32_t id) {
  Side& t = side(id);
  if (t.slot == kNone) return;
  visible -= t.planes != kOutside;
  const auto last = static_cast<uint32_t>(drawn.size() - 1);
  if (t.slot != last) putTriangle(t.slot, drawn[last].owner);
  t.slot = kNone;
  drawn.pop_back();
  mesh->triangles.pop_back();
}

void Roam::Impl::redraw(uint32_t from, uint32_t to) {
  Side &f = side(from), &t = side(to);
  if (f.slot == kNone || !t.ground) {
    undraw(from);
    draw(to);
    return;
  }
  visible -= f.planes != kOutside;
  visible += t.planes != kOutside;
  putTriangle(f.slot, to);
  f.slot = kNone;
}

Roam::Impl::Neighbour Roam::Impl::across(uint32_t d, uint32_t k) const {
  const Diamond& here = diamonds[d];
  if (isRoot(d)) return acrossPatches(here, k);
  // Both are children of the diamond at the apex, one after the other around it.
  const uint32_t s = k >> 1;
  const bool next = (k & 1) == 0;
  const uint32_t parent = here.parent[s];
  const uint32_t index = (here.side[s].childIndex + (next ? 1U : 3U)) & 3;
  const uint32_t there = diamonds[parent].child[index];
  if (there == kNone) return {};
  return {there, 2 * sideToward(there, parent) + (next ? 1U : 0U)};
}

Roam::Impl::Neighbour Roam::Impl::acrossPatches(const Diamond& here, uint32_t k) const {
  const glm::ivec2 offset = here.childOffset(k);
  const glm::ivec2 patch = here.centre / (2 * patches.side) + glm::sign(offset);
  if (patch.x < 0 || patch.y < 0 || patch.x >= patches.count.x || patch.y >= patches.count.y) return {};
  const auto there = static_cast<uint32_t>(patch.y * patches.count.x + patch.x);
  for (uint32_t edge = 0; edge < 4; ++edge)
    if (diamonds[there].childOffset(edge) == -offset) return {there, edge};
  return {};
}

Roam::Impl::Neighbour Roam::Impl::missingParent(const Diamond& d, uint32_t s) const {
  return across(d.parent[1 - s], d.side[1 - s].childIndex);
}

void Roam::Impl::makeRoom() {
  while (freeDiamonds.size() < 4) {
    freeDiamonds.push_back(static_cast<uint32_t>(diamonds.size()));
    diamonds.emplace_back();
    vertexHeights.push_back(0);
    mesh->vertices.emplace_back();
  }
}

void Roam::Impl::forceSplit(uint32_t d, uint8_t reason) {
  for (uint32_t s = 0; s < 2; ++s) {
    if (diamonds[d].side[s].present) continue;
    const Neighbour parent = missingParent(diamonds[d], s);
    if (parent.diamond != kNone) forceSplit(parent.diamond, static_cast<uint8_t>(kBecauseOfChild + parent.edge));
  }
  split(d);
  diamonds[d].reason = reason;
}

void Roam::Impl::split(uint32_t d) {
  makeRoom();
  Diamond& here = diamonds[d];
  assert(!here.split && !here.finest);
  here.split = true;
  here.weight = eye.band < 1 ? -1.0F : 1.0F;  // not yet worked out
  if (eye.band < 1) reweigh.push_back(d);
  for (const uint32_t parent : here.parent)
    if (parent != kNone) ++diamonds[parent].splitChildren;

  const uint32_t vertex = vertexOf(d);
  placeVertex(vertex, sampleAt(here.centre));
  const Around around = aroundCentre(here, vertex);
  Batch batch;
  for (uint32_t s = 0; s < 2; ++s) {
    if (!here.side[s].present) continue;
    ++operations.splits;
    const uint8_t mask = inherited(here, s);
    for (uint32_t k = 2 * s; k < 2 * s + 2; ++k) {
      const uint32_t id = makeChild(d, k);
      Diamond& child = diamonds[id >> 1];
      Side& t = child.side[id & 1];
      describe(child, id & 1);
      t.planes = mask == 0 || mask == kOutside ? mask : planesCrossed(mask, id);
      if (k == 2 * s)
        redraw(2 * d + s, id);
      else
        draw(id);
      if (!idle(t) && !settle(id, t, around)) addToBatch(batch, id);
    }
  }
  if (batch.count > 0) evaluate(batch);
}

Roam::Impl::Around Roam::Impl::aroundCentre(const Diamond& d, uint32_t vertex) const {
  const glm::vec3 c = fromEye(d.centre, vertex);
  const float distance = std::sqrt(c.x * c.x + c.y * c.y + c.z * c.z);
  const float ux = static_cast<float>(d.u.x), uy = static_cast<float>(d.u.y);
  const float xx = halfStep.x * halfStep.x, yy = halfStep.y * halfStep.y;
  const float level = std::max(ux * ux * xx + uy * uy * yy, uy * uy * xx + ux * ux * yy);
  const float height = vertexHeights[vertex];
  float rise = 0;
  for (uint32_t k = 0; k < 4; ++k)
    if (d.side[0].present || k != 1) rise = std::max(rise, std::abs(vertexHeights[d.corner[k]] - height));
  return {distance - std::sqrt(level + rise * rise), distance};
}

bool Roam::Impl::settle(uint32_t id, Side& t, const Around& around) {
  const float reach = t.error * eye.scale;
  if (!eye.perspective) return false;
  if (reach < around.least) {
    ++t.stamp;
    deferral.put(id, t.stamp, path, around.least - reach);
  } else if (reach * eye.band > around.centre && !ordered) {
    setWeight(id, t, 1);
    const float ratio = reach / around.centre;
    setBucket(id, t, std::max(1U, bucketOf(ratio * ratio)));
    ++t.stamp;
    deferral.put(id, t.stamp, path, reach * eye.band - around.centre);
  } else {
    return false;
  }
  ++operations.evaluations;
  return true;
}

uint32_t Roam::Impl::makeChild(uint32_t d, uint32_t k) {
  Diamond& here = diamonds[d];
  const Neighbour beyond = across(d, k);
  uint32_t m = kNone, s = 0;
  if (beyond.diamond != kNone && diamonds[beyond.diamond].split) {
    m = diamonds[beyond.diamond].child[beyond.edge];
    s = diamonds[m].side[0].present ? 1 : 0;
  } else {
    m = freeDiamonds.back();
    freeDiamonds.pop_back();
    Diamond& fresh = diamonds[m];
    const glm::ivec2 offset = here.childOffset(k);
    fresh.centre = here.centre + offset;
    fresh.u = {-offset.y, offset.x};  // so that v leads back to this diamond's centre: its apex is p0
    fresh.corner[0] = here.corner[(k + 1) & 3];
    fresh.corner[2] = here.corner[k];
    fresh.finest = (fresh.centre.x & 1) != 0;
    fresh.pressed = reachesOut(fresh);
    fresh.reason = kNoReason;
  }
  Diamond& child = diamonds[m];
  here.child[k] = m;
  child.parent[s] = d;
  child.corner[s == 0 ? 1 : 3] = vertexOf(d);
  Side& t = child.side[s];
  t.present = true;
  t.wanted = false;
  t.bucket = 0;
  t.weight = 0;
  t.slot = kNone;
  t.childIndex = static_cast<uint8_t>(k);
  return 2 * m + s;
}

void Roam::Impl::merge(uint32_t d) {
  Diamond& here = diamonds[d];
  assert(here.split && here.splitChildren == 0);
  here.split = false;
  here.reason = kNoReason;
  for (const uint32_t parent : here.parent)
    if (parent != kNone) {
      --diamonds[parent].splitChildren;
      if (eye.band < 1) reweigh.push_back(parent);
    }
  for (uint32_t s = 0; s < 2; ++s) {
    if (!here.side[s].present) continue;
    ++operations.merges;
    for (uint32_t k = 2 * s; k < 2 * s + 2; ++k) {
      const uint32_t m = here.child[k];
      Diamond& child = diamonds[m];
      const uint32_t id = 2 * m + sideToward(m, d);
      Side& t = side(id);
      if (k == 2 * s)
        redraw(id, 2 * d + s);
      else
        undraw(id);
      takeFromQueue(id, t);
      t.bucket = 0;
      t.present = false;
      ++t.stamp;
      child.parent[id & 1] = kNone;
      if (!child.side[1 - (id & 1)].present) freeDiamonds.push_back(m);
      here.child[k] = kNone;
    }
    if (here.side[s].wanted) unwant(2 * d + s);
  }
}

}  // namespace vicus::terrain
