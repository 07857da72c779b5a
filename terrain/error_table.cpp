/// Based on: the binary triangle trees of Duchaineau et al. 1997, "ROAMing Terrain: Real-time Optimally Adapting
/// Meshes". Departs from it: no nested bounds (wedgies). Each triangle's own largest error over all its samples is
/// found by walking its rows, level by level; that costs one pass over the field for each of the 2·log2(side) levels
/// and gives meshes of a third to a fifth of the triangles for the same guarantee.
#include "terrain/error_table.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

namespace vicus::terrain {
namespace {

constexpr int kExponentShift = 12;                      // 23 bits of a float's mantissa to 11
constexpr uint32_t kExponentOffset = (127 - 14) << 23;  // code exponent 1 is 2⁻¹³ m
constexpr float kSmallestError = 0x1p-13F;
constexpr ErrorCode kLargestCode = kNoGround - 1;

/// Runs `work(task)` for 0 … tasks − 1 on several threads.
template <typename Work>
void parallelFor(int tasks, unsigned threads, const Work& work) {
  std::atomic<int> next = 0;
  const auto run = [&] {
    for (int task = next++; task < tasks; task = next++) work(task);
  };
  const auto helpers = static_cast<unsigned>(std::clamp(tasks - 1, 0, static_cast<int>(threads) - 1));
  std::vector<std::jthread> pool;
  for (unsigned i = 0; i < helpers; ++i) pool.emplace_back(run);
  run();
}

/// Heights along a row, and what their errors weigh; no weights where all weigh the same.
struct Row {
  const float* heights;
  const float* weights;
};

/// Largest weight[i] · |row[i] − (z + slope · i)| for i in 0 … count − 1.
template <bool kWeighted>
float largestDeviationOf(const Row& row, int count, float z, float slope) {
  const auto deviation = [&](int i, float at) {
    const float d = std::abs(row.heights[i] - (z + slope * at));
    return kWeighted ? d * row.weights[i] : d;
  };
  constexpr int kLanes = 8;
  float most = 0;
  int i = 0;
  if (count >= kLanes) {
    std::array<float, kLanes> lanes{}, at{};
    for (int l = 0; l < kLanes; ++l) at[static_cast<size_t>(l)] = static_cast<float>(l);
    for (; i + kLanes <= count; i += kLanes)
      for (size_t l = 0; l < kLanes; ++l) {
        const float d = deviation(i + static_cast<int>(l), at[l]);
        lanes[l] = d > lanes[l] ? d : lanes[l];
        at[l] += static_cast<float>(kLanes);
      }
    for (const float lane : lanes) most = lane > most ? lane : most;
  }
  for (; i < count; ++i) {
    const float d = deviation(i, static_cast<float>(i));
    most = d > most ? d : most;
  }
  return most;
}
float largestDeviation(const Row& row, int count, float z, float slope) {
  return row.weights ? largestDeviationOf<true>(row, count, z, slope) : largestDeviationOf<false>(row, count, z, slope);
}

/// Heights of the field as the patches see them.
struct Samples {
  const city::HeightField& field;
  const float* filled;  ///< heights with gaps filled: what stands in a gap may be drawn too
  PatchGrid patches;
  const float* weights;  ///< null: all weigh 1

