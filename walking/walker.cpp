/// Based on: Ericson 2005, "Real-Time Collision Detection", §5.5.6 (a moving sphere against a segment is a ray against
/// a capsule), and Fauerby 2003, "Improved Collision detection and Response" (slide along what was hit and go on with
/// the rest). Here both are on the plan: a visitor's body is upright, and so is nearly everything that stops it. A
/// surface that is not is cut to the height of the body first, and its cut's edges are the walls.
///
/// Departs from both in that no place is taken before it was looked at: each piece of a move ends where the body stands
/// free on firm ground, or where it began. What is then right at the beginning is right for ever.
#include "walking/walker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "walking/surroundings.hpp"

namespace vicus::walking {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSkin = 1e-4;       ///< metres kept from what is touched, so that rounding never lets one in
constexpr double kTolerance = 1e-3;  ///< metres: how exactly a place must be right
constexpr double kReach = 12;        ///< metres about the visitor that are gathered at once

bool finite(glm::dvec2 v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

glm::dvec2 nearestOn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  return length2 > 0 ? a + std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) * along : a;
}

/// The part of a triangle between two heights, as a convex polygon of at most five corners on the plan.
struct Cut {
  std::array<glm::dvec3, 8> corners;
  size_t count = 0;
};
Cut cutToHeights(const Face& face, double bottom, double top) {
  Cut cut;
  for (const glm::dvec3& corner : face.corners) cut.corners[cut.count++] = corner;
  for (const auto& [height, sign] : {std::pair{bottom, 1.0}, std::pair{top, -1.0}}) {
    Cut in;
    for (size_t i = 0; i < cut.count; ++i) {
      const glm::dvec3 &p = cut.corners[i], &q = cut.corners[(i + 1) % cut.count];
      const double dp = sign * (p.z - height), dq = sign * (q.z - height);
      if (dp >= 0) in.corners[in.count++] = p;
      if ((dp >= 0) != (dq >= 0)) in.corners[in.count++] = glm::mix(p, q, dp / (dp - dq));
    }
    cut = in;
  }
  return cut;
}

/// Whether the cut, seen from above, covers a point. Upright ones cover none.
bool covers(const Cut& cut, glm::dvec2 p) {
  for (size_t k = 2; k < cut.count; ++k) {
    const glm::dvec2 a(cut.corners[0]), b(cut.corners[k - 1]), c(cut.corners[k]);
    const glm::dvec2 u = b - a, v = c - a;
    if (std::abs(u.x * v.y - u.y * v.x) > 1e-9 && triangleCovers(a, b, c, p)) return true;
  }
  return false;
}

/// Height of a triangle's plane over a point of the plan.
double heightOn(const Face& face, glm::dvec2 p) {
  const auto& [a, b, c] = face.corners;
  const glm::dvec3 n = glm::cross(b - a, c - a);
  return a.z - (n.x * (p.x - a.x) + n.y * (p.y - a.y)) / n.z;
}

/// Where a moving point first comes as near as `distance` to a segment, as a share of its way; nothing where it never
/// does, moves away, or is nearer already and not coming nearer. `normal` points from the segment to the point.
std::optional<double> firstTouch(glm::dvec2 a, glm::dvec2 b, double distance, glm::dvec2 from, glm::dvec2 by,
                                 glm::dvec2& normal) {
  const glm::dvec2 apart = from - nearestOn(a, b, from);
  const double now = glm::length(apart);
  if (now <= distance) {
    if (!(now > 0) || glm::dot(apart, by) >= 0) return std::nullopt;
    normal = apart / now;
    return 0;
  }
  double first = kInfinity;
  const glm::dvec2 along = b - a;
  const double length = glm::length(along);
  if (length > 0) {  // the two straight sides
    const glm::dvec2 u = along / length, n(-u.y, u.x);
    const double side = glm::dot(from - a, n), speed = glm::dot(by, n);
    if (side * speed < 0) {
      const double t = (std::abs(side) - distance) / std::abs(speed);
      const double s = glm::dot(from + t * by - a, u);
      if (t >= 0 && t <= 1 && s >= 0 && s <= length) first = t, normal = side > 0 ? n : -n;
    }
  }
  for (const glm::dvec2& end : {a, b}) {  // the two round ends
    const glm::dvec2 to = from - end;
    const double qa = glm::dot(by, by), qb = glm::dot(to, by), qc = glm::dot(to, to) - distance * distance;
    const double root = qb * qb - qa * qc;
    if (!(qa > 0) || qb >= 0 || root < 0) continue;
    const double t = (-qb - std::sqrt(root)) / qa;
    if (t >= 0 && t <= 1 && t < first) first = t, normal = glm::normalize(to + t * by);
  }
  if (first > 1) return std::nullopt;
  return first;
}

}  // namespace

void Ground::need(glm::dvec2 point, double about) {
  if (near_.halfSide > 0 && near_.covers(point, about)) return;
  near_ = gatherObstacles(*city_, point, std::max(kReach, 2 * about));
}

