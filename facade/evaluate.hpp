/// The values of expressions in one scope.
#pragma once

#include <span>
#include <string_view>

#include "facade/rules.hpp"

namespace vicus::facade {

/// A number or a text. Texts live as long as the style and the house's attributes.
struct Value {
  double number = 0;
  std::string_view text;
  bool isText = false;
};

/// What expressions see.
struct Surrounding {
  Value variables[static_cast<size_t>(Variable::Number)];
  std::span<const double> parameters;  ///< one for each of the style's
  std::span<const double> choices;     ///< those already made
  uint32_t seed = 0;                   ///< of the scope

  Value& operator[](Variable v) { return variables[static_cast<size_t>(v)]; }
};

/// Texts count as 0 where a number is needed; texts equal whatever the case. What is not finite becomes 0, like a
/// division by 0. `rand` gives the same number for the same expression and seed.
Value evaluate(const Style& style, uint32_t expression, const Surrounding& surrounding);
double numberOf(const Style& style, uint32_t expression, const Surrounding& surrounding);

}  // namespace vicus::facade
