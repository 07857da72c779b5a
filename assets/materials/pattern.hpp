/// The toolkit for textures made by code: tileable noise, cells and courses of stones, strokes, and the light that is
/// baked into a surface. All of it wraps round at the edges; x runs right, y up, row 0 is at the bottom, lengths are in
/// texels and colours linear.
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "assets/materials/materials.hpp"

namespace vicus::assets::pattern {

/// Size of a texture in texels.
struct Size {
  int width = 0, height = 0;
  bool operator==(const Size&) const = default;
  size_t texels() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
};

/// v brought into 0 … n − 1 by whole turns.
inline int wrapped(int v, int n) {
  if (v >= 0 && v < n) return v;
  v %= n;
  return v < 0 ? v + n : v;
}

/// One float for each texel.
struct Field {
  Size size;
  std::vector<float> texels;

  Field() = default;
  explicit Field(Size s, float value = 0) : size(s), texels(s.texels(), value) {}
  float operator[](size_t i) const { return texels[i]; }
  float& operator[](size_t i) { return texels[i]; }
};

/// Smooth noise of mean 0 and rms about 0.5, tileable: random values on a lattice of `cells` (≥ 1 each), joined by
/// Catmull–Rom splines. Unequal cells give streaks.
Field noise(Size size, glm::ivec2 cells, uint32_t seed);

/// `octaves` of noise, each with twice the cells and `gain` times the height of the last; rms about 0.5. Octaves that
/// would have less than two texels to a cell are left out.
Field fbm(Size size, glm::ivec2 cells, int octaves, float gain, uint32_t seed);

/// Independent values for each texel, uniform in −1 … 1.
Field grain(Size size, uint32_t seed);

/// Mean over about ±radius texels (two passes of a box), tileable. A radius of 0 gives a copy.
Field blurred(const Field& field, int radius);

/// `field` read at each texel moved by (dx, dy) · `texels`, bilinear.
Field displaced(const Field& field, const Field& dx, const Field& dy, float texels);

/// Where a texel lies in its stone, brick or tile.
struct CellTexel {
  float edge = 0;            ///< texels to the nearest edge; negative in rounded-off corners
  float across = 0, up = 0;  ///< 0 … 1 from left to right and from bottom to top (from the middle: −1 … 1 in Voronoi)
  uint32_t id = 0;           ///< 0 … Cells::count − 1
};

/// A division of the texture into cells.
struct Cells {
  Size size;
  uint32_t count = 0;
  std::vector<CellTexel> texels;
  const CellTexel& operator[](size_t i) const { return texels[i]; }
};

/// Voronoi cells of points jittered (0 … 1) about a lattice; what rubble, cobbles and flints look like. `wobble` moves
/// the borders by noise, in texels, by less than a cell. `stretch`: how many times taller than wide cells want to be.
/// Based on: Worley, "A Cellular Texture Basis Function" (1996); the edge is the distance to the nearest
/// bisector, which unlike F2 − F1 gives joints of even width.
Cells voronoi(Size size, glm::ivec2 cells, float jitter, float wobble, uint32_t seed, float stretch = 1);

/// One course of a wall: its height and the texel at which each of its blocks begins, ascending, the last wrapping
/// round to the first.
struct Course {
  float height = 0;
  std::vector<float> joints;
};

/// Blocks laid in courses from the bottom up. The heights are scaled so that they fill the texture. `corner`: radius of
/// the corners in texels. `wobble` bends the edges by noise, in texels.
Cells courses(Size size, const std::vector<Course>& rows, float corner, float wobble, uint32_t seed);

/// Courses of `perCourse` equal blocks, each course moved by `shift` of a block against the one below, joints moved at
/// random by up to `irregular` of a block.
std::vector<Course> runningBond(Size size, int courseCount, int perCourse, float shift, float irregular, uint32_t seed);

/// A course of stretchers, then one of headers (English bond, the usual bond of England before about 1650).
/// `courseCount` must be even.
std::vector<Course> englishBond(Size size, int courseCount, int stretchersPerCourse, uint32_t seed);

/// Courses of unequal heights (± `irregular`) with stones of unequal lengths.
std::vector<Course> ashlarCourses(Size size, int courseCount, int perCourse, float irregular, uint32_t seed);

/// One texel of a surface: linear colour, height in texels.
struct Texel {
  glm::vec3 colour{0};
  float height = 0;
};

/// A surface before light falls on it.
struct Surface {
  Size size;
  std::vector<Texel> texels;
  std::vector<uint8_t> cover;  ///< 1 where there is something; empty: everywhere
};

/// Calls `texel(x, y, i) → Texel` for every texel.
template <class F>
Surface paint(Size size, F&& texel) {
  Surface surface{size, std::vector<Texel>(size.texels()), {}};
  size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++i) surface.texels[i] = texel(x, y, i);
  return surface;
}

/// A rectangle in texels, from and to.
struct Rect {
  float left = 0, bottom = 0, right = 0, top = 0;
};

