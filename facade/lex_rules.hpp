/// Words, numbers and signs of a style's text. Used by parse_rules.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "facade/rules.hpp"

namespace vicus::facade {

enum class TokenKind : uint8_t { Name, Number, Text, Sign, Broken, End };

struct Token {
  TokenKind kind = TokenKind::End;
  std::string_view text;  ///< as written; of a Text without its quotes; of a Broken one the reason
  double number = 0;
  SourcePlace place;
};

/// Tokens up to and with the end. Names are letters, digits, `_` and `.`; texts stand in double quotes on one line; `#`
/// begins a comment; signs are => .. <= >= == != and single characters. Broken ones stand where nothing fits.
std::vector<Token> lexRules(std::string_view text);

}  // namespace vicus::facade
