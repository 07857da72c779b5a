#include "scenegraph/texture_classes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

namespace vicus::scenegraph {
namespace {

using Pixels = std::vector<glm::vec4>;  // linear rgb times alpha, alpha

const std::array<float, 256>& linearOfSrgb() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) {
      const double s = static_cast<double>(i) / 255;
      t[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return table;
}

/// Weighted mean of `from` pixels over [lo, hi) along one axis: the box filter that goes through `take(index, weight)`.
template <typename Take>
void cover(double lo, double hi, int count, const Take& take) {
  const int first = std::clamp(static_cast<int>(std::floor(lo)), 0, count - 1);
  const int last = std::clamp(static_cast<int>(std::ceil(hi)) - 1, first, count - 1);
  for (int i = first; i <= last; ++i) {
    const double part = std::min(hi, i + 1.0) - std::max(lo, static_cast<double>(i));
    take(i, static_cast<float>(part / (hi - lo)));
  }
}

/// Box-filtered to size × size; enlarging repeats pixels.
Pixels resampled(const assets::Image& image, int size) {
  const auto& linear = linearOfSrgb();
  Pixels rows(static_cast<size_t>(size) * static_cast<size_t>(image.height));
  const double sx = static_cast<double>(image.width) / size, sy = static_cast<double>(image.height) / size;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < size; ++x) {
      glm::vec4 sum(0);
      cover(x * sx, (x + 1) * sx, image.width, [&](int i, float weight) {
        const uint8_t* p = image.rgba.data() +
                           4 * (static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(i));
        const float a = static_cast<float>(p[3]) / 255;
        sum += weight * glm::vec4(a * glm::vec3(linear[p[0]], linear[p[1]], linear[p[2]]), a);
      });
      rows[static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x)] = sum;
    }
  Pixels out(static_cast<size_t>(size) * static_cast<size_t>(size));
  for (int y = 0; y < size; ++y)
    cover(y * sy, (y + 1) * sy, image.height, [&](int i, float weight) {
      const glm::vec4* from = rows.data() + static_cast<size_t>(i) * static_cast<size_t>(size);
      glm::vec4* to = out.data() + static_cast<size_t>(y) * static_cast<size_t>(size);
      for (int x = 0; x < size; ++x) to[x] += weight * from[x];
    });
  return out;
}

Pixels halved(const Pixels& from, int size) {
  const auto half = static_cast<size_t>(size / 2), row = static_cast<size_t>(size);
  Pixels out(half * half);
  for (size_t y = 0; y < half; ++y)
    for (size_t x = 0; x < half; ++x) {
      const glm::vec4* p = from.data() + 2 * y * row + 2 * x;
      out[y * half + x] = 0.25f * (p[0] + p[1] + p[row] + p[row + 1]);
    }
  return out;
}

/// The factor on alpha that makes `fraction` of the pixels reach 0.5.
float alphaScale(const Pixels& pixels, double fraction) {
  if (fraction <= 0 || fraction >= 1) return 1;
  std::vector<float> alphas;
  alphas.reserve(pixels.size());
  for (const glm::vec4& p : pixels) alphas.push_back(p.a);
  const size_t rank =
      std::min(static_cast<size_t>((1 - fraction) * static_cast<double>(alphas.size())), alphas.size() - 1);
  std::nth_element(alphas.begin(), alphas.begin() + static_cast<std::ptrdiff_t>(rank), alphas.end());
  return alphas[rank] > 1e-3f ? 0.5f / alphas[rank] : 1;
}

std::vector<uint8_t> encoded(const Pixels& pixels, float scaleOfAlpha) {
  std::vector<uint8_t> out(pixels.size() * 4);
  for (size_t i = 0; i < pixels.size(); ++i) {
    const glm::vec4& p = pixels[i];
    const glm::vec3 colour = glm::vec3(p) / std::max(p.a, 1e-4f);
    for (int k = 0; k < 3; ++k)
      out[4 * i + static_cast<size_t>(k)] =
          static_cast<uint8_t>(255 * std::sqrt(std::clamp(colour[k], 0.0f, 1.0f)) + 0.5f);
    out[4 * i + 3] = static_cast<uint8_t>(255 * std::clamp(p.a * scaleOfAlpha, 0.0f, 1.0f) + 0.5f);
  }
  return out;
}

uint64_t bytesOf(std::span<const TextureClass> classes) {
  uint64_t sum = 0;
  for (const TextureClass& c : classes) sum += c.layers * layerBytes(c.size);
  return sum;
}

}  // namespace

uint64_t layerBytes(int size) {
  uint64_t sum = 0;
  for (int s = size; s > 0; s /= 2) sum += 4 * static_cast<uint64_t>(s) * static_cast<uint64_t>(s);
  return sum;
}

