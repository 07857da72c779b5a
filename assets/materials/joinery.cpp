#include <array>

#include "assets/materials/recipes.hpp"
#include "city/random.hpp"

namespace vicus::assets::recipes {
using namespace pattern;

Field woodGrain(Size size, int rings, uint32_t seed) {
  // Streaks along y, bent by a slow wave, as a sawn face cuts the rings.
  const Field streaks = fbm(size, {rings, 2}, 4, 0.9F, seed),
              fibres = fbm(size, {glm::min(rings * 4, size.width / 2), 12}, 2, 0.7F, seed + 1);
  const Field bend = fbm(size, {4, 3}, 2, 0.4F, seed + 2), still(size);
  Field grainField = displaced(streaks, bend, still, 0.9F * static_cast<float>(size.width) / static_cast<float>(rings));
  for (size_t i = 0; i < grainField.texels.size(); ++i) grainField[i] = 0.75F * grainField[i] + 0.4F * fibres[i];
  // Pores: fine dark strokes that follow the grain.
  city::Random random(seed + 3);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  const auto count = static_cast<int>(size.texels() / 110);
  for (int n = 0; n < count; ++n) {
    const glm::vec2 at(uniform(0, static_cast<float>(size.width)), uniform(0, static_cast<float>(size.height)));
    const float length = uniform(8, 46), depth = uniform(0.3F, 1.3F);
    overStroke(size, at, at + glm::vec2(uniform(-1.2F, 1.2F), length), uniform(0.5F, 0.9F), 0.3F,
               [&](size_t i, float cover, float) { grainField[i] -= cover * depth; });
  }
  return grainField;
}

namespace {

/// Upright boards edge to edge over the whole picture.
Surface boards(Size size, int count, float irregular, const std::array<glm::vec3, 4>& palette, float gapTexels,
               uint32_t seed) {
  const Field wood = woodGrain(size, 36, seed), speck = grain(size, seed + 11),
              clouds = fbm(size, {4, 4}, 4, 0.6F, seed + 12);
  const Cells laid = courses(size, runningBond(size, 1, count, 0, irregular, seed + 13), 0, 0.7F, seed + 14);
  std::vector<glm::vec3> colours(laid.count);
  std::vector<int> shifts(laid.count);
  for (uint32_t id = 0; id < laid.count; ++id) {
    const auto pick = [&](uint32_t salt) { return palette[static_cast<size_t>(chance(id + seed, salt) * 4)]; };
    colours[id] = glm::mix(pick(1), pick(2), chance(id + seed, 3)) * (0.84F + 0.3F * chance(id + seed, 4));
    shifts[id] = static_cast<int>(chance(id + seed, 5) * static_cast<float>(size.height));
  }
  const float boardTexels = static_cast<float>(size.width) / static_cast<float>(count);
  return paint(size, [&](int x, int y, size_t i) {
    const CellTexel& c = laid[i];
    // Each board is cut from another place of the log.
    const int from = (y + shifts[c.id]) % size.height;
    const float w = wood[static_cast<size_t>(from) * static_cast<size_t>(size.width) + static_cast<size_t>(x)];
    const float side = glm::min(c.across, 1 - c.across) * boardTexels;
    const float in = smoothly(gapTexels * 0.5F - 0.5F, gapTexels * 0.5F + 0.8F, side);
    const float rounded = smoothly(0, gapTexels + 2.5F, side);
    const float tone = 1 + 0.17F * w + 0.05F * clouds[i] + 0.04F * speck[i];
    return Texel{colours[c.id] * tone * (0.22F + 0.78F * in), 2.2F * rounded + 0.6F * w + 0.15F * speck[i]};
  });
}

/// A nail or stud: a dome of `radius` texels with its rust running down.
void stud(Surface& surface, glm::vec2 at, float radius, glm::vec3 colour, float height) {
  const Rect rect{at.x - radius - 1, at.y - radius - 1, at.x + radius + 1, at.y + radius + 1};
  repaint(surface, rect, [&](int x, int y, const Texel& under, int) {
    const glm::vec2 d = glm::vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - at;
    const float r2 = glm::dot(d, d) / (radius * radius);
    if (r2 >= 1) return under;
    return Texel{colour, under.height + height * (1 - r2)};
  });
}

}  // namespace

Image timber() {
  // Old oak beams: silvered, with shakes (cracks along the grain) and the facets of the adze.
  const Field wood = woodGrain(kFull, 34, 400), speck = grain(kFull, 402);
  const Field clouds = fbm(kFull, {6, 3}, 4, 0.6F, 403), adze = fbm(kFull, {6, 12}, 2, 0.5F, 404);
  Field shakes(kFull);
  city::Random random(405);
  const auto uniform = [&](float lo, float hi) { return static_cast<float>(random.uniform(lo, hi)); };
  for (int n = 0; n < 46; ++n) {
    glm::vec2 at(uniform(0, 512), uniform(0, 512));
    const float width = uniform(0.9F, 2.6F);
    const int steps = 3 + static_cast<int>(random.below(7));
    for (int step = 0; step < steps; ++step) {
      // Thin at both ends, jogging a little from fibre to fibre.
      const auto open = [&](int s) {
        return width * (1 - glm::abs(2 * static_cast<float>(s) / static_cast<float>(steps) - 1));
      };
      const glm::vec2 to = at + glm::vec2(uniform(-1.5F, 1.5F), uniform(14, 26));
      overStroke(kFull, at, to, glm::max(0.3F, open(step)), glm::max(0.3F, open(step + 1)),
                 [&](size_t i, float cover, float) { shakes[i] = glm::max(shakes[i], cover); });
      at = to;
    }
  }
  const glm::vec3 brown = srgb(0x584839), silver = srgb(0x776c5f);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float tone = (1 + 0.17F * wood[i] + 0.05F * speck[i]) * (1 - 0.72F * shakes[i]);
                        const float age = glm::clamp(0.45F + 0.35F * clouds[i] + 0.22F * wood[i], 0.0F, 1.0F);
                        return Texel{glm::mix(brown, silver, age) * tone,
                                     0.7F * wood[i] + 1.6F * adze[i] - 2.0F * shakes[i] + 0.15F * speck[i]};
                      }),
                {0.32F, 0.16F, 4});
}

