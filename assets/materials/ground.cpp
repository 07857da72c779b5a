#include <array>

#include "assets/materials/recipes.hpp"
#include "city/random.hpp"

namespace vicus::assets::recipes {
using namespace pattern;
namespace {

/// Blades strewn at random over a surface, each leaning its own way.
struct Sward {
  int blades;
  float shortest, longest, width;  ///< texels
  float lean;                      ///< 0: in all directions, 1: all up the picture
  std::array<glm::vec3, 5> palette;
  uint32_t seed;
};

void strew(Surface& surface, const Sward& sward, const Field& patches, float threshold) {
  city::Random random(sward.seed);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  const glm::vec2 size(surface.size.width, surface.size.height);
  for (int n = 0; n < sward.blades; ++n) {
    const glm::vec2 at(uniform(0, size.x), uniform(0, size.y));
    const float length = uniform(sward.shortest, sward.longest);
    glm::vec2 way(uniform(-1, 1), uniform(-1 + 2 * sward.lean, 1));
    const glm::vec3 colour = sward.palette[random.below(5)] * uniform(0.70F, 1.22F);
    const float width = sward.width * uniform(0.7F, 1.2F), height = uniform(0.8F, 3.0F);
    const float patch =
        patches[static_cast<size_t>(at.y) * static_cast<size_t>(surface.size.width) + static_cast<size_t>(at.x)];
    if (patch + uniform(-0.3F, 0.3F) < threshold) continue;
    drawStroke(surface, {at, at + way * length, width, 0.35F * width, colour * (1 + 0.10F * patch), height});
  }
}

/// Soil: crumbs over a soft, uneven ground.
Surface soil(Size size, glm::vec3 base, float crumbs, uint32_t seed) {
  const Field clouds = fbm(size, {5, 5}, 4, 0.6F, seed), lumps = fbm(size, {30, 30}, 4, 0.7F, seed + 1),
              speck = grain(size, seed + 2);
  return paint(size, [&](int, int, size_t i) {
    return Texel{base * (1 + 0.06F * clouds[i] + 0.12F * lumps[i] + 0.06F * speck[i]),
                 crumbs * (1.6F * lumps[i] + 0.3F * speck[i]) + 0.6F * clouds[i]};
  });
}

/// Single pebbles pressed into a surface, on a share of the cells of a lattice.
void pebbles(Surface& surface, glm::ivec2 cells, float share, float radius, const std::array<glm::vec3, 3>& palette,
             uint32_t seed) {
  const Cells lattice = voronoi(surface.size, cells, 0.9F, 2, seed);
  const float cell = static_cast<float>(surface.size.width) / static_cast<float>(cells.x);
  for (size_t i = 0; i < surface.texels.size(); ++i) {
    const CellTexel& c = lattice[i];
    if (chance(c.id, seed + 1) >= share) continue;
    const float r = radius * (0.5F + 0.7F * chance(c.id, seed + 2));
    const float squash = 0.75F + 0.5F * chance(c.id, seed + 3);
    const float d2 = (c.across * c.across * squash + c.up * c.up / squash) * cell * cell * 0.25F / (r * r);
    if (d2 >= 1) continue;
    const float in = smoothly(1.0F, 0.7F, d2);
    const glm::vec3 stone =
        palette[static_cast<size_t>(chance(c.id, seed + 4) * 3)] * (0.8F + 0.35F * chance(c.id, seed + 5));
    Texel& t = surface.texels[i];
    t.colour = glm::mix(t.colour, stone, in);
    t.height += in * (0.6F + 1.8F * (1 - d2)) * r * 0.25F;
  }
}

}  // namespace

Image cobbles() {
  const Cells stones = voronoi(kFull, {17, 19}, 0.62F, 2.5F, 500);
  const std::array<glm::vec3, 5> palette{srgb(0x7f7a72), srgb(0x716a60), srgb(0x8b847a), srgb(0x6a6867),
                                         srgb(0x86796a)};
  std::vector<glm::vec3> colours(stones.count);
  for (uint32_t id = 0; id < stones.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id, salt) * 5)]; };
    colours[id] = glm::mix(pick(1), pick(2), chance(id, 3)) * (0.82F + 0.3F * chance(id, 4));
  }
  const Field rough = fbm(kFull, {40, 40}, 4, 0.7F, 501), clouds = fbm(kFull, {4, 4}, 3, 0.6F, 502),
              speck = grain(kFull, 503);
  const glm::vec3 dirt = srgb(0x5d5244);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const CellTexel& c = stones[i];
                        // Corners are rubbed off.
                        const float r2 = glm::clamp(c.across * c.across + c.up * c.up, 0.0F, 1.6F);
                        const float corner = 3.2F * glm::max(0.0F, r2 - 0.8F);
                        const float e = c.edge + 0.5F * rough[i] - corner;
                        const float in = smoothly(1.0F, 2.5F, e);
                        const float dome = smoothly(0.6F, 9.0F, e) * (1 - 0.25F * r2);
                        // Feet have rubbed the crowns paler.
                        const glm::vec3 stone =
                            colours[c.id] * (1 + 0.10F * rough[i] + 0.05F * speck[i]) * (0.9F + 0.16F * dome);
                        const glm::vec3 gap = dirt * (0.85F + 0.15F * rough[i] + 0.08F * speck[i]);
                        return Texel{glm::mix(gap, stone, in) * (1 + 0.05F * clouds[i]),
                                     6.5F * dome + 0.7F * rough[i] + 0.2F * speck[i]};
                      }),
                {0.34F, 0.11F, 6});
}

