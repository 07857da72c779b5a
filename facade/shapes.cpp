// The shapes that AttachScope fits into scopes: each fills its rectangle and reaches to the attachment's depth.
#include <algorithm>
#include <cmath>

#include "facade/triangulate.hpp"
#include "facade/wall_mesh.hpp"

namespace vicus::facade {
namespace {

/// One item on its way into the builder; positions in the wall's frame.
class Item {
 public:
  Item(city::BuildingBuilder& builder, const WallFrame& frame, const PaintLook& look)
      : builder_(builder), frame_(frame), look_(look) {}

  struct Point {
    double x, y, z;
  };
  void use(const PaintLook& look) { look_ = look; }

  /// A quadrilateral, its whole picture on it.
  void picture(Point a, Point b, Point c, Point d) {
    const glm::vec2 s = look_.metresPerRepeat;
    builder_.addQuad({at(a), at(b), at(c), at(d)}, {{0, 0}, {s.x, 0}, s, {0, s.y}}, look_.material);
  }
  /// The same with the texture in its own size.
  void quad(Point a, Point b, Point c, Point d) {
    builder_.addQuad(at(a), at(b), at(c), at(d), look_.material, uvA(a));
  }
  void triangle(Point a, Point b, Point c) {
    const glm::vec3 corners[] = {at(a), at(b), at(c)};
    builder_.addConvex(corners, glm::vec3(frame_.along), glm::vec3(frame_.up), look_.material);
  }
  /// A triangle that stands out of the wall.
  void upright(Point a, Point b, Point c) {
    const glm::vec3 corners[] = {at(a), at(b), at(c)};
    builder_.addConvex(corners, glm::vec3(frame_.normal()), glm::vec3(frame_.up), look_.material);
  }
  enum Faces : unsigned { Top = 1, Bottom = 2, Sides = 4, All = 7, Back = 8 };
  /// A box on the wall, without its back unless that is asked for.
  void box(const Rect& r, double from, double to, unsigned faces = All) {
    quad({r.left, r.bottom, to}, {r.right, r.bottom, to}, {r.right, r.top, to}, {r.left, r.top, to});
    if (faces & Top) quad({r.left, r.top, to}, {r.right, r.top, to}, {r.right, r.top, from}, {r.left, r.top, from});
    if (faces & Bottom)
      quad({r.left, r.bottom, from}, {r.right, r.bottom, from}, {r.right, r.bottom, to}, {r.left, r.bottom, to});
    if (faces & Back)
      quad({r.right, r.bottom, from}, {r.left, r.bottom, from}, {r.left, r.top, from}, {r.right, r.top, from});
    if (faces & Sides) {
      quad({r.left, r.bottom, from}, {r.left, r.bottom, to}, {r.left, r.top, to}, {r.left, r.top, from});
      quad({r.right, r.bottom, to}, {r.right, r.bottom, from}, {r.right, r.top, from}, {r.right, r.top, to});
    }
  }

 private:
  glm::vec3 at(Point p) const { return frame_.at(p.x, p.y, p.z); }
  static glm::vec2 uvA(Point p) { return glm::vec2(p.x, p.y); }

