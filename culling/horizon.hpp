/// The horizon that walls make around the eye, by direction.
///
/// Based on: Downs, Möller and Séquin 2001, "Occlusion Horizons for Driving through Urban Scenery". Departs: columns by
/// tangent instead of by angle, so that nothing is approximated; a column counts only where it is covered over its
/// whole width.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace vicus::culling {

/// Directions on the plan fall into four faces, east, north, west and south, as on the sides of a cube around the eye.
/// Within a face a point has a depth (its distance along the face's axis) and a position u = sideways ÷ depth in −1 …
/// 1, growing counter-clockwise. A straight wall's 1 ÷ depth, and with it the slope of its top as the eye sees it
/// ((top − eye) ÷ depth), is linear in u: nothing in here needs an angle.
///
/// The depth of a point is the greater of |x| and |y|: the same number orders points in all faces.
constexpr int kFaces = 4;

/// A plan position relative to the eye, turned so that the face's axis is x.
inline glm::dvec2 turned(glm::dvec2 p, int face) {
  switch (face) {
    case 0:
      return p;
    case 1:
      return {p.y, -p.x};
    case 2:
      return -p;
    default:
      return {-p.y, p.x};
  }
}

/// A box on the plan relative to the eye, turned likewise.
struct PlanBox {
  glm::dvec2 min, max;
};

inline PlanBox turned(const PlanBox& b, int face) {
  switch (face) {
    case 0:
      return b;
    case 1:
      return {{b.min.y, -b.max.x}, {b.max.y, -b.min.x}};
    case 2:
      return {-b.max, -b.min};
    default:
      return {{-b.max.y, b.min.x}, {-b.min.y, b.max.x}};
  }
}

inline double largerOf(glm::dvec2 p) {
  return std::max(std::abs(p.x), std::abs(p.y));
}

/// One slope for each column of the four faces: below it everything is hidden over the column's whole width.
/// Invariant: slopes only rise between two calls of `clear`.
class Horizon {
 public:
  /// Which ends of a wall no other wall of its chain goes on from.
  struct FreeEnds {
    bool first = false, last = false;
  };

  /// `columns` all round, at least 4; `sway`: radians by which what is drawn may stray.
  Horizon(uint32_t columns, double sway);

  /// All directions count, or only those counter-clockwise from `right` to `left`, less than half a turn.
  void allRound();
  void between(glm::dvec2 right, glm::dvec2 left);
  /// Nothing is hidden any more.
  void clear();

  /// Whether everything in the box, positions relative to the eye, up to the height `top` above it lies below the
  /// horizon.
  bool hides(const PlanBox& box, double top) const;
  /// The same for an upright prism over a convex quadrilateral.
  bool hides(const std::array<glm::dvec2, 4>& corners, double top) const;

  uint32_t columns() const { return static_cast<uint32_t>(perFace_ * kFaces); }
  /// Slope below which all is hidden, for each column: four faces (east, north, west, south), each counter-clockwise.
  const std::vector<float>& slopes() const { return slopes_; }

  /// Begins a chain of walls: the walls that follow touch each other.
  void beginChain() { column_ = -1; }

  /// The next wall of a chain, counter-clockwise from p to q relative to the eye, z the height of its top above the
  /// eye; of it only what is not deeper than `limit`. The chain's free ends are drawn in by what the drawn ones may
  /// stray: between houses whose walls end in one line there may be a slit.
  void addWall(glm::dvec3 p, glm::dvec3 q, double limit, FreeEnds free);

 private:
  /// Columns that matter in a face, from `first` up to and without `end`.
  struct Active {
    int first = 0, end = 0;
  };

  static constexpr double kStray = 1e-3;     ///< metres by which what is drawn may stray: floats on their way
  static constexpr double kNearest = 0.01;   ///< metres: nearer boxes count as around the eye
  static constexpr double kRounding = 1e-6;  ///< relative: floats of the horizon, rounding of what is drawn

  float* row(int face) { return slopes_.data() + static_cast<ptrdiff_t>(face) * perFace_; }
  const float* row(int face) const { return slopes_.data() + static_cast<ptrdiff_t>(face) * perFace_; }

  /// In columns from the face's right edge: 0 … perFace.
  double position(double u) const { return (u + 1) * (0.5 * perFace_); }

  /// Whether the slope is below the horizon in all columns that u from `from` to `to` touches.
  bool below(int face, double from, double to, double slope) const;
  void addPiece(int face, double x0, double s0, double x1, double s1);

  int perFace_;
  double sway_;
  std::array<Active, kFaces> active_{};
  std::vector<float> slopes_;
  // The chain's open column: whether all of it up to where the chain has come is covered, and how low.
  int face_ = 0, column_ = -1;
  bool whole_ = false;
  double lowest_ = std::numeric_limits<double>::infinity();
};

}  // namespace vicus::culling
