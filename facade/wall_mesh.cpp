#include "facade/wall_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace vicus::facade {
namespace {

/// Edges nearer than this become one: metres.
constexpr double kSame = 2e-3;

bool overlap(const Rect& a, const Rect& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

/// Takes `cut` out of every piece: strips below and above over the whole width, then what is left and right of it.
void subtract(std::vector<VisibleFill>& pieces, Rect cut) {
  for (const VisibleFill& p : pieces) {
    const auto snap = [](double& v, double to) {
      if (std::abs(v - to) < kSame) v = to;
    };
    snap(cut.left, p.rect.left), snap(cut.right, p.rect.right);
    snap(cut.bottom, p.rect.bottom), snap(cut.top, p.rect.top);
  }
  std::vector<VisibleFill> out;
  out.reserve(pieces.size() + 4);
  for (const VisibleFill& p : pieces) {
    if (!overlap(p.rect, cut)) {
      out.push_back(p);
      continue;
    }
    Rect middle = p.rect;
    const auto keep = [&](Rect rect) {
      if (rect.width() > 0 && rect.height() > 0) out.push_back({rect, p.fill});
    };
    if (cut.bottom > p.rect.bottom) {
      keep({p.rect.left, p.rect.bottom, p.rect.right, cut.bottom});
      middle.bottom = cut.bottom;
    }
    if (cut.top < p.rect.top) {
      keep({p.rect.left, cut.top, p.rect.right, p.rect.top});
      middle.top = cut.top;
    }
    if (cut.left > p.rect.left) keep({p.rect.left, middle.bottom, cut.left, middle.top});
    if (cut.right < p.rect.right) keep({cut.right, middle.bottom, p.rect.right, middle.top});
  }
  pieces = std::move(out);
}

/// Texture coordinates as the material wants them: they are divided by its metres for each repeat when drawn.
glm::vec2 uvOf(const Fill* fill, const PaintLook& look, glm::dvec2 p) {
  if (!fill || (fill->repeat && !(fill->map.width() > 0 && fill->map.height() > 0))) return glm::vec2(p);
  const Rect& map = fill->map;
  const glm::dvec2 t = fill->repeat
                           ? glm::dvec2((p.x - map.left) / map.width(), (p.y - map.bottom) / map.height())
                           : glm::dvec2(map.left + map.width() * (p.x - fill->rect.left) / fill->rect.width(),
                                        map.bottom + map.height() * (p.y - fill->rect.bottom) / fill->rect.height());
  return glm::vec2(t) * look.metresPerRepeat;
}

}  // namespace

std::vector<VisibleFill> visibleFills(const WallDetail& detail, double width, double height, double below) {
  std::vector<VisibleFill> pieces{{{0, -below, width, height}, kNothing}};
  for (uint32_t i = 0; i < detail.fills.size(); ++i) {
    const Fill& f = detail.fills[i];
    Rect rect = f.rect;
    if (f.repeat && rect.bottom <= 0) rect.bottom = -below;
    subtract(pieces, rect);
    pieces.push_back({rect, i});
  }
  for (const Attachment& a : detail.attachments)
    if (a.shape == Shape::Opening && a.depth < 0) subtract(pieces, a.rect);
  std::erase_if(pieces, [](const VisibleFill& p) { return !(p.rect.width() > 0 && p.rect.height() > 0); });
  return pieces;
}

void addWallDetail(city::BuildingBuilder& builder, const WallFrame& frame, const WallDetail& detail,
                   std::span<const PaintLook> looks, uint32_t plain) {
  for (const VisibleFill& piece : visibleFills(detail, frame.width, frame.height, frame.below)) {
    const Fill* fill = piece.fill == kNothing ? nullptr : &detail.fills[piece.fill];
    const PaintLook& look = looks[fill ? fill->paint : plain];
    const Rect& r = piece.rect;
    const auto uv = [&](double x, double y) { return uvOf(fill, look, {x, y}); };
    builder.addQuad(
        {frame.at(r.left, r.bottom), frame.at(r.right, r.bottom), frame.at(r.right, r.top), frame.at(r.left, r.top)},
        {uv(r.left, r.bottom), uv(r.right, r.bottom), uv(r.right, r.top), uv(r.left, r.top)}, look.material);
  }
  for (const Attachment& a : detail.attachments) addShape(builder, frame, a, looks, plain);
}

}  // namespace vicus::facade
