/// What culling by occlusion leaves of a set's plan.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "city/frame_plan.hpp"

namespace vicus::culling {

/// The runs of a set that are still in the plan, and which of them were seen.
struct SetWalk {
  const city::InstanceSet& set;
  city::SetPlan& plan;
  std::vector<city::Range> seen;

  /// First drawn run that ends after `instance`.
  size_t runAt(uint32_t instance) const {
    return static_cast<size_t>(std::partition_point(plan.drawn.begin(), plan.drawn.end(),
                                                    [&](const city::Range& r) { return r.end() <= instance; }) -
                               plan.drawn.begin());
  }
  bool planned(city::Range run) const {
    const size_t k = runAt(run.first);
    return k < plan.drawn.size() && plan.drawn[k].first < run.end();
  }

  /// Calls `run` with each instance of a run that is still in the plan.
  template <typename Run>
  void forEachPlanned(city::Range run, const Run& call) const {
    for (size_t k = runAt(run.first); k < plan.drawn.size() && plan.drawn[k].first < run.end(); ++k) {
      const uint32_t end = std::min(plan.drawn[k].end(), run.end());
      for (uint32_t i = std::max(plan.drawn[k].first, run.first); i < end; ++i) call(i);
    }
  }

  /// Leaves in the plan what was seen of what it held.
  void finish() {
    std::sort(seen.begin(), seen.end(), [](const city::Range& a, const city::Range& b) { return a.first < b.first; });
    std::vector<city::Range> drawn;
    std::vector<city::DroppedRange> dropped, hidden;
    uint64_t count = 0;
    size_t k = 0;
    for (const city::Range& run : plan.drawn) {
      uint32_t at = run.first;
      const auto hideUpTo = [&](uint32_t end) {
        if (end > at) hidden.push_back({{at, end - at}, city::DropReason::Occluded});
        at = std::max(at, end);
      };
      while (k < seen.size() && seen[k].first < run.end()) {
        const uint32_t first = std::max(seen[k].first, at), end = std::min(seen[k].end(), run.end());
        if (end > first) {
          hideUpTo(first);
          if (!drawn.empty() && drawn.back().end() == first)
            drawn.back().count += end - first;
          else
            drawn.push_back({first, end - first});
          count += end - first, at = end;
        }
        if (seen[k].end() > run.end()) break;
        ++k;
      }
      hideUpTo(run.end());
    }
    dropped.reserve(plan.dropped.size() + hidden.size());
    std::merge(plan.dropped.begin(), plan.dropped.end(), hidden.begin(), hidden.end(), std::back_inserter(dropped),
               [](const city::DroppedRange& a, const city::DroppedRange& b) { return a.range.first < b.range.first; });
    plan.drawn = std::move(drawn), plan.dropped = std::move(dropped), plan.drawnCount = count;
  }
};

}  // namespace vicus::culling
