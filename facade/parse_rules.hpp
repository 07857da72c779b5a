/// Reads the text of a style (`*.rules`); docs/rules.md describes the language.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/diagnostics.hpp"
#include "facade/rule_words.hpp"
#include "facade/rules.hpp"

namespace vicus::facade {

/// Texts longer than this are refused: bytes.
constexpr size_t kLongestRules = 1 << 20;

/// The style; nothing where the text has errors. Each error's file is `file:line:column`, its message ends with the
/// line and a caret under the place. At most 20 are told.
std::optional<Style> parseRules(std::string_view text, const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::facade
