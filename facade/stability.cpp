#include "facade/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "facade/house.hpp"
#include "facade/parse_rules.hpp"

namespace vicus::facade {
namespace {

/// Everything that a wall of the size got from the rules: NaN and reaching over its edges must not come of it.
struct Outcome {
  WallDetail wall;
  Derivation made;
  double width = 0, height = 0;
  bool parsed = false;

  /// Metres that the worst piece reaches over the wall's edges; infinite where anything is not a number.
  double over() const {
    double worst = 0;
    const auto check = [&](const Rect& r) {
      for (const double v : {r.left, r.bottom, r.right, r.top})
        if (!std::isfinite(v)) worst = INFINITY;
      worst =
          std::max({worst, -r.left, -r.bottom, r.right - width, r.top - height, r.left - r.right, r.bottom - r.top});
    };
    for (const Fill& f : wall.fills) check(f.rect);
    for (const Attachment& a : wall.attachments) check(a.rect);
    return parsed ? worst : INFINITY;
  }
};

Outcome outcomeOf(const std::string& rules, double width, double height) {
  Outcome out;
  city::Diagnostics diagnostics;
  const std::optional<Style> style = parseRules(rules + "\nA => AttachScope(panel, 0.1, 30, 40)", "stiff", diagnostics);
  out.width = std::isfinite(width) ? std::max(0.0, width) : 0, out.height = std::isfinite(height) ? height : 0;
  if (!style) return out;
  out.parsed = true;
  const StyledHouse house(*style, {}, {});
  out.wall = deriveWall(house, style->facade, width, height, 0, 1, out.made);
  return out;
}

}  // namespace

std::vector<city::StabilityRow> rulesStability() {
  std::vector<city::StabilityRow> rows;
  const auto add = [&](const std::string& name, const std::string& what, double figure, double bound) {
    rows.push_back(city::stabilityRow("rules", name, what, figure, bound));
  };
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string plain = "Facade => RepeatX(1, SplitY((Abs, 1, A), (Rel, 1, A)))";
  for (const auto& [name, width] : {std::pair{"a wall without width", 0.0},
                                    {"a wall of negative width", -3.0},
                                    {"a wall 1e-9 m wide", 1e-9},
                                    {"a wall of NaN", std::nan("")},
                                    {"a wall without end", kInfinity}})
    add(name, "shapes on it", static_cast<double>(outcomeOf(plain, width, 5).wall.attachments.size()), 0);

  const Outcome tight = outcomeOf("Facade => SplitX((Abs, 30, A), (Abs, 10, A), (Flt, 3, A), (Rel, 1, A))", 4, 3);
  add("pieces of 43 m on 4 m", "metres over the wall's edges", tight.over(), 1e-9);
  add("pieces of 43 m on 4 m", "difference of their shares from 3 to 1",
      tight.wall.attachments.size() == 2
          ? std::abs(tight.wall.attachments[0].rect.width() / tight.wall.attachments[1].rect.width() - 3)
          : INFINITY,
      1e-9);
  const Outcome negative =
      outcomeOf("Facade => SplitX((Abs, -5, A), (Rel, -1, A), (Rel, 0, A), (Flt, 1 / 0, A))", 4, 3);
  add("pieces of negative size and of 1 / 0", "metres over the wall's edges", negative.over(), 1e-9);

  const Outcome fine = outcomeOf("Facade => RepeatX(0.000001, A)", 40, 3);
  add("repeats of 1e-6 m over 40 m", "shapes made", static_cast<double>(fine.wall.attachments.size()), kMostRepeats);
  add("repeats of 1e-6 m over 40 m", "metres over the wall's edges", fine.over(), 1e-9);
  for (const auto& [name, size] :
       {std::pair{"repeats of 0 m", "0"}, {"repeats of −1 m", "-1"}, {"repeats of 0 / 0 m", "0 / 0"}})
    add(name, "shapes beside the one",
        std::abs(static_cast<double>(
                     outcomeOf(std::string("Facade => RepeatX(") + size + ", A)", 40, 3).wall.attachments.size()) -
                 1),
        0);

  const Outcome deep = outcomeOf("Facade => SplitY((Abs, 0.01, A), (Rel, 1, Facade))", 4, 1000);
  add("a rule that calls itself", "rules within each other", deep.made.deepest, kDeepestRule);
  add("a rule that calls itself", "metres over the wall's edges", deep.over(), 1e-9);
  const Outcome wide = outcomeOf("Facade => RepeatX(width / 1000, Facade)", 1000, 4);
  add("a rule that calls itself a thousand times", "rules applied", static_cast<double>(wide.made.scopes), kMostScopes);

  // Volumes that cannot be: the house stays as it was, and nothing flies away.
  for (const auto& [name, rule] : {std::pair{"aisles wider than the house", "LeanTo(50, 1, tile, B)"},
                                   {"aisles that rise over the eaves", "LeanTo(1, 90, tile, B)"},
                                   {"a tower wider than the house", "Tower(1 / 0, 8, B)"},
                                   {"a tower of −8 m", "Tower(3, -8, B)"},
                                   {"turrets as wide as the walls", "Turrets(9, 8, B)"},
                                   {"towers on towers", "Tower(3, 8, House)"}}) {
    city::Diagnostics unheard;
    const auto style =
        parseRules(std::string("House => Extrude(6, ") + rule + ")\nB => Comp(side: Nothing())", "stiff", unheard);
    double farthest = INFINITY;
    if (style) {
      StyleInUse use;
      use.style = &*style, use.looks.resize(style->paints.size());
      Lot lot;
      lot.rings = {{{0, 0}, {9, 0}, {9, 7}, {0, 7}}};
      city::BuildingBuilder builder("stiff");
      Derivation made;
      addHouse(builder, use, lot, made);
      farthest = 0;
      for (const city::Vertex& v : builder.finish().vertices)
        for (const float c : {v.position.x, v.position.y, v.position.z})
          farthest = std::max(farthest, std::isfinite(c) ? std::abs(static_cast<double>(c)) : double{INFINITY});
    }
    add(name, "metres that its corners lie from the first", farthest, 40);
  }

  // Shapes of depth 0 stand a centimetre out, and openings of depth 0 are pictures: nothing divides by it.
  city::Diagnostics diagnostics;
  const auto flat = parseRules(
      "Facade => Layer(AttachScope(opening, 0, 0, 0), AttachScope(block, 0, 0, 0), AttachScope(pediment, 0 / 0, 0, 0),"
      "AttachScope(cornice, -1, 0, 0))",
      "flat", diagnostics);
  double outside = INFINITY;
  if (flat) {
    const StyledHouse house(*flat, {}, {});
    Derivation made;
    WallFrame frame;
    frame.width = 3, frame.height = 3;
    const WallDetail detail = deriveWall(house, flat->facade, 3, 3, 0, 1, made);
    const std::vector<PaintLook> looks(1);
    city::BuildingBuilder builder("flat");
    builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
    addWallDetail(builder, frame, detail, looks, 0);
    outside = 0;
    for (const city::Vertex& v : builder.finish().vertices)
      outside = std::max(
          {outside, std::isfinite(v.position.y) ? std::abs(static_cast<double>(v.position.y)) : double{INFINITY}});
  }
  add("shapes of depth 0, 0 / 0 and −1", "metres that they stand out", outside, 0.0101);
  return rows;
}

}  // namespace vicus::facade
