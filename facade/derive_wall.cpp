#include "facade/derive_wall.hpp"

#include <algorithm>
#include <cmath>

#include "city/random.hpp"

namespace vicus::facade {
namespace {

using city::hash32;

/// Smooth noise of about one metre's grain, 0 to 1.
double noise(double x, double y, uint32_t seed) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto corner = [&](double dx, double dy) {
    const auto cell = [](double v) { return static_cast<uint32_t>(static_cast<int64_t>(v)); };
    return hash32(hash32(seed, cell(fx + dx)), cell(fy + dy)) / 4294967296.0;
  };
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double u = smooth(x - fx), v = smooth(y - fy);
  return (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) + (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
}

struct MaskUse {
  Mask mask = Mask::Noise;
  bool repeat = false;
  Rect box;    ///< as Fill::map
  Rect scope;  ///< that it was asked over
  double from = 0, to = 1;
  uint32_t seed = 0;

  bool keeps(const Rect& rect) const {
    const double px = (rect.left + rect.right) / 2, py = (rect.bottom + rect.top) / 2;
    double x, y;  // in repeats, or in the fitted picture
    if (repeat) {
      x = box.width() > 0 ? (px - box.left) / box.width() : px,
      y = box.height() > 0 ? (py - box.bottom) / box.height() : py;
    } else {
      x = box.left + box.width() * (px - scope.left) / scope.width();
      y = box.bottom + box.height() * (py - scope.bottom) / scope.height();
    }
    double value = 0;
    switch (mask) {
      case Mask::Noise:
        value = noise(x * 4, y * 4, seed);
        break;
      case Mask::Foot:
        value = std::clamp(1 - (py - scope.bottom) / scope.height(), 0.0, 1.0);
        break;
      case Mask::Eaves:
        value = std::clamp((py - scope.bottom) / scope.height(), 0.0, 1.0);
        break;
      case Mask::Checker:
        value = static_cast<int64_t>(std::floor(std::clamp(x, -1e9, 1e9)) + std::floor(std::clamp(y, -1e9, 1e9))) & 1
                    ? 1
                    : 0;
        break;
      case Mask::Count:
        break;
    }
    return value >= from && value <= to;
  }
};

class Walker {
 public:
  Walker(const StyledHouse& house, Derivation& made)
      : style_(*house.style), surrounding_(house.surrounding), made_(made) {}

  Surrounding& surrounding() { return surrounding_; }
  WallDetail take() { return std::move(out_); }

  void apply(uint32_t rule, const Rect& scope, uint32_t index, uint32_t count, uint32_t seed, uint32_t depth) {
    if (!(scope.width() > kSmallestScope && scope.height() > kSmallestScope)) {
      ++made_.empty;
      return;
    }
    if (depth > kDeepestRule || made_.scopes + kScopesForVolumes >= kMostScopes) {
      ++made_.cutShort;
      return;
    }
    ++made_.scopes;
    made_.deepest = std::max(made_.deepest, depth);
    look(scope, index, count, seed);
    const Operation* operation = chosenOperation(style_, rule, surrounding_);
    if (operation) run(*operation, scope, seed, depth);
  }

 private:
  void look(const Rect& scope, uint32_t index, uint32_t count, uint32_t seed) {
    surrounding_[Variable::Width].number = scope.width();
    surrounding_[Variable::Height].number = scope.height();
    surrounding_[Variable::X].number = scope.left;
    surrounding_[Variable::Y].number = scope.bottom;
    surrounding_[Variable::Index].number = index;
    surrounding_[Variable::Count].number = count;
    surrounding_.seed = seed;
  }

  double number(const Operation& o, size_t i) const { return numberOf(style_, o.numbers[i], surrounding_); }
  Rect box(const Operation& o) const { return {number(o, 0), number(o, 1), number(o, 2), number(o, 3)}; }

  void run(const Operation& o, const Rect& scope, uint32_t seed, uint32_t depth) {
    switch (o.kind) {
      case Operator::SplitX:
      case Operator::SplitY:
        split(o, scope, seed, depth);
        break;
      case Operator::RepeatX:
      case Operator::RepeatY:
        repeat(o, scope, seed, depth);
        break;
      case Operator::Layer:
        layer(o, scope, seed, depth);
        break;
      case Operator::SkipMask:
        mask_.push_back({static_cast<Mask>(o.what), o.repeat, box(o), scope, number(o, 4), number(o, 5), seed});
        break;
      case Operator::SampleTexture:
        ++made_.fills;
        out_.fills.push_back({scope, o.paints[0], o.repeat, box(o)});
        break;
      case Operator::SetColor:
        ++made_.fills;
        out_.fills.push_back({scope, o.paints[0], true, {}});
        break;
      case Operator::AttachScope:
        attach(o, scope, number(o, 0), number(o, 1), number(o, 2));
        break;
      case Operator::AttachTexture:
        scatter(o, scope, seed);
        break;
      default:  // operators on volumes mean nothing on a wall
        break;
    }
  }

