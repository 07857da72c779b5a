#include "assets/norvic/plan_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// Half the length of a rectangle's projection on a unit axis.
double reach(const PlanRect& r, glm::dvec2 axis) {
  return r.halfWidth * std::abs(glm::dot(r.axis, axis)) + r.halfDepth * std::abs(glm::dot(r.across(), axis));
}

double latticeValue(int x, int y, uint32_t seed) {
  const uint32_t h = city::hash32(city::hash32(static_cast<uint32_t>(x), static_cast<uint32_t>(y)), seed);
  return h * (2.0 / 4294967295.0) - 1.0;
}

/// The box of a segment grown by `margin`.
std::pair<glm::dvec2, glm::dvec2> boxOf(glm::dvec2 a, glm::dvec2 b, double margin) {
  return {glm::min(a, b) - margin, glm::max(a, b) + margin};
}

std::pair<glm::dvec2, glm::dvec2> boxOf(const PlanRect& r, double margin) {
  const glm::dvec2 half(reach(r, {1, 0}) + margin, reach(r, {0, 1}) + margin);
  return {r.centre - half, r.centre + half};
}

}  // namespace

std::array<glm::dvec2, 4> PlanRect::corners() const {
  const glm::dvec2 w = axis * halfWidth, d = across() * halfDepth;
  return {centre - w - d, centre + w - d, centre + w + d, centre - w + d};
}

bool PlanRect::contains(glm::dvec2 p, double margin) const {
  const glm::dvec2 q = p - centre;
  return std::abs(glm::dot(q, axis)) < halfWidth + margin && std::abs(glm::dot(q, across())) < halfDepth + margin;
}

bool overlaps(const PlanRect& a, const PlanRect& b, double gap) {
  const glm::dvec2 between = b.centre - a.centre;
  for (const glm::dvec2 axis : {a.axis, a.across(), b.axis, b.across()})
    if (std::abs(glm::dot(between, axis)) >= reach(a, axis) + reach(b, axis) + gap) return false;
  return true;
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 ab = b - a;
  const double square = glm::dot(ab, ab);
  const double t = square > 0 ? std::clamp(glm::dot(p - a, ab) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + ab * t));
}

double distanceToSegment(const PlanRect& rect, glm::dvec2 a, glm::dvec2 b) {
  // In the rectangle's own frame it is a box about 0.
  const auto local = [&](glm::dvec2 p) {
    return glm::dvec2(glm::dot(p - rect.centre, rect.axis), glm::dot(p - rect.centre, rect.across()));
  };
  const glm::dvec2 half(rect.halfWidth, rect.halfDepth);
  const glm::dvec2 la = local(a), lb = local(b);
  // Clip the segment against the box: what is left lies inside.
  double t0 = 0, t1 = 1;
  const glm::dvec2 d = lb - la;
  bool inside = true;
  for (int k = 0; k < 2 && inside; ++k) {
    if (std::abs(d[k]) < 1e-12) {
      inside = std::abs(la[k]) < half[k];
      continue;
    }
    const double near = (-half[k] - la[k]) / d[k], far = (half[k] - la[k]) / d[k];
    t0 = std::max(t0, std::min(near, far));
    t1 = std::min(t1, std::max(near, far));
    inside = t0 < t1;
  }
  if (inside) return 0;
  double best = 1e300;
  for (const glm::dvec2 end : {la, lb}) {
    const glm::dvec2 out = glm::max(glm::abs(end) - half, glm::dvec2(0));
    best = std::min(best, glm::length(out));
  }
  for (const glm::dvec2 sign : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
    best = std::min(best, distanceToSegment(sign * half, la, lb));
  return best;
}

double crossing(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const double area = cross(b - a, d - c);
  if (std::abs(area) < 1e-12) return -1;
  const double t = cross(c - a, d - c) / area;
  const double s = cross(c - a, b - a) / area;
  return t >= 0 && t <= 1 && s >= 0 && s <= 1 ? t : -1;
}

double lengthOf(std::span<const glm::dvec2> line) {
  double sum = 0;
  for (size_t i = 1; i < line.size(); ++i) sum += glm::length(line[i] - line[i - 1]);
  return sum;
}

std::vector<glm::dvec2> resample(std::span<const glm::dvec2> line, double step) {
  if (line.size() < 2) return {line.begin(), line.end()};
  const double total = lengthOf(line);
  const auto pieces = static_cast<size_t>(std::max(1.0, std::ceil(total / step)));
  std::vector<glm::dvec2> out{line.front()};
  size_t segment = 1;
  double before = 0, here = glm::length(line[1] - line[0]);
  for (size_t k = 1; k < pieces; ++k) {
    const double at = total * static_cast<double>(k) / static_cast<double>(pieces);
    while (before + here < at && segment + 1 < line.size()) {
      before += here;
      ++segment;
      here = glm::length(line[segment] - line[segment - 1]);
    }
    const double t = here > 0 ? std::clamp((at - before) / here, 0.0, 1.0) : 0.0;
    out.push_back(glm::mix(line[segment - 1], line[segment], t));
  }
  out.push_back(line.back());
  return out;
}

std::vector<glm::dvec2> curveThrough(std::span<const glm::dvec2> points, double step) {
  if (points.size() < 3) return resample(points, step);
  std::vector<glm::dvec2> out{points.front()};
  for (size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec2 p1 = points[i], p2 = points[i + 1];
    const glm::dvec2 p0 = i > 0 ? points[i - 1] : 2.0 * p1 - p2;
    const glm::dvec2 p3 = i + 2 < points.size() ? points[i + 2] : 2.0 * p2 - p1;
    const int pieces = std::max(1, static_cast<int>(std::ceil(glm::length(p2 - p1) / step)));
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces, t2 = t * t, t3 = t2 * t;
      out.push_back(0.5 * (2.0 * p1 + (p2 - p0) * t + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * t2 +
                           (3.0 * (p1 - p2) + p3 - p0) * t3));
    }
  }
  return resample(out, step);
}

