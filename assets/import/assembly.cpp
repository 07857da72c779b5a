#include "assets/import/assembly.hpp"

#include <algorithm>
#include <cstdio>

#include "assets/materials/materials.hpp"
#include "city/random.hpp"

namespace vicus::assets {

std::string list(const std::vector<std::string>& names) {
  constexpr size_t kShown = 10;
  std::string out;
  for (size_t i = 0; i < std::min(names.size(), kShown); ++i) out += (i ? ", " : "") + names[i];
  if (names.size() > kShown) out += " and " + std::to_string(names.size() - kShown) + " more";
  return out;
}

std::string counted(size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string metres(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f m", v);
  return text;
}

std::string shortNumber(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return text;
}

uint32_t seedOf(std::string_view text) {
  // FNV-1a.
  uint32_t h = 2166136261u;
  for (const char c : text) h = (h ^ static_cast<uint8_t>(c)) * 16777619u;
  return city::hash32(h);
}

std::string_view attribute(const city::Attributes& attributes, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    for (const auto& [key, value] : attributes)
      if (key == name) return value;
  return {};
}

void reportGaps(const std::string& file, std::vector<double> gaps, const char* what, city::Diagnostics& diagnostics) {
  if (gaps.empty()) return;
  std::sort(gaps.begin(), gaps.end());
  diagnostics.warn(file, "",
                   std::string(what) + " and the terrain differ by " + metres(gaps[gaps.size() / 2]) + " (median) to " +
                       metres(gaps.back()));
}

std::vector<city::MaterialId> addMaterials(Assembly& a, const Source& source) {
  std::vector<city::MaterialId> numbers;
  size_t lost = 0;
  for (const SourceMaterial& m : source.materials) {
    if (a.materials.size() >= kMostOwnMaterials) {
      numbers.push_back(id(Finish::Plaster));
      ++lost;
      continue;
    }
    city::Material material = builtinMaterial("plaster");
    if (!m.image.empty()) {
      material.source = m.image;
      material.metresPerRepeat = {1, 1};
      material.repeat = m.repeat;
    }
    material.name = m.name, material.tint = m.colour, material.tintVariation = 0;
    numbers.push_back(ownMaterial(a.materials.size()));
    a.materials.push_back(std::move(material));
  }
  if (lost > 0)
    a.diagnostics.leftOut.push_back({"materials", lost, "a city holds at most " + std::to_string(kMostOwnMaterials)});
  return numbers;
}

}  // namespace vicus::assets
