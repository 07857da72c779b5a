#include <array>
#include <cmath>

#include "assets/materials/recipes.hpp"

namespace vicus::assets::recipes {
using namespace pattern;

namespace {

/// The whole number nearest to `count`, at least `least`.
int atLeast(int least, float count) {
  return glm::max(least, static_cast<int>(std::lround(count)));
}

}  // namespace

glm::vec3 plasterColour() {
  return srgb(0xcbc0aa);
}

Surface plasterWall(Size size, glm::vec2 metres, glm::vec3 base, uint32_t seed) {
  const glm::ivec2 perMetre(glm::max(glm::vec2(1), metres));
  // Clouds of uneven curing, the arcs of the float, sand.
  const Field clouds = fbm(size, perMetre * 3, 5, 0.6F, seed + 1);
  const Field sweep = fbm(size, {perMetre.x * 5, perMetre.y * 6}, 2, 0.45F, seed + 2);
  const Field sand = fbm(size, perMetre * 56, 2, 0.8F, seed + 3);
  const Field speck = grain(size, seed + 4);
  const Cells cracks = voronoi(size, perMetre * 3, 0.95F, 9, seed + 5);
  const glm::vec3 warm(1.015F, 1.0F, 0.975F);
  return paint(size, [&](int, int, size_t i) {
    const float crack = smoothly(0.9F, 0.1F, cracks[i].edge) * smoothly(0.35F, 0.7F, sweep[i]);
    const float tone = 1 + 0.05F * clouds[i] + 0.04F * sand[i] + 0.03F * speck[i] - 0.16F * crack;
    const glm::vec3 tinted = glm::mix(glm::vec3(1), warm, glm::clamp(0.5F + clouds[i], 0.0F, 1.0F));
    return Texel{base * tinted * tone, 1.7F * sweep[i] + 0.3F * sand[i] + 0.25F * speck[i] - 0.7F * crack};
  });
}

Image plaster() {
  return finish(plasterWall(kFull, {2, 2}, plasterColour(), 100), {0.32F, 0.20F, 6});
}

Image limewash() {
  // Coats brushed crosswise; where they wear thin the plaster below shows.
  const Field upright = fbm(kFull, {96, 10}, 3, 0.6F, 121), level = fbm(kFull, {10, 96}, 3, 0.6F, 122);
  const Field which = fbm(kFull, {7, 7}, 2, 0.5F, 123), worn = fbm(kFull, {6, 6}, 5, 0.62F, 124);
  const Field sand = fbm(kFull, {110, 110}, 2, 0.8F, 125), sweep = fbm(kFull, {10, 12}, 2, 0.45F, 126);
  const glm::vec3 coat = srgb(0xe2dccd), under = srgb(0xc8b898);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float brush = glm::mix(upright[i], level[i], smoothly(-0.2F, 0.2F, which[i]));
                        const float thin = 0.40F * smoothly(0.35F, 1.05F, worn[i] + 0.2F * brush);
                        const float tone = 1 + 0.012F * brush + 0.025F * sand[i] + 0.02F * worn[i];
                        return Texel{glm::mix(coat, under, thin) * tone,
                                     0.22F * brush + 0.4F * sand[i] + 1.7F * sweep[i] - 0.8F * thin};
                      }),
                {0.28F, 0.2F, 6});
}

