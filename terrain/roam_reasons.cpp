/// Why a diamond is split, and what is merged when a reason is gone.
#include "terrain/roam_impl.hpp"

#include <algorithm>

namespace vicus::terrain {

void Roam::Impl::unwant(uint32_t id) {
  Side& t = side(id);
  takeFromQueue(id, t);
  t.wanted = false;
  putInQueue(id, t);
}

void Roam::Impl::want(uint32_t id) {
  Side& t = side(id);
  takeFromQueue(id, t);
  t.wanted = true;
  putInQueue(id, t);
  const uint32_t d = id >> 1;
  if (!diamonds[d].split)
    forceSplit(d, static_cast<uint8_t>(id & 1));
  else if (diamonds[d].reason >= kBecauseOfChild && !restsOn(diamonds[d].parent[id & 1], d))
    diamonds[d].reason = static_cast<uint8_t>(id & 1);
}

void Roam::Impl::release(uint32_t id) {
  unwant(id);
  if (diamonds[id >> 1].reason == (id & 1)) reground(id >> 1);
}

uint32_t Roam::Impl::reasonOf(const Diamond& d) const {
  return d.reason < kBecauseOfChild ? d.parent[d.reason] : d.child[d.reason - kBecauseOfChild];
}

bool Roam::Impl::restsOn(uint32_t d, uint32_t through) const {
  if (!isReason(through)) return false;
  while (d != kNone && d != through) d = reasonOf(diamonds[d]);
  return d == through && d != kNone;
}

uint8_t Roam::Impl::otherSide(uint32_t d) const {
  for (uint8_t s = 0; s < 2; ++s)
    if (diamonds[d].side[s].wanted && !restsOn(diamonds[d].parent[s], d)) return s;
  return kNoReason;
}

void Roam::Impl::mergeWithParents(uint32_t d) {
  const std::array<uint32_t, 2> parents = diamonds[d].parent;
  std::array<bool, 2> rests{};
  for (size_t s = 0; s < 2; ++s)
    rests[s] = parents[s] != kNone && diamonds[parents[s]].reason == kBecauseOfChild + diamonds[d].side[s].childIndex;
  merge(d);
  for (size_t s = 0; s < 2; ++s)
    if (rests[s]) reground(parents[s]);
}

bool Roam::Impl::isReason(uint32_t d) const {
  const Diamond& here = diamonds[d];
  for (uint32_t s = 0; s < 2; ++s)
    if (here.parent[s] != kNone && diamonds[here.parent[s]].reason == kBecauseOfChild + here.side[s].childIndex)
      return true;
  if (here.splitChildren > 0)
    for (const uint32_t child : here.child)
      if (child != kNone && diamonds[child].split && diamonds[child].reason == sideToward(child, d)) return true;
  return false;
}

void Roam::Impl::mark(uint32_t d) {
  diamonds[d].marked = true;
  group.push_back(d);
}

void Roam::Impl::unmark(uint32_t d, uint8_t reason) {
  diamonds[d].marked = false;
  diamonds[d].reason = reason;
  work.push_back(d);
}

uint8_t Roam::Impl::reasonOutside(const Diamond& d) const {
  for (uint8_t s = 0; s < 2; ++s)
    if (d.side[s].wanted && (d.parent[s] == kNone || !diamonds[d.parent[s]].marked)) return s;
  for (uint8_t k = 0; k < 4; ++k)
    if (d.child[k] != kNone && diamonds[d.child[k]].split && !diamonds[d.child[k]].marked)
      return static_cast<uint8_t>(kBecauseOfChild + k);
  return kNoReason;
}

void Roam::Impl::reground(uint32_t lost) {
  if (diamonds[lost].splitChildren == 0) {
    if (const uint8_t reason = otherSide(lost); reason != kNoReason)
      diamonds[lost].reason = reason;
    else
      mergeWithParents(lost);
    return;
  }
  group.clear();
  work.clear();
  mark(lost);
  for (size_t i = 0; i < group.size(); ++i) {
    const Diamond& d = diamonds[group[i]];
    for (const uint32_t child : d.child)
      if (child != kNone && restsDirectlyOn(child, group[i])) mark(child);
    for (const uint32_t parent : d.parent)
      if (parent != kNone && restsDirectlyOn(parent, group[i])) mark(parent);
  }
  for (const uint32_t d : group)
    if (const uint8_t reason = reasonOutside(diamonds[d]); reason != kNoReason) unmark(d, reason);
  while (!work.empty()) {
    const uint32_t d = work.back();
    work.pop_back();
    for (uint32_t s = 0; s < 2; ++s) {
      const uint32_t parent = diamonds[d].parent[s];
      if (parent != kNone && diamonds[parent].marked)
        unmark(parent, static_cast<uint8_t>(kBecauseOfChild + diamonds[d].side[s].childIndex));
    }
    for (const uint32_t child : diamonds[d].child) {
      if (child == kNone || !diamonds[child].marked) continue;
      const uint32_t s = sideToward(child, d);
      if (diamonds[child].side[s].wanted) unmark(child, static_cast<uint8_t>(s));
    }
  }
  std::erase_if(group, [&](uint32_t d) { return !diamonds[d].marked; });
  const auto size = [&](uint32_t d) { return std::abs(diamonds[d].u.x) + std::abs(diamonds[d].u.y); };
  const auto extent = [&](uint32_t d) {  // grows with each level up: squares of side 2h lie over edges of length 2h
    return std::max(std::abs(diamonds[d].u.x), std::abs(diamonds[d].u.y)) * 4 + size(d);
  };
  if (group.size() > 1)
    std::sort(group.begin(), group.end(), [&](uint32_t x, uint32_t y) { return extent(x) < extent(y); });
  for (const uint32_t d : group) {
    diamonds[d].marked = false;
    merge(d);
  }
}

bool Roam::Impl::restsDirectlyOn(uint32_t d, uint32_t reason) const {
  const Diamond& diamond = diamonds[d];
  return diamond.split && !diamond.marked && reasonOf(diamond) == reason;
}

}  // namespace vicus::terrain
