#include <array>
#include <cmath>

#include "assets/materials/recipes.hpp"
#include "city/random.hpp"

namespace vicus::assets::recipes {
using namespace pattern;

Image glass() {
  // The dark of a room behind, a faint sky that fades up and down, the waviness of blown glass.
  const Field wave = fbm(kHalf, {4, 5}, 3, 0.5F, 701);
  const glm::vec3 dark = srgb(0x2b3135), sky = srgb(0x56636b);
  return finish(
      paint(kHalf,
            [&](int, int y, size_t i) {
              const float up = 0.5F - 0.5F * std::cos(static_cast<float>(y) / 256.0F * 6.2831853F);
              return Texel{glm::mix(dark, sky, glm::clamp(0.25F + 0.22F * up + 0.16F * wave[i], 0.0F, 1.0F)), wave[i]};
            }),
      {0.1F, 0, 4});
}

Image leadGlass() {
  // Diamond quarries, 4 across and 3 up to the picture, each set at its own slight angle.
  const Field wave = fbm(kFull, {8, 8}, 4, 0.5F, 721), speck = grain(kFull, 722);
  const glm::vec3 dark = srgb(0x2a3030), sky = srgb(0x5d6967), came = srgb(0x54565a);
  return finish(
      paint(kFull,
            [&](int x, int y, size_t i) {
              const float u = (static_cast<float>(x) + 0.5F) / 128, v = (static_cast<float>(y) + 0.5F) / 170.667F;
              const float a = u + v, b = u - v + 16;
              const int ia = static_cast<int>(a), ib = static_cast<int>(b);
              const float fa = a - static_cast<float>(ia), fb = b - static_cast<float>(ib);
              const float edge = glm::min(glm::min(fa, 1 - fa), glm::min(fb, 1 - fb)) * 102;
              // Diamonds repeat with the picture: 4 across and 3 up, seen along their two diagonals.
              const int column = ((ia + ib) % 8 + 8) % 8, row = ((ia - ib) % 6 + 6) % 6;
              const auto id = static_cast<uint32_t>(column * 8 + row);
              const float lead = smoothly(4.6F, 3.4F, edge);
              const float shine =
                  glm::clamp(0.12F + 0.5F * chance(id, 1) * (0.5F + 0.5F * fa) + 0.18F * wave[i], 0.0F, 1.0F);
              const glm::vec3 tint = glm::mix(glm::vec3(1), glm::vec3(0.90F, 1.0F, 0.94F), chance(id, 2));
              const glm::vec3 pane = glm::mix(dark, sky, shine) * tint;
              return Texel{glm::mix(pane, came * (1 + 0.08F * speck[i]), lead), lead * (2.5F - 0.08F * (4.6F - edge))};
            }),
      {0.34F, 0.12F, 5});
}

Image bark() {
  // Plates along y between furrows that split and join; cracks across the plates.
  const Cells plates = voronoi(kFull, {14, 4}, 0.9F, 8, 741, 3.2F),
              scales = voronoi(kFull, {30, 14}, 0.9F, 3, 742, 2.2F);
  const Field rough = fbm(kFull, {40, 24}, 4, 0.75F, 743), speck = grain(kFull, 744);
  const Field moss = fbm(kFull, {5, 5}, 4, 0.65F, 745), fibres = fbm(kFull, {60, 8}, 3, 0.7F, 746);
  const glm::vec3 ridge = srgb(0x7a7164), furrow = srgb(0x40382f), green = srgb(0x6d6f59);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float e = plates[i].edge + 1.6F * rough[i];
                        const float plate = smoothly(0.5F, 10.0F, e);
                        const float scale = smoothly(-0.3F, 2.6F, scales[i].edge + 0.6F * rough[i]);
                        const float up = plate * (0.78F + 0.22F * scale);
                        const float tone = 0.86F + 0.26F * chance(scales[i].id, 747) + 0.13F * rough[i] +
                                           0.08F * fibres[i] + 0.05F * speck[i];
                        const float grows = 0.35F * smoothly(0.2F, 0.9F, moss[i]) * up;
                        return Texel{glm::mix(glm::mix(furrow, ridge, up), green, grows) * tone,
                                     7 * plate + 1.6F * scale + 1.1F * rough[i] + 0.8F * fibres[i]};
                      }),
                {0.26F, 0.07F, 6});
}

