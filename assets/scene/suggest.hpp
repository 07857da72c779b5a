/// The word that someone probably meant.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vicus::assets {

/// Smallest number of letters to insert, delete, replace or swap with a neighbour (optimal string alignment).
size_t editDistance(std::string_view a, std::string_view b);

/// The nearest of `known` where it is near enough to be meant (a third of its letters, at least one); else empty.
std::string nearest(std::string_view word, std::span<const std::string> known);

}  // namespace vicus::assets