Image earth() {
  Surface ground = soil(kFull, srgb(0x8a7860), 0.7F, 520);
  pebbles(ground, {46, 46}, 0.22F, 3.2F, {srgb(0x948a7a), srgb(0x7d7263), srgb(0xa39783)}, 523);
  pebbles(ground, {22, 22}, 0.12F, 6.0F, {srgb(0x8f8576), srgb(0x7a7064), srgb(0x9c917f)}, 524);
  return finish(ground, {0.32F, 0.16F, 5});
}

Image grass() {
  Surface ground = soil(kFull, srgb(0x4a4a33), 0.6F, 540);
  const Field patches = fbm(kFull, {5, 5}, 4, 0.6F, 543);
  strew(
      ground,
      {9000, 9, 20, 1.7F, 0.25F, {srgb(0x5e6942), srgb(0x53603c), srgb(0x6a724a), srgb(0x767854), srgb(0x596640)}, 544},
      patches, -9);
  strew(
      ground,
      {5000, 8, 18, 1.4F, 0.25F, {srgb(0x6e774d), srgb(0x7b8056), srgb(0x636f47), srgb(0x8b8764), srgb(0x727d52)}, 545},
      patches, -0.45F);
  return finish(ground, {0.26F, 0.16F, 5});
}

Image field() {
  // Strips of stubble after harvest, in rows along y.
  const Field clouds = fbm(kFull, {4, 4}, 4, 0.6F, 560), lumps = fbm(kFull, {30, 30}, 4, 0.7F, 561),
              speck = grain(kFull, 562);
  Surface ground = paint(kFull, [&](int x, int, size_t i) {
    const float phase = static_cast<float>(x % 32) / 32 * 2 - 1;
    const float ridge = 1 - phase * phase;
    return Texel{
        srgb(0x83755a) * (1 + 0.06F * clouds[i] + 0.12F * lumps[i] + 0.05F * speck[i]) * (0.93F + 0.1F * ridge),
        1.6F * ridge + 1.2F * lumps[i]};
  });
  city::Random random(563);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  const std::array<glm::vec3, 4> straw{srgb(0xa3956c), srgb(0x91835b), srgb(0xb1a47c), srgb(0x8a8360)};
  for (int n = 0; n < 7000; ++n) {
    const float row = 32 * static_cast<float>(random.below(16)) + 16;
    const glm::vec2 at(row + uniform(-7, 7) + uniform(-6, 6), uniform(0, 512));
    const glm::vec2 to = at + glm::vec2(uniform(-5, 5), uniform(-3, 9));
    drawStroke(ground, {at, to, 1.4F, 0.8F, straw[random.below(4)] * uniform(0.75F, 1.15F), uniform(0.5F, 2.5F)});
  }
  return finish(ground, {0.28F, 0.14F, 5});
}