std::optional<double> Ground::footing(glm::dvec2 point, double feet) {
  if (!finite(point) || !std::isfinite(feet)) return std::nullopt;
  need(point, 1);
  double height = dryGroundAt(*city_, point);
  near_.faceCells.visit(point, point, [&](uint32_t i) {
    const Face& face = near_.faces[i];
    if (!face.walkable) return;
    const auto& [a, b, c] = face.corners;
    if (!triangleCovers(glm::dvec2(a), glm::dvec2(b), glm::dvec2(c), point)) return;
    const double z = heightOn(face, point);
    if (z <= feet + kStep + kTolerance) height = std::max(height, z);
  });
  if (!(std::abs(height - feet) <= kStep + kTolerance)) return std::nullopt;
  bool drowned = false;
  near_.waterCells.visit(point, point, [&](uint32_t i) {
    const WaterTriangle& w = near_.water[i];
    drowned =
        drowned || (w.level > height + kDeepWater && triangleCovers(w.corners[0], w.corners[1], w.corners[2], point));
  });
  if (drowned) return std::nullopt;
  return height;
}

void Ground::segmentsAbout(glm::dvec2 min, glm::dvec2 max, double feet, std::vector<Segment>& out) {
  out.clear();
  const glm::dvec2 from = min - kRadius - 0.2, to = max + kRadius + 0.2;  // 0.2: trunks' and posts' own thickness
  need(0.5 * (from + to), 0.5 * std::max(to.x - from.x, to.y - from.y));
  near_.wallCells.visit(from, to, [&](uint32_t i) {
    const Wall& wall = near_.walls[i];
    if (wall.top <= feet + kStep + kTolerance) return;
    out.push_back({wall.a, wall.b, wall.thickness + (wall.top > feet + kLegs ? kRadius : kLegRadius)});
  });
  near_.faceCells.visit(from, to, [&](uint32_t i) {
    for (const auto& [bottom, top, distance] :
         {std::array{kStep + kTolerance, kLegs, kLegRadius}, std::array{kLegs, kTall, kRadius}}) {
      const Cut cut = cutToHeights(near_.faces[i], feet + bottom, feet + top);
      for (size_t k = 0; k < cut.count && cut.count > 1; ++k)
        out.push_back({glm::dvec2(cut.corners[k]), glm::dvec2(cut.corners[(k + 1) % cut.count]), distance});
    }
  });
}

bool Ground::fits(const Standing& standing) {
  if (!finite(standing.at) || !std::isfinite(standing.feet)) return false;
  segmentsAbout(standing.at, standing.at, standing.feet, scratch_);
  bool covered = false;  // by what hangs lower than the head, or stands higher than a step
  near_.faceCells.visit(standing.at, standing.at, [&](uint32_t i) {
    covered = covered || covers(cutToHeights(near_.faces[i], standing.feet + kStep + kTolerance, standing.feet + kTall),
                                standing.at);
  });
  return !covered && std::none_of(scratch_.begin(), scratch_.end(), [&](const Segment& s) {
    return glm::distance(standing.at, nearestOn(s.a, s.b, standing.at)) < s.distance - kTolerance;
  });
}

bool Ground::stands(const Standing& standing) {
  const std::optional<double> height = footing(standing.at, standing.feet);
  return height && std::abs(*height - standing.feet) <= kTolerance && fits(standing);
}

std::optional<Standing> Ground::piece(const Standing& from, glm::dvec2 displacement, glm::dvec2& blocked,
                                      bool& noGround) {
  constexpr int kSlides = 4;  // two walls that meet, and what is left over from rounding
  const double length = glm::length(displacement);
  segmentsAbout(from.at - length, from.at + length, from.feet, scratch_);

  // Sweep, stop at what is touched first, go on along it.
  glm::dvec2 at = from.at, rest = displacement;
  std::array<glm::dvec2, kSlides> touched;
  for (size_t slide = 0; slide < kSlides && glm::length(rest) > 1e-9; ++slide) {
    double first = 1;
    glm::dvec2 normal(0);
    for (const Segment& s : scratch_) {
      glm::dvec2 n(0);
      const auto t = firstTouch(s.a, s.b, s.distance + kSkin, at, rest, n);
      if (t && *t < first) first = *t, normal = n;
    }
    at += first * rest;
    if (normal == glm::dvec2(0)) break;
    blocked = normal;
    touched[slide] = normal;
    rest *= 1 - first;
    rest -= std::min(glm::dot(rest, normal), 0.0) * normal;
    // In a corner what leads along one wall leads into the other: there is no way on.
    for (size_t k = 0; k < slide; ++k)
      if (glm::dot(rest, touched[k]) < -1e-12) rest = glm::dvec2(0);
  }

  // Is there firm ground, and no cliff within the length of a piece ahead?
  const glm::dvec2 moved = at - from.at;
  const double distance = glm::length(moved);
  if (!(distance > 1e-9)) return std::nullopt;
  const std::optional<double> feet = footing(at, from.feet);
  noGround = true;
  if (!feet) return std::nullopt;
  if (distance < kPiece && !footing(from.at + moved * (kPiece / distance), from.feet)) return std::nullopt;
  noGround = false;
  const Standing there{at, *feet};
  if (!fits(there)) return std::nullopt;
  return there;
}