  void split(const Operation& o, const Rect& scope, uint32_t seed, uint32_t depth) {
    const bool along = o.kind == Operator::SplitX;
    const std::vector<double> sizes =
        splitSizes(style_, o, along ? scope.width() : scope.height(), surrounding_, made_.squeezed);
    double from = along ? scope.left : scope.bottom;
    const auto count = static_cast<uint32_t>(sizes.size());
    for (uint32_t i = 0; i < count; ++i) {
      // The last one ends where the scope does, to the bit, if the pieces fill it.
      double to = from + sizes[i];
      const double end = along ? scope.right : scope.top;
      if (std::abs(to - end) < 1e-9 * (1 + std::abs(end))) to = end;
      Rect piece = scope;
      (along ? piece.left : piece.bottom) = from, (along ? piece.right : piece.top) = to;
      apply(o.pieces[i].rule, piece, i, count, hash32(seed, i + 1), depth + 1);
      from = to;
    }
  }

  void repeat(const Operation& o, const Rect& scope, uint32_t seed, uint32_t depth) {
    const bool along = o.kind == Operator::RepeatX;
    const double size = along ? scope.width() : scope.height(), wish = number(o, 0);
    const double fits = wish > 0 ? std::round(size / wish) : 1;
    if (fits > kMostRepeats) ++made_.cutShort;
    const auto count = static_cast<uint32_t>(std::clamp(fits, 1.0, static_cast<double>(kMostRepeats)));
    for (uint32_t i = 0; i < count; ++i) {
      Rect piece = scope;
      const double start = along ? scope.left : scope.bottom;
      (along ? piece.left : piece.bottom) = start + size * i / count;
      if (i + 1 < count) (along ? piece.right : piece.top) = start + size * (i + 1) / count;
      apply(o.rules[0], piece, i, count, hash32(seed, i + 1), depth + 1);
    }
  }

  void layer(const Operation& o, const Rect& scope, uint32_t seed, uint32_t depth) {
    size_t fillsBelow = out_.fills.size(), attachmentsBelow = out_.attachments.size();
    const auto count = static_cast<uint32_t>(o.rules.size());
    for (uint32_t i = 0; i < count; ++i) {
      const size_t fills = out_.fills.size(), attachments = out_.attachments.size(), masks = mask_.size();
      apply(o.rules[i], scope, i, count, hash32(seed, i + 1), depth + 1);
      if (mask_.size() > masks) {
        const MaskUse mask = mask_.back();
        mask_.resize(masks);
        const auto skipped = [&](const auto& item) { return !mask.keeps(item.rect); };
        const auto erase = [&](auto& list, size_t from, size_t to) {
          const auto begin = list.begin() + static_cast<std::ptrdiff_t>(from);
          const auto end = list.begin() + static_cast<std::ptrdiff_t>(to);
          list.erase(std::remove_if(begin, end, skipped), end);
        };
        erase(out_.fills, fillsBelow, fills);
        erase(out_.attachments, attachmentsBelow, attachments);
      }
      fillsBelow = fills, attachmentsBelow = attachments;
    }
  }

  void attach(const Operation& o, const Rect& rect, double depth, double near, double far) {
    Attachment a{rect, static_cast<Shape>(o.what), depth, near, far, {}};
    for (size_t i = 0; i < 2; ++i) a.paints[i] = i < o.paints.size() ? o.paints[i] : kNothing;
    ++made_.attachments;
    out_.attachments.push_back(a);
  }

  /// Sixteen places to a tile, one in each of its 4 × 4 cells.
  void scatter(const Operation& o, const Rect& scope, uint32_t seed) {
    constexpr int kCells = 4;
    const Rect tile = box(o);
    const double near = number(o, 4), far = number(o, 5);
    double w = o.repeat ? tile.width() : scope.width(), h = o.repeat ? tile.height() : scope.height();
    if (!(w > 0 && h > 0)) w = scope.width(), h = scope.height();
    const double columns = std::ceil(scope.width() / w), rows = std::ceil(scope.height() / h);
    if (!(columns * rows <= kMostRepeats)) {
      ++made_.cutShort;
      return;
    }
    city::Random random(seed);
    for (int ty = 0; ty < rows; ++ty)
      for (int tx = 0; tx < columns; ++tx)
        for (int k = 0; k < kCells * kCells; ++k) {
          const double x = scope.left + (tx + (k % kCells + random.uniform()) / kCells) * w;
          const double y = scope.bottom + (ty + (k / kCells + random.uniform()) / kCells) * h;
          const double size = random.uniform(0.5, 0.8) * std::min(w, h) / kCells;
          const Rect rect{x - size / 2, y - size / 2, x + size / 2, y + size / 2};
          if (rect.left < scope.left || rect.right > scope.right || rect.bottom < scope.bottom || rect.top > scope.top)
            continue;
          attach(o, rect, random.uniform(0.02, 0.12), near, far);
        }
  }

