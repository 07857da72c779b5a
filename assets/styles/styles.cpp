#include "assets/styles/styles.hpp"

#include <fstream>
#include <sstream>

#include "facade/parse_rules.hpp"

namespace vicus::assets {

std::vector<std::string> styleNames() {
  return {"bare", "dutch_brick", "levantine", "limestone_south", "plain", "plaster_19th", "timber_frame"};
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

}  // namespace vicus::assets