Surface brickWall(Size size, glm::vec2 metres, bool dark, uint32_t seed) {
  // Bricks of 225 mm × 75 mm with their joints, as many as come nearest.
  const int stretchers = atLeast(1, metres.x / 0.225F);
  const int rows = 2 * atLeast(1, metres.y / 0.15F);
  const float texelsPerMetre = static_cast<float>(size.height) / metres.y;
  const float joint = 0.0045F * texelsPerMetre;  // half of it
  const std::array<glm::vec3, 6> palette =
      dark ? std::array{srgb(0x6a473c), srgb(0x5d4038), srgb(0x744e41), srgb(0x543e39), srgb(0x674c44), srgb(0x4b3c3b)}
           : std::array{srgb(0x96654f), srgb(0x885a48), srgb(0x9e7159), srgb(0x8f6350), srgb(0x7c5546), srgb(0xa37e67)};
  const glm::vec3 mortar = dark ? srgb(0x9a8d7a) : srgb(0xbcb09b);

  const Cells bond = courses(size, englishBond(size, rows, stretchers, seed), 2.2F, 0.9F, seed + 1);
  std::vector<glm::vec3> bricks(bond.count);
  for (uint32_t id = 0; id < bond.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id + seed, salt) * 6)]; };
    bricks[id] = glm::mix(pick(1), pick(2), chance(id + seed, 3)) * (0.86F + 0.26F * chance(id + seed, 4));
    if (chance(id + seed, 5) < 0.05F) bricks[id] *= 0.68F;  // overburnt ends
  }
  const Field clouds = fbm(size, {5, 5}, 3, 0.6F, seed + 2), face = fbm(size, {40, 48}, 4, 0.7F, seed + 3);
  const Field speck = grain(size, seed + 4);
  return paint(size, [&](int, int, size_t i) {
    const CellTexel& c = bond[i];
    const float in = smoothly(joint - 0.5F, joint + 0.7F, c.edge + 0.35F * face[i]);
    const float rounded = smoothly(joint - 0.6F, joint + 2.2F, c.edge);
    const glm::vec3 brick = bricks[c.id] * (1 + 0.13F * face[i] + 0.06F * speck[i]);
    const glm::vec3 lime = mortar * (0.93F + 0.10F * face[i] + 0.06F * speck[i]);
    return Texel{glm::mix(lime, brick, in) * (1 + 0.05F * clouds[i]),
                 1.5F * rounded + 0.35F * face[i] * in + 0.22F * speck[i]};
  });
}

Image brick() {
  return finish(brickWall(kFull, {1.8F, 1.8F}, false, 140), {0.42F, 0.26F, 4});
}
Image brickDark() {
  return finish(brickWall(kFull, {1.8F, 1.8F}, true, 160), {0.42F, 0.26F, 4});
}

Image rubble() {
  const Cells stones = voronoi(kFull, {9, 14}, 0.78F, 7, 180);
  const std::array<glm::vec3, 5> palette{srgb(0x9d907a), srgb(0x8a8072), srgb(0xaa9c82), srgb(0x968a7e),
                                         srgb(0x857661)};
  std::vector<glm::vec3> colours(stones.count);
  for (uint32_t id = 0; id < stones.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id, salt) * 5)]; };
    colours[id] = glm::mix(pick(1), pick(2), chance(id, 3)) * (0.84F + 0.28F * chance(id, 4));
  }
  const Field rough = fbm(kFull, {20, 20}, 5, 0.68F, 181), clouds = fbm(kFull, {4, 4}, 3, 0.6F, 182);
  const Field speck = grain(kFull, 183), mud = fbm(kFull, {40, 40}, 3, 0.7F, 184);
  const glm::vec3 mortar = srgb(0xb3a68d);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const CellTexel& c = stones[i];
                        const float e = c.edge + 0.8F * rough[i];
                        const float in = smoothly(1.9F, 3.3F, e);
                        const float dome = smoothly(1.4F, 8.0F, e);
                        // A dressed face leans a little, each its own way.
                        const float lean =
                            1.6F * ((chance(c.id, 6) - 0.5F) * c.across + (chance(c.id, 7) - 0.5F) * c.up);
                        const glm::vec3 stone = colours[c.id] * (1 + 0.12F * rough[i] + 0.05F * speck[i]);
                        const glm::vec3 lime = mortar * (0.95F + 0.08F * mud[i] + 0.06F * speck[i]);
                        return Texel{glm::mix(lime, stone, in) * (1 + 0.04F * clouds[i]),
                                     2.6F * dome + in * (1.4F * rough[i] + lean) + 0.5F * mud[i] + 0.2F * speck[i]};
                      }),
                {0.34F, 0.15F, 6});
}