Image garden() {
  // Beds of herbs and greens in rows.
  Surface ground = soil(kFull, srgb(0x5d4f41), 1.0F, 580);
  city::Random random(583);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  const std::array<glm::vec3, 4> greens{srgb(0x5f6d47), srgb(0x6e7b53), srgb(0x576545), srgb(0x7a815b)};
  for (int row = 0; row < 8; ++row)
    for (int plant = 0; plant < 11; ++plant) {
      const uint32_t id = static_cast<uint32_t>(row * 16 + plant);
      if (chance(id, 584) < 0.1F) continue;
      const glm::vec2 centre(46.5F * (static_cast<float>(plant) + 0.5F) + 12 * (chance(id, 585) - 0.5F),
                             64 * (static_cast<float>(row) + 0.5F) + 10 * (chance(id, 586) - 0.5F));
      const glm::vec3 green =
          greens[static_cast<size_t>(((row * 7) % 4 + static_cast<int>(chance(id, 587) * 1.6F)) % 4)];
      const float spread = row % 3 == 0 ? 19.0F : (row % 3 == 1 ? 24.0F : 15.0F);
      for (int ring = 0; ring < 40; ++ring) {
        const float angle = uniform(0, 6.2832F),
                    away = spread * (1 - static_cast<float>(ring) / 40) * uniform(0.6F, 1.1F);
        const glm::vec2 at = centre + away * glm::vec2(glm::cos(angle), glm::sin(angle));
        const float light = 0.60F + 0.5F * static_cast<float>(ring) / 40;
        drawLeaf(ground, {at, uniform(11, 19), uniform(5, 10), angle + uniform(-0.5F, 0.5F),
                          green * light * uniform(0.85F, 1.15F), 1.5F + 0.1F * static_cast<float>(ring)});
      }
    }
  return finish(ground, {0.3F, 0.12F, 6});
}

Image bank() {
  // The river's edge: mud, stones, sparse grass.
  Surface ground = soil(kFull, srgb(0x6b6049), 1.0F, 600);
  pebbles(ground, {30, 30}, 0.3F, 5.0F, {srgb(0x7d776a), srgb(0x6a655b), srgb(0x8e8778)}, 603);
  const Field patches = fbm(kFull, {5, 5}, 4, 0.6F, 604);
  strew(
      ground,
      {9000, 8, 20, 1.6F, 0.3F, {srgb(0x5f6a3e), srgb(0x6f744a), srgb(0x56613b), srgb(0x7f7d55), srgb(0x66703f)}, 605},
      patches, 0.05F);
  return finish(ground, {0.3F, 0.14F, 5});
}

Image water() {
  // Slow swell and ripples; the sky in it is the shaders' part.
  const Field swell = fbm(kFull, {5, 6}, 2, 0.5F, 621), ripples = fbm(kFull, {14, 19}, 3, 0.5F, 622);
  const glm::vec3 deep = srgb(0x434b44), shallow = srgb(0x555d53);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float t = glm::clamp(0.45F + 0.30F * swell[i] + 0.25F * ripples[i], 0.0F, 1.0F);
                        return Texel{glm::mix(deep, shallow, t), 2.0F * ripples[i] + 2.0F * swell[i]};
                      }),
                {0.34F, 0.03F, 5});
}

}  // namespace vicus::assets::recipes
