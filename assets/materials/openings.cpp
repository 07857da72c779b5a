// Windows, doors and shop fronts: each picture fills one opening from jamb to jamb and from sill to head.
#include <algorithm>
#include <cmath>

#include "assets/materials/recipes.hpp"

namespace vicus::assets::recipes {
using namespace pattern;
namespace {

constexpr int kTexels = 512;

size_t at(int x, int y) {
  return static_cast<size_t>(y) * kTexels + static_cast<size_t>(x);
}

/// A rectangle given as parts of the picture.
Rect part(float left, float bottom, float right, float top) {
  return {left * kTexels, bottom * kTexels, right * kTexels, top * kTexels};
}

/// Panes that mirror a dim sky, brighter where the glass leans back.
Surface panes(uint32_t seed, float light) {
  const Field wave = fbm(kFull, {5, 7}, 3, 0.5F, seed), fine = fbm(kFull, {40, 40}, 2, 0.6F, seed + 1);
  const glm::vec3 dark = srgb(0x20262a), sky = srgb(0x6b7a84);
  return paint(kFull, [&](int x, int y, size_t i) {
    const float up = static_cast<float>(y) / kTexels, across = static_cast<float>(x) / kTexels;
    const float slant = smoothly(0.8F, 0.1F, glm::abs(up - 0.3F - 0.35F * across));
    const float shine = glm::clamp(light * (0.1F + 0.5F * slant) + 0.15F * wave[i] + 0.03F * fine[i], 0.0F, 1.0F);
    return Texel{glm::mix(dark, sky, shine), -3};
  });
}

/// Painted wood over a part of the picture.
void wood(Surface& surface, const Field& grainOf, glm::vec3 colour, float height, const Rect& rect) {
  repaint(surface, rect, [&](int x, int y, const Texel&, int edge) {
    return Texel{colour * (1 + 0.07F * grainOf[at(x, y)]) * (edge == 0 ? 0.8F : 1.0F), height - (edge == 0 ? 0.6F : 0)};
  });
}

struct Bars {
  int columns = 2, rows = 4;  ///< of panes
  float thin = 0.009F;        ///< half a bar's width, as a part of the picture
  float frame = 0.055F;
  float meeting = 0;  ///< half the width of the stiles that meet in the middle; 0: none
  float rail = 0;     ///< half the height of a rail at half height; 0: none
};

Surface glazed(const Bars& bars, glm::vec3 colour, uint32_t seed) {
  Surface s = panes(seed, 0.75F);
  const Field grainOf = woodGrain(kFull, 60, seed + 2);
  const auto bar = [&](float left, float bottom, float right, float top, float height) {
    wood(s, grainOf, colour, height, part(left, bottom, right, top));
  };
  for (int r = 1; r < bars.rows; ++r) {
    const float y = static_cast<float>(r) / static_cast<float>(bars.rows);
    bar(0, y - 0.7F * bars.thin, 1, y + 0.7F * bars.thin, -2);
  }
  for (int c = 1; c < bars.columns; ++c) {
    const float x = static_cast<float>(c) / static_cast<float>(bars.columns);
    bar(x - bars.thin, 0, x + bars.thin, 1, -2);
  }
  if (bars.rail > 0) bar(0, 0.5F - bars.rail, 1, 0.5F + bars.rail, -1.2F);
  if (bars.meeting > 0) {
    bar(0.5F - bars.meeting, 0, 0.5F + bars.meeting, 1, -1.2F);
    repaint(s, part(0.5F - 0.004F, 0, 0.5F + 0.004F, 1), [](int, int, const Texel& under, int) {
      return Texel{under.colour * 0.5F, under.height};
    });
  }
  const float f = bars.frame;
  bar(0, 0, f, 1, -1), bar(1 - f, 0, 1, 1, -1), bar(0, 1 - 0.7F * f, 1, 1, -1), bar(0, 0, 1, f, -0.6F);
  // Shade under the head and beside the left jamb: the light comes from the upper left.
  repaint(s, part(0, 0, 1, 1), [](int x, int y, const Texel& under, int) {
    const float head = smoothly(0.16F * kTexels, 0.02F * kTexels, static_cast<float>(kTexels - y));
    const float jamb = smoothly(0.10F * kTexels, 0.01F * kTexels, static_cast<float>(x));
    return Texel{under.colour * (1 - 0.5F * glm::max(head, 0.8F * jamb)), under.height};
  });
  return s;
}

/// Stone over the corners above a round arch whose springing lies at `spring` of the height.
void archOver(Surface& s, float spring, glm::vec3 stone, uint32_t seed) {
  const Field fine = fbm(kFull, {50, 50}, 3, 0.7F, seed);
  const float rise = 1 - spring;
  repaint(s, part(0, spring, 1, 1), [&](int x, int y, const Texel& under, int) {
    const float dx = 2 * static_cast<float>(x) / kTexels - 1;
    const float dy = (static_cast<float>(y) / kTexels - spring) / rise;
    const float r = glm::sqrt(dx * dx + dy * dy);
    if (r < 0.94F) return under;
    // Voussoirs: joints that point at the middle.
    const float angle = std::atan2(dy, dx) / 3.14159265F * 11;
    const float joint = glm::abs(angle - std::floor(angle) - 0.5F) > 0.47F && r < 1.25F ? 0.75F : 1.0F;
    return Texel{stone * joint * (1 + 0.08F * fine[at(x, y)]) * (r < 0.97F ? 0.55F : 1.0F), 1.5F};
  });
}

}  // namespace

Image windowCasement() {
  return finish(glazed({2, 4, 0.011F, 0.06F, 0.045F, 0}, srgb(0xb9b4a8), 1200), {0.32F, 0.18F, 5});
}

Image windowSash() {
  return finish(glazed({3, 6, 0.008F, 0.075F, 0, 0.022F}, srgb(0xd6d2c6), 1220), {0.32F, 0.18F, 5});
}

namespace {

/// `inner` within a larger picture, the rest stone.
Surface framed(const Surface& inner, float left, float bottom, float right, float top, glm::vec3 stone, uint32_t seed) {
  const Field fine = fbm(kFull, {50, 50}, 3, 0.7F, seed), broad = fbm(kFull, {3, 4}, 2, 0.5F, seed + 1);
  Surface s = paint(kFull, [&](int, int, size_t i) {
    return Texel{stone * (1 + 0.06F * fine[i] + 0.05F * broad[i]), 2 + 0.4F * fine[i]};
  });
  const Rect hole = part(left, bottom, right, top);
  repaint(s, hole, [&](int x, int y, const Texel&, int) {
    const float u = (static_cast<float>(x) - hole.left) / (hole.right - hole.left);
    const float v = (static_cast<float>(y) - hole.bottom) / (hole.top - hole.bottom);
    return inner.texels[at(std::min(kTexels - 1, static_cast<int>(u * kTexels)),
                           std::min(kTexels - 1, static_cast<int>(v * kTexels)))];
  });
  return s;
}

/// A light edge above and a shadow below: what juts out.
void ledge(Surface& s, const Rect& r, glm::vec3 stone) {
  const float high = r.top - r.bottom;
  repaint(s, {r.left, r.bottom - 0.8F * high, r.right, r.bottom}, [&](int, int, const Texel& under, int) {
    return Texel{under.colour * 0.72F, under.height};
  });
  repaint(s, r, [&](int, int y, const Texel&, int edge) {
    const float up = (static_cast<float>(y) - r.bottom) / high;
    return Texel{stone * (0.82F + 0.25F * up) * (edge == 0 ? 0.85F : 1.0F), 5};
  });
}

}  // namespace

Image windowFramed() {
  // A casement in its stone surround, sill and lintel with it: 1.35 m × 2.1 m.
  const glm::vec3 stone = srgb(0xc4baa6);
  Surface s =
      framed(glazed({2, 4, 0.011F, 0.06F, 0.045F, 0}, srgb(0xb9b4a8), 1210), 0.13F, 0.09F, 0.87F, 0.88F, stone, 1214);
  // Joints of the jambs and of the lintel's three stones.
  for (const float y : {0.24F, 0.42F, 0.58F, 0.74F})
    for (const float x : {0.0F, 0.87F})
      repaint(s, part(x, y, x + 0.13F, y + 0.006F), [](int, int, const Texel& under, int) {
        return Texel{under.colour * 0.7F, under.height - 1};
      });
  for (const float x : {0.40F, 0.594F})
    repaint(s, part(x, 0.88F, x + 0.006F, 1), [](int, int, const Texel& under, int) {
      return Texel{under.colour * 0.7F, under.height - 1};
    });
  ledge(s, part(0, 0.04F, 1, 0.09F), stone);
  return finish(s, {0.32F, 0.18F, 5});
}

Image windowShuttered() {
  // A casement between louvred shutters folded back: 2.05 m × 1.85 m. The paint is pale, so that a tint can turn it.
  const glm::vec3 coat = srgb(0xc9cdc6), stone = srgb(0xc4baa6);
  Surface s =
      framed(glazed({2, 4, 0.011F, 0.06F, 0.045F, 0}, srgb(0xc2beb2), 1230), 0.25F, 0.07F, 0.75F, 0.94F, stone, 1234);
  const Field grainOf = woodGrain(kFull, 60, 1236), worn = fbm(kFull, {9, 9}, 3, 0.6F, 1237);
  for (const float from : {0.0F, 0.765F}) {
    const Rect leaf = part(from, 0.07F, from + 0.235F, 0.96F);
    repaint(s, leaf, [&](int x, int y, const Texel&, int edge) {
      const size_t i = at(x, y);
      const glm::vec3 painted = coat * (1 + 0.07F * grainOf[i] - 0.09F * worn[i]);
      const float rail = glm::abs(static_cast<float>(y) - (leaf.bottom + 0.45F * (leaf.top - leaf.bottom)));
      if (edge < 13 || rail < 9) return Texel{painted * (edge < 2 ? 0.6F : 1.0F), 4 - (edge < 2 ? 1.5F : 0.0F)};
      const float slat = static_cast<float>((y - static_cast<int>(leaf.bottom)) % 11) / 11;
      return Texel{painted * (slat < 0.14F ? 0.5F : 0.98F - 0.3F * slat), 3 - 1.6F * slat};
    });
  }
  repaint(s, part(0, 0, 1, 0.02F), [](int, int, const Texel& under, int) {
    return Texel{under.colour * 0.7F, under.height};
  });
  ledge(s, part(0.2F, 0.025F, 0.8F, 0.07F), stone);
  return finish(s, {0.32F, 0.18F, 5});
}

Image windowSashFramed() {
  // A tall sash under a flat arch, over a stone sill: 1.2 m × 2.3 m.
  const glm::vec3 stone = srgb(0xcdc6b4), brickColour = srgb(0x8a4f3b);
  Surface s = framed(glazed({3, 6, 0.008F, 0.075F, 0, 0.022F}, srgb(0xd6d2c6), 1250), 0.045F, 0.065F, 0.955F, 0.88F,
                     srgb(0xd9d5ca), 1254);
  const Field fine = fbm(kFull, {40, 40}, 3, 0.7F, 1256);
  repaint(s, part(0, 0.885F, 1, 1), [&](int x, int y, const Texel&, int) {
    // Bricks on end that lean from the middle.
    const float lean = (static_cast<float>(x) / kTexels - 0.5F) * (static_cast<float>(y) / kTexels - 0.6F) * 40;
    const float brickAt = (static_cast<float>(x) + lean) / 26;
    const bool joint = brickAt - std::floor(brickAt) < 0.12F;
    const float tone = 0.85F + 0.3F * chance(static_cast<uint32_t>(static_cast<int>(std::floor(brickAt)) + 99), 1257);
    return joint ? Texel{srgb(0xa89f90), 1} : Texel{brickColour * tone * (1 + 0.1F * fine[at(x, y)]), 2};
  });
  ledge(s, part(0, 0.02F, 1, 0.065F), stone);
  return finish(s, {0.32F, 0.18F, 5});
}

Image windowLeaded() {
  // Lozenges of old glass in lead, in an oak frame with a mullion.
  Surface s = panes(1240, 0.9F);
  const Field grainOf = woodGrain(kFull, 50, 1242);
  for (int k = -10; k < 20; ++k)
    for (const float lean : {1.0F, -1.0F}) {
      const float from = static_cast<float>(k) * 51.2F;
      const glm::vec2 a(from, 0), b(from + lean * 330, kTexels);
      overStroke(kFull, a, b, 4, 4, [&](size_t i, float cover, float) {
        s.texels[i] = Texel{glm::mix(s.texels[i].colour, srgb(0x4a4a48), cover), -2};
      });
    }
  const glm::vec3 oakColour = srgb(0x5d4a38);
  for (const Rect& r : {part(0, 0, 0.08F, 1), part(0.92F, 0, 1, 1), part(0, 0.93F, 1, 1), part(0, 0, 1, 0.08F),
                        part(0.46F, 0, 0.54F, 1)})
    wood(s, grainOf, oakColour, -0.5F, r);
  return finish(s, {0.32F, 0.18F, 5});
}

Image windowTracery() {
  // Two lancets and a foiled circle under a pointed arch, quarries of old glass in lead.
  Surface s = panes(1266, 0.7F);
  for (int k = -12; k < 24; ++k)
    for (const float lean : {1.0F, -1.0F}) {
      const float from = static_cast<float>(k) * 42.7F;
      overStroke(kFull, glm::vec2(from, 0), glm::vec2(from + lean * 300, kTexels), 3, 3,
                 [&](size_t i, float cover, float) {
                   s.texels[i] = Texel{glm::mix(s.texels[i].colour, srgb(0x3c3d3e), cover), -2};
                 });
    }
  const Field fine = fbm(kFull, {50, 50}, 3, 0.7F, 1268);
  const glm::vec3 stone = srgb(0xc6bba2);
  constexpr float kSpring = 0.62F;
  // Distance inside a pointed arch of half-width `half` over `x`, whose two arcs begin at `spring`; negative: outside.
  const auto inArch = [](float dx, float dy, float half) {
    if (dy < 0) return half - glm::abs(dx);
    const float r = 2 * half;
    return r - glm::length(glm::vec2(glm::abs(dx) + half, dy * 1.0F));
  };
  repaint(s, part(0, 0, 1, 1), [&](int px, int py, const Texel& under, int) {
    const float x = static_cast<float>(px) / kTexels - 0.5F, y = static_cast<float>(py) / kTexels;
    // The picture is usually two and a half times as high as wide: heights count so in widths.
    const float up = (y - kSpring) * 2.2F;
    const float outer = inArch(x, up, 0.47F);
    const float lancet = inArch(glm::abs(x) - 0.235F, (y - 0.56F) * 2.2F, 0.19F);
    const glm::vec2 fromEye(x, (y - 0.79F) * 2.2F);
    const float lobe = glm::length(fromEye) > 0 ? std::atan2(fromEye.y, fromEye.x) : 0.0F;
    const float eye = 0.12F + 0.03F * glm::abs(std::cos(2 * lobe)) - glm::length(fromEye);
    const float open = glm::min(outer - 0.035F, glm::max(lancet, eye));
    if (open > 0.012F) return under;
    const float round = glm::clamp(1 - open / 0.012F, 0.0F, 1.0F);
    const float edge = outer > -0.02F && outer < 0.035F ? 0.88F : 1.0F;
    return Texel{stone * edge * (0.72F + 0.28F * round) * (1 + 0.08F * fine[at(px, py)]), outer < 0 ? 2.0F : 0.8F};
  });
  return finish(s, {0.34F, 0.18F, 5});
}

Image portal() {
  // A pointed door of oak boards within two orders of stone.
  Surface s = panes(1270, 0.1F);
  const Field grainOf = woodGrain(kFull, 44, 1271), fine = fbm(kFull, {50, 50}, 3, 0.7F, 1272);
  const glm::vec3 oak = srgb(0x6a5138), stone = srgb(0xc4b89e);
  for (int board = 0; board < 8; ++board) {
    const float x = 0.18F + 0.08F * static_cast<float>(board);
    wood(s, grainOf, oak * (0.9F + 0.2F * chance(static_cast<uint32_t>(board), 1273)), 0, part(x, 0, x + 0.077F, 1));
  }
  for (const float y : {0.10F, 0.42F}) wood(s, grainOf, srgb(0x35322e), 1.5F, part(0.18F, y, 0.82F, y + 0.025F));
  repaint(s, part(0, 0, 1, 1), [&](int px, int py, const Texel& under, int) {
    const float x = glm::abs(static_cast<float>(px) / kTexels - 0.5F);
    const float up = glm::max(0.0F, static_cast<float>(py) / kTexels - 0.55F) * 1.5F;
    const float inside = 0.64F - glm::length(glm::vec2(x + 0.32F, up));
    if (inside > 0) return Texel{under.colour * glm::clamp(0.45F + 6 * inside, 0.45F, 1.0F), under.height};
    // Orders: rolls that catch the light between hollows.
    const float order = -inside / 0.16F;
    const float roll = order < 1 ? 0.62F + 0.38F * std::cos(order * 4 * 3.14159265F) : 1.0F;
    return Texel{stone * roll * (1 + 0.08F * fine[at(px, py)]), order < 1 ? 1 + roll : 3};
  });
  return finish(s, {0.36F, 0.2F, 5});
}

Image windowArched() {
  Surface s = glazed({2, 4, 0.014F, 0.08F, 0.05F, 0}, srgb(0x6f8478), 1260);
  archOver(s, 0.68F, srgb(0xcbbd9c), 1264);
  return finish(s, {0.32F, 0.18F, 5});
}

Image doorPanelled() {
  // Two leaves of three panels under a light.
  Surface s = panes(1280, 0.5F);
  const Field grainOf = woodGrain(kFull, 50, 1282), worn = fbm(kFull, {8, 10}, 4, 0.6F, 1283);
  const glm::vec3 coat = srgb(0xc4bcac);
  repaint(s, part(0, 0, 1, 0.80F), [&](int x, int y, const Texel&, int) {
    return Texel{coat * (1 + 0.07F * grainOf[at(x, y)] - 0.08F * worn[at(x, y)]), 0};
  });
  for (const float left : {0.07F, 0.54F})
    for (const Rect& r : {part(left, 0.05F, left + 0.39F, 0.22F), part(left, 0.27F, left + 0.39F, 0.50F),
                          part(left, 0.55F, left + 0.39F, 0.76F)})
      repaint(s, r, [&](int, int, const Texel& under, int edge) {
        const float bevel = edge < 10 ? -0.28F * static_cast<float>(10 - glm::abs(edge - 5) * 2) : -0.6F;
        return Texel{under.colour * (edge < 3 ? 0.75F : 1.0F), bevel};
      });
  repaint(s, part(0.496F, 0, 0.504F, 0.80F), [](int, int, const Texel& under, int) {
    return Texel{under.colour * 0.35F, -2};
  });
  wood(s, grainOf, coat, 1.2F, part(0, 0.78F, 1, 0.83F));
  for (const float x : {0.25F, 0.5F, 0.75F}) wood(s, grainOf, coat, -1.5F, part(x - 0.012F, 0.83F, x + 0.012F, 1));
  for (const Rect& r : {part(0, 0, 0.035F, 1), part(0.965F, 0, 1, 1), part(0, 0.965F, 1, 1)})
    wood(s, grainOf, coat, 0.8F, r);
  wood(s, grainOf, srgb(0x8e8a80), 1, part(0, 0, 1, 0.025F));
  return finish(s, {0.36F, 0.2F, 5});
}

Image doorArched() {
  Surface s = panes(1300, 0.2F);
  const Field grainOf = woodGrain(kFull, 44, 1302);
  const glm::vec3 coat = srgb(0x86998c);
  for (int board = 0; board < 8; ++board) {
    const float x = static_cast<float>(board) / 8;
    wood(s, grainOf, coat * (0.92F + 0.16F * chance(static_cast<uint32_t>(board), 1303)), 0, part(x, 0, x + 0.122F, 1));
  }
  for (const float y : {0.12F, 0.5F, 0.72F}) wood(s, grainOf, coat * 0.9F, 1.5F, part(0, y, 1, y + 0.03F));
  archOver(s, 0.74F, srgb(0xcbbd9c), 1304);
  return finish(s, {0.36F, 0.2F, 5});
}

Image shopFront() {
  // A sign board, two windows in slender bars over panelled stall boards, a door between them.
  Surface s = panes(1320, 0.6F);
  const Field grainOf = woodGrain(kFull, 60, 1322), worn = fbm(kFull, {8, 8}, 3, 0.6F, 1323);
  const glm::vec3 coat = srgb(0xbfc2b8);
  const auto painted = [&](float left, float bottom, float right, float top, float height, float tone = 1) {
    repaint(s, part(left, bottom, right, top), [&](int x, int y, const Texel&, int edge) {
      const float v = 1 + 0.06F * grainOf[at(x, y)] - 0.07F * worn[at(x, y)];
      return Texel{coat * (tone * v * (edge == 0 ? 0.7F : 1.0F)), height - (edge == 0 ? 0.7F : 0)};
    });
  };
  painted(0, 0.84F, 1, 1, 2.5F);
  painted(0.04F, 0.87F, 0.96F, 0.97F, 1.5F, 0.82F);
  painted(0, 0, 1, 0.2F, 1);
  for (const float x : {0.05F, 0.21F, 0.62F, 0.80F}) painted(x, 0.03F, x + 0.14F, 0.17F, 0.2F, 0.92F);
  for (const float x : {0.0F, 0.37F, 0.59F, 0.965F}) painted(x, 0, x + 0.035F, 0.86F, 2);
  for (const float x : {0.2F, 0.78F}) painted(x - 0.006F, 0.2F, x + 0.006F, 0.84F, -1);
  painted(0, 0.60F, 1, 0.615F, -1);
  painted(0.405F, 0, 0.59F, 0.34F, 0.6F, 0.95F);
  painted(0.405F, 0.33F, 0.425F, 0.84F, 0.6F), painted(0.57F, 0.33F, 0.59F, 0.84F, 0.6F);
  repaint(s, part(0, 0.72F, 1, 0.84F), [](int, int y, const Texel& under, int) {
    return Texel{under.colour * (1 - 0.5F * smoothly(0.74F, 0.84F, static_cast<float>(y) / kTexels)), under.height};
  });
  return finish(s, {0.34F, 0.2F, 5});
}

}  // namespace vicus::assets::recipes