  city::BuildingBuilder& builder_;
  const WallFrame& frame_;
  PaintLook look_;
};

/// A beam between two corners of the scope, as thick as a fifth of its shorter side.
void addBrace(Item& item, const Rect& r, double depth, bool back) {
  const double t = 0.2 * std::min(r.width(), r.height());
  const double x0 = back ? r.right : r.left, x1 = back ? r.left : r.right, s = back ? -t : t;
  // Its four corners; the beam's upper edge runs from the first side to the top.
  Item::Point a{x0, r.bottom, depth}, b{x0 + s, r.bottom, depth}, c{x1, r.top, depth}, d{x1 - s, r.top, depth};
  if (back) std::swap(a, b), std::swap(c, d);
  item.quad(a, b, c, d);
  const auto flat = [](Item::Point p) { return Item::Point{p.x, p.y, 0}; };
  item.quad(flat(b), flat(c), c, b);
  item.quad(flat(d), flat(a), a, d);
}

/// A wall of the outline's form that stands before a gable and over the roof behind it.
void addParapet(Item& item, const std::vector<glm::dvec2>& outline, double depth) {
  constexpr double kThick = 0.35;
  const double front = depth, back = depth - kThick;
  std::vector<std::vector<glm::dvec2>> rings{outline};
  const std::vector<uint32_t> triangles = triangulate(rings);
  const auto at = [&](uint32_t i, double z) { return Item::Point{outline[i].x, outline[i].y, z}; };
  for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
    item.triangle(at(triangles[t], front), at(triangles[t + 1], front), at(triangles[t + 2], front));
    item.triangle(at(triangles[t], back), at(triangles[t + 2], back), at(triangles[t + 1], back));
  }
  // The rim; the foot stands on the wall.
  const auto n = static_cast<uint32_t>(outline.size());
  for (uint32_t i = 1; i < n; ++i) {
    const uint32_t k = (i + 1) % n;
    item.quad(at(i, front), at(i, back), at(k, back), at(k, front));
  }
}

std::vector<glm::dvec2> stepOutline(const Rect& r) {
  const int steps = std::clamp(static_cast<int>(std::lround(r.height() / 0.75)), 2, 8);
  const double half = r.width() / 2, rise = r.height() / steps, tread = half / (steps + 0.6);
  std::vector<glm::dvec2> right;
  for (int i = 0; i < steps; ++i) {
    right.emplace_back(r.right - i * tread, r.bottom + i * rise);
    right.emplace_back(r.right - i * tread, r.bottom + (i + 1) * rise);
  }
  right.emplace_back(r.right - steps * tread, r.top), right.emplace_back(r.right - steps * tread, r.top + 0.5 * rise);
  std::vector<glm::dvec2> out{{r.left, r.bottom}};
  out.insert(out.end(), right.begin(), right.end());
  for (size_t i = right.size(); i-- > 1;) out.emplace_back(r.left + r.right - right[i].x, right[i].y);
  return out;
}

std::vector<glm::dvec2> bellOutline(const Rect& r) {
  const double half = r.width() / 2, middle = (r.left + r.right) / 2, h = r.height();
  std::vector<glm::dvec2> right;
  constexpr int kParts = 6;
  // A shoulder that swings in, then a round head.
  for (int i = 0; i <= kParts; ++i) {
    const double t = static_cast<double>(i) / kParts, s = 1 - t;
    right.emplace_back(middle + half * (0.38 + 0.62 * s * s * s), r.bottom + h * 0.78 * t);
  }
  for (int i = 1; i < kParts; ++i) {
    const double angle = i * 1.5707963 / kParts;
    right.emplace_back(middle + half * 0.38 * std::cos(angle), r.bottom + h * (0.78 + 0.42 * std::sin(angle)));
  }
  std::vector<glm::dvec2> out{{r.left, r.bottom}};
  out.insert(out.end(), right.begin(), right.end());
  out.emplace_back(middle, r.bottom + 1.2 * h);
  for (size_t i = right.size(); i-- > 1;) out.emplace_back(2 * middle - right[i].x, right[i].y);
  return out;
}

/// A pier whose two stages end in slopes.
void addButtress(Item& item, const Rect& r, double depth) {
  // Its profile from the foot: metres up and out.
  const double h = r.height(), half = 0.6 * depth;
  const glm::dvec2 profile[] = {{r.bottom, depth},
                                {r.bottom + 0.50 * h, depth},
                                {r.bottom + 0.60 * h, half},
                                {r.bottom + 0.88 * h, half},
                                {r.top, 0}};
  for (size_t i = 0; i + 1 < std::size(profile); ++i) {
    const glm::dvec2 a = profile[i], b = profile[i + 1];
    item.quad({r.left, a.x, a.y}, {r.right, a.x, a.y}, {r.right, b.x, b.y}, {r.left, b.x, b.y});
    if (b.y > 0) {
      item.quad({r.left, a.x, 0}, {r.left, a.x, a.y}, {r.left, b.x, b.y}, {r.left, b.x, 0});
      item.quad({r.right, a.x, a.y}, {r.right, a.x, 0}, {r.right, b.x, 0}, {r.right, b.x, b.y});
    } else {
      item.upright({r.left, a.x, 0}, {r.left, a.x, a.y}, {r.left, b.x, 0});
      item.upright({r.right, a.x, a.y}, {r.right, a.x, 0}, {r.right, b.x, 0});
    }
  }
}

/// A breast wall on the wall's top and merlons on it, about one to 1.5 m; the scope is the band below that carries it.
void addBattlement(Item& item, const Rect& r, double depth) {
  constexpr double kThick = 0.35, kBreast = 0.55, kMerlon = 0.8;
  item.box(r, 0, depth, Item::Bottom | Item::Sides);
  const Rect breast{r.left, r.top, r.right, r.top + kBreast};
  item.box(breast, -kThick, depth, Item::All | Item::Back);
  const int count = std::clamp(static_cast<int>(std::lround(r.width() / 1.5)), 1, 200);
  const double pitch = r.width() / count, side = 0.21 * pitch;
  for (int i = 0; i < count; ++i) {
    const double left = r.left + i * pitch;
    item.box({left + side, breast.top, left + pitch - side, breast.top + kMerlon}, -kThick, depth,
             Item::Top | Item::Sides | Item::Back);
  }
}

void addOutside(Item& item, const Attachment& a, double depth) {
  const Rect& r = a.rect;
  const double w = r.width(), h = r.height();
  switch (a.shape) {
    case Shape::Opening:  // without depth it is a picture of one
    case Shape::Panel:
    case Shape::Count:
      item.picture({r.left, r.bottom, depth}, {r.right, r.bottom, depth}, {r.right, r.top, depth},
                   {r.left, r.top, depth});
      break;
    case Shape::Block:
      item.box(r, 0, depth);
      break;
    case Shape::Cornice: {
      const double lower = r.bottom + 0.45 * h;
      item.box({r.left, r.bottom, r.right, lower}, 0, 0.55 * depth, Item::Bottom | Item::Sides);
      item.box({r.left, lower, r.right, r.top}, 0, depth, Item::All);
      break;
    }
    case Shape::Pediment: {
      const double x = (r.left + r.right) / 2, foot = r.bottom + 0.25 * h;
      item.box({r.left, r.bottom, r.right, foot}, 0, depth, Item::Bottom | Item::Sides);
      item.triangle({r.left, foot, 0.8 * depth}, {r.right, foot, 0.8 * depth}, {x, r.top, 0.8 * depth});
      item.quad({r.right, foot, depth}, {r.right, foot, 0}, {x, r.top, 0}, {x, r.top, depth});
      item.quad({r.left, foot, 0}, {r.left, foot, depth}, {x, r.top, depth}, {x, r.top, 0});
      break;
    }
    case Shape::Pilaster: {
      const double inset = 0.12 * w, base = r.bottom + std::min(0.5, 0.12 * h),
                   capital = r.top - std::min(0.35, 0.1 * h);
      item.box({r.left, r.bottom, r.right, base}, 0, depth, Item::Top | Item::Sides);
      item.box({r.left + inset, base, r.right - inset, capital}, 0, 0.7 * depth, Item::Sides);
      item.box({r.left, capital, r.right, r.top}, 0, depth, Item::All);
      break;
    }
    case Shape::Brace:
      addBrace(item, r, depth, false);
      break;
    case Shape::BraceBack:
      addBrace(item, r, depth, true);
      break;
    case Shape::Awning: {
      const Item::Point hl{r.left, r.top, 0}, hr{r.right, r.top, 0}, ll{r.left, r.bottom, depth},
          lr{r.right, r.bottom, depth};
      item.quad(ll, lr, hr, hl);
      item.quad(hl, hr, lr, ll);
      break;
    }
    case Shape::Balcony: {
      item.box({r.left, r.bottom, r.right, r.bottom + std::min(0.18, 0.3 * h)}, 0, depth);
      break;
    }
    case Shape::Steps:
      addParapet(item, stepOutline(r), depth);
      break;
    case Shape::Bell:
      addParapet(item, bellOutline(r), depth);
      break;
    case Shape::Buttress:
      addButtress(item, r, depth);
      break;
    case Shape::Battlement:
      addBattlement(item, r, depth);
      break;
    case Shape::Leaf:
      item.picture({r.left, r.bottom, depth}, {r.right, r.bottom, depth * 0.6}, {r.right, r.top, depth * 0.2},
                   {r.left, r.top, depth * 0.5});
      break;
  }
}

}  // namespace

