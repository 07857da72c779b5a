#include "facade/read_expression.hpp"

#include <algorithm>

#include "facade/rule_words.hpp"

namespace vicus::facade {
namespace {

/// Sums and products have at most so many terms.
constexpr int kDeepestSum = 400;

struct Binary {
  std::string_view sign;
  ExprKind kind;
};

}  // namespace

uint32_t ExpressionReader::expression() {
  RuleReader::Deeper deeper(in_);
  return operators(0);
}

/// Loosest first: or, and, comparison, sum, product, sign.
uint32_t ExpressionReader::operators(int level) {
  static constexpr Binary kLevels[][6] = {
      {{"or", ExprKind::Or}},
      {{"and", ExprKind::And}},
      {{"<=", ExprKind::LessEqual},
       {">=", ExprKind::GreaterEqual},
       {"<", ExprKind::Less},
       {">", ExprKind::Greater},
       {"==", ExprKind::Equal},
       {"!=", ExprKind::NotEqual}},
      {{"+", ExprKind::Add}, {"-", ExprKind::Subtract}},
      {{"*", ExprKind::Multiply}, {"/", ExprKind::Divide}},
  };
  if (level == static_cast<int>(std::size(kLevels))) return unary();
  uint32_t left = operators(level + 1);
  for (;;) {
    const Binary* found = nullptr;
    for (const Binary& b : kLevels[level])
      if (!b.sign.empty() && (in_.isSign(b.sign) || in_.isName(b.sign))) found = &b;
    if (!found) return left;
    in_.take();
    const uint32_t right = operators(level + 1);
    left = add(found->kind, {left, right});
  }
}

uint32_t ExpressionReader::add(ExprKind kind, std::initializer_list<uint32_t> children) {
  Expr e;
  e.kind = kind;
  std::copy(children.begin(), children.end(), e.children);
  return add(e);
}

uint32_t ExpressionReader::add(const Expr& e) {
  int deepest = 0;
  for (const uint32_t child : e.children)
    if (child != kNothing) deepest = std::max(deepest, depthOf_[child]);
  if (deepest >= kDeepestSum) in_.fail(in_.at().place, "this expression is too long");
  depthOf_.push_back(deepest + 1);
  style_.expressions.push_back(e);
  return static_cast<uint32_t>(style_.expressions.size() - 1);
}

uint32_t ExpressionReader::unary() {
  RuleReader::Deeper deeper(in_);
  if (in_.takeSign("-")) return add(ExprKind::Negate, {unary()});
  if (in_.takeSign("!") || (in_.isName("not") && (in_.take(), true))) return add(ExprKind::Not, {unary()});
  if (in_.takeSign("(")) {
    const uint32_t inner = expression();
    in_.need(")");
    return inner;
  }
  Expr e;
  const Token token = in_.at();
  if (token.kind == TokenKind::Number) {
    in_.take();
    e.number = token.number * in_.unitFactor();
    return add(e);
  }
  if (token.kind == TokenKind::Text) {
    in_.take();
    e.kind = ExprKind::Text, e.index = static_cast<uint32_t>(style_.texts.size());
    style_.texts.emplace_back(token.text);
    return add(e);
  }
  if (token.kind != TokenKind::Name) in_.expected("a number, a name or (");
  in_.take();
  return in_.isSign("(") ? call(token) : named(token);
}

uint32_t ExpressionReader::call(const Token& name) {
  for (const RuleFunction& f : ruleFunctions()) {
    if (f.name != name.text) continue;
    Expr e;
    e.kind = f.kind;
    in_.need("(");
    for (size_t i = 0; i < f.arguments; ++i) {
      if (i > 0) in_.need(",");
      e.children[i] = expression();
    }
    in_.need(")");
    return add(e);
  }
  in_.fail(name.place, "there is no function " + std::string(name.text));
}

uint32_t ExpressionReader::named(const Token& name) {
  Expr e;
  const std::string text(name.text);
  for (size_t i = 0; i < variableNames().size(); ++i)
    if (variableNames()[i] == name.text) {
      e.kind = ExprKind::Scope, e.index = static_cast<uint32_t>(i);
      return add(e);
    }
  if (const auto p = names_.parameters.find(text); p != names_.parameters.end()) {
    e.kind = ExprKind::Parameter, e.index = p->second;
    return add(e);
  }
  if (const auto c = names_.choices.find(text); c != names_.choices.end()) {
    e.kind = ExprKind::Choice, e.index = c->second;
    return add(e);
  }
  in_.fail(name.place, text + " is no variable, and no param or let above defines it");
}

}  // namespace vicus::facade
