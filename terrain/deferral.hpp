/// Puts off looking at something again until the eye has moved far enough to change it.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vicus::terrain {

/// Items that hold for the next `slack` metres of the eye's path, sorted by the power of two below that slack. Each
/// power has a first-in first-out list, so an item comes up between half of its slack and all of it after it was put
/// in, and the work spreads over the frames in between.
///
/// Based on: the priority deferral of Duchaineau et al. 1997, §6.4, with metres of path instead of frames.
class Deferral {
 public:
  struct Entry {
    uint32_t item = 0;
    uint32_t stamp = 0;  ///< the item's stamp when it was put in; an item whose stamp changed since is no longer meant
    double path = 0;     ///< metres that the eye had gone
  };

  /// `slack` in metres, ≥ 0; above 2²⁰ m the item need not come up again.
  void put(uint32_t item, uint32_t stamp, double path, float slack) {
    if (slack >= 0x1p20F) return;
    const uint32_t exponent =
        std::bit_cast<uint32_t>(slack) >> 23;  // biased by 127; NaN and small slacks come up soonest
    const uint32_t list = slack >= 0x1p-10F ? exponent - (127 + kSmallest) : 0;
    lists_[list].entries.push_back({item, stamp, path});
    ++size_;
  }

  /// Calls `look(entry)` for all that are due at `path`; it may put items in again.
  template <typename Look>
  void takeDue(double path, const Look& look) {
    for (size_t i = 0; i < lists_.size(); ++i) {
      List& list = lists_[i];
      const double hold = i == 0 ? 0 : std::ldexp(1.0, static_cast<int>(i) + kSmallest);
      const size_t end = list.entries.size();  // what is put in meanwhile is not due
      while (list.first < end && list.entries[list.first].path + hold <= path && list.entries[list.first].path < path) {
        const Entry entry = list.entries[list.first++];
        --size_;
        look(entry);
      }
      if (list.first > 64 && list.first > list.entries.size() / 2) {
        list.entries.erase(list.entries.begin(), list.entries.begin() + static_cast<std::ptrdiff_t>(list.first));
        list.first = 0;
      }
    }
  }

  /// Drops entries for which `keep(entry)` is false.
  template <typename Keep>
  void purge(const Keep& keep) {
    size_ = 0;
    for (List& list : lists_) {
      list.entries.erase(list.entries.begin(), list.entries.begin() + static_cast<std::ptrdiff_t>(list.first));
      list.first = 0;
      std::erase_if(list.entries, [&](const Entry& e) { return !keep(e); });
      size_ += list.entries.size();
    }
  }

  void clear() { *this = {}; }
  size_t size() const { return size_; }

 private:
  static constexpr int kSmallest = -11;  // 2⁻¹¹ m and less: due whenever the eye moves
  struct List {
    std::vector<Entry> entries;
    size_t first = 0;
  };
  std::array<List, 32> lists_;
  size_t size_ = 0;
};

}  // namespace vicus::terrain
