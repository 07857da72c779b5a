#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <string_view>
#include <thread>

#include "assets/materials/image_file.hpp"
#include "assets/materials/materials.hpp"
#include "assets/materials/recipes.hpp"

namespace vicus::assets {
namespace {

struct Recipe {
  std::string_view name;
  glm::vec2 metresPerRepeat;
  float tintVariation;
  float specular;
  Image (*make)();
};

/// What people see from 1.65 m: sizes are those of the real thing. `plaster` stands first: it is what unknown names
/// get.
constexpr std::array kRecipes{
    Recipe{"plaster", {2, 2}, 0.35F, 0.02F, recipes::plaster},
    Recipe{"limewash", {2, 2}, 0.25F, 0.02F, recipes::limewash},
    Recipe{"brick", {1.8F, 1.8F}, 0.20F, 0.03F, recipes::brick},
    Recipe{"brick-dark", {1.8F, 1.8F}, 0.20F, 0.03F, recipes::brickDark},
    Recipe{"rubble", {2.4F, 2.4F}, 0.15F, 0.02F, recipes::rubble},
    Recipe{"ashlar", {2.5F, 2.5F}, 0.12F, 0.03F, recipes::ashlar},
    Recipe{"flint", {2, 2}, 0.12F, 0.12F, recipes::flint},
    Recipe{"timber", {1, 1.5F}, 0.25F, 0.04F, recipes::timber},
    Recipe{"oak", {0.8F, 1.2F}, 0.20F, 0.06F, recipes::oak},
    Recipe{"planks", {1.8F, 2.4F}, 0.25F, 0.04F, recipes::planks},
    Recipe{"tile", {1.98F, 2}, 0.20F, 0.03F, recipes::tile},
    Recipe{"slate", {2.5F, 2.8F}, 0.15F, 0.10F, recipes::slate},
    Recipe{"thatch", {1.6F, 1.6F}, 0.20F, 0.01F, recipes::thatch},
    Recipe{"lead", {2.4F, 2.4F}, 0.10F, 0.18F, recipes::lead},
    Recipe{"cobbles", {2.2F, 2.2F}, 0.10F, 0.06F, recipes::cobbles},
    Recipe{"earth", {3, 3}, 0.10F, 0.01F, recipes::earth},
    Recipe{"grass", {2, 2}, 0.15F, 0.02F, recipes::grass},
    Recipe{"field", {4, 4}, 0.20F, 0.01F, recipes::field},
    Recipe{"garden", {4, 4}, 0.15F, 0.02F, recipes::garden},
    Recipe{"bank", {3, 3}, 0.10F, 0.03F, recipes::bank},
    Recipe{"water", {6, 6}, 0, 0.70F, recipes::water},
    Recipe{"glass", {1, 1.5F}, 0.10F, 0.60F, recipes::glass},
    Recipe{"lead-glass", {0.48F, 0.48F}, 0.10F, 0.40F, recipes::leadGlass},
    Recipe{"door", {1, 2.1F}, 0.40F, 0.05F, recipes::door},
    Recipe{"shutter", {0.5F, 1.2F}, 0.60F, 0.06F, recipes::shutter},
    Recipe{"bark", {1, 1.5F}, 0.15F, 0.01F, recipes::bark},
    Recipe{"leaves", {1, 1}, 0.30F, 0.04F, recipes::leaves},
    Recipe{"leaves-dark", {1, 1}, 0.25F, 0.04F, recipes::leavesDark},
    Recipe{"iron", {0.6F, 0.6F}, 0.05F, 0.25F, recipes::iron},
    Recipe{"wool", {0.12F, 0.12F}, 0.60F, 0.01F, recipes::wool},
    Recipe{"concrete", {2.5F, 2.5F}, 0.10F, 0.03F, recipes::concrete},
    Recipe{"window-casement", {1, 1}, 0.10F, 0.30F, recipes::windowCasement},
    Recipe{"window-framed", {1, 1}, 0.12F, 0.20F, recipes::windowFramed},
    Recipe{"window-shuttered", {1, 1}, 0.15F, 0.12F, recipes::windowShuttered},
    Recipe{"window-sash-framed", {1, 1}, 0.08F, 0.25F, recipes::windowSashFramed},
    Recipe{"window-sash", {1, 1}, 0.05F, 0.30F, recipes::windowSash},
    Recipe{"window-leaded", {1, 1}, 0.10F, 0.30F, recipes::windowLeaded},
    Recipe{"window-arched", {1, 1}, 0.15F, 0.20F, recipes::windowArched},
    Recipe{"window-tracery", {1, 1}, 0.06F, 0.12F, recipes::windowTracery},
    Recipe{"portal", {1, 1}, 0.10F, 0.03F, recipes::portal},
    Recipe{"door-panelled", {1, 1}, 0.50F, 0.06F, recipes::doorPanelled},
    Recipe{"door-arched", {1, 1}, 0.40F, 0.05F, recipes::doorArched},
    Recipe{"shop-front", {1, 1}, 0.60F, 0.12F, recipes::shopFront},
    Recipe{"facade-limestone", {1, 1}, 0.15F, 0.04F, recipes::facadeLimestone},
    Recipe{"facade-plaster", {1, 1}, 0.35F, 0.04F, recipes::facadePlaster},
    Recipe{"facade-brick", {1, 1}, 0.20F, 0.04F, recipes::facadeBrick},
    Recipe{"facade-plaster-shutters", {1, 1}, 0.35F, 0.04F, recipes::facadePlasterShutters},
};

constexpr std::string_view kPrefix = "builtin:";

const Recipe& recipeOf(std::string_view name) {
  for (const Recipe& r : kRecipes)
    if (r.name == name) return r;
  return kRecipes[0];
}

}  // namespace

std::vector<std::string> builtinMaterialNames() {
  std::vector<std::string> names;
  names.reserve(kRecipes.size());
  for (const Recipe& r : kRecipes) names.emplace_back(r.name);
  return names;
}

city::Material builtinMaterial(std::string_view name) {
  const Recipe& r = recipeOf(name);
  city::Material material;
  material.name = r.name;
  material.source = std::string(kPrefix) + std::string(r.name);
  material.metresPerRepeat = r.metresPerRepeat;
  material.tintVariation = r.tintVariation;
  material.specular = r.specular;
  return material;
}

Image materialImage(const city::Material& material, city::Diagnostics& diagnostics) {
  const std::string_view source = material.source;
  if (!source.starts_with(kPrefix)) return readImageFile(material.source, diagnostics);
  const std::string_view name = source.substr(kPrefix.size());
  const Recipe& r = recipeOf(name);
  if (r.name != name)
    diagnostics.warn(material.source, material.name, "there is no built-in texture of this name; plaster is shown");
  return r.make();
}

std::vector<Image> materialImages(std::span<const city::Material> materials, city::Diagnostics& diagnostics) {
  std::vector<Image> images(materials.size());
  std::vector<city::Diagnostics> found(materials.size());
  std::atomic<size_t> next = 0;
  const auto work = [&] {
    for (size_t i = next++; i < materials.size(); i = next++) images[i] = materialImage(materials[i], found[i]);
  };
  {
    const size_t threads = std::min<size_t>(std::max(1U, std::thread::hardware_concurrency()), materials.size());
    std::vector<std::jthread> helpers;
    for (size_t t = 1; t < threads; ++t) helpers.emplace_back(work);
    work();
  }
  for (city::Diagnostics& d : found)
    std::move(d.messages.begin(), d.messages.end(), std::back_inserter(diagnostics.messages));
  return images;
}

}  // namespace vicus::assets
