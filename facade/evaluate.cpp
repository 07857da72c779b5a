#include "facade/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include "city/random.hpp"

namespace vicus::facade {
namespace {

bool equalTexts(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) { return lower(x) == lower(y); });
}

bool equal(const Value& a, const Value& b) {
  if (a.isText != b.isText) return false;
  return a.isText ? equalTexts(a.text, b.text) : a.number == b.number;
}

Value number(double v) {
  return {std::isfinite(v) ? v : 0, {}, false};
}

}  // namespace

Value evaluate(const Style& style, uint32_t expression, const Surrounding& s) {
  const Expr& e = style.expressions[expression];
  const auto value = [&](int i) { return evaluate(style, e.children[i], s); };
  const auto child = [&](int i) { return value(i).number; };
  switch (e.kind) {
    case ExprKind::Number:
      return number(e.number);
    case ExprKind::Text:
      return {0, style.texts[e.index], true};
    case ExprKind::Scope:
      return s.variables[e.index];
    case ExprKind::Parameter:
      return number(e.index < s.parameters.size() ? s.parameters[e.index] : style.parameters[e.index].value);
    case ExprKind::Choice:
      return number(e.index < s.choices.size() ? s.choices[e.index] : 0);
    case ExprKind::Negate:
      return number(-child(0));
    case ExprKind::Not:
      return number(child(0) == 0);
    case ExprKind::Add:
      return number(child(0) + child(1));
    case ExprKind::Subtract:
      return number(child(0) - child(1));
    case ExprKind::Multiply:
      return number(child(0) * child(1));
    case ExprKind::Divide:
      return number(child(0) / child(1));
    case ExprKind::Less:
      return number(child(0) < child(1));
    case ExprKind::LessEqual:
      return number(child(0) <= child(1));
    case ExprKind::Greater:
      return number(child(0) > child(1));
    case ExprKind::GreaterEqual:
      return number(child(0) >= child(1));
    case ExprKind::Equal:
      return number(equal(value(0), value(1)));
    case ExprKind::NotEqual:
      return number(!equal(value(0), value(1)));
    case ExprKind::And:
      return number(child(0) != 0 && child(1) != 0);
    case ExprKind::Or:
      return number(child(0) != 0 || child(1) != 0);
    case ExprKind::If:
      return child(0) != 0 ? value(1) : value(2);
    case ExprKind::Min:
      return number(std::min(child(0), child(1)));
    case ExprKind::Max:
      return number(std::max(child(0), child(1)));
    case ExprKind::Clamp:
      return number(std::max(child(1), std::min(child(2), child(0))));
    case ExprKind::Floor:
      return number(std::floor(child(0)));
    case ExprKind::Ceil:
      return number(std::ceil(child(0)));
    case ExprKind::Round:
      return number(std::round(child(0)));
    case ExprKind::Abs:
      return number(std::abs(child(0)));
    case ExprKind::Random:
      return number(city::Random(city::hash32(s.seed, expression)).uniform(child(0), child(1)));
  }
  return {};
}

double numberOf(const Style& style, uint32_t expression, const Surrounding& surrounding) {
  return evaluate(style, expression, surrounding).number;
}

}  // namespace vicus::facade
