#include <array>

#include "assets/materials/recipes.hpp"
#include "city/random.hpp"

namespace vicus::assets::recipes {
using namespace pattern;
namespace {

/// Tiles or slates lapped in courses: each lies thick at its foot over the one below.
struct Lapped {
  int rows, perRow;
  float irregular;  ///< of a tile's width
  float thickness;  ///< texels
  float roughness;  ///< 0 … 1
  float tongue;     ///< how unevenly the feet hang, texels
  std::array<glm::vec3, 5> palette;
  glm::vec3 lichen;
  float lichenCover;  ///< 0 … 1
  uint32_t seed;
};

Surface lappedRoof(const Lapped& look) {
  const Size size = kFull;
  const Cells tiles = courses(size, runningBond(size, look.rows, look.perRow, 0.5F, look.irregular, look.seed), 0,
                              look.tongue, look.seed + 1);
  const float rowTexels = static_cast<float>(size.height) / static_cast<float>(look.rows);
  const float tileTexels = static_cast<float>(size.width) / static_cast<float>(look.perRow);
  struct TileLook {
    glm::vec3 colour;
    float drop, tilt;
  };
  std::vector<TileLook> looks(tiles.count);
  for (uint32_t id = 0; id < tiles.count; ++id) {
    const uint32_t key = id + 7 * look.seed;
    const auto pick = [&](uint32_t salt) { return look.palette[static_cast<size_t>(chance(key, salt) * 5)]; };
    looks[id].colour = glm::mix(pick(1), pick(2), chance(key, 3)) * (0.82F + 0.32F * chance(key, 4));
    looks[id].drop = 1.4F * chance(key, 5);
    looks[id].tilt = chance(key, 6) - 0.5F;
  }
  const Field face = fbm(size, {36, 36}, 4, 0.7F, look.seed + 2), speck = grain(size, look.seed + 3);
  const Field moss = fbm(size, {13, 13}, 5, 0.72F, look.seed + 4), clouds = fbm(size, {4, 4}, 3, 0.6F, look.seed + 5);
  return paint(size, [&](int, int, size_t i) {
    const CellTexel& c = tiles[i];
    const TileLook& t = looks[c.id];
    const float fromFoot = c.up * rowTexels - t.drop;
    const float side = glm::min(c.across, 1 - c.across) * tileTexels;
    // The foot of this tile and the gaps beside it; just above it nothing, just below it lies its shadow, which falls
    // on the head of the course below.
    const float shadow = smoothly(0.30F * rowTexels, 0, (1 - c.up) * rowTexels);
    const float gap = smoothly(1.5F, 0.4F, side), foot = smoothly(0.4F, -0.4F, fromFoot);
    const float dark = glm::min(1.0F, 0.75F * gap + foot);
    const float grows = look.lichenCover * smoothly(0.25F, 1.1F, moss[i] + 0.4F * face[i]);
    const glm::vec3 clay = t.colour * (1 + 0.14F * look.roughness * face[i] + 0.07F * look.roughness * speck[i]);
    const float lip = smoothly(3.0F, 0.6F, fromFoot) * (1 - foot);
    const glm::vec3 colour = glm::mix(clay, look.lichen * (1 + 0.2F * face[i]), grows) * (1 - 0.62F * dark) *
                             (1 - 0.34F * shadow) * (1 + 0.16F * lip) * (1 + 0.045F * clouds[i]);
    const float height = look.thickness * (1 - c.up) + t.tilt * (c.across - 0.5F) * 2.4F -
                         dark * 0.5F * look.thickness + look.roughness * (0.55F * face[i] + 0.25F * speck[i]);
    return Texel{colour, height};
  });
}

}  // namespace

Image tile() {
  // Plain clay tiles, 165 mm wide, laid to a gauge of 100 mm.
  return finish(lappedRoof({20,
                            12,
                            0.05F,
                            3.0F,
                            1.0F,
                            1.0F,
                            {srgb(0x8b604d), srgb(0x7a5343), srgb(0x956d57), srgb(0x815b4b), srgb(0x6c4c42)},
                            srgb(0x8d8566),
                            0.42F,
                            300}),
                {0.30F, 0.16F, 5});
}

Image slate() {
  return finish(lappedRoof({14,
                            10,
                            0.16F,
                            2.0F,
                            0.7F,
                            0.8F,
                            {srgb(0x686b6d), srgb(0x5d6163), srgb(0x737577), srgb(0x63656a), srgb(0x6b696c)},
                            srgb(0x83846f),
                            0.30F,
                            320}),
                {0.30F, 0.16F, 5});
}

Image thatch() {
  // Reed laid down the slope, its butts combed level; weathered grey over brown.
  const Field clouds = fbm(kFull, {5, 4}, 4, 0.6F, 341), strands = fbm(kFull, {100, 8}, 3, 0.75F, 342);
  Surface roof = paint(kFull, [&](int, int, size_t i) {
    return Texel{srgb(0x5f5444) * (1 + 0.2F * strands[i]), -1.2F + 0.8F * strands[i]};
  });
  const std::array<glm::vec3, 5> palette{srgb(0x877a63), srgb(0x75694f), srgb(0x978a72), srgb(0x6a604f),
                                         srgb(0x82786a)};
  city::Random random(343);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  for (int n = 0; n < 9000; ++n) {
    const glm::vec2 at(uniform(0, 512), uniform(0, 512));
    const float length = uniform(16, 44);
    const glm::vec2 lean(uniform(-3.5F, 3.5F), -length);
    const auto cloud = static_cast<size_t>(at.y) * 512 + static_cast<size_t>(at.x);
    const glm::vec3 colour = palette[random.below(5)] * (1 + 0.13F * clouds[cloud]) * uniform(0.72F, 1.16F);
    drawStroke(roof, {at, at + lean, uniform(0.8F, 1.4F), uniform(1.2F, 2.0F), colour, uniform(0.6F, 2.6F)});
  }
  return finish(roof, {0.30F, 0.20F, 5});
}

Image lead() {
  // Sheets of 0.6 m between rolls, with drips across every 2.4 m.
  const Field streaks = fbm(kFull, {40, 4}, 4, 0.6F, 361), clouds = fbm(kFull, {5, 5}, 5, 0.62F, 362),
              dents = fbm(kFull, {12, 10}, 3, 0.55F, 363);
  const Field speck = grain(kFull, 364);
  const glm::vec3 fresh = srgb(0x7f8488), white = srgb(0xa3a6a6);
  return finish(paint(kFull,
                      [&](int x, int y, size_t i) {
                        const float across = static_cast<float>(x % 128) - 64 + 0.5F;
                        const float roll = glm::clamp(1 - across * across / 42, 0.0F, 1.0F);
                        const float drip = smoothly(
                            2.5F, 0.5F, glm::abs(static_cast<float>((y + 192 * ((x / 128 + 1) % 2)) % 512) - 60));
                        const float oxide = glm::clamp(0.35F + 0.35F * clouds[i] + 0.35F * streaks[i], 0.0F, 1.0F);
                        return Texel{glm::mix(fresh, white, oxide) * (1 + 0.03F * speck[i] - 0.16F * drip),
                                     7 * roll + 3.0F * dents[i] + 0.1F * speck[i] - 1.2F * drip};
                      }),
                {0.34F, 0.10F, 5});
}

}  // namespace vicus::assets::recipes