Image oak() {
  const Field wood = woodGrain(kFull, 44, 420), rays = fbm(kFull, {120, 26}, 2, 0.5F, 421),
              clouds = fbm(kFull, {4, 4}, 3, 0.6F, 422);
  return finish(paint(kFull,
                      [&](int, int, size_t i) {
                        const float ray = smoothly(0.8F, 1.2F, rays[i]);
                        const float tone = 1 + 0.15F * wood[i] + 0.06F * ray + 0.05F * clouds[i];
                        return Texel{srgb(0x7b644c) * tone, 0.5F * wood[i]};
                      }),
                {0.26F, 0.15F, 4});
}

Image planks() {
  Surface wall = boards(kFull, 9, 0.22F, {srgb(0x786856), srgb(0x6b5b4a), srgb(0x85765f), srgb(0x736860)}, 2.4F, 440);
  // Two rows of nails.
  for (int row = 0; row < 2; ++row)
    for (int k = 0; k < 18; ++k) {
      const uint32_t id = static_cast<uint32_t>(row * 32 + k);
      stud(wall,
           {14.2F + 28.44F * static_cast<float>(k) + 5 * (chance(id, 441) - 0.5F),
            120 + 256 * static_cast<float>(row) + 6 * (chance(id, 442) - 0.5F)},
           1.8F, srgb(0x332b26), 0.6F);
    }
  return finish(wall, {0.34F, 0.2F, 4});
}

Image door() {
  // Oak boards with iron straps and studs from edge to edge, so that a door may begin anywhere in the picture.
  Surface leaf = boards(kFull, 5, 0.1F, {srgb(0x5f4d3c), srgb(0x574635), srgb(0x695643), srgb(0x5c4e41)}, 3.2F, 460);
  const Field rough = fbm(kFull, {40, 40}, 3, 0.7F, 461);
  const glm::vec3 ironColour = srgb(0x393632);
  for (const float y : {92.0F, 416.0F}) {
    repaint(leaf, {0, y - 6, 512, y + 6}, [&](int x, int yy, const Texel&, int) {
      const float away = glm::abs(static_cast<float>(yy) + 0.5F - y);
      const float r = rough[static_cast<size_t>(yy) * 512 + static_cast<size_t>(x)];
      return Texel{ironColour * (1 + 0.16F * r), 5 - 1.2F * smoothly(3.5F, 6, away) + 0.4F * r};
    });
    for (int k = 0; k < 8; ++k) stud(leaf, {32 + 64 * static_cast<float>(k), y}, 3.2F, ironColour * 1.3F, 2.0F);
  }
  for (const float y : {22.0F, 173.0F, 254.0F, 335.0F, 486.0F})
    for (int k = 0; k < 10; ++k) stud(leaf, {26 + 51.2F * static_cast<float>(k), y}, 3.4F, ironColour, 2.6F);
  return finish(leaf, {0.36F, 0.2F, 4});
}

Image shutter() {
  // A louvred shutter: frame, a middle rail, slats; paint gone chalky. Grey-green, so that a tint can turn it.
  const Size size = kHalf;
  const Field wood = woodGrain(size, 24, 480), worn = fbm(size, {10, 6}, 4, 0.66F, 481), speck = grain(size, 482);
  const glm::vec3 coat = srgb(0x7f8a82), bare = srgb(0x847e73);
  const auto painted = [&](size_t i, float tone) {
    const float chalk = smoothly(0.35F, 1.0F, worn[i] + 0.5F * wood[i]);
    return glm::mix(coat, bare, 0.5F * chalk) * tone * (1 + 0.05F * wood[i] + 0.03F * speck[i]);
  };
  Surface leaf = paint(size, [&](int x, int y, size_t i) {
    const int stile = 26, rail = 20;
    const bool frame =
        x < stile || x >= size.width - stile || y < rail || y >= size.height - rail || (y >= 118 && y < 138);
    if (frame) {
      const bool border = x < 1 || x >= size.width - 1;
      return Texel{painted(i, border ? 0.35F : 1.0F), 4 + 0.3F * wood[i] - (border ? 3.0F : 0.0F)};
    }
    const float slat = static_cast<float>((y - rail) % 11) / 11.0F;
    // The light comes from above: each slat's upper face is bright, its foot hangs over the dark below.
    const float tone = glm::mix(0.95F, 0.62F, smoothly(0.55F, 1.0F, slat)) * (slat < 0.1F ? 0.45F : 1.0F);
    return Texel{painted(i, tone), 2.2F - 2.2F * slat};
  });
  return finish(leaf, {0.28F, 0.16F, 4});
}

}  // namespace vicus::assets::recipes