Surface ashlarWall(Size size, glm::vec2 metres, uint32_t seed) {
  const int rows = atLeast(2, metres.y / 0.32F);
  const int stones = atLeast(2, metres.x / 0.62F);
  const float texelsPerMetre = static_cast<float>(size.height) / metres.y;
  const float joint = 0.004F * texelsPerMetre;
  const Cells bond = courses(size, ashlarCourses(size, rows, stones, 0.22F, seed), 1.2F, 0.6F, seed + 1);
  const std::array<glm::vec3, 4> palette{srgb(0xc0b59d), srgb(0xb7ac97), srgb(0xc5bba5), srgb(0xb2a790)};
  std::vector<glm::vec3> colours(bond.count);
  for (uint32_t id = 0; id < bond.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id + seed, salt) * 4)]; };
    colours[id] = glm::mix(pick(1), pick(2), chance(id + seed, 3)) * (0.92F + 0.14F * chance(id + seed, 4));
  }
  const Field clouds = fbm(size, {4, 4}, 4, 0.6F, seed + 2), face = fbm(size, {28, 28}, 4, 0.66F, seed + 3);
  const Field bedding = fbm(size, {6, 40}, 3, 0.6F, seed + 4), speck = grain(size, seed + 5);
  return paint(size, [&](int, int, size_t i) {
    const CellTexel& c = bond[i];
    const float e = c.edge + 0.3F * face[i];
    const float in = smoothly(joint - 0.4F, joint + 0.9F, e);
    const float rounded = smoothly(joint - 0.4F, joint + 2.6F, e);
    const glm::vec3 stone = colours[c.id] * (1 + 0.05F * face[i] + 0.035F * bedding[i] + 0.04F * speck[i]);
    const glm::vec3 lime = srgb(0xa89d89) * (0.92F + 0.08F * face[i] + 0.05F * speck[i]);
    return Texel{glm::mix(lime, stone, in) * (1 + 0.045F * clouds[i]),
                 1.3F * rounded + in * (0.8F * face[i] + 0.5F * bedding[i]) + 0.22F * speck[i]};
  });
}

Image ashlar() {
  return finish(ashlarWall(kFull, {2.5F, 2.5F}, 200), {0.34F, 0.24F, 4});
}

Image flint() {
  // Knapped flints: dark glassy faces with white rims, close set in pale lime.
  const Cells flints = voronoi(kFull, {19, 22}, 0.85F, 2.6F, 220);
  const std::array<glm::vec3, 5> palette{srgb(0x4f5154), srgb(0x6a6963), srgb(0x3f4347), srgb(0x827d72),
                                         srgb(0x5b5853)};
  std::vector<glm::vec3> colours(flints.count);
  for (uint32_t id = 0; id < flints.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id, salt) * 5)]; };
    colours[id] = glm::mix(pick(1), pick(2), chance(id, 3)) * (0.8F + 0.35F * chance(id, 4));
    if (chance(id, 5) < 0.16F) colours[id] = glm::mix(colours[id], srgb(0xb9b3a4), 0.7F);  // left in its rind
  }
  const Field swirl = fbm(kFull, {24, 24}, 4, 0.6F, 221), speck = grain(kFull, 222),
              mud = fbm(kFull, {50, 50}, 3, 0.7F, 223);
  const glm::vec3 mortar = srgb(0xa79d89), rind = srgb(0xb5afa0);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const CellTexel& c = flints[i];
                        const float e = c.edge + 0.45F * swirl[i];
                        const float in = smoothly(1.5F, 2.6F, e), inner = smoothly(2.6F, 4.2F, e + 0.9F * swirl[i]);
                        const glm::vec3 face = colours[c.id] * (1 + 0.18F * swirl[i] + 0.05F * speck[i]);
                        const glm::vec3 stone = glm::mix(glm::mix(rind, face, 0.55F), face, inner);
                        const glm::vec3 lime = mortar * (0.92F + 0.10F * mud[i] + 0.07F * speck[i]);
                        const float lean =
                            1.3F * ((chance(c.id, 6) - 0.5F) * c.across + (chance(c.id, 7) - 0.5F) * c.up);
                        return Texel{glm::mix(lime, stone, in),
                                     2.2F * smoothly(1.0F, 6.0F, e) + in * (lean + 0.5F * swirl[i]) + 0.5F * mud[i]};
                      }),
                {0.36F, 0.2F, 5});
}

Image concrete() {
  const Field clouds = fbm(kFull, {4, 4}, 5, 0.6F, 241), pores = fbm(kFull, {90, 90}, 2, 0.8F, 242),
              speck = grain(kFull, 243);
  const Field boards = fbm(kFull, {3, 24}, 3, 0.6F, 244);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float pore = smoothly(0.85F, 1.2F, pores[i]);
                        const float tone = 1 + 0.05F * clouds[i] + 0.012F * boards[i] + 0.03F * speck[i] - 0.2F * pore;
                        return Texel{srgb(0xa5a29a) * tone, 0.3F * speck[i] + 0.35F * boards[i] - 1.2F * pore};
                      }),
                {0.3F, 0.2F, 4});
}

}  // namespace vicus::assets::recipes
