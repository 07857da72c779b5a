/// Rectangles and lines on the plan, and grids that find those near a place.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace vicus::assets::norvic {

/// An oriented rectangle on the plan, metres. `axis` is a unit vector along its width.
struct PlanRect {
  glm::dvec2 centre{0};
  glm::dvec2 axis{1, 0};
  double halfWidth = 0, halfDepth = 0;

  glm::dvec2 across() const { return {-axis.y, axis.x}; }
  /// Counter-clockwise from the corner at −width, −depth.
  std::array<glm::dvec2, 4> corners() const;
  bool contains(glm::dvec2 p, double margin = 0) const;
  double radius() const { return glm::length(glm::dvec2(halfWidth, halfDepth)); }
};

/// True where the rectangles, each grown by half of `gap`, share an inner point (separating axes, exact for rectangles;
/// touching is not overlapping).
bool overlaps(const PlanRect& a, const PlanRect& b, double gap = 0);

/// A straight piece of something with a width: a street, a town wall.
struct PlanSegment {
  glm::dvec2 a{0}, b{0};
  double halfWidth = 0;
};

/// Distance from a point to the line between a and b; for a = b to that point.
double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b);
/// Distance between a rectangle and the line between a and b; 0 where they meet.
double distanceToSegment(const PlanRect& rect, glm::dvec2 a, glm::dvec2 b);

/// Where the lines a–b and c–d cross, as the fraction along a–b; negative where they do not.
double crossing(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d);

/// Points along a polyline at most `step` metres apart; its own corners are kept only at its ends.
std::vector<glm::dvec2> resample(std::span<const glm::dvec2> line, double step);
/// A smooth curve through all the points (Catmull–Rom, centripetal enough for evenly spaced points), `step` metres
/// between its points.
std::vector<glm::dvec2> curveThrough(std::span<const glm::dvec2> points, double step);
/// Indices of the points that keep the line within `tolerance` metres (Douglas and Peucker 1973); first and last
/// always.
std::vector<uint32_t> simplify(std::span<const glm::dvec2> line, double tolerance);
double lengthOf(std::span<const glm::dvec2> line);

/// Smooth noise in −1 … 1 with features about `wavelength` metres across; the same for a seed everywhere.
double noise(glm::dvec2 p, double wavelength, uint32_t seed);

/// Buckets of numbered things over a square of the plan. Things are entered with a box; `visit` reports every thing
/// whose bucket touches the box asked for, some more than once, in the order of entering within a bucket.
class PlanGrid {
 public:
  PlanGrid(glm::dvec2 min, glm::dvec2 max, double cell);
  void enter(uint32_t thing, glm::dvec2 min, glm::dvec2 max);

  /// Calls visitor(thing) until it returns false; true where it never did.
  template <typename Visitor>
  bool visit(glm::dvec2 min, glm::dvec2 max, const Visitor& visitor) const {
    const glm::ivec2 from = cellOf(min), to = cellOf(max);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x)
        for (uint32_t e = head_[static_cast<size_t>(y * size_.x + x)]; e != kEnd; e = entries_[e].next)
          if (!visitor(entries_[e].thing)) return false;
    return true;
  }

 private:
  static constexpr uint32_t kEnd = 0xffffffffU;
  struct Entry {
    uint32_t thing, next;
  };
  glm::ivec2 cellOf(glm::dvec2 p) const;

  glm::dvec2 min_;
  double cell_;
  glm::ivec2 size_;
  std::vector<uint32_t> head_;
  std::vector<Entry> entries_;
};

/// Rectangles found by place.
class RectGrid {
 public:
  RectGrid(glm::dvec2 min, glm::dvec2 max) : grid_(min, max, 16) {}
  void add(const PlanRect& rect);
  /// True where `rect` overlaps one of those added.
  bool anyOverlap(const PlanRect& rect, double gap = 0) const;
  bool anyContains(glm::dvec2 p, double margin) const;
  const std::vector<PlanRect>& rects() const { return rects_; }

 private:
  PlanGrid grid_;
  std::vector<PlanRect> rects_;
};

/// Segments with widths found by place.
class SegmentGrid {
 public:
  SegmentGrid(glm::dvec2 min, glm::dvec2 max) : grid_(min, max, 16) {}
  void add(const PlanSegment& segment);
  /// True where `rect` comes within the half width of a segment less `slack`.
  bool anyTouches(const PlanRect& rect, double slack = 0) const;
  bool anyNear(glm::dvec2 p, double margin) const;

 private:
  PlanGrid grid_;
  std::vector<PlanSegment> segments_;
};

}  // namespace vicus::assets::norvic
