#include "assets/norvic/ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <thread>

#include "city/random.hpp"

namespace vicus::assets::norvic {
namespace {

using city::Ground;
using glm::dvec2;

/// Paints shapes into a raster: a texel belongs to a shape when its centre does.
class Painter {
 public:
  explicit Painter(city::GroundCover& cover) : cover_(cover) {}

  template <typename Inside>
  void paint(dvec2 min, dvec2 max, Ground ground, const Inside& inside) {
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor((min - cover_.origin) / cover_.spacing)), glm::ivec2(0));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::floor((max - cover_.origin) / cover_.spacing)), cover_.size - 1);
    for (int y = from.y; y <= to.y; ++y)
      for (int x = from.x; x <= to.x; ++x)
        if (inside(cover_.origin + (dvec2(x, y) + 0.5) * cover_.spacing)) texel(x, y) = ground;
  }

  void rect(const PlanRect& r, Ground ground) {
    const dvec2 half(r.halfWidth * std::abs(r.axis.x) + r.halfDepth * std::abs(r.axis.y),
                     r.halfWidth * std::abs(r.axis.y) + r.halfDepth * std::abs(r.axis.x));
    paint(r.centre - half, r.centre + half, ground, [&](dvec2 p) { return r.contains(p); });
  }

  /// A line no narrower than a texel, so that it does not break up.
  void line(dvec2 a, dvec2 b, double halfWidth, Ground ground) {
    const double half = std::max(halfWidth, 0.75 * cover_.spacing);
    paint(glm::min(a, b) - half, glm::max(a, b) + half, ground,
          [&](dvec2 p) { return distanceToSegment(p, a, b) < half; });
  }

  /// A polygon by rows: texels between odd and even crossings.
  void polygon(std::span<const dvec2> ring, Ground ground) {
    dvec2 min(1e300), max(-1e300);
    for (const dvec2 p : ring) min = glm::min(min, p), max = glm::max(max, p);
    const int from = std::max(0, static_cast<int>(std::floor((min.y - cover_.origin.y) / cover_.spacing)));
    const int to =
        std::min(cover_.size.y - 1, static_cast<int>(std::floor((max.y - cover_.origin.y) / cover_.spacing)));
    std::vector<double> crossings;
    for (int y = from; y <= to; ++y) {
      const double at = cover_.origin.y + (y + 0.5) * cover_.spacing;
      crossings.clear();
      for (size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        if ((a.y <= at) != (b.y <= at)) crossings.push_back(a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y));
      }
      std::sort(crossings.begin(), crossings.end());
      for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
        const int x0 =
            std::max(0, static_cast<int>(std::ceil((crossings[i] - cover_.origin.x) / cover_.spacing - 0.5)));
        const int x1 =
            std::min(cover_.size.x - 1,
                     static_cast<int>(std::floor((crossings[i + 1] - cover_.origin.x) / cover_.spacing - 0.5)));
        for (int x = x0; x <= x1; ++x) texel(x, y) = ground;
      }
    }
  }

 private:
  Ground& texel(int x, int y) {
    return cover_.kinds[static_cast<size_t>(y) * static_cast<size_t>(cover_.size.x) + static_cast<size_t>(x)];
  }
  city::GroundCover& cover_;
};

/// A wave between −1 and 1 with period 2, of parabolas: like a sine, and cheap for millions of texels.
double swing(double t) {
  const double whole = std::floor(t);
  const double x = t - whole;
  const double arc = 4 * x * (1 - x);
  return static_cast<int64_t>(whole) & 1 ? -arc : arc;
}

void paintFields(city::GroundCover& cover, uint32_t seed) {
  const int threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 16u));
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&cover, seed, t, threads] {
      for (int y = t; y < cover.size.y; y += threads)
        for (int x = 0; x < cover.size.x; ++x) {
          const Parcel parcel = parcelAt(cover.origin + (dvec2(x, y) + 0.5) * cover.spacing, seed);
          cover.kinds[static_cast<size_t>(y) * static_cast<size_t>(cover.size.x) + static_cast<size_t>(x)] =
              parcel.toEdge < 1.2 ? Ground::Grass : parcel.ground;
        }
    });
}

}  // namespace

