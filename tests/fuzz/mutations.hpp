/// Damage to files, as disks, networks and people do it.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "city/random.hpp"

namespace vicus::fuzz {

inline constexpr std::array<std::string_view, 8> kMutations = {
    "bit flips", "truncation", "swapped numbers", "huge numbers", "deep nesting", "cut out", "repeated", "bytes set"};

/// A damaged copy of `bytes` by the way number `kind` of kMutations. The same random numbers give the same copy.
std::string mutated(std::string_view bytes, size_t kind, city::Random& random);

}  // namespace vicus::fuzz