TexturePlan planTextures(std::span<const TextureDemand> demands, uint64_t budgetBytes) {
  TexturePlan plan;
  // A class for each size and wrap, largest first.
  const auto sizeOf = [](const TextureDemand& d) {
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(d.size, 1, kLargestTexture))));
  };
  std::vector<std::vector<uint32_t>> members;
  for (uint32_t i = 0; i < demands.size(); ++i) {
    const int size = sizeOf(demands[i]);
    size_t c = 0;
    while (c < plan.classes.size() && (plan.classes[c].size != size || plan.classes[c].repeat != demands[i].repeat))
      ++c;
    if (c == plan.classes.size()) {
      c = 0;
      while (c < plan.classes.size() && plan.classes[c].size >= size) ++c;
      plan.classes.insert(plan.classes.begin() + static_cast<std::ptrdiff_t>(c), {size, demands[i].repeat, 0});
      members.insert(members.begin() + static_cast<std::ptrdiff_t>(c), std::vector<uint32_t>());
    }
    members[c].push_back(i);
    ++plan.classes[c].layers;
  }

  // Join a class to the next larger of its wrap, the smallest first, where that costs little or must be.
  for (size_t c = plan.classes.size(); c-- > 1;) {
    size_t larger = c;
    while (larger-- > 0)
      if (plan.classes[larger].repeat == plan.classes[c].repeat) break;
    if (larger >= plan.classes.size()) continue;
    const uint64_t joined = bytesOf(plan.classes) + plan.classes[c].layers * (layerBytes(plan.classes[larger].size) -
                                                                              layerBytes(plan.classes[c].size));
    if (joined > budgetBytes / 4 && plan.classes.size() <= kMostTextureClasses) continue;
    plan.classes[larger].layers += plan.classes[c].layers;
    members[larger].insert(members[larger].end(), members[c].begin(), members[c].end());
    plan.classes.erase(plan.classes.begin() + static_cast<std::ptrdiff_t>(c));
    members.erase(members.begin() + static_cast<std::ptrdiff_t>(c));
  }

  for (plan.bytes = bytesOf(plan.classes); plan.bytes > budgetBytes; plan.bytes = bytesOf(plan.classes)) {
    const auto largest =
        std::max_element(plan.classes.begin(), plan.classes.end(), [](const TextureClass& a, const TextureClass& b) {
          return (a.size == 1 ? 0 : a.layers * layerBytes(a.size)) < (b.size == 1 ? 0 : b.layers * layerBytes(b.size));
        });
    if (largest->size == 1) break;
    largest->size /= 2;
    ++plan.halvings;
  }

  plan.places.resize(demands.size());
  for (uint32_t c = 0; c < plan.classes.size(); ++c)
    for (uint32_t layer = 0; layer < members[c].size(); ++layer) plan.places[members[c][layer]] = {c, layer};
  return plan;
}

std::vector<std::vector<uint8_t>> mipLevels(const assets::Image& image, int size) {
  assets::Image grey;
  const bool usable = image.width > 0 && image.height > 0 &&
                      image.rgba.size() == 4 * static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
  if (!usable) grey = {1, 1, {128, 128, 128, 255}};
  const assets::Image& source = usable ? image : grey;

  Pixels level = resampled(source, size);
  const bool holes = hasHoles(source);
  const auto covered =
      static_cast<double>(std::count_if(level.begin(), level.end(), [](const glm::vec4& p) { return p.a >= 0.5f; }));
  const double fraction = covered / static_cast<double>(level.size());

  std::vector<std::vector<uint8_t>> levels;
  levels.push_back(encoded(level, 1));
  for (int s = size; s > 1; s /= 2) {
    level = halved(level, s);
    levels.push_back(encoded(level, holes ? alphaScale(level, fraction) : 1));
  }
  return levels;
}

bool hasHoles(const assets::Image& image) {
  constexpr uint8_t kOpaque = 229;  // 0.9
  for (size_t i = 3; i < image.rgba.size(); i += 4)
    if (image.rgba[i] < kOpaque) return true;
  return false;
}

std::vector<uint8_t> overSurroundings(std::span<const uint8_t> level, int size, std::span<const uint8_t> coarse,
                                      int coarseSize) {
  std::vector<uint8_t> out(level.size());
  const auto texel = [&](int x, int y, size_t channel) {
    const auto wrapped = [&](int v) { return static_cast<size_t>((v + coarseSize) % coarseSize); };
    return static_cast<float>(coarse[4 * (wrapped(y) * static_cast<size_t>(coarseSize) + wrapped(x)) + channel]);
  };
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::vec2 at = (glm::vec2(x, y) + 0.5f) * static_cast<float>(coarseSize) / static_cast<float>(size) - 0.5f;
      const glm::vec2 floor = glm::floor(at), t = at - floor;
      const int cx = static_cast<int>(floor.x), cy = static_cast<int>(floor.y);
      const size_t pixel = 4 * (static_cast<size_t>(y) * static_cast<size_t>(size) + static_cast<size_t>(x));
      for (size_t k = 0; k < 4; ++k) {
        const float mean = glm::mix(glm::mix(texel(cx, cy, k), texel(cx + 1, cy, k), t.x),
                                    glm::mix(texel(cx, cy + 1, k), texel(cx + 1, cy + 1, k), t.x), t.y);
        out[pixel + k] = static_cast<uint8_t>(
            std::min(255.0f, 128 * static_cast<float>(level[pixel + k]) / std::max(mean, 1.0f) + 0.5f));
      }
    }
  return out;
}

}  // namespace vicus::scenegraph
