#include "assets/materials/recipes.hpp"

namespace vicus::assets::recipes {
using namespace pattern;
namespace {

/// The bay that a facade texture shows, metres.
constexpr glm::vec2 kBay{2.6F, 2.9F};

Rect inTexels(Size size, float left, float bottom, float right, float top) {
  const glm::vec2 s = glm::vec2(size.width, size.height) / kBay;
  return {left * s.x, bottom * s.y, right * s.x, top * s.y};
}

struct Window {
  glm::vec3 frame;       ///< paint of frame and bars, linear
  glm::vec3 surround;    ///< stone or brick of sill, lintel and jambs
  bool jambs = true;     ///< a surround on all sides, else a lintel and a sill only
  bool casement = true;  ///< two leaves that open inwards (French), else sashes that slide
  bool shutters = false;
  glm::vec3 shutter{0};
};

/// Draws a window 1.0 m × 1.55 m, its sill 0.85 m above the floor, into the middle of a bay.
void drawWindow(Surface& wall, const Window& look) {
  const Size size = wall.size;
  const Field fine = fbm(size, {60, 60}, 3, 0.7F, 901), wood = woodGrain(size, 60, 902),
              wave = fbm(size, {5, 6}, 3, 0.5F, 903);
  const float left = 0.80F, right = 1.80F, bottom = 0.85F, top = 2.40F;
  const auto at = [&](int x, int y) {
    return static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x);
  };
  const auto stone = [&](float height, float joint) {
    return [&, height, joint](int x, int y, const Texel&, int edge) {
      const float bevel = edge == 0 ? -0.8F : 0.0F;
      return Texel{look.surround * (1 + 0.07F * fine[at(x, y)]) * (1 - joint), height + bevel + 0.4F * fine[at(x, y)]};
    };
  };
  // Surround, lintel with its keystone's joints, sill.
  if (look.jambs)
    repaint(wall, inTexels(size, left - 0.14F, bottom - 0.02F, right + 0.14F, top + 0.16F), stone(2.6F, 0));
  repaint(wall, inTexels(size, left - 0.17F, top - 0.01F, right + 0.17F, top + 0.19F), stone(3.2F, 0));
  repaint(wall, inTexels(size, left - 0.18F, bottom - 0.11F, right + 0.18F, bottom + 0.01F), stone(4.5F, 0));
  // Below the sill a shadow and the streaks of rain off its ends.
  repaint(wall, inTexels(size, left - 0.16F, bottom - 0.20F, right + 0.18F, bottom - 0.11F),
          [&](int, int, const Texel& under, int edge) {
            return Texel{under.colour * (1 - 0.05F * static_cast<float>(glm::min(edge, 6))), under.height};
          });
  // The opening: panes far back in the wall.
  const Rect opening = inTexels(size, left, bottom, right, top);
  const glm::vec3 dark = srgb(0x282e32), sky = srgb(0x5b6870);
  repaint(wall, opening, [&](int x, int y, const Texel&, int) {
    const float up = (static_cast<float>(y) - opening.bottom) / (opening.top - opening.bottom);
    const float across = (static_cast<float>(x) - opening.left) / (opening.right - opening.left);
    const float shine =
        glm::clamp(0.05F + 0.45F * smoothly(0.9F, 0.1F, glm::abs(up - 0.25F - 0.35F * across)) + 0.18F * wave[at(x, y)],
                   0.0F, 1.0F);
    return Texel{glm::mix(dark, sky, shine), -3};
  });
  // Frame and bars.
  const auto bar = [&](float height) {
    return [&, height](int x, int y, const Texel&, int edge) {
      return Texel{look.frame * (1 + 0.08F * wood[at(x, y)]), height + (edge == 0 ? -0.5F : 0.0F)};
    };
  };
  const float f = 0.055F, thin = 0.016F;
  const float middle = 0.5F * (left + right), half = 0.5F * (bottom + top);
  for (int row = 1; row < 4; ++row) {
    const float y = bottom + (top - bottom) * static_cast<float>(row) / 4;
    repaint(wall, inTexels(size, left, y - thin, right, y + thin), bar(-2.0F));
  }
  if (!look.casement)
    for (int column = 1; column < 3; ++column) {
      const float x = left + (right - left) * static_cast<float>(column) / 3;
      repaint(wall, inTexels(size, x - thin, bottom, x + thin, top), bar(-2.0F));
    }
  if (look.casement) {
    repaint(wall, inTexels(size, middle - 0.045F, bottom, middle + 0.045F, top), bar(-1.2F));
    repaint(wall, inTexels(size, middle - 0.004F, bottom, middle + 0.004F, top),
            [&](int, int, const Texel& under, int) {
              return Texel{under.colour * 0.55F, under.height};
            });
  } else {
    repaint(wall, inTexels(size, left, half - 0.03F, right, half + 0.03F), bar(-1.2F));
  }
  repaint(wall, inTexels(size, left, bottom, left + f, top), bar(-1.2F));
  repaint(wall, inTexels(size, right - f, bottom, right, top), bar(-1.2F));
  repaint(wall, inTexels(size, left, top - f, right, top), bar(-1.2F));
  repaint(wall, inTexels(size, left, bottom, right, bottom + 1.3F * f), bar(-1.0F));
  // The reveal's shadow: the light comes from the upper left.
  repaint(wall, opening, [&](int x, int y, const Texel& under, int) {
    const float fromTop = opening.top - static_cast<float>(y), fromLeft = static_cast<float>(x) - opening.left;
    const float shade = 1 - 0.58F * glm::max(smoothly(26, 8, fromTop), 0.8F * smoothly(16, 4, fromLeft));
    return Texel{under.colour * shade, under.height};
  });
  if (!look.shutters) return;
  // Shutters folded back against the wall, louvred, each half the window's width.
  for (const float from : {left - 0.16F - 0.50F, right + 0.16F}) {
    const Rect leaf = inTexels(size, from, bottom - 0.02F, from + 0.50F, top + 0.02F);
    const Rect shadow = inTexels(size, from + 0.02F, bottom - 0.07F, from + 0.54F, top);
    repaint(wall, shadow, [&](int, int, const Texel& under, int edge) {
      return Texel{under.colour * (1 - 0.09F * static_cast<float>(glm::min(edge + 1, 5))), under.height};
    });
    const float rail = leaf.bottom + 0.45F * (leaf.top - leaf.bottom);
    repaint(wall, leaf, [&](int x, int y, const Texel&, int edge) {
      const size_t i = at(x, y);
      const glm::vec3 paintColour = look.shutter * (1 + 0.08F * wood[i] + 0.06F * fine[i]);
      const bool frame = edge < 10 || glm::abs(static_cast<float>(y) - rail) < 6;
      if (frame) return Texel{paintColour, 4.5F + (edge == 0 ? -1.0F : 0.0F)};
      const float slat = static_cast<float>((y - static_cast<int>(leaf.bottom)) % 8) / 8;
      return Texel{paintColour * (slat < 0.13F ? 0.5F : 0.98F - 0.3F * slat), 3.4F - 1.6F * slat};
    });
  }
}

}  // namespace

Image facadeLimestone() {
  Surface wall = ashlarWall(kFull, kBay, 920);
  drawWindow(wall, {srgb(0xb9b4a8), srgb(0xc4baa6), true, true, true, srgb(0x8b938c)});
  return finish(wall, {0.32F, 0.18F, 5});
}

Image facadePlaster() {
  Surface wall = plasterWall(kFull, kBay, plasterColour(), 940);
  drawWindow(wall, {srgb(0xa9a294), srgb(0xb5a88e), true, true, false, {}});
  return finish(wall, {0.32F, 0.18F, 5});
}

Image facadeBrick() {
  Surface wall = brickWall(kFull, kBay, false, 960);
  drawWindow(wall, {srgb(0xc3beb2), srgb(0xb5a890), false, false, false, {}});
  return finish(wall, {0.40F, 0.24F, 4});
}

Image facadePlasterShutters() {
  Surface wall = plasterWall(kFull, kBay, plasterColour() * glm::vec3(1.02F, 0.97F, 0.90F), 980);
  drawWindow(wall, {srgb(0xb3ada0), srgb(0xbdb096), true, true, true, srgb(0x6f8079)});
  return finish(wall, {0.32F, 0.18F, 5});
}

}  // namespace vicus::assets::recipes
