/// The styles of houses that travel inside the program, and those of the user's own files.
#pragma once

#include <optional>
#include <string>
#include <string_view>
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

}  // namespace vicus::assets
