/// Distances from the eye to triangles, four at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace vicus::terrain {

/// Corners of up to four triangles from the eye, coordinate by coordinate, so that they are worked on side by side.
struct Batch {
  static constexpr size_t kLanes = 4;
  using Lanes = std::array<float, kLanes>;
  std::array<Lanes, 3> a{}, b{}, apex{};
  Lanes error{};
  std::array<uint32_t, kLanes> side{};
  size_t count = 0;
};

/// Squares of the distances from the eye to the batch's triangles.
Batch::Lanes distancesSquared(const Batch& t);

}  // namespace vicus::terrain
