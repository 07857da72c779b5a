#include "city/knob.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace vicus::city {
namespace {

/// Levenshtein distance, for suggestions.
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string number(double v) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, v).ptr;
  return {buffer, end};
}

}  // namespace

void Knobs::declare(std::span<const Knob> knobs) {
  for (const Knob& k : knobs) {
    assert(!has(k.name) && "knob declared twice");
    declared_.push_back(k);
    values_.emplace(k.name, k.value);
  }
}

bool Knobs::has(std::string_view name) const {
  return values_.contains(name);
}

double Knobs::operator[](std::string_view name) const {
  const auto it = values_.find(name);
  assert(it != values_.end() && "knob not declared");
  return it == values_.end() ? 0 : it->second;
}

std::string Knobs::set(std::string_view name, double value) {
  const auto it = std::find_if(declared_.begin(), declared_.end(), [&](const Knob& k) { return k.name == name; });
  if (it == declared_.end()) {
    std::string message = "unknown knob '" + std::string(name) + "'";
    const auto nearest = std::min_element(declared_.begin(), declared_.end(), [&](const Knob& a, const Knob& b) {
      return editDistance(a.name, name) < editDistance(b.name, name);
    });
    if (nearest != declared_.end()) message += "; did you mean '" + std::string(nearest->name) + "'?";
    return message;
  }
  if (!(value >= it->min && value <= it->max))
    return "knob '" + std::string(name) + "' takes " + number(it->min) + " to " + number(it->max) + ", not " +
           number(value);
  if (it->isSwitch() && value != 0 && value != 1)
    return "knob '" + std::string(name) + "' is a switch: on or off, not " + number(value);
  values_.find(name)->second = value;
  return {};
}

std::string Knobs::set(std::string_view assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) return "'" + std::string(assignment) + "' is not name=value";
  const std::string_view name = assignment.substr(0, equals), text = assignment.substr(equals + 1);
  const auto known = std::find_if(declared_.begin(), declared_.end(), [&](const Knob& k) { return k.name == name; });
  if (known == declared_.end()) return set(name, 0);  // says which name is unknown before what is wrong with the value
  if (known->isSwitch() && (text == "on" || text == "off")) return set(name, text == "on" ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return "'" + std::string(text) + "' is not a number, in '" + std::string(assignment) + "'";
  return set(name, value);
}

}  // namespace vicus::city
