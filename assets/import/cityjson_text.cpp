#include "assets/import/cityjson_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "assets/import/read_cityjson.hpp"

namespace vicus::assets {
namespace cityjson {
namespace {

/// "line 3, column 17" of a byte.
std::string lineAndColumn(std::string_view text, size_t byte, size_t firstLine) {
  byte = std::min(byte, text.size());
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n') +
                    static_cast<std::ptrdiff_t>(firstLine);
  const size_t start = byte == 0 ? std::string_view::npos : text.rfind('\n', byte - 1);
  const size_t column = byte - (start == std::string_view::npos ? 0 : start + 1);
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

}  // namespace

std::optional<Json> parse(std::string_view text, const std::string& file, size_t firstLine,
                          city::Diagnostics& diagnostics) {
  const auto refuse = [&](size_t byte, std::string what) {
    if (const size_t at = what.find("; last read"); at != std::string::npos) what = what.substr(0, at);
    if (const size_t at = what.rfind(": "); at != std::string::npos) what = what.substr(at + 2);
    diagnostics.error(file, lineAndColumn(text, byte, firstLine), "this is not JSON: " + what);
    return std::nullopt;
  };
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& e) {
    return refuse(e.byte, e.what());
  } catch (const Json::exception& e) {
    return refuse(0, e.what());
  }
}

}  // namespace cityjson

bool isCityJson(std::string_view text) {
  if (text.find("\"CityJSONFeature\"") != std::string_view::npos) return true;
  // The member may stand anywhere at the top level, and before or after megabytes of others.
  for (size_t at = text.find("\"CityJSON\""); at != std::string_view::npos; at = text.find("\"CityJSON\"", at + 1)) {
    size_t before = at;
    const auto skipSpace = [&] {
      while (before > 0 && (text[before - 1] == ' ' || text[before - 1] == '\t' || text[before - 1] == '\n' ||
                            text[before - 1] == '\r'))
        --before;
    };
    skipSpace();
    if (before == 0 || text[before - 1] != ':') continue;
    --before;
    skipSpace();
    if (before >= 6 && text.substr(before - 6, 6) == "\"type\"") return true;
  }
  return false;
}

}  // namespace vicus::assets