Parcel parcelAt(dvec2 p, uint32_t seed) {
  // Strips of furlongs: blocks of 190 m in which all strips lie one way, each block its own.
  constexpr double kFurlong = 190;
  static const dvec2 axis(std::cos(0.31), std::sin(0.31));
  const dvec2 q(glm::dot(p, axis), glm::dot(p, dvec2(-axis.y, axis.x)));
  const dvec2 bent = q + 14.0 * dvec2(swing(q.y * (1 / 286.0)), swing(q.x * (1 / 350.0)));
  const dvec2 block = glm::floor(bent / kFurlong);
  const dvec2 in = bent - block * kFurlong;
  const uint32_t blockHash = city::hash32(
      city::hash32(static_cast<uint32_t>(static_cast<int>(block.x)), static_cast<uint32_t>(static_cast<int>(block.y))),
      seed);
  const bool turned = blockHash & 1U;
  const double along = turned ? in.y : in.x, across = turned ? in.x : in.y;
  const double strips = 3 + (blockHash >> 1 & 3U);
  const double width = kFurlong / strips;
  const double strip = std::floor(across / width);
  const uint32_t number = city::hash32(blockHash, static_cast<uint32_t>(strip));
  Parcel out;
  out.number = number;
  out.toEdge =
      std::min(std::min(along, kFurlong - along), std::min(across - strip * width, (strip + 1) * width - across));
  const uint32_t use = blockHash >> 8 & 7U;
  out.ground = use == 0             ? Ground::Grass
               : (number & 7U) < 5  ? Ground::Field
               : (number & 7U) == 5 ? Ground::Earth
                                    : Ground::Grass;
  return out;
}

city::GroundCover paintGround(const Landscape& land, std::span<const QuarterPlan> quarters, double spacing,
                              uint32_t seed) {
  city::GroundCover cover;
  const int size = static_cast<int>(std::lround(land.side() / spacing));
  cover.origin = dvec2(-0.5 * land.side());
  cover.spacing = land.side() / size;
  cover.size = glm::ivec2(size);
  cover.kinds.resize(static_cast<size_t>(size) * static_cast<size_t>(size));
  paintFields(cover, seed);

  Painter painter(cover);
  for (const QuarterPlan& q : quarters) {
    painter.polygon(q.outline, Ground::Grass);
    for (const PlanRect& r : q.gardens) painter.rect(r, Ground::Garden);
    for (const PlanRect& r : q.grass) painter.rect(r, Ground::Grass);
    for (const PlanRect& r : q.trodden) painter.rect(r, Ground::Earth);
  }
  if (land.hasRiver()) {
    const double half = land.riverHalfWidth() + land.bankWidth();
    const double step = 12;
    for (double x = -0.5 * land.side(); x < 0.5 * land.side(); x += step)
      painter.line({x, land.riverAt(x)}, {x + step, land.riverAt(x + step)}, half + 2, Ground::Bank);
    for (double x = -0.5 * land.side(); x < 0.5 * land.side(); x += step)
      painter.line({x, land.riverAt(x)}, {x + step, land.riverAt(x + step)},
                   land.riverHalfWidth() + 0.3 * land.bankWidth(), Ground::Water);
  }
  for (const QuarterPlan& q : quarters) {
    for (const PlanRect& r : q.paved) painter.rect(r, Ground::Paving);
    for (const StreetLine& line : q.streets) {
      if (line.style.kind == city::StreetKind::Bridge) continue;
      const Ground ground = line.style.kind == city::StreetKind::Road ? Ground::Earth : Ground::Street;
      for (size_t i = 1; i < line.points.size(); ++i)
        painter.line(line.points[i - 1], line.points[i], 0.5 * line.style.width + 0.4, ground);
    }
  }
  return cover;
}

}  // namespace vicus::assets::norvic
