#include "viewer/path_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

namespace vicus::viewer {
namespace {

using nlohmann::json;
using std::numbers::pi;

/// "line 3, column 7" of a byte (counted from 1, as the parser does).
std::string placeOfByte(std::string_view text, size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte > 0 ? byte - 1 : 0, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const size_t newline = before.rfind('\n');
  const size_t column = 1 + before.size() - (newline == std::string_view::npos ? 0 : newline + 1);
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// What is wrong with a path, and where.
struct Fault {
  std::string place, message;
};

/// A finite number of a key; `missing` where it may be left out.
double numberOf(const json& key, const char* name, const std::string& place, std::optional<double> missing) {
  if (!key.contains(name)) {
    if (missing) return *missing;
    throw Fault{place, std::string("has no \"") + name + "\""};
  }
  const json& value = key[name];
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw Fault{place + "." + name, "is not a number: " + value.dump()};
  return value.get<double>();
}

void warnOfUnknown(const json& object, std::initializer_list<std::string_view> known, const std::string& place,
                   const std::string& file, city::Diagnostics& diagnostics) {
  for (const auto& [name, value] : object.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      diagnostics.warn(file, place, "\"" + name + "\" means nothing here and is passed over");
}

city::Tour::Key keyFrom(const json& value, const std::string& place) {
  if (!value.is_object()) throw Fault{place, "is not an object with time and position"};
  city::Tour::Key key;
  key.time = numberOf(value, "time", place, std::nullopt);
  if (!value.contains("position")) throw Fault{place, "has no \"position\""};
  const json& position = value["position"];
  if (!position.is_array() || position.size() != 3)
    throw Fault{place + ".position", "is not three numbers [x, y, z]: " + position.dump()};
  for (int k = 0; k < 3; ++k) {
    const json& c = position[static_cast<size_t>(k)];
    if (!c.is_number() || !std::isfinite(c.get<double>()))
      throw Fault{place + ".position", "is not three numbers [x, y, z]: " + position.dump()};
    key.position[k] = c.get<double>();
  }
  key.heading = numberOf(value, "heading", place, 0.0) * pi / 180;
  const double pitch = numberOf(value, "pitch", place, 0.0);
  if (std::abs(pitch) > 90)
    throw Fault{place + ".pitch", "is " + value["pitch"].dump() + "; it goes from -90 (straight down) to 90"};
  key.pitch = pitch * pi / 180;
  return key;
}

city::Tour tourFrom(const json& root, const std::string& file, city::Diagnostics& diagnostics) {
  if (!root.is_object() || !root.contains("keys")) throw Fault{"", "is not an object with \"keys\""};
  const json& keys = root["keys"];
  if (!keys.is_array() || keys.empty()) throw Fault{"keys", "is not a list of at least one key"};
  warnOfUnknown(root, {"name", "jumps", "keys"}, "", file, diagnostics);
  city::Tour tour;
  tour.name = std::filesystem::path(file).stem().string();
  if (root.contains("name")) {
    if (!root["name"].is_string()) throw Fault{"name", "is not a text"};
    tour.name = root["name"].get<std::string>();
  }
  if (root.contains("jumps")) {
    if (!root["jumps"].is_boolean()) throw Fault{"jumps", "is neither true nor false"};
    tour.jumps = root["jumps"].get<bool>();
  }
  for (size_t k = 0; k < keys.size(); ++k) {
    const std::string place = "keys[" + std::to_string(k) + "]";
    tour.keys.push_back(keyFrom(keys[k], place));
    warnOfUnknown(keys[k], {"time", "position", "heading", "pitch"}, place, file, diagnostics);
    if (k > 0 && !(tour.keys[k].time > tour.keys[k - 1].time))
      throw Fault{place + ".time",
                  "is " + keys[k]["time"].dump() + ", not after the key before (" + keys[k - 1]["time"].dump() + ")"};
  }
  return tour;
}

}  // namespace

std::optional<city::Tour> parsePath(std::string_view text, const std::string& file, city::Diagnostics& diagnostics) {
  try {
    return tourFrom(json::parse(text), file, diagnostics);
  } catch (const json::parse_error& e) {
    diagnostics.error(file, placeOfByte(text, e.byte), "is not JSON from here on");
  } catch (const json::exception& e) {  // a number beyond double's range
    diagnostics.error(file, "", std::string("cannot be understood: ") + e.what());
  } catch (const Fault& fault) {
    diagnostics.error(file, fault.place, fault.message);
  }
  return std::nullopt;
}

std::string pathText(const city::Tour& tour) {
  json keys = json::array();
  for (const city::Tour::Key& key : tour.keys)
    keys.push_back({{"time", key.time},
                    {"position", {key.position.x, key.position.y, key.position.z}},
                    {"heading", key.heading * 180 / pi},
                    {"pitch", std::clamp(key.pitch * 180 / pi, -90.0, 90.0)}});
  const json root{{"name", tour.name}, {"jumps", tour.jumps}, {"keys", std::move(keys)}};
  return root.dump(1) + "\n";
}

std::optional<city::Tour> readPath(const std::string& file, city::Diagnostics& diagnostics) {
  std::error_code ignored;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, ignored)) {
    diagnostics.error(file, "", "cannot be opened");
    return std::nullopt;
  }
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return parsePath(text, file, diagnostics);
}

}  // namespace vicus::viewer
