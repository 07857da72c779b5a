#include "culling/horizon.hpp"

namespace vicus::culling {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int firstFace(dvec2 p) {
  for (int face = 0; face < kFaces; ++face) {
    const dvec2 t = turned(p, face);
    if (t.x > 0 && t.y >= -t.x && t.y < t.x) return face;
  }
  return 0;
}

/// Cuts [from, to] to where the linear function from va at 0 to vb at 1 is not negative.
bool clip(double va, double vb, double& from, double& to) {
  if (va < 0 && vb < 0) return false;
  if (va < 0) from = std::max(from, va / (va - vb));
  if (vb < 0) to = std::min(to, va / (va - vb));
  return true;
}

/// Whether the columns are all above the slope. Eight at a time without a branch between them, so
/// that the compiler compares them at once.
bool allAbove(const float* slopes, int first, int end, double slope) {
  float bound = static_cast<float>(slope);
  if (static_cast<double>(bound) < slope) bound = std::nextafter(bound, std::numeric_limits<float>::infinity());
  int i = first;
  for (; i + 8 <= end; i += 8) {
    int open = 0;
    for (int k = 0; k < 8; ++k) open += !(bound < slopes[i + k]);
    if (open > 0) return false;
  }
  for (; i < end; ++i)
    if (!(bound < slopes[i])) return false;
  return true;
}

}  // namespace

Horizon::Horizon(uint32_t columns, double sway) : perFace_(static_cast<int>(columns / kFaces)), sway_(sway) {
  slopes_.resize(static_cast<size_t>(perFace_) * kFaces, -std::numeric_limits<float>::infinity());
}

void Horizon::allRound() {
  active_.fill({0, perFace_});
}

void Horizon::between(dvec2 right, dvec2 left) {
  for (int face = 0; face < kFaces; ++face) {
    const dvec2 r = turned(right, face), l = turned(left, face);
    double from = -1, to = 1;
    // (1, u) is left of r where r.x · u − r.y ≥ 0, and right of l where l.y − l.x · u ≥ 0.
    const auto cut = [&](double a, double b) {  // a · u + b ≥ 0
      if (a > 0) from = std::max(from, -b / a);
      if (a < 0) to = std::min(to, -b / a);
      if (a == 0 && b < 0) to = -2;
    };
    cut(r.x, -r.y), cut(-l.x, l.y);
    if (from > to) continue;
    const int first = static_cast<int>(position(from)) - 1, last = static_cast<int>(position(to)) + 1;
    active_[static_cast<size_t>(face)] = {std::max(first, 0), std::min(last + 1, perFace_)};
  }
}

void Horizon::clear() {
  for (int face = 0; face < kFaces; ++face)
    std::fill(row(face) + active_[static_cast<size_t>(face)].first, row(face) + active_[static_cast<size_t>(face)].end,
              -std::numeric_limits<float>::infinity());
}

bool Horizon::hides(const PlanBox& box, double top) const {
  for (int face = 0; face < kFaces; ++face) {
    const Active active = active_[static_cast<size_t>(face)];
    if (active.first >= active.end) continue;
    const PlanBox b = turned(box, face);
    const double pad = kStray + sway_ * std::max(largerOf(b.min), largerOf(b.max));
    const double y0 = b.min.y - pad, y1 = b.max.y + pad, far = b.max.x + pad;
    const double sideways = y0 > 0 ? y0 : y1 < 0 ? -y1 : 0;  // the least |y|: nothing of this face is nearer
    if (far <= 0 || far < sideways) continue;
    const double near = std::max(b.min.x - pad, sideways);
    if (near <= kNearest) return false;
    const double from = std::max(y0 < 0 ? y0 / near : y0 / far, -1.0);
    const double to = std::min(y1 > 0 ? y1 / near : y1 / far, 1.0);
    const double slope = top > 0 ? top / near : top / far;
    if (!below(face, from, to, slope)) return false;
  }
  return true;
}

bool Horizon::hides(const std::array<dvec2, 4>& corners, double top) const {
  for (int face = 0; face < kFaces; ++face) {
    const Active active = active_[static_cast<size_t>(face)];
    if (active.first >= active.end) continue;
    // The part of the quadrilateral with |y| ≤ x, and what may stray into it.
    std::array<dvec2, 8> polygon{}, cut{};
    size_t count = corners.size();
    double reach = 0;
    for (size_t i = 0; i < count; ++i)
      polygon[i] = turned(corners[i], face), reach = std::max(reach, largerOf(corners[i]));
    const double pad = kStray + sway_ * reach;
    for (const double side : {1.0, -1.0}) {
      size_t kept = 0;
      for (size_t i = 0; i < count; ++i) {
        const dvec2 a = polygon[i], b = polygon[(i + 1) % count];
        const double va = a.x + side * a.y + 2 * pad, vb = b.x + side * b.y + 2 * pad;
        if (va >= 0) cut[kept++] = a;
        if ((va >= 0) != (vb >= 0)) cut[kept++] = a + (va / (va - vb)) * (b - a);
      }
      std::swap(polygon, cut);
      count = kept;
    }
    if (count == 0) continue;
    double near = kInfinity, far = 0, from = 1, to = -1;
    for (size_t i = 0; i < count; ++i) near = std::min(near, polygon[i].x), far = std::max(far, polygon[i].x);
    near -= pad, far += pad;
    if (near <= kNearest) return false;
    for (size_t i = 0; i < count; ++i) {
      const double u = polygon[i].y / polygon[i].x;
      from = std::min(from, u), to = std::max(to, u);
    }
    const double slope = top > 0 ? top / near : top / far, stray = 2.5 * pad / near;
    if (!below(face, std::max(from - stray, -1.0), std::min(to + stray, 1.0), slope)) return false;
  }
  return true;
}