  size_t index(glm::ivec2 at) const {
    return static_cast<size_t>(at.y) * static_cast<size_t>(field.size.x) + static_cast<size_t>(at.x);
  }
  glm::ivec2 pressed(glm::ivec2 at) const { return glm::min(at, patches.cells); }
  bool within(glm::ivec2 at) const { return at.x <= patches.cells.x && at.y <= patches.cells.y; }
  float corner(glm::ivec2 at) const { return filled[index(at)]; }
  Row row(glm::ivec2 at) const { return {filled + index(at), weights ? weights + index(at) : nullptr}; }
  float weight(glm::ivec2 at) const { return weights ? weights[index(at)] : 1; }
  bool hasData(glm::ivec2 at) const { return std::isfinite(field.heights[index(at)]); }
};

/// A triangle by its corners in samples: hypotenuse a–b, right angle at the apex.
struct Corners {
  glm::ivec2 a, b, apex;
};

/// Error of a triangle whose corners all lie in the field: its rows begin and end on whole samples.
float errorOfRightTriangle(const Samples& s, const Corners& t) {
  const glm::ivec2 p = t.apex;
  const float za = s.corner(t.a), zb = s.corner(t.b), zp = s.corner(p);
  float most = 0;
  if (t.a.x != t.b.x && t.a.y != t.b.y) {  // legs along the axes: rows from the leg to the hypotenuse
    const bool aLevel = t.a.y == p.y;
    const glm::ivec2 level = aLevel ? t.a : t.b, upright = aLevel ? t.b : t.a;
    const int length = std::abs(level.x - p.x), dx = level.x > p.x ? 1 : -1, dy = upright.y > p.y ? 1 : -1;
    const float slopeX = ((aLevel ? za : zb) - zp) / static_cast<float>(length);
    const float slopeY = ((aLevel ? zb : za) - zp) / static_cast<float>(length);
    for (int i = 0; i <= length; ++i) {
      const int far = length - i;
      const float z = zp + slopeY * static_cast<float>(i);
      const float d = dx > 0 ? largestDeviation(s.row({p.x, p.y + dy * i}), far + 1, z, slopeX)
                             : largestDeviation(s.row({p.x - far, p.y + dy * i}), far + 1,
                                                z + slopeX * static_cast<float>(far), -slopeX);
      most = std::max(most, d);
    }
  } else if (t.a.y == t.b.y) {  // level hypotenuse: rows widen away from the apex
    const int h = std::abs(t.a.y - p.y), dy = t.a.y > p.y ? 1 : -1;
    const bool aWest = t.a.x < t.b.x;
    const float west = aWest ? za : zb, east = aWest ? zb : za;
    const float slopeX = (east - west) / static_cast<float>(2 * h);
    const float slopeY = ((east + west) / 2 - zp) / static_cast<float>(h);
    for (int i = 0; i <= h; ++i) {
      const float z = zp + slopeY * static_cast<float>(i) - slopeX * static_cast<float>(i);
      most = std::max(most, largestDeviation(s.row({p.x - i, p.y + dy * i}), 2 * i + 1, z, slopeX));
    }
  } else {  // upright hypotenuse: rows from the nearer leg to it
    const int h = std::abs(t.a.x - p.x), dx = t.a.x > p.x ? 1 : -1;
    const bool aSouth = t.a.y < t.b.y;
    const float south = aSouth ? za : zb, north = aSouth ? zb : za;
    const float slopeY = (north - south) / static_cast<float>(2 * h);
    const float slopeX = ((south + north) / 2 - zp) / static_cast<float>(h);
    for (int j = -h; j <= h; ++j) {
      const int near = std::abs(j);
      const int from = dx > 0 ? p.x + near : p.x - h;
      const float z = zp + slopeY * static_cast<float>(j) + slopeX * static_cast<float>(dx > 0 ? near : h);
      const float slope = dx > 0 ? slopeX : -slopeX;
      most = std::max(most, largestDeviation(s.row({from, p.y + j}), h - near + 1, z, slope));
    }
  }
  return most;
}

/// What of the full-detail ground lies under a triangle.
enum Cover : uint8_t { kNothing = 0, kData = 1, kGap = 2, kBoth = 3 };

struct UnderTriangle {
  float metres = 0;
  Cover cover = kNothing;
};

/// Error of a triangle that is pressed together at the field's edge: any shape, its rows found from its edges. Its
/// children need not lie within it, so its cover is that of its own samples.
UnderTriangle errorOfPressedTriangle(const Samples& s, const Corners& t) {
  const glm::dvec2 a(t.a), ab = glm::dvec2(t.b) - a, ap = glm::dvec2(t.apex) - a;
  const double area = ab.x * ap.y - ab.y * ap.x;
  UnderTriangle result;
  if (area == 0) return result;
  const double za = static_cast<double>(s.corner(t.a)), rise = static_cast<double>(s.corner(t.b)) - za,
               climb = static_cast<double>(s.corner(t.apex)) - za;
  const double slopeX = (rise * ap.y - climb * ab.y) / area, slopeY = (climb * ab.x - rise * ap.x) / area;
  const std::array<glm::ivec2, 4> ring{t.a, t.b, t.apex, t.a};
  const int bottom = std::min({t.a.y, t.b.y, t.apex.y}), top = std::max({t.a.y, t.b.y, t.apex.y});
  constexpr double kOnEdge = 1e-9;  // samples exactly on an edge belong to the triangle
  uint8_t cover = kNothing;
  for (int y = bottom; y <= top; ++y) {
    double west = std::numeric_limits<double>::infinity(), east = -west;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec2 from(ring[k]), to(ring[k + 1]);
      if (std::min(from.y, to.y) > y || std::max(from.y, to.y) < y) continue;
      const double x = from.y == to.y ? to.x : from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x);
      west = std::min(west, x), east = std::max(east, x);
    }
    const int first = static_cast<int>(std::ceil(west - kOnEdge)), last = static_cast<int>(std::floor(east + kOnEdge));
    for (int x = first; x <= last; ++x) {
      const double plane = za + slopeX * (x - t.a.x) + slopeY * (y - t.a.y);
      const auto d = s.weight({x, y}) * static_cast<float>(std::abs(static_cast<double>(s.corner({x, y})) - plane));
      cover |= s.hasData({x, y}) ? kData : kGap;
      result.metres = d > result.metres ? d : result.metres;
    }
  }
  result.cover = static_cast<Cover>(cover);
  return result;
}

