/// Which column of a table holds heights, found by its usual names.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vicus::assets {

/// Height of a storey where only their number is known, and of a building where nothing is: metres.
constexpr double kStoreyHeight = 3;
constexpr double kDefaultHeight = 6;

/// Heights of buildings, numbers of storeys, altitudes of the ground, of the ground at their uphill side, and of their
/// roofs: names in the order in which they are preferred, in lower case without separators.
std::span<const std::string_view> heightNames();
std::span<const std::string_view> storeyNames();
std::span<const std::string_view> groundNames();
std::span<const std::string_view> uphillNames();
std::span<const std::string_view> roofNames();

/// Indices into `columns` of those that have one of the `names`, best first. Case and the separators _ - : . and space
/// do not count.
std::vector<size_t> columnsNamed(std::span<const std::string> columns, std::span<const std::string_view> names);

/// The name in lower case without separators.
std::string plainName(std::string_view column);

/// The first number in a text ("12.5 m", "12,5"); NaN where there is none.
double numberIn(std::string_view text);

}  // namespace vicus::assets
