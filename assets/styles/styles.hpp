/// The styles of houses that travel inside the program, and those of the user's own files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "city/diagnostics.hpp"
#include "facade/rules.hpp"

namespace vicus::assets {

/// Text of a rules file as it lies in assets/styles ("plain.rules"); empty where there is none of that name.
std::string_view styleText(std::string_view fileName);

/// Names of the styles inside the program, without `.rules`, in the order of the alphabet.
std::vector<std::string> styleNames();

/// The style of that name, or of the file where it ends in `.rules`. Nothing, with errors that name file, line and
/// column, where it is not known or its rules have mistakes.
std::optional<facade::Style> loadStyle(const std::string& nameOrFile, city::Diagnostics& diagnostics);

/// One value for each of the style's parameters, in the rules' own units: those given by name (in the unit that the
/// rules write), else the style's own. Names that it does not have count for nothing.
std::vector<double> parametersOf(const facade::Style& style, std::span<const std::pair<std::string, double>> given);

/// What is wrong with giving a parameter that value, in plain words, with the nearest name or the range; empty is good.
std::string parameterProblem(const facade::Style& style, const std::string& name, double value);

}  // namespace vicus::assets
