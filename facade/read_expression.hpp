/// Expressions of rules. Used by parse_rules.cpp.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "facade/rule_reader.hpp"
#include "facade/rules.hpp"

namespace vicus::facade {

/// What a style's text has named so far, by name: numbers in the style's lists.
struct RuleNames {
  std::map<std::string, uint32_t, std::less<>> rules, parameters, choices;
};

/// Enters expressions into a style. Invariant: no expression is nested so deep that evaluating it could run out of
/// stack.
class ExpressionReader {
 public:
  ExpressionReader(RuleReader& in, Style& style, const RuleNames& names) : in_(in), style_(style), names_(names) {}

  /// Number of the expression that stands here.
  uint32_t expression();

 private:
  uint32_t operators(int level);
  uint32_t unary();
  uint32_t call(const Token& name);
  uint32_t named(const Token& name);
  uint32_t add(ExprKind kind, std::initializer_list<uint32_t> children);
  uint32_t add(const Expr& e);

  RuleReader& in_;
  Style& style_;
  const RuleNames& names_;
  std::vector<int> depthOf_;  ///< of each expression
};

}  // namespace vicus::facade
