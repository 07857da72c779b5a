#include "app/figures.hpp"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace vicus::app {
namespace {

using Json = nlohmann::ordered_json;

/// A tenth of a microsecond, or a ten-thousandth of a count, is more than any of the figures is worth.
double rounded(double v) {
  return std::round(v * 1e4) / 1e4;
}

double megabytes(uint64_t bytes) {
  return std::round(static_cast<double>(bytes) / 1e6 * 10) / 10;
}

Json json(const viewer::Percentiles& p) {
  return {{"median", rounded(p.median)}, {"p95", rounded(p.p95)}, {"p99", rounded(p.p99)}, {"max", rounded(p.max)}};
}

Json json(std::span<const plan::FeatureReport> features) {
  Json out = Json::object();
  for (const plan::FeatureReport& f : features) out[f.name] = {{"on", f.on}, {"why", f.why}};
  return out;
}

std::string text(const Json& value) {
  // Names of files may hold bytes that are no UTF-8: shown as the replacement character.
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string number(double v) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", v);
  return buffer;
}

/// Characters that a UTF-8 text takes on the screen.
size_t width(std::string_view utf8) {
  size_t count = 0;
  for (const char c : utf8) count += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  return count;
}

std::string padded(std::string_view utf8, size_t to) {
  std::string out(utf8);
  for (size_t w = width(utf8); w < to; ++w) out += ' ';
  return out;
}

std::string rangeOf(const city::Knob& knob) {
  return knob.isSwitch() ? std::string(knob.unit)
                         : number(knob.min) + " to " + number(knob.max) + " " + std::string(knob.unit);
}

std::string defaultOf(const city::Knob& knob) {
  return knob.isSwitch() ? (knob.value != 0 ? "on" : "off") : number(knob.value);
}

}  // namespace

std::string walkJson(const WalkResult& result) {
  Json out;
  out["scene"] = result.scene.name;
  out["renderer"] = result.renderer;
  out["size"] = {result.size.x, result.size.y};
  out["frames"] = result.records.size();
  out["knobs"] = Json::object();
  for (const city::Knob& knob : result.scene.knobs.declared())
    out["knobs"][std::string(knob.name)] = result.scene.knobs[knob.name];
  out["features"] = json(result.features);
  const viewer::RunTimes times = viewer::timesOf(result.records);
  out["run_time_ms"]["frame"] = json(times.frame);
  out["run_time_ms"]["gpu"] = times.gpu ? json(*times.gpu) : Json(nullptr);
  out["run_time_ms"]["stages"] = Json::object();
  for (const auto& [name, p] : times.stages) out["run_time_ms"]["stages"][name] = json(p);
  for (const auto& [name, c] : viewer::countsOf(result.records))
    out["counts"][name] = {{"mean", rounded(c.mean)}, {"max", c.max}};
  out["loading_s"] = {{"city", rounded(result.scene.seconds)}, {"first_frame", rounded(result.firstFrameSeconds)}};
  out["from_cache"] = result.scene.fromCache;
  out["memory_mb"] = {{"peak_resident", megabytes(result.peakResidentBytes)}, {"gpu", megabytes(result.gpuBytes)}};
  return text(out);
}

std::string infoJson(const OpenScene& scene, std::span<const plan::FeatureReport> features) {
  const city::City& city = *scene.city;
  const glm::dvec3 extent = city.extent.empty() ? glm::dvec3(0) : city.extent.size();
  const city::CityBytes bytes = city::memoryOf(city);
  Json out;
  out["scene"] = scene.name;
  out["crs"] = city.crs;
  out["origin"] = {city.origin.x, city.origin.y, city.origin.z};
  out["extent_m"] = {rounded(extent.x), rounded(extent.y), rounded(extent.z)};
  out["buildings"] = city.buildings.size();
  out["building_types"] = city.buildingTypes.size();
  out["building_polygons"] = city::fullDetailTriangles(city);
  out["monuments"] = city.monuments.size();
  out["trees"] = city.trees.size();
  out["tiles"] = {city.grid.size, city.grid.size};
  out["terrain"] = nullptr;
  if (city.terrain)
    out["terrain"] = {{"size", {city.terrain->size.x, city.terrain->size.y}},
                      {"spacing_m", {rounded(city.terrain->spacing.x), rounded(city.terrain->spacing.y)}}};
  out["features"] = json(features);
  out["left_out"] = Json::array();
  for (const city::LeftOut& l : scene.diagnostics.leftOut)
    out["left_out"].push_back({{"what", l.what}, {"count", l.count}, {"why", l.why}});
  out["bytes"] = {{"parameters", bytes.instances}, {"geometry", bytes.geometry}, {"terrain", bytes.terrain}};
  return text(out);
}

