#include "facade/lex_rules.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vicus::facade {
namespace {

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Characters of a number at the start: digits, a point with a digit after it (`2..4` is a range), an exponent.
size_t numberLength(std::string_view s) {
  size_t n = 0;
  const auto digits = [&] {
    while (n < s.size() && isDigit(s[n])) ++n;
  };
  digits();
  if (n + 1 < s.size() && s[n] == '.' && isDigit(s[n + 1])) ++n, digits();
  if (n + 1 < s.size() && (s[n] == 'e' || s[n] == 'E')) {
    const size_t sign = s[n + 1] == '-' || s[n + 1] == '+' ? 1 : 0;
    if (n + 1 + sign < s.size() && isDigit(s[n + 1 + sign])) n += 1 + sign, digits();
  }
  return n;
}

}  // namespace

std::vector<Token> lexRules(std::string_view text) {
  std::vector<Token> tokens;
  SourcePlace place;
  size_t i = 0;
  const auto advance = [&](size_t n) {
    for (; n > 0 && i < text.size(); --n, ++i) {
      // Bytes that continue a UTF-8 character are no columns of their own.
      if (text[i] == '\n')
        ++place.line, place.column = 1;
      else if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80)
        ++place.column;
    }
  };
  const auto add = [&](TokenKind kind, std::string_view shown, size_t length) {
    tokens.push_back({kind, shown, 0, place});
    advance(length);
  };
  while (i < text.size()) {
    const std::string_view rest = text.substr(i);
    const char c = rest[0];
    if (isSpace(c)) {
      advance(1);
    } else if (c == '#') {
      advance(std::min(rest.find('\n'), rest.size()));
    } else if (isLetter(c)) {
      size_t n = 1;
      while (n < rest.size() && (isLetter(rest[n]) || isDigit(rest[n]) ||
                                 (rest[n] == '.' && n + 1 < rest.size() && isLetter(rest[n + 1]))))
        ++n;
      add(TokenKind::Name, rest.substr(0, n), n);
    } else if (isDigit(c) || (c == '.' && rest.size() > 1 && isDigit(rest[1]))) {
      const size_t n = numberLength(rest);
      double value = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + n, value);
      if (error != std::errc() || end != rest.data() + n || !std::isfinite(value)) {
        add(TokenKind::Broken, "this number is too large", n);
      } else {
        add(TokenKind::Number, rest.substr(0, n), n);
        tokens.back().number = value;
      }
    } else if (c == '"') {
      const size_t end = rest.find_first_of("\"\n", 1);
      if (end == std::string_view::npos || rest[end] == '\n')
        add(TokenKind::Broken, "this text does not end on its line", std::min(end, rest.size()));
      else
        add(TokenKind::Text, rest.substr(1, end - 1), end + 1);
    } else {
      size_t n = 0;
      for (const std::string_view sign : {"=>", "..", "<=", ">=", "==", "!="})
        if (rest.starts_with(sign)) n = sign.size();
      if (n == 0 && std::string_view("()+-*/<>=:,@!%").find(c) != std::string_view::npos) n = 1;
      if (n > 0)
        add(TokenKind::Sign, rest.substr(0, n), n);
      else
        add(TokenKind::Broken, "this character has no meaning here", 1);
    }
  }
  tokens.push_back({TokenKind::End, {}, 0, place});
  return tokens;
}

}  // namespace vicus::facade
