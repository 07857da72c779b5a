#include "assets/import/finishes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "assets/import/parallel.hpp"
#include "assets/materials/materials.hpp"

namespace vicus::assets {
namespace {

constexpr auto kCount = static_cast<size_t>(Finish::Count);
constexpr std::array<std::string_view, kCount> kNames = {
    "plaster", "limewash", "brick", "ashlar", "rubble",           "timber",         "tile",
    "slate",   "concrete", "glass", "door",   "facade-limestone", "facade-plaster", "facade-brick"};

bool mentions(std::string_view text, std::initializer_list<std::string_view> words) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view w) { return lower.find(w) != std::string::npos; });
}

std::optional<Style> styleOf(std::string_view material) {
  if (mentions(material, {"stone", "pierre", "stein", "piedra", "pietra", "ashlar", "limestone"}))
    return Style{Finish::FacadeLimestone, mentions(material, {"rubble", "field"}) ? Finish::Rubble : Finish::Ashlar,
                 Finish::Tile};
  if (mentions(material, {"brick", "brique", "ziegel", "ladrillo", "baksteen", "mattone"}))
    return Style{Finish::FacadeBrick, Finish::Brick, Finish::Tile};
  if (mentions(material, {"plaster", "stucco", "render", "putz", "enduit"}))
    return Style{Finish::FacadePlaster, Finish::Plaster, Finish::Tile};
  return std::nullopt;
}

}  // namespace

Style styleFor(std::string_view material, uint32_t variant) {
  if (const auto style = styleOf(material)) return *style;
  // Five in eight of stone, three rendered: what the historic centres of southern France look like.
  return variant % 8 < 5 ? Style{Finish::FacadeLimestone, Finish::Ashlar, Finish::Tile}
                         : Style{Finish::FacadePlaster, Finish::Plaster, Finish::Tile};
}

Style brickStyleFor(std::string_view material) {
  return styleOf(material).value_or(Style{Finish::FacadeBrick, Finish::Brick, Finish::Tile});
}

int baysIn(double length) {
  if (!(length >= kSmallestFacadeLength)) return 0;
  return std::max(1, static_cast<int>(std::lround(std::min(length, 1e6) / 2.6)));
}

int storeysIn(double height) {
  if (!(height > 0)) return 1;
  return std::max(1, static_cast<int>(std::lround(std::min(height, 1e6) / 2.9)));
}

void keepUsedFinishes(city::City& city) {
  std::array<bool, kCount> used{};
  for (const city::BuildingGeometry& g : city.buildingTypes) {
    for (const city::Vertex& v : g.vertices) used.at(v.material) = true;
    for (const city::Plane& p : g.planes) used.at(p.baseTexture) = true;
  }
  std::array<city::MaterialId, kCount> number{};
  city.materials.clear();
  for (size_t i = 0; i < kCount; ++i)
    if (used[i]) {
      number[i] = static_cast<city::MaterialId>(city.materials.size());
      city.materials.push_back(builtinMaterial(kNames[i]));
    }
  parallelFor(city.buildingTypes.size(), 256, [&](size_t t) {
    for (city::Vertex& v : city.buildingTypes[t].vertices) v.material = number[v.material];
    for (city::Plane& p : city.buildingTypes[t].planes) p.baseTexture = number[p.baseTexture];
  });
}

}  // namespace vicus::assets