Standing Ground::move(const Standing& from, glm::dvec2 displacement, glm::dvec2* blocked) {
  // Where straight on is no ground, aside of it may be: along a quay, about a ramp's foot.
  constexpr double kAside[] = {0.6, -0.6, 1.2, -1.2};
  glm::dvec2 hit(0);
  Standing now = from;
  const double length = glm::length(displacement);
  if (finite(displacement) && length > 1e-9) {
    const auto pieces = static_cast<int>(std::ceil(std::min(length, 1e4) / kPiece));
    const glm::dvec2 each = displacement / static_cast<double>(pieces);
    for (int k = 0; k < pieces; ++k) {
      bool noGround = false, ignored = false;
      std::optional<Standing> next = piece(now, each, hit, noGround);
      for (size_t a = 0; a < std::size(kAside) && noGround && !next; ++a) {
        const double c = std::cos(kAside[a]), s = std::sin(kAside[a]);
        next = piece(now, c * glm::dvec2(c * each.x - s * each.y, s * each.x + c * each.y), hit, ignored);
      }
      if (!next) {
        hit = -each / glm::length(each);
        break;
      }
      now = *next;
    }
  }
  if (blocked) *blocked = hit;
  return now;
}

double Ground::freeWay(const Standing& from, glm::dvec2 direction, double reach) {
  segmentsAbout(from.at - reach, from.at + reach, from.feet, scratch_);
  double share = 1;
  for (const Segment& s : scratch_) {
    glm::dvec2 normal(0);
    const auto t = firstTouch(s.a, s.b, 0.05, from.at, reach * direction, normal);
    if (t) share = std::min(share, *t);
  }
  return share * reach;
}

bool Ground::outdoors(const Standing& standing) {
  if (clearance(*city_, standing.at, kRadius) < kRadius - kTolerance) return false;
  // Inside a church, every way ends at the same monument; in a gate's passage or on a bridge two are open.
  constexpr int kWays = 16;
  constexpr double kFar = 40;  // metres: half of a cathedral
  uint32_t monument = city::kNone;
  need(standing.at, kFar);
  for (int k = 0; k < kWays; ++k) {
    const double angle = 2 * 3.141592653589793 * (k + 0.5) / kWays;
    const glm::dvec2 way = kFar * glm::dvec2(std::cos(angle), std::sin(angle));
    double first = kInfinity;
    uint32_t at = city::kNone;
    near_.faceCells.visit(
        glm::min(standing.at, standing.at + way), glm::max(standing.at, standing.at + way), [&](uint32_t i) {
          const Cut cut = cutToHeights(near_.faces[i], standing.feet + kLegs, standing.feet + kTall);
          for (size_t c = 0; c < cut.count && cut.count > 1; ++c) {
            glm::dvec2 normal(0);
            const auto t = firstTouch(glm::dvec2(cut.corners[c]), glm::dvec2(cut.corners[(c + 1) % cut.count]), 0.01,
                                      standing.at, way, normal);
            if (t && *t < first) first = *t, at = near_.faces[i].monument;
          }
        });
    if (at == city::kNone || (monument != city::kNone && at != monument)) return true;
    monument = at;
  }
  return false;
}

std::optional<Standing> Ground::place(glm::dvec2 point, double feet, double reach) {
  if (!finite(point)) return std::nullopt;
  const auto tryAt = [&](glm::dvec2 p) -> std::optional<Standing> {
    // Level with the feet where there is ground, else on the dry ground below or above.
    for (const double about : {feet, dryGroundAt(*city_, p)}) {
      const std::optional<double> height = footing(p, about);
      const Standing standing{p, height.value_or(0)};
      if (height && fits(standing) && outdoors(standing)) return standing;
    }
    return std::nullopt;
  };
  if (auto here = tryAt(point)) return here;
  // Rings outward; twelve places on the first, spaced alike on all others.
  constexpr double kBetween = 0.5;
  for (double radius = kBetween; radius <= reach; radius += std::max(kBetween, 0.1 * radius)) {
    const int places = std::clamp(static_cast<int>(12 * radius / kBetween), 12, 64);
    for (int k = 0; k < places; ++k) {
      const double angle = 2 * 3.141592653589793 * k / places;
      if (auto there = tryAt(point + radius * glm::dvec2(std::cos(angle), std::sin(angle)))) return there;
    }
  }
  return std::nullopt;
}

}  // namespace vicus::walking