void addShape(city::BuildingBuilder& builder, const WallFrame& frame, const Attachment& a,
              std::span<const PaintLook> looks, uint32_t plain) {
  const auto look = [&](size_t i) { return looks[a.paints[i] != kNothing ? a.paints[i] : plain]; };
  // A scope without a size in any direction has nothing to show; NaN neither.
  if (!(a.rect.width() > 0 && a.rect.height() > 0) || !std::isfinite(a.depth)) return;
  const Rect& r = a.rect;
  Item item(builder, frame, look(0));
  if (a.shape == Shape::Opening && a.depth < 0) {
    const double z = -std::min(-a.depth, frame.thickness);
    builder.beginExternalOpening(static_cast<float>(-z));
    item.picture({r.left, r.bottom, z}, {r.right, r.bottom, z}, {r.right, r.top, z}, {r.left, r.top, z});
    item.use(look(1));
    item.quad({r.left, r.bottom, 0}, {r.left, r.bottom, z}, {r.left, r.top, z}, {r.left, r.top, 0});
    item.quad({r.right, r.bottom, z}, {r.right, r.bottom, 0}, {r.right, r.top, 0}, {r.right, r.top, z});
    item.quad({r.left, r.top, z}, {r.right, r.top, z}, {r.right, r.top, 0}, {r.left, r.top, 0});
    item.quad({r.left, r.bottom, 0}, {r.right, r.bottom, 0}, {r.right, r.bottom, z}, {r.left, r.bottom, z});
    return;
  }
  // Flat things stand a centimetre before the wall, so that neither hides the other.
  const double depth = std::clamp(a.depth, 0.01, 5.0);
  builder.beginExternalGeometry(static_cast<float>(depth));
  addOutside(item, a, depth);
  if (a.shape == Shape::Balcony && a.paints[1] != kNothing) {
    item.use(look(1));
    const double slab = r.bottom + std::min(0.18, 0.3 * r.height());
    item.box({r.left, r.top - 0.05, r.right, r.top}, depth - 0.05, depth);
    const int bars = std::clamp(static_cast<int>(r.width() / 0.14), 2, 30);
    for (int i = 0; i <= bars; ++i) {
      const double x = r.left + (r.width() - 0.02) * i / bars;
      item.quad({x, slab, depth}, {x + 0.02, slab, depth}, {x + 0.02, r.top, depth}, {x, r.top, depth});
    }
    for (const double x : {r.left, r.right - 0.03})
      item.box({x, r.top - 0.05, x + 0.03, r.top}, 0, depth, Item::Sides | Item::Top);
  }
}

}  // namespace vicus::facade