  const Style& style_;
  Surrounding surrounding_;
  Derivation& made_;
  WallDetail out_;
  std::vector<MaskUse> mask_;
};

}  // namespace

Derivation& Derivation::operator+=(const Derivation& more) {
  scopes += more.scopes, deepest = std::max(deepest, more.deepest);
  fills += more.fills, attachments += more.attachments;
  squeezed += more.squeezed, empty += more.empty, cutShort += more.cutShort;
  return *this;
}

StyledHouse::StyledHouse(const Style& used, const HouseFacts& facts, std::span<const double> given) : style(&used) {
  for (size_t i = 0; i < used.parameters.size(); ++i) {
    const Parameter& p = used.parameters[i];
    const double wished = i < given.size() && std::isfinite(given[i]) ? given[i] : p.value;
    parameters.push_back(std::clamp(wished, p.least, p.most));
  }
  const auto set = [&](Variable v, double number) { surrounding[v].number = std::isfinite(number) ? number : 0; };
  const auto say = [&](Variable v, std::string_view text) { surrounding[v] = {0, text, true}; };
  set(Variable::HouseHeight, facts.height), set(Variable::HouseWidth, facts.width);
  set(Variable::HouseArea, facts.area), set(Variable::HouseCorners, facts.corners);
  set(Variable::HouseYear, facts.year);
  say(Variable::HouseUse, facts.use), say(Variable::HouseMaterial, facts.material);
  say(Variable::HouseRoof, facts.roof);
  surrounding.seed = facts.seed;
  surrounding.parameters = parameters;
  choices.reserve(used.choices.size());
  for (const Choice& c : used.choices) {
    surrounding.choices = choices;
    choices.push_back(numberOf(used, c.expression, surrounding));
  }
  surrounding.choices = choices;
}

const Operation* chosenOperation(const Style& style, uint32_t rule, const Surrounding& surrounding) {
  if (rule >= style.rules.size()) return nullptr;
  const Operation* chosen = nullptr;
  double sum = 0;
  city::Random random(hash32(surrounding.seed, rule + 0x51u));
  for (const Alternative& way : style.rules[rule].alternatives) {
    if (way.condition != kNothing && numberOf(style, way.condition, surrounding) == 0) continue;
    if (way.weight == kNothing) return sum > 0 ? chosen : &way.operation;
    const double weight = numberOf(style, way.weight, surrounding);
    if (!(weight > 0)) continue;
    // Reservoir sampling: each is chosen in proportion to its weight.
    sum += weight;
    if (random.uniform() * sum < weight) chosen = &way.operation;
  }
  return chosen;
}

std::vector<double> splitSizes(const Style& style, const Operation& split, double size, const Surrounding& surrounding,
                               uint64_t& squeezed) {
  std::vector<double> sizes;
  double fixed = 0, floating = 0, relative = 0;
  for (const Piece& piece : split.pieces) {
    sizes.push_back(std::clamp(numberOf(style, piece.amount, surrounding), 0.0, 1e9));
    (piece.size == SizeKind::Absolute ? fixed : piece.size == SizeKind::Floating ? floating : relative) += sizes.back();
  }
  // Absolute pieces come first; floating ones stretch unless relative ones take what is left.
  double scaleFixed = 1, scaleFloating = 1;
  if (fixed > size) {
    scaleFixed = size / fixed, scaleFloating = 0;
    ++squeezed;
  } else if (floating > 0 && (relative == 0 || fixed + floating > size)) {
    scaleFloating = (size - fixed) / floating;
    if (relative > 0) ++squeezed;
  }
  const double rest = std::max(0.0, size - fixed * scaleFixed - floating * scaleFloating);
  for (size_t i = 0; i < sizes.size(); ++i) {
    const SizeKind kind = split.pieces[i].size;
    if (kind == SizeKind::Absolute)
      sizes[i] *= scaleFixed;
    else if (kind == SizeKind::Floating)
      sizes[i] *= scaleFloating;
    else
      sizes[i] = relative > 0 ? rest * (sizes[i] / relative) : 0;
  }
  return sizes;
}

WallDetail deriveWall(const StyledHouse& house, uint32_t rule, double width, double height, uint32_t index,
                      uint32_t seed, Derivation& made) {
  Walker walker(house, made);
  if (!(std::isfinite(width) && std::isfinite(height) && width < 1e6 && height < 1e6)) {
    ++made.empty;
    return {};
  }
  walker.surrounding()[Variable::FacadeWidth].number = width;
  walker.surrounding()[Variable::FacadeHeight].number = height;
  walker.surrounding()[Variable::FacadeIndex].number = index;
  walker.apply(rule, {0, 0, width, height}, index, 1, seed, 1);
  return walker.take();
}

}  // namespace vicus::facade