std::string infoText(const OpenScene& scene, std::span<const plan::FeatureReport> features) {
  const city::City& city = *scene.city;
  const glm::dvec3 extent = city.extent.empty() ? glm::dvec3(0) : city.extent.size();
  const city::CityBytes bytes = city::memoryOf(city);
  constexpr size_t kLabel = 20;
  std::string out;
  const auto line = [&](std::string_view label, const std::string& value) {
    out += padded(label, kLabel) + value + "\n";
  };
  const auto megabyteText = [](uint64_t b) { return number(megabytes(b)) + " MB"; };
  line("scene", scene.name);
  line("coordinates", city.crs.empty() ? "local metres" : city.crs);
  line("extent", number(extent.x) + " × " + number(extent.y) + " m, " + number(extent.z) + " m high");
  line("buildings",
       std::to_string(city.buildings.size()) + " of " + std::to_string(city.buildingTypes.size()) + " types");
  line("monuments", std::to_string(city.monuments.size()));
  line("trees", std::to_string(city.trees.size()));
  line("triangles", std::to_string(city::fullDetailTriangles(city)) + " of buildings and monuments at full detail");
  line("tiles", std::to_string(city.grid.size) + " × " + std::to_string(city.grid.size) + " of " +
                    number(city.grid.tileSize) + " m");
  if (city.terrain)
    line("terrain", std::to_string(city.terrain->size.x) + " × " + std::to_string(city.terrain->size.y) + " heights, " +
                        number(city.terrain->spacing.x) + " × " + number(city.terrain->spacing.y) + " m apart");
  line("memory", megabyteText(bytes.instances) + " of parameters, " + megabyteText(bytes.geometry) + " of geometry, " +
                     megabyteText(bytes.terrain) + " of terrain");
  out += "features\n";
  for (const plan::FeatureReport& f : features) line("  " + f.name, std::string(f.on ? "on" : "off") + ", " + f.why);
  if (!scene.diagnostics.leftOut.empty()) out += "left out\n";
  for (const city::LeftOut& l : scene.diagnostics.leftOut)
    out += "  " + std::to_string(l.count) + " " + l.what + ": " + l.why + "\n";
  return out;
}

std::string knobsJson(const city::Knobs& knobs) {
  Json out = Json::array();
  for (const city::Knob& k : knobs.declared())
    out.push_back({{"name", k.name},
                   {"default", k.value},
                   {"min", k.min},
                   {"max", k.max},
                   {"unit", k.unit},
                   {"meaning", k.meaning},
                   {"too_small", k.tooSmall},
                   {"too_large", k.tooLarge}});
  return text(out);
}

std::string knobsText(const city::Knobs& knobs) {
  size_t nameWidth = 4, defaultWidth = 7, rangeWidth = 5;
  for (const city::Knob& k : knobs.declared()) {
    nameWidth = std::max(nameWidth, width(k.name));
    defaultWidth = std::max(defaultWidth, width(defaultOf(k)));
    rangeWidth = std::max(rangeWidth, width(rangeOf(k)));
  }
  const auto row = [&](std::string_view name, std::string_view value, std::string_view range,
                       std::string_view meaning) {
    return padded(name, nameWidth + 2) + padded(value, defaultWidth + 2) + padded(range, rangeWidth + 2) +
           std::string(meaning) + "\n";
  };
  std::string out = row("knob", "default", "takes", "what it does");
  for (const city::Knob& k : knobs.declared()) {
    out += row(k.name, defaultOf(k), rangeOf(k), k.meaning);
    out += row("", "", "", "too small: " + std::string(k.tooSmall));
    out += row("", "", "", "too large: " + std::string(k.tooLarge));
  }
  return out;
}

}  // namespace vicus::app
