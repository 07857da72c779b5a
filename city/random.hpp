/// Deterministic random numbers: the same seed gives the same city on every machine and for every thread count.
#pragma once

#include <cstdint>

namespace vicus::city {

/// Mixes 32 bits so that near inputs give unrelated outputs (the "lowbias32" constants of Ellis/Wellons' search).
constexpr uint32_t hash32(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  x ^= x >> 16;
  return x;
}

/// Joins two hashes, order matters.
constexpr uint32_t hash32(uint32_t a, uint32_t b) {
  return hash32(a ^ (hash32(b) + 0x9e3779b9U + (a << 6) + (a >> 2)));
}

/// A stream of random numbers from a seed.
class Random {
 public:
  explicit constexpr Random(uint32_t seed) : state_(seed) {}
  constexpr uint32_t bits() { return hash32(state_ += 0x9e3779b9U); }
  /// Uniform in [0, 1).
  constexpr double uniform() { return bits() * (1.0 / 4294967296.0); }
  /// Uniform in [lo, hi).
  constexpr double uniform(double lo, double hi) { return lo + (hi - lo) * uniform(); }
  /// Uniform in 0 … n−1; 0 where n is 0.
  constexpr uint32_t below(uint32_t n) { return static_cast<uint32_t>((uint64_t{bits()} * n) >> 32); }

 private:
  uint32_t state_;
};

}  // namespace vicus::city
