#include "facade/rule_reader.hpp"

#include "facade/rule_words.hpp"

namespace vicus::facade {
namespace {

/// Expressions and rules in brackets nest at most so deep.
constexpr int kDeepest = 60;

}  // namespace

void RuleReader::say(SourcePlace place, const std::string& message) {
  ++errors_;
  size_t begin = 0;
  for (uint32_t line = 1; line < place.line; ++line) begin = std::min(text_.find('\n', begin), text_.size() - 1) + 1;
  // Long lines are shown around the place; characters that would move the caret become blanks.
  std::string line;
  size_t caret = 0;
  for (uint32_t column = 1; begin < text_.size() && text_[begin] != '\n' && text_[begin] != '\r'; ++begin) {
    const auto c = static_cast<unsigned char>(text_[begin]);
    if ((c & 0xc0) == 0x80) {
      if (!line.empty()) line += text_[begin];
      continue;
    }
    if (column + 60 > place.column && column < place.column + 60) {
      if (column < place.column) ++caret;
      line += c < 0x20 || c == 0x7f ? ' ' : text_[begin];
    }
    ++column;
  }
  diagnostics_.error(file_ + ":" + std::to_string(place.line) + ":" + std::to_string(place.column), "",
                     message + "\n  " + line + "\n  " + std::string(caret, ' ') + "^");
}

void RuleReader::expected(const std::string& what) {
  if (at().kind == TokenKind::Broken) fail(at().place, std::string(at().text));
  const std::string found = at().kind == TokenKind::End    ? "the end"
                            : at().kind == TokenKind::Text ? "\"" + std::string(at().text) + "\""
                                                           : std::string(at().text);
  fail(at().place, "here belongs " + what + ", not " + found);
}

double RuleReader::needNumber(std::string* unit) {
  const double sign = takeSign("-") ? -1 : 1;
  if (at().kind != TokenKind::Number) expected("a number");
  return sign * take().number * unitFactor(unit);
}

double RuleReader::unitFactor(std::string* unit) {
  if (at().kind != TokenKind::Name && !isSign("%")) return 1;
  for (const RuleUnit& u : ruleUnits())
    if (at().text == u.name) {
      if (unit) *unit = u.name;
      take();
      return u.factor;
    }
  return 1;
}

uint8_t RuleReader::oneOf(std::span<const std::string_view> names, const std::string& what) {
  if (at().kind == TokenKind::Name)
    for (size_t i = 0; i < names.size(); ++i)
      if (names[i] == at().text) {
        take();
        return static_cast<uint8_t>(i);
      }
  std::string all;
  for (const std::string_view name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  expected(what + " (" + all + ")");
}

RuleReader::Deeper::Deeper(RuleReader& r) : reader(r) {
  if (++reader.depth_ > kDeepest) {
    --reader.depth_;
    reader.fail(reader.at().place, "this is nested too deep");
  }
}

}  // namespace vicus::facade
