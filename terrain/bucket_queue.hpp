/// A priority queue of small numbers over 256 buckets.
#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstdint>

namespace vicus::terrain {

/// An item's place in its bucket's list; part of the item.
struct BucketLinks {
  uint32_t next = 0xffffffffU, previous = 0xffffffffU;
};

/// Items in 256 buckets; within a bucket the last one in comes out first. All operations take constant time and no
/// memory: the lists run through the items. `links(item)` gives the BucketLinks of an item; the owner remembers each
/// item's bucket.
class BucketQueue {
 public:
  static constexpr uint32_t kEnd = 0xffffffffU;

  BucketQueue() { heads_.fill(kEnd); }

  bool empty() const { return (words_[0] | words_[1] | words_[2] | words_[3]) == 0; }

  /// Highest and lowest bucket with an item; the queue must not be empty.
  uint32_t highest() const {
    assert(!empty());
    size_t w = 3;
    while (words_[w] == 0) --w;
    return static_cast<uint32_t>(w * 64 + 63) - static_cast<uint32_t>(std::countl_zero(words_[w]));
  }
  uint32_t lowest() const {
    assert(!empty());
    size_t w = 0;
    while (words_[w] == 0) ++w;
    return static_cast<uint32_t>(w * 64) + static_cast<uint32_t>(std::countr_zero(words_[w]));
  }
  /// First item of a bucket, or kEnd.
  uint32_t first(uint32_t bucket) const { return heads_[bucket]; }

  template <typename Links>
  void push(uint32_t bucket, uint32_t item, const Links& links) {
    const uint32_t next = heads_[bucket];
    links(item) = {next, kEnd};
    if (next != kEnd) links(next).previous = item;
    heads_[bucket] = item;
    words_[bucket >> 6] |= uint64_t{1} << (bucket & 63);
  }

  template <typename Links>
  void remove(uint32_t bucket, uint32_t item, const Links& links) {
    const BucketLinks of = links(item);
    if (of.next != kEnd) links(of.next).previous = of.previous;
    if (of.previous != kEnd) {
      links(of.previous).next = of.next;
      return;
    }
    assert(heads_[bucket] == item && "the item is not in this bucket");
    heads_[bucket] = of.next;
    if (of.next == kEnd) words_[bucket >> 6] &= ~(uint64_t{1} << (bucket & 63));
  }

 private:
  std::array<uint32_t, 256> heads_;
  std::array<uint64_t, 4> words_{};
};

}  // namespace vicus::terrain
