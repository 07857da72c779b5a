/// The tokens of a style's text, one after the other, and the mistakes in them. Used by parse_rules.cpp and
/// read_expression.cpp.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "city/diagnostics.hpp"
#include "facade/lex_rules.hpp"

namespace vicus::facade {

/// Thrown at a mistake that was told, to the statement's reader, which goes on behind it.
struct RuleMistake {};

class RuleReader {
 public:
  RuleReader(std::string_view text, const std::string& file, city::Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics), tokens_(lexRules(text)) {}

  const Token& at() const { return tokens_[next_]; }
  Token take() {
    const Token token = at();
    if (token.kind != TokenKind::End) ++next_;
    return token;
  }
  /// The token before, and after, the present one.
  const Token& last() const { return tokens_[next_ > 0 ? next_ - 1 : 0]; }
  const Token& following() const { return tokens_[std::min(next_ + 1, tokens_.size() - 1)]; }
  bool isSign(std::string_view sign) const { return at().kind == TokenKind::Sign && at().text == sign; }
  bool isName(std::string_view name) const { return at().kind == TokenKind::Name && at().text == name; }
  bool takeSign(std::string_view sign) {
    if (!isSign(sign)) return false;
    take();
    return true;
  }

  /// Tells a mistake: file, line and column, the line, a caret under the place.
  void say(SourcePlace place, const std::string& message);
  [[noreturn]] void fail(SourcePlace place, const std::string& message) {
    say(place, message);
    throw RuleMistake{};
  }
  [[noreturn]] void expected(const std::string& what);
  void need(std::string_view sign) {
    if (!takeSign(sign)) expected(std::string(sign));
  }
  std::string needName(const std::string& what) {
    if (at().kind != TokenKind::Name) expected(what);
    return std::string(take().text);
  }
  std::string needText(const std::string& what) {
    if (at().kind != TokenKind::Text && at().kind != TokenKind::Name) expected(what);
    return std::string(take().text);
  }

  /// A number with its unit, which may be negative.
  double needNumber(std::string* unit = nullptr);
  /// The factor of the unit that stands here; 1 where there is none.
  double unitFactor(std::string* unit = nullptr);
  /// Which of the names stands here.
  uint8_t oneOf(std::span<const std::string_view> names, const std::string& what);

  /// Behind a mistake: on to the next line that begins at its first column.
  void recover() {
    const uint32_t line = at().place.line;
    while (at().kind != TokenKind::End && !(at().place.column == 1 && at().place.line > line)) take();
  }

  size_t mistakes() const { return errors_; }

  /// Counts how deep brackets are nested while it lives; too deep is a mistake.
  struct Deeper {
    explicit Deeper(RuleReader& r);
    ~Deeper() { --reader.depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    RuleReader& reader;
  };

 private:
  std::string_view text_;
  std::string file_;
  city::Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  size_t next_ = 0;
  size_t errors_ = 0;
  int depth_ = 0;
};

}  // namespace vicus::facade