namespace {

/// A cluster of foliage, darker within and below, on nothing.
Image foliage(const std::array<glm::vec3, 4>& greens, float leafLength, int leafCount, uint32_t seed) {
  Surface card{kFull, std::vector<Texel>(kFull.texels(), Texel{greens[0], 0}), std::vector<uint8_t>(kFull.texels(), 0)};
  city::Random random(seed);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  // Sprays: leaves sit round a few dozen twig ends, so that holes are as large as sprays and live through mip levels.
  struct Spray {
    glm::vec2 at;
    float radius;
  };
  std::vector<Spray> sprays;
  constexpr int kSprays = 76;
  for (int n = 0; n < kSprays; ++n) {
    // Spread evenly by the golden angle; a stride prime to their number mixes near and far.
    const int k = (n * 29) % kSprays;
    const float angle = 2.3999632F * static_cast<float>(k) + uniform(-0.3F, 0.3F);
    const float away = 212 * std::sqrt((static_cast<float>(k) + 0.5F) / kSprays) * uniform(0.86F, 1.04F);
    sprays.push_back({glm::vec2(256) + away * glm::vec2(std::cos(angle), std::sin(angle)), uniform(22, 38)});
  }
  for (int n = 0; n < leafCount; ++n) {
    const float depth = static_cast<float>(n) / static_cast<float>(leafCount);
    // Sprays are filled from the back to the front, each over a stretch of the order.
    const auto nearest = static_cast<size_t>(glm::clamp(depth * kSprays + uniform(-12, 12), 0.0F, kSprays - 1.0F));
    const Spray& spray = sprays[nearest];
    const float angle = uniform(0, 6.2831853F), away = spray.radius * std::sqrt(uniform(0, 1));
    const glm::vec2 at = spray.at + away * glm::vec2(std::cos(angle), std::sin(angle));
    const float lit = 0.55F + 0.40F * depth + 0.10F * (at.y - at.x) / 512 +
                      0.12F * (std::sin(angle) - std::cos(angle)) * away / spray.radius;
    const glm::vec3 colour =
        glm::mix(greens[random.below(4)], greens[random.below(4)], uniform(0, 1)) * lit * uniform(0.85F, 1.15F);
    const float length = leafLength * uniform(0.75F, 1.25F);
    const Leaf leaf{at, length, length * uniform(0.42F, 0.6F), angle + uniform(-0.9F, 0.9F), colour, 8 * depth};
    const float reach = 0.5F * leaf.length + 2;
    if (at.x < reach || at.y < reach || at.x > 512 - reach || at.y > 512 - reach) continue;
    drawLeaf(card, leaf);
  }
  return finish(card, {0.14F, 0.05F, 5});
}

}  // namespace

Image leaves() {
  return foliage({srgb(0x6a7549), srgb(0x5e6b43), srgb(0x798052), srgb(0x707a4e)}, 19, 3800, 760);
}

Image leavesDark() {
  return foliage({srgb(0x49553d), srgb(0x414d38), srgb(0x556044), srgb(0x4d5a44)}, 15, 5200, 780);
}

Image iron() {
  const Field clouds = fbm(kHalf, {5, 5}, 5, 0.65F, 801), pits = fbm(kHalf, {36, 36}, 3, 0.7F, 802),
              hammer = fbm(kHalf, {9, 9}, 2, 0.5F, 803);
  const glm::vec3 black = srgb(0x45423f), rust = srgb(0x6b4c3a);
  return finish(
      paint(kHalf,
            [&](int, int, size_t i) {
              const float t = 0.6F * smoothly(0.15F, 1.0F, clouds[i] + 0.4F * pits[i]);
              return Texel{glm::mix(black, rust, t) * (1 + 0.12F * pits[i]), 0.7F * pits[i] + 1.6F * hammer[i]};
            }),
      {0.36F, 0.2F, 4});
}

Image wool() {
  // A plain weave, fulled: threads over and under, half lost in the nap. Pale, so that a tint dyes it.
  const Field nap = fbm(kHalf, {40, 40}, 3, 0.7F, 821), folds = fbm(kHalf, {4, 4}, 3, 0.5F, 822),
              speck = grain(kHalf, 823);
  return finish(paint(kHalf,
                      [&](int x, int y, size_t i) {
                        const float cx = static_cast<float>(x % 8) / 8 * 2 - 0.875F,
                                    cy = static_cast<float>(y % 8) / 8 * 2 - 0.875F;
                        const bool over = ((x / 8) + (y / 8)) % 2 == 0;
                        const float thread = over ? 1 - cy * cy : 1 - cx * cx;
                        const float tone = 1 + 0.05F * nap[i] + 0.03F * folds[i] + 0.04F * speck[i];
                        return Texel{srgb(0xbfb5a4) * tone * (0.9F + 0.1F * thread),
                                     1.1F * thread + 0.7F * nap[i] + 0.2F * speck[i]};
                      }),
                {0.28F, 0.2F, 3});
}

}  // namespace vicus::assets::recipes