/// Cover of every triangle, from the finest up; only for fields with gaps.
class Covers {
 public:
  explicit Covers(const Samples& samples) : samples_(samples), columns_(samples.patches.span().x + 1) {
    const glm::ivec2 span = samples.patches.span();
    covers_.resize(2 * static_cast<size_t>(columns_) * static_cast<size_t>(span.y + 1), kNothing);
    // A triangle's children have half its area: squares of side 2h come after edges of length 2h.
    for (int h = 1; h <= samples.patches.side / 2; h *= 2)
      for (const bool edges : {true, false})
        for (int y = 0; y <= span.y; y += h)
          for (int x = 0; x <= span.x; x += h) {
            const bool oddX = (x & h) != 0, oddY = (y & h) != 0;
            if (edges ? oddX != oddY : oddX && oddY) join({x, y});
          }
  }
  Cover at(glm::ivec2 centre, uint32_t side) const {
    return static_cast<Cover>(
        covers_[2 * (static_cast<size_t>(centre.y) * static_cast<size_t>(columns_) + static_cast<size_t>(centre.x)) +
                side]);
  }

 private:
  void join(glm::ivec2 centre) {
    const DiamondShape shape = diamondAt(samples_.patches, centre);
    for (const int sign : {1, -1}) {
      const glm::ivec2 v = sign * shape.v, apex = centre + v;
      const glm::ivec2 span = samples_.patches.span();
      if (apex.x < 0 || apex.y < 0 || apex.x > span.x || apex.y > span.y) continue;
      uint8_t cover = kNothing;
      for (const int end : {1, -1}) {
        const glm::ivec2 hypotenuse = centre + end * shape.u;
        const glm::ivec2 twice = hypotenuse + apex;
        // The child over the leg from that end to the apex, with its own apex at the centre.
        if ((twice.x | twice.y) % 2 != 0)
          cover |= cell(hypotenuse, apex, centre);
        else
          cover |= at(twice / 2, canonicalSide(centre - twice / 2));
      }
      covers_[2 * (static_cast<size_t>(centre.y) * static_cast<size_t>(columns_) + static_cast<size_t>(centre.x)) +
              canonicalSide(v)] = cover;
    }
  }
  uint8_t cell(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) const {
    if (!samples_.within(a) || !samples_.within(b) || !samples_.within(c)) return kNothing;
    for (const glm::ivec2 corner : {a, b, c})
      if (!samples_.hasData(corner)) return kGap;
    return kData;
  }

  const Samples& samples_;
  int columns_;
  std::vector<uint8_t> covers_;
};

/// Fills gaps: along each row from the samples to both sides, rows without data from the nearest row with data.
std::vector<float> fillGaps(const city::HeightField& field) {
  std::vector<float> filled = field.heights;
  const int columns = field.size.x, rows = field.size.y;
  const auto row = [&](int y) { return filled.data() + static_cast<size_t>(y) * static_cast<size_t>(columns); };
  std::vector<int> rowsWithData;
  for (int y = 0; y < rows; ++y) {
    int last = -1;
    for (int x = 0; x <= columns; ++x) {
      if (x < columns && !std::isfinite(row(y)[x])) continue;
      for (int gap = last + 1; gap < x && (last >= 0 || x < columns); ++gap) {
        const float before = row(y)[last >= 0 ? last : x], after = row(y)[x < columns ? x : last];
        const float t = static_cast<float>(gap - last) / static_cast<float>(x - last);
        row(y)[gap] = before + t * (after - before);
      }
      last = x;
    }
    if (std::isfinite(row(y)[0])) rowsWithData.push_back(y);
  }
  for (int y = 0; y < rows; ++y) {
    const auto above = std::lower_bound(rowsWithData.begin(), rowsWithData.end(), y);
    if (above != rowsWithData.end() && *above == y) continue;
    int nearest = above != rowsWithData.end() ? *above : rowsWithData.back();
    if (above != rowsWithData.begin() && y - *(above - 1) < std::abs(nearest - y)) nearest = *(above - 1);
    std::copy(row(nearest), row(nearest) + columns, row(y));
  }
  return filled;
}

