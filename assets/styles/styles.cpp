#include "assets/styles/styles.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "assets/scene/suggest.hpp"
#include "facade/parse_rules.hpp"

namespace vicus::assets {

std::vector<std::string> styleNames() {
  return {"bare",           "castle_keep", "church",       "dutch_brick",  "levantine", "limestone_south",
          "medieval_stone", "plain",       "plaster_19th", "timber_frame", "town_wall"};
}

std::optional<facade::Style> loadStyle(const std::string& nameOrFile, city::Diagnostics& diagnostics) {
  if (nameOrFile.ends_with(".rules")) {
    std::ifstream stream(nameOrFile, std::ios::binary);
    std::ostringstream text;
    if (stream) text << stream.rdbuf();
    if (!stream) {
      diagnostics.error(nameOrFile, "", "cannot be read");
      return std::nullopt;
    }
    return facade::parseRules(std::move(text).str(), nameOrFile, diagnostics);
  }
  const std::string file = nameOrFile + ".rules";
  const std::string_view text = styleText(file);
  if (text.empty()) {
    std::string all;
    for (const std::string& name : styleNames()) all += (all.empty() ? "" : ", ") + name;
    diagnostics.error(nameOrFile, "", "there is no style of this name; there are " + all);
    return std::nullopt;
  }
  return facade::parseRules(text, file, diagnostics);
}

std::vector<double> parametersOf(const facade::Style& style, std::span<const std::pair<std::string, double>> given) {
  std::vector<double> values;
  for (const facade::Parameter& p : style.parameters) {
    values.push_back(p.value);
    for (const auto& [name, value] : given)
      if (name == p.name) values.back() = value * facade::unitFactorOf(p.unit);
  }
  return values;
}

std::string parameterProblem(const facade::Style& style, const std::string& name, double value) {
  std::vector<std::string> names;
  for (const facade::Parameter& p : style.parameters) {
    names.push_back(p.name);
    if (p.name != name) continue;
    const double factor = facade::unitFactorOf(p.unit), slack = 1e-9 * (std::abs(p.least) + std::abs(p.most));
    if (value * factor >= p.least - slack && value * factor <= p.most + slack) return {};
    std::ostringstream range;
    range << name << " is " << value << "; it goes from " << p.least / factor << " to " << p.most / factor
          << (p.unit.empty() ? "" : " ") << p.unit;
    return range.str();
  }
  const std::string meant = nearest(name, names);
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
  return "the rules have no parameter " + name +
         (!meant.empty() ? "; did you mean " + meant + "?"
          : all.empty()  ? ": they have none"
                         : ": they have " + all);
}

}  // namespace vicus::assets