/// Repaints the part of a surface in `rect` (rounded to texels, cut to the texture):
/// `texel(x, y, under, edge) → Texel`, where `under` is what was there and `edge` the texels to the rectangle's border.
template <class F>
void repaint(Surface& surface, const Rect& rect, F&& texel) {
  const auto clampTo = [](float v, int hi) { return glm::clamp(static_cast<int>(std::lround(v)), 0, hi); };
  const int x0 = clampTo(rect.left, surface.size.width), x1 = clampTo(rect.right, surface.size.width);
  const int y0 = clampTo(rect.bottom, surface.size.height), y1 = clampTo(rect.top, surface.size.height);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      Texel& t =
          surface.texels[static_cast<size_t>(y) * static_cast<size_t>(surface.size.width) + static_cast<size_t>(x)];
      const int edge = glm::min(glm::min(x - x0, x1 - 1 - x), glm::min(y - y0, y1 - 1 - y));
      t = texel(x, y, t, edge);
    }
}

/// Calls `texel(i, cover, t)` for the texels that a line from `from` to `to`, tapering from one width to the other,
/// covers by 0 < cover ≤ 1; t is 0 … 1 along it. Wraps round.
template <class F>
void overStroke(Size size, glm::vec2 from, glm::vec2 to, float widthFrom, float widthTo, F&& texel) {
  const glm::vec2 d = to - from;
  const float length2 = glm::max(d.x * d.x + d.y * d.y, 1e-6F);
  const float reach = 0.5F * glm::max(widthFrom, widthTo) + 0.5F;
  const glm::ivec2 lo(glm::floor(glm::min(from, to) - reach)), hi(glm::ceil(glm::max(from, to) + reach));
  for (int y = lo.y; y <= hi.y; ++y) {
    int x0 = lo.x, x1 = hi.x;
    // Only the span of this row that the thickened line can reach.
    if (glm::abs(d.y) > 0.5F) {
      const float slope = d.x / d.y;
      const float middle = from.x + (static_cast<float>(y) + 0.5F - from.y) * slope;
      const float half = (reach + 1) * (1 + glm::abs(slope)) + 1;
      x0 = glm::max(x0, static_cast<int>(middle - half) - 1);
      x1 = glm::min(x1, static_cast<int>(middle + half) + 1);
    }
    const size_t row = static_cast<size_t>(wrapped(y, size.height)) * static_cast<size_t>(size.width);
    for (int x = x0; x <= x1; ++x) {
      const glm::vec2 p(static_cast<float>(x) + 0.5F - from.x, static_cast<float>(y) + 0.5F - from.y);
      const float t = glm::clamp((p.x * d.x + p.y * d.y) / length2, 0.0F, 1.0F);
      const float offX = p.x - t * d.x, offY = p.y - t * d.y;
      const float half = 0.5F * (widthFrom + (widthTo - widthFrom) * t);
      const float far2 = offX * offX + offY * offY;
      if (far2 >= (half + 0.5F) * (half + 0.5F)) continue;
      // Lines thinner than a texel fade instead of breaking up.
      const float cover = glm::min(glm::min(half + 0.5F - glm::sqrt(far2), 1.0F), 2 * half + 0.2F);
      texel(row + static_cast<size_t>(wrapped(x, size.width)), cover, t);
    }
  }
}

/// A tapering blade, straw or hair.
struct Stroke {
  glm::vec2 from{0}, to{0};
  float widthFrom = 1, widthTo = 0.3F;  ///< texels
  glm::vec3 colour{0};
  float height = 0;  ///< of its tip; its foot lies at 0
};

/// Draws it over what is there, antialiased; wraps round.
void drawStroke(Surface& surface, const Stroke& stroke);

/// A pointed leaf seen from above.
struct Leaf {
  glm::vec2 centre{0};
  float length = 10, width = 5;  ///< texels
  float angle = 0;               ///< radians from x
  glm::vec3 colour{0};
  float height = 0;
};

/// Draws it over what is there, with a lighter midrib, and marks its texels as covered; wraps round.
void drawLeaf(Surface& surface, const Leaf& leaf);

/// Light baked into a surface: soft, from the upper left.
struct Light {
  float relief = 0.5F;   ///< how far slopes lighten and darken; 0 none, 1 as the sun at 45°
  float cavity = 0.5F;   ///< how far hollows darken, for each texel of depth below their surroundings
  int cavityRadius = 4;  ///< texels; the surroundings
};

/// Lights the surface and encodes it. Uncovered texels get alpha 0 and the colour of what is covered near by, so that
/// filtering and mip levels bring in no foreign colour.
Image finish(const Surface& surface, const Light& light);

/// Linear colour of 0xRRGGBB in sRGB.
glm::vec3 srgb(uint32_t hex);

/// Uniform in [0, 1) from an id and a salt that says what it is for.
float chance(uint32_t id, uint32_t salt);

/// 0 below `from`, 1 above `to`, smooth between; `from` may lie above `to`.
inline float smoothly(float from, float to, float x) {
  const float t = glm::clamp((x - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3 - 2 * t);
}

}  // namespace vicus::assets::pattern