std::vector<uint32_t> simplify(std::span<const glm::dvec2> line, double tolerance) {
  std::vector<uint32_t> kept;
  if (line.empty()) return kept;
  const auto last = static_cast<uint32_t>(line.size() - 1);
  std::vector<bool> keep(line.size(), false);
  keep[0] = keep[last] = true;
  std::vector<std::pair<uint32_t, uint32_t>> open{{0, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double worst = tolerance;
    uint32_t at = 0;
    for (uint32_t i = from + 1; i < to; ++i) {
      const double d = distanceToSegment(line[i], line[from], line[to]);
      if (d > worst) worst = d, at = i;
    }
    if (at == 0) continue;
    keep[at] = true;
    open.push_back({from, at});
    open.push_back({at, to});
  }
  for (uint32_t i = 0; i <= last; ++i)
    if (keep[i]) kept.push_back(i);
  return kept;
}

double noise(glm::dvec2 p, double wavelength, uint32_t seed) {
  const glm::dvec2 q = p / wavelength;
  const glm::dvec2 cell = glm::floor(q);
  const glm::dvec2 f = q - cell;
  const glm::dvec2 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);  // second derivative without steps: no creases
  const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
  const double south = glm::mix(latticeValue(x, y, seed), latticeValue(x + 1, y, seed), s.x);
  const double north = glm::mix(latticeValue(x, y + 1, seed), latticeValue(x + 1, y + 1, seed), s.x);
  return glm::mix(south, north, s.y);
}

PlanGrid::PlanGrid(glm::dvec2 min, glm::dvec2 max, double cell)
    : min_(min),
      cell_(cell),
      size_(glm::max(glm::ivec2(glm::ceil((max - min) / cell)), glm::ivec2(1))),
      head_(static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y), kEnd) {}

glm::ivec2 PlanGrid::cellOf(glm::dvec2 p) const {
  return glm::clamp(glm::ivec2(glm::floor((p - min_) / cell_)), glm::ivec2(0), size_ - 1);
}

void PlanGrid::enter(uint32_t thing, glm::dvec2 min, glm::dvec2 max) {
  const glm::ivec2 from = cellOf(min), to = cellOf(max);
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) {
      uint32_t& head = head_[static_cast<size_t>(y * size_.x + x)];
      entries_.push_back({thing, head});
      head = static_cast<uint32_t>(entries_.size() - 1);
    }
}

void RectGrid::add(const PlanRect& rect) {
  const auto [min, max] = boxOf(rect, 0);
  grid_.enter(static_cast<uint32_t>(rects_.size()), min, max);
  rects_.push_back(rect);
}

bool RectGrid::anyOverlap(const PlanRect& rect, double gap) const {
  const auto [min, max] = boxOf(rect, gap);
  return !grid_.visit(min, max, [&](uint32_t i) { return !overlaps(rects_[i], rect, gap); });
}

bool RectGrid::anyContains(glm::dvec2 p, double margin) const {
  return !grid_.visit(p - margin, p + margin, [&](uint32_t i) { return !rects_[i].contains(p, margin); });
}

void SegmentGrid::add(const PlanSegment& segment) {
  const auto [min, max] = boxOf(segment.a, segment.b, segment.halfWidth);
  grid_.enter(static_cast<uint32_t>(segments_.size()), min, max);
  segments_.push_back(segment);
}

bool SegmentGrid::anyTouches(const PlanRect& rect, double slack) const {
  const auto [min, max] = boxOf(rect, 0);
  return !grid_.visit(min, max, [&](uint32_t i) {
    const PlanSegment& s = segments_[i];
    return distanceToSegment(rect, s.a, s.b) >= s.halfWidth - slack;
  });
}

bool SegmentGrid::anyNear(glm::dvec2 p, double margin) const {
  return !grid_.visit(p - margin, p + margin, [&](uint32_t i) {
    const PlanSegment& s = segments_[i];
    return distanceToSegment(p, s.a, s.b) >= s.halfWidth + margin;
  });
}

}  // namespace vicus::assets::norvic
