/// Which buildings look how: rules over their attributes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/finishes.hpp"
#include "city/city.hpp"

namespace vicus::assets {

/// One thing that an attribute must be.
struct StyleCondition {
  std::string attribute;              ///< its name as the source writes it
  std::optional<std::string> equals;  ///< text; upper and lower case count as the same
  std::optional<std::string> contains;
  std::optional<double> atLeast, below;  ///< of the first number in its text

  bool operator==(const StyleCondition&) const = default;
};

/// A number that a scene gives to a parameter of rules.
struct StyleParameter {
  std::string name;
  double value = 0;   ///< in the unit that the rules write behind the parameter's own value
  std::string place;  ///< in the description: "line 3, column 1"

  bool operator==(const StyleParameter&) const = default;
};

/// What buildings are finished with for which all conditions hold; what is not named stays as it was.
struct StyleRule {
  std::vector<StyleCondition> where;
  std::string rules;  ///< a style by name, or a file of rules; empty: as it was, or what `facade` stands for
  std::vector<StyleParameter> parameters;  ///< of `rules`
  std::optional<Finish> facade, plain, roof;

  bool operator==(const StyleRule&) const = default;
};

/// The finish of that name ("brick", "facade-plaster", …); nothing where there is none.
std::optional<Finish> finishNamed(std::string_view name);
/// Names of all finishes, as scene descriptions write them.
std::vector<std::string> finishNames();

/// `style` as the first rule changes it whose conditions all hold.
Style styled(Style style, const std::vector<StyleRule>& rules, const city::Attributes& attributes);

}  // namespace vicus::assets
