#include "assets/import/style_rules.hpp"

#include <algorithm>

#include "assets/import/columns.hpp"

namespace vicus::assets {
namespace {

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool holds(const StyleCondition& condition, const city::Attributes& attributes) {
  for (const auto& [name, text] : attributes) {
    if (name != condition.attribute) continue;
    if (condition.equals && lowerCase(text) != lowerCase(*condition.equals)) continue;
    if (condition.contains && lowerCase(text).find(lowerCase(*condition.contains)) == std::string::npos) continue;
    if (condition.atLeast && !(numberIn(text) >= *condition.atLeast)) continue;
    if (condition.below && !(numberIn(text) < *condition.below)) continue;
    return true;
  }
  return false;
}

}  // namespace

Style styled(Style style, const std::vector<StyleRule>& rules, const city::Attributes& attributes) {
  for (const StyleRule& rule : rules) {
    if (!std::all_of(rule.where.begin(), rule.where.end(),
                     [&](const StyleCondition& c) { return holds(c, attributes); }))
      continue;
    if (rule.facade) style.facade = *rule.facade, style.rules = rulesFor(*rule.facade);
    if (!rule.rules.empty()) style.rules = rule.rules;
    for (const StyleParameter& p : rule.parameters) style.parameters.emplace_back(p.name, p.value);
    if (rule.plain) style.plain = *rule.plain, style.plainStated = true;
    if (rule.roof) style.roof = *rule.roof, style.roofStated = true;
    break;
  }
  return style;
}

}  // namespace vicus::assets