bool Horizon::below(int face, double from, double to, double slope) const {
  const Active active = active_[static_cast<size_t>(face)];
  const int first = std::max(static_cast<int>(position(from)), active.first);
  const int end = std::min(static_cast<int>(position(to)) + 1, active.end);
  return allAbove(row(face), first, end, slope + 2 * sway_ * (1 + slope * slope) + kRounding * std::abs(slope));
}

void Horizon::addWall(dvec3 p, dvec3 q, double limit, FreeEnds free) {
  for (int face = firstFace(dvec2(p)), k = 0; k < kFaces; ++k, face = (face + 1) % kFaces) {
    const dvec2 a = turned(dvec2(p), face), b = turned(dvec2(q), face);
    // The part of a → b where |y| ≤ x; on the diagonals u is −1 or 1 exactly.
    const double a0 = a.y + a.x, b0 = b.y + b.x, a1 = a.x - a.y, b1 = b.x - b.y;
    double from = 0, to = 1;
    if (!clip(a0, b0, from, to) || !clip(a1, b1, from, to) || !(from < to)) {
      if (k > 0) return;
      continue;
    }
    double start = from, end = to;
    if (!clip(limit - a.x, limit - b.x, start, end) || !(start < end)) {
      beginChain();
      if (to == 1) return;
      continue;
    }
    if (start > from) beginChain();
    const auto at = [&](double t) { return t == 0 ? a : t == 1 ? b : a + t * (b - a); };
    const auto topAt = [&](double t) { return t == 0 ? p.z : t == 1 ? q.z : p.z + t * (q.z - p.z); };
    const dvec2 s = at(start), e = at(end);
    if (!(s.x > 0) || !(e.x > 0)) return beginChain();
    const double u0 = start == from && from > 0 ? -1.0 : std::clamp(s.y / s.x, -1.0, 1.0);
    const double u1 = end == to && to < 1 ? 1.0 : std::clamp(e.y / e.x, -1.0, 1.0);
    double x0 = position(u0), x1 = position(u1), s0 = topAt(start) / s.x, s1 = topAt(end) / e.x;
    const double rise = x1 > x0 ? (s1 - s0) / (x1 - x0) : 0;
    const auto stray = [&](double depth) { return (kStray / depth + 2 * sway_) * (0.5 * perFace_); };
    if (free.first && start == 0) x0 += stray(s.x), s0 += rise * stray(s.x);
    if (free.last && end == 1) x1 -= stray(e.x), s1 -= rise * stray(e.x);
    if (x1 > x0 || !(free.first || free.last)) addPiece(face, x0, s0, x1, s1);
    if (end < to) beginChain();
    if (to == 1) return;
  }
}

/// A stretch from x0 to x1 (in columns of the face) whose slope goes from s0 to s1. Columns that the chain covers
/// from edge to edge take the lowest slope that it has there.
void Horizon::addPiece(int face, double x0, double s0, double x1, double s1) {
  const Active active = active_[static_cast<size_t>(face)];
  if (x1 < active.first || x0 > active.end || active.first >= active.end) return beginChain();
  if (!(x1 > x0)) {
    if (column_ >= 0) lowest_ = std::min({lowest_, s0, s1});
    return;
  }
  if (column_ < 0 || face_ != face) {
    column_ = std::min(static_cast<int>(x0), perFace_ - 1);
    whole_ = x0 == static_cast<double>(column_);
    lowest_ = kInfinity;
    face_ = face;
  }
  const double slope = (s1 - s0) / (x1 - x0);
  double left = s0;
  if (column_ < active.first) {
    column_ = active.first, whole_ = x0 <= static_cast<double>(column_);
    lowest_ = kInfinity, left = s0 + (column_ - x0) * slope;
  }
  float* const out = row(face);
  while (column_ < active.end) {
    const double edge = column_ + 1;
    if (x1 < edge) {
      lowest_ = std::min({lowest_, left, s1});
      return;
    }
    const double right = x1 == edge ? s1 : s0 + (edge - x0) * slope;
    const auto value = static_cast<float>(std::min({lowest_, left, right}));
    if (whole_) out[column_] = std::max(out[column_], value);
    ++column_;
    whole_ = true, lowest_ = kInfinity, left = right;
    if (x1 == edge) return;
  }
  beginChain();
}

}  // namespace vicus::culling
