/// What the rules make of one wall: painted rectangles and shapes in their places.
///
/// Based on: Krecklau, Born, Kobbelt 2013, §3 to §7. The paper evaluates one pixel; here a scope is followed to all its
/// ends, so masks and attachment textures decide for whole shapes, by their centres.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "facade/evaluate.hpp"
#include "facade/rules.hpp"

namespace vicus::facade {

/// Metres on the wall: x from its left end seen from outside, y up from its foot.
struct Rect {
  double left = 0, bottom = 0, right = 0, top = 0;

  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// A painted rectangle; later ones lie over earlier ones.
struct Fill {
  Rect rect;
  uint32_t paint = kNothing;
  bool repeat = true;
  Rect map;  ///< Rep: metres that one repeat covers (no size: the texture's own); Fit: part of the picture, 0 to 1
};

/// A shape fitted into a rectangle.
struct Attachment {
  Rect rect;
  Shape shape = Shape::Panel;
  double depth = 0;          ///< metres out of the wall; negative: into it
  double near = 0, far = 0;  ///< metres from the eye between which it fades into the flat wall (2013, §5)
  uint32_t paints[2] = {kNothing, kNothing};
};

struct WallDetail {
  std::vector<Fill> fills;
  std::vector<Attachment> attachments;
};

/// What a derivation made, and where it was held back.
struct Derivation {
  uint64_t scopes = 0;   ///< rules applied
  uint32_t deepest = 0;  ///< rules within each other
  uint64_t fills = 0, attachments = 0;
  uint64_t squeezed = 0;  ///< splits whose pieces did not fit and were made smaller
  uint64_t empty = 0;     ///< scopes without a size, which are left out
  uint64_t cutShort = 0;  ///< rules not followed because a bound was reached

  Derivation& operator+=(const Derivation& more);
};

/// Bounds on one house.
constexpr uint32_t kDeepestRule = 48;
constexpr uint64_t kMostScopes = 50000;
/// The last of them are not for walls, so that the largest hall still gets its roof.
constexpr uint64_t kScopesForVolumes = 1000;
constexpr uint32_t kMostRepeats = 1000;
/// Scopes smaller than this on a side are empty: metres.
constexpr double kSmallestScope = 1e-4;

/// What is said of a house beside its footprint.
struct HouseFacts {
  double height = 0, width = 0, area = 0, corners = 0, year = 0;
  std::string_view use, material, roof;
  uint32_t seed = 0;
};

/// A style at work on one house: its choices are made. Refers to the style.
struct StyledHouse {
  const Style* style = nullptr;
  Surrounding surrounding;  ///< of the whole house; its spans refer to the two lists
  std::vector<double> parameters, choices;

  StyledHouse(const Style& style, const HouseFacts& facts, std::span<const double> parameters);
  StyledHouse(const StyledHouse&) = delete;
  StyledHouse& operator=(const StyledHouse&) = delete;
};

/// Follows one way of a rule: the first alternative without weight whose condition holds, else one of the weighted ones
/// by the seed. Nothing where none holds.
const Operation* chosenOperation(const Style& style, uint32_t rule, const Surrounding& surrounding);

/// Metres of each piece of a split over `size` metres. Where they do not fit, absolute and floating pieces shrink alike
/// and `squeezed` grows. The sizes add up to `size` unless all pieces are absolute and too small together.
std::vector<double> splitSizes(const Style& style, const Operation& split, double size, const Surrounding& surrounding,
                               uint64_t& squeezed);

/// Derives `rule` over a wall of width × height metres. `index` is its number among its side's walls. Adds to `made`,
/// which bounds the whole house.
WallDetail deriveWall(const StyledHouse& house, uint32_t rule, double width, double height, uint32_t index,
                      uint32_t seed, Derivation& made);

}  // namespace vicus::facade
