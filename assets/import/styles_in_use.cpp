#include "assets/import/styles_in_use.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "assets/import/assembly.hpp"
#include "assets/materials/materials.hpp"
#include "assets/materials/wall_colours.hpp"
#include "assets/styles/styles.hpp"

namespace vicus::assets {
namespace {

bool isBuiltin(const std::string& texture) {
  const std::vector<std::string> names = builtinMaterialNames();
  return std::find(names.begin(), names.end(), texture) != names.end();
}

/// The number of a material, entered where it is new; the last one where there is no room.
facade::PaintLook entered(Assembly& a, const city::Material& material) {
  size_t number =
      static_cast<size_t>(std::find(a.materials.begin(), a.materials.end(), material) - a.materials.begin());
  if (number == a.materials.size() && number < kMostOwnMaterials) a.materials.push_back(material);
  number = std::min(number, a.materials.size() - 1);
  return {ownMaterial(number), material.metresPerRepeat};
}

/// The look of a paint: a built-in texture, or a picture where it is a path. Without a name it is a colour alone.
facade::PaintLook lookOf(Assembly& a, const facade::Paint& paint, const std::string& style) {
  const std::string texture = paint.texture.empty() ? "limewash" : paint.texture;
  city::Material material = builtinMaterial(texture);
  if (!isBuiltin(texture)) {
    if (texture.find_first_of("./") != std::string::npos) {
      material = builtinMaterial("plaster");
      // A picture lies beside the rules that name it.
      const std::filesystem::path file = std::filesystem::path(style).parent_path() / texture;
      material.name = material.source = style.ends_with(".rules") ? file.lexically_normal().string() : texture;
    } else {
      a.diagnostics.warn(style, "", "there is no texture " + texture + "; plaster is shown");
    }
  }
  material.tint *= paint.colour;
  return entered(a, material);
}

constexpr std::string_view kBuiltin = "builtin:";

std::optional<glm::vec3> wallColourOf(const city::Material& material) {
  const std::string_view source = material.source;
  return source.starts_with(kBuiltin) ? wallColour(source.substr(kBuiltin.size())) : std::nullopt;
}

/// The far picture on a wall of the look `wallLook`: as bright and as warm as that from far away, shifted by a house's
/// seed as that is. The far picture as it is where either is no built-in wall.
facade::PaintLook farLookOf(Assembly& a, const facade::PaintLook& farLook, const facade::PaintLook& wallLook) {
  const auto of = [&](const facade::PaintLook& look) { return a.materials[look.material - ownMaterial(0)]; };
  city::Material far = of(farLook);
  const city::Material wall = of(wallLook);
  const std::optional<glm::vec3> ofFar = wallColourOf(far), ofWall = wallColourOf(wall);
  if (!ofFar || !ofWall) return farLook;
  far.tint = wall.tint * *ofWall / *ofFar;
  far.tintVariation = wall.tintVariation;
  return entered(a, far);
}

}  // namespace

size_t StylesInUse::use(Assembly& a, const Style& style) {
  // What decides nothing here makes no style of its own.
  Style key = style;
  key.facade = {};
  if (!key.plainStated) key.plain = {};
  if (!key.roofStated) key.roof = {};
  const auto known = std::find(wanted_.begin(), wanted_.end(), key);
  if (known != wanted_.end()) return static_cast<size_t>(known - wanted_.begin());

  std::optional<facade::Style> loaded = loadStyle(style.rules, a.diagnostics);
  if (!loaded) loaded = loadStyle("plain", a.diagnostics);
  styles_.push_back(std::make_unique<const facade::Style>(std::move(*loaded)));
  const facade::Style& rules = *styles_.back();
  facade::StyleInUse inUse;
  inUse.style = &rules;
  inUse.parameters = parametersOf(rules, style.parameters);
  const std::string plain = rules.paints[rules.plainPaint].texture;
  constexpr std::array<std::string_view, 4> kCoverings = {"tile", "slate", "thatch", "lead"};
  for (facade::Paint paint : rules.paints) {
    const bool covering = std::find(kCoverings.begin(), kCoverings.end(), paint.texture) != kCoverings.end();
    if (style.plainStated && paint.texture == plain) paint = {std::string(nameOf(style.plain)), glm::vec3(1)};
    if (style.roofStated && covering) paint = {std::string(nameOf(style.roof)), glm::vec3(1)};
    inUse.looks.push_back(lookOf(a, paint, style.rules));
  }
  if (rules.farPaint != facade::kNothing)
    for (const facade::PaintLook& wall : inUse.looks)
      inUse.farOf.push_back(farLookOf(a, inUse.looks[rules.farPaint], wall).material);
  wanted_.push_back(key);
  inUse_.push_back(std::move(inUse));
  return wanted_.size() - 1;
}

}  // namespace vicus::assets
