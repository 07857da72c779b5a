#include "assets/import/finishes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "assets/import/parallel.hpp"
#include "assets/import/style_rules.hpp"
#include "assets/materials/materials.hpp"

namespace vicus::assets {
namespace {

constexpr auto kCount = static_cast<size_t>(Finish::Count);
constexpr std::array<std::string_view, kCount> kNames = {
    "plaster",        "limewash",     "brick",      "ashlar",
    "rubble",         "timber",       "tile",       "slate",
    "concrete",       "glass",        "door",       "facade-limestone",
    "facade-plaster", "facade-brick", "brick-dark", "flint",
    "planks",         "thatch",       "lead",       "facade-plaster-shutters"};

bool mentions(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view w) { return lower.find(w) != std::string::npos; });
}

Style withRules(std::string rules, Finish facade, Finish plain) {
  Style style;
  style.rules = std::move(rules), style.facade = facade, style.plain = plain;
  return style;
}

std::optional<Style> styleOf(std::string_view material) {
  if (mentions(material, {"stone", "pierre", "stein", "piedra", "pietra", "ashlar", "limestone"}))
    return withRules("limestone_south", Finish::FacadeLimestone,
                     mentions(material, {"rubble", "field"}) ? Finish::Rubble : Finish::Ashlar);
  if (mentions(material, {"brick", "brique", "ziegel", "ladrillo", "baksteen", "mattone"}))
    return withRules("dutch_brick", Finish::FacadeBrick, Finish::Brick);
  if (mentions(material, {"timber", "fachwerk", "colombage", "wood"}))
    return withRules("timber_frame", Finish::FacadePlaster, Finish::Limewash);
  if (mentions(material, {"plaster", "stucco", "render", "putz", "enduit"}))
    return withRules("plaster_19th", Finish::FacadePlaster, Finish::Plaster);
  return std::nullopt;
}

}  // namespace

Style styleFor(std::string_view material, uint32_t variant) {
  if (const auto style = styleOf(material)) return *style;
  // Where only surfaces come without rules: five in eight of stone, three rendered, as in southern France.
  Style style;
  if (variant % 8 >= 5) style.facade = Finish::FacadePlaster, style.plain = Finish::Plaster;
  return style;
}

Style brickStyleFor(std::string_view material) {
  return styleOf(material).value_or(withRules("dutch_brick", Finish::FacadeBrick, Finish::Brick));
}

std::string rulesFor(Finish facade) {
  switch (facade) {
    case Finish::FacadeLimestone:
      return "limestone_south";
    case Finish::FacadeBrick:
      return "dutch_brick";
    case Finish::FacadePlaster:
    case Finish::FacadePlasterShutters:
      return "plaster_19th";
    default:
      return "bare";
  }
}

std::string_view nameOf(Finish finish) {
  return kNames.at(static_cast<size_t>(finish));
}

int baysIn(double length) {
  if (!(length >= kSmallestFacadeLength)) return 0;
  return std::max(1, static_cast<int>(std::lround(std::min(length, 1e6) / 2.6)));
}

int storeysIn(double height) {
  if (!(height > 0)) return 1;
  return std::max(1, static_cast<int>(std::lround(std::min(height, 1e6) / 2.9)));
}

std::optional<Finish> finishNamed(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Finish>(found - kNames.begin());
}

std::vector<std::string> finishNames() {
  return {kNames.begin(), kNames.end()};
}

void keepUsedMaterials(city::City& city, std::span<const city::Material> own) {
  const size_t all = kCount + own.size();
  std::vector<uint8_t> used(all, 0);
  for (const city::BuildingGeometry& g : city.buildingTypes) {
    for (const city::Vertex& v : g.vertices) used.at(v.material) = 1;
    for (const city::Plane& p : g.planes) used.at(p.baseTexture) = 1;
  }
  for (const auto* list : {&city.meshes, &city.treeTypes})
    for (const city::MeshGeometry& g : *list)
      for (const city::Vertex& v : g.mesh.vertices) used.at(v.material) = 1;
  std::vector<city::MaterialId> number(all, 0);
  city.materials.clear();
  for (size_t i = 0; i < all; ++i)
    if (used[i]) {
      number[i] = static_cast<city::MaterialId>(city.materials.size());
      city.materials.push_back(i < kCount ? builtinMaterial(kNames[i]) : own[i - kCount]);
    }
  parallelFor(city.buildingTypes.size(), 256, [&](size_t t) {
    for (city::Vertex& v : city.buildingTypes[t].vertices) v.material = number[v.material];
    for (city::Plane& p : city.buildingTypes[t].planes) p.baseTexture = number[p.baseTexture];
  });
  for (auto* list : {&city.meshes, &city.treeTypes})
    for (city::MeshGeometry& g : *list)
      for (city::Vertex& v : g.mesh.vertices) v.material = number[v.material];
}

}  // namespace vicus::assets
