#include "assets/import/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

namespace vicus::assets {

namespace fs = std::filesystem;

std::string findPicture(const std::string& modelFile, const std::string& name) {
  constexpr size_t kLongestName = 1000;
  if (name.empty() || name.size() > kLongestName || name.find("://") != std::string::npos ||
      name.find('\0') != std::string::npos)
    return {};
  std::string plain = name;
  std::replace(plain.begin(), plain.end(), '\\', '/');
  std::error_code error;
  const fs::path folder = fs::path(modelFile).parent_path(), written(plain);
  std::vector<fs::path> places{written.is_absolute() ? written : folder / written};
  for (const char* usual : {"appearance", "appearances", "textures", "images", ""})
    places.push_back(folder / usual / written.filename());
  for (const fs::path& place : places)
    if (fs::is_regular_file(place, error)) return place.string();
  return {};
}

glm::vec3 linearColour(glm::vec3 srgb) {
  glm::vec3 out(1);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(srgb[k])) continue;
    const double s = std::clamp(static_cast<double>(srgb[k]), 0.0, 1.0);
    out[k] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
  }
  return out;
}

}  // namespace vicus::assets