/// Error of one side of a diamond, as its code.
ErrorCode codeOf(const Samples& s, const Covers* covers, glm::ivec2 centre, const DiamondShape& shape, int sign) {
  const glm::ivec2 apex = centre + sign * shape.v;
  const Corners corners{centre - sign * shape.u, centre + sign * shape.u, apex};
  UnderTriangle under;
  if (s.within(corners.a) && s.within(corners.b) && s.within(corners.apex)) {
    under.cover = covers ? covers->at(centre, canonicalSide(sign * shape.v)) : kData;
    if (under.cover != kGap) under.metres = errorOfRightTriangle(s, corners);
  } else {
    under = errorOfPressedTriangle(s, {s.pressed(corners.a), s.pressed(corners.b), s.pressed(corners.apex)});
  }
  if (under.cover == kGap) return kNoGround;
  if (under.cover == kBoth) {
    const glm::dvec2 length = glm::dvec2(s.pressed(corners.a) - s.pressed(corners.b)) * s.field.spacing;
    under.metres = std::max(under.metres, static_cast<float>(glm::length(length)));
  }
  return encodeError(under.metres);
}

}  // namespace

ErrorCode encodeError(float metres) {
  if (metres == 0) return 0;
  const uint32_t bits = std::bit_cast<uint32_t>(std::max(metres, kSmallestError)) - kExponentOffset;
  const uint32_t code = (bits + (1U << kExponentShift) - 1) >> kExponentShift;  // rounds up
  return static_cast<ErrorCode>(std::min(code, uint32_t{kLargestCode}));
}

float decodeError(ErrorCode code) {
  if (code == 0 || code == kNoGround) return 0;
  return std::bit_cast<float>((uint32_t{code} << kExponentShift) + kExponentOffset);
}

ErrorTable buildErrorTable(const city::HeightField& field, std::span<const float> weights, unsigned threads) {
  assert((weights.empty() || weights.size() == field.heights.size()) && "one weight for each sample");
  ErrorTable table;
  const bool gaps = std::any_of(field.heights.begin(), field.heights.end(), [](float h) { return !std::isfinite(h); });
  const bool data = std::any_of(field.heights.begin(), field.heights.end(), [](float h) { return std::isfinite(h); });
  if (field.empty() || !data) return table;
  table.patches = patchGridFor(field.size);
  if (gaps) table.filled = fillGaps(field);

  const glm::ivec2 span = table.patches.span();
  const auto columns = static_cast<size_t>(span.x) + 1;
  table.codes.resize(2 * columns * (static_cast<size_t>(span.y) + 1), 0);
  const Samples samples{field, gaps ? table.filled.data() : field.heights.data(), table.patches,
                        weights.empty() ? nullptr : weights.data()};
  std::optional<Covers> covers;
  if (gaps) covers.emplace(samples);

  // Rows are handed out in bands: a row's work depends on how many powers of two divide it, a band's hardly does.
  constexpr int kBand = 16;
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  parallelFor((span.y + kBand) / kBand, threads, [&](int band) {
    for (int y = band * kBand; y <= std::min(span.y, band * kBand + kBand - 1); ++y)
      for (int x = 0; x <= span.x; ++x) {
        if ((x | y) % table.patches.side == 0) continue;
        const glm::ivec2 centre(x, y);
        const DiamondShape shape = diamondAt(table.patches, centre);
        for (const int sign : {1, -1}) {
          const glm::ivec2 apex = centre + sign * shape.v;
          if (apex.x < 0 || apex.y < 0 || apex.x > span.x || apex.y > span.y) continue;
          table.codes[2 * (static_cast<size_t>(y) * columns + static_cast<size_t>(x)) + canonicalSide(sign * shape.v)] =
              codeOf(samples, covers ? &*covers : nullptr, centre, shape, sign);
        }
      }
  });
  return table;
}

}  // namespace vicus::terrain
