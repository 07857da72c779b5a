#include "assets/materials/pattern.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "city/random.hpp"

namespace vicus::assets::pattern {
namespace {

size_t index(Size size, int x, int y) {
  return static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x);
}

/// Uniform in −1 … 1.
float signedChance(uint32_t h) {
  return static_cast<float>(h) * (2.0F / 4294967296.0F) - 1.0F;
}

/// Catmull–Rom weights of the lattice points −1, 0, 1, 2 at 0 ≤ t < 1.
std::array<float, 4> splineWeights(float t) {
  const float t2 = t * t, t3 = t2 * t;
  return {-0.5F * t3 + t2 - 0.5F * t, 1.5F * t3 - 2.5F * t2 + 1.0F, -1.5F * t3 + 2.0F * t2 + 0.5F * t,
          0.5F * t3 - 0.5F * t2};
}

/// Where a texel lies on a lattice: its four lattice neighbours and their weights.
struct Knot {
  std::array<int, 4> at;
  std::array<float, 4> weight;
};

std::vector<Knot> knots(int texels, int cells, float offset) {
  std::vector<Knot> result(static_cast<size_t>(texels));
  for (int x = 0; x < texels; ++x) {
    const float position = static_cast<float>(x) * static_cast<float>(cells) / static_cast<float>(texels) + offset;
    const int cell = static_cast<int>(position);
    Knot& k = result[static_cast<size_t>(x)];
    for (int n = 0; n < 4; ++n) k.at[static_cast<size_t>(n)] = wrapped(cell + n - 1, cells);
    k.weight = splineWeights(position - static_cast<float>(cell));
  }
  return result;
}

/// Adds noise · amplitude. Splines are separable: each lattice row is first drawn out to the texture's width.
void addNoise(Field& field, glm::ivec2 cells, float amplitude, uint32_t seed) {
  // The rms of uniform lattice values under these splines is 0.577 · 0.80; the factor brings it to 0.5.
  const float scale = amplitude * 1.083F;
  const Size size = field.size;
  const auto width = static_cast<size_t>(size.width);
  // Noise is strongest at its lattice points: each octave begins elsewhere, so that they meet nowhere.
  const std::vector<Knot> xs = knots(size.width, cells.x, chance(seed, 1)),
                          ys = knots(size.height, cells.y, chance(seed, 2));
  std::vector<float> lattice(static_cast<size_t>(cells.x));
  std::vector<float> rows(static_cast<size_t>(cells.y) * width);
  for (int j = 0; j < cells.y; ++j) {
    const uint32_t rowSeed = city::hash32(seed, static_cast<uint32_t>(j));
    for (int i = 0; i < cells.x; ++i)
      lattice[static_cast<size_t>(i)] =
          scale * signedChance(city::hash32(rowSeed + static_cast<uint32_t>(i) * 0x9e3779b9U));
    float* row = rows.data() + static_cast<size_t>(j) * width;
    for (size_t x = 0; x < width; ++x) {
      const Knot& k = xs[x];
      row[x] =
          k.weight[0] * lattice[static_cast<size_t>(k.at[0])] + k.weight[1] * lattice[static_cast<size_t>(k.at[1])] +
          k.weight[2] * lattice[static_cast<size_t>(k.at[2])] + k.weight[3] * lattice[static_cast<size_t>(k.at[3])];
    }
  }
  for (int y = 0; y < size.height; ++y) {
    const Knot& k = ys[static_cast<size_t>(y)];
    const float* a = rows.data() + static_cast<size_t>(k.at[0]) * width;
    const float* b = rows.data() + static_cast<size_t>(k.at[1]) * width;
    const float* c = rows.data() + static_cast<size_t>(k.at[2]) * width;
    const float* d = rows.data() + static_cast<size_t>(k.at[3]) * width;
    float* out = field.texels.data() + static_cast<size_t>(y) * width;
    for (size_t x = 0; x < width; ++x)
      out[x] += k.weight[0] * a[x] + k.weight[1] * b[x] + k.weight[2] * c[x] + k.weight[3] * d[x];
  }
}

/// One box pass along rows of `length` values `stride` apart, wrapping round.
void boxPass(const float* in, float* out, int length, size_t stride, int radius) {
  const float scale = 1.0F / static_cast<float>(2 * radius + 1);
  float sum = 0;
  for (int n = -radius; n <= radius; ++n) sum += in[static_cast<size_t>(wrapped(n, length)) * stride];
  for (int n = 0; n < length; ++n) {
    out[static_cast<size_t>(n) * stride] = sum * scale;
    sum += in[static_cast<size_t>(wrapped(n + radius + 1, length)) * stride] -
           in[static_cast<size_t>(wrapped(n - radius, length)) * stride];
  }
}

/// The same down all columns at once, row by row, for the cache's sake.
void boxPassDown(const Field& in, Field& out, int radius) {
  const auto width = static_cast<size_t>(in.size.width);
  const int height = in.size.height;
  const float scale = 1.0F / static_cast<float>(2 * radius + 1);
  const auto row = [&](int y) { return in.texels.data() + static_cast<size_t>(wrapped(y, height)) * width; };
  std::vector<float> sum(width, 0.0F);
  for (int n = -radius; n <= radius; ++n)
    for (size_t x = 0; x < width; ++x) sum[x] += row(n)[x];
  for (int y = 0; y < height; ++y) {
    float* o = out.texels.data() + static_cast<size_t>(y) * width;
    const float* enter = row(y + radius + 1);
    const float* leave = row(y - radius);
    for (size_t x = 0; x < width; ++x) {
      o[x] = sum[x] * scale;
      sum[x] += enter[x] - leave[x];
    }
  }
}

/// 4 096 steps from linear to 8-bit sRGB.
const std::array<uint8_t, 4097>& encodeTable() {
  static const std::array<uint8_t, 4097> table = [] {
    std::array<uint8_t, 4097> t{};
    for (size_t i = 0; i < t.size(); ++i) {
      const double v = static_cast<double>(i) / 4096.0;
      const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
      t[i] = static_cast<uint8_t>(std::lround(s * 255.0));
    }
    return t;
  }();
  return table;
}

/// Fills uncovered texels with the colour of covered ones, nearest first, by passes that grow by twice as far each.
void bleed(Image& image) {
  const Size size{image.width, image.height};
  std::vector<uint8_t> known(size.texels());
  glm::dvec3 sum(0);
  double n = 0;
  for (size_t i = 0; i < known.size(); ++i) {
    known[i] = image.rgba[4 * i + 3] != 0;
    if (!known[i]) continue;
    sum += glm::dvec3(image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2]);
    n += 1;
  }
  if (n == 0) return;
  for (int step = 1; step <= 8; step *= 2) {
    const std::vector<uint8_t> before = known;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        const size_t i = index(size, x, y);
        if (before[i]) continue;
        int count = 0;
        glm::ivec3 total(0);
        for (const glm::ivec2 d :
             {glm::ivec2(step, 0), glm::ivec2(-step, 0), glm::ivec2(0, step), glm::ivec2(0, -step)}) {
          const size_t j = index(size, wrapped(x + d.x, size.width), wrapped(y + d.y, size.height));
          if (!before[j]) continue;
          total += glm::ivec3(image.rgba[4 * j], image.rgba[4 * j + 1], image.rgba[4 * j + 2]);
          ++count;
        }
        if (count == 0) continue;
        for (int c = 0; c < 3; ++c) image.rgba[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(total[c] / count);
        known[i] = 1;
      }
  }
  const glm::dvec3 mean = sum / n;
  for (size_t i = 0; i < known.size(); ++i)
    if (!known[i])
      for (int c = 0; c < 3; ++c) image.rgba[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(mean[c]);
}

}  // namespace

Field noise(Size size, glm::ivec2 cells, uint32_t seed) {
  Field field(size);
  addNoise(field, cells, 1, seed);
  return field;
}

Field fbm(Size size, glm::ivec2 cells, int octaves, float gain, uint32_t seed) {
  Field field(size);
  std::vector<float> amplitudes;
  float power = 0;
  float amplitude = 1;
  for (int o = 0; o < octaves; ++o, amplitude *= gain) {
    const glm::ivec2 c(cells.x << o, cells.y << o);
    if (o > 0 && (2 * c.x > size.width || 2 * c.y > size.height)) break;
    amplitudes.push_back(amplitude);
    power += amplitude * amplitude;
  }
  const float scale = 1.0F / std::sqrt(power);
  for (size_t o = 0; o < amplitudes.size(); ++o)
    addNoise(field, {cells.x << o, cells.y << o}, amplitudes[o] * scale, city::hash32(seed, static_cast<uint32_t>(o)));
  return field;
}

Field grain(Size size, uint32_t seed) {
  Field field(size);
  city::Random random(seed);
  for (float& v : field.texels) v = signedChance(random.bits());
  return field;
}

Field blurred(const Field& field, int radius) {
  if (radius <= 0) return field;
  Field result = field;
  Field other(field.size);
  for (int pass = 0; pass < 2; ++pass) {
    for (int y = 0; y < field.size.height; ++y)
      boxPass(result.texels.data() + index(field.size, 0, y), other.texels.data() + index(field.size, 0, y),
              field.size.width, 1, radius);
    boxPassDown(other, result, radius);
  }
  return result;
}

Field displaced(const Field& field, const Field& dx, const Field& dy, float texels) {
  assert(field.size == dx.size && field.size == dy.size);
  Field result(field.size);
  const Size size = field.size;
  size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++i) {
      // Moved into the positive before the cut to whole texels, which rounds towards zero.
      const float px = static_cast<float>(x + 4 * size.width) + dx[i] * texels;
      const float py = static_cast<float>(y + 4 * size.height) + dy[i] * texels;
      const int ix = static_cast<int>(px), iy = static_cast<int>(py);
      const float fx = px - static_cast<float>(ix), fy = py - static_cast<float>(iy);
      const int x0 = wrapped(ix, size.width), x1 = x0 + 1 == size.width ? 0 : x0 + 1;
      const int y0 = wrapped(iy, size.height), y1 = y0 + 1 == size.height ? 0 : y0 + 1;
      const float bottom = field[index(size, x0, y0)] * (1 - fx) + field[index(size, x1, y0)] * fx;
      const float top = field[index(size, x0, y1)] * (1 - fx) + field[index(size, x1, y1)] * fx;
      result[i] = bottom * (1 - fy) + top * fy;
    }
  return result;
}

Cells voronoi(Size size, glm::ivec2 cells, float jitter, float wobble, uint32_t seed, float stretch) {
  Cells result{size, static_cast<uint32_t>(cells.x * cells.y), std::vector<CellTexel>(size.texels())};
  const glm::vec2 cell(static_cast<float>(size.width) / static_cast<float>(cells.x),
                       static_cast<float>(size.height) / static_cast<float>(cells.y));
  // The points with a border of two cells round them, so that neighbours need no wrapping.
  const int stride = cells.x + 4;
  struct Point {
    glm::vec2 at;
    uint32_t id;
  };
  std::vector<Point> points;
  points.reserve(static_cast<size_t>(stride) * static_cast<size_t>(cells.y + 4));
  for (int j = -2; j < cells.y + 2; ++j)
    for (int i = -2; i < cells.x + 2; ++i) {
      const auto id = static_cast<uint32_t>(wrapped(j, cells.y) * cells.x + wrapped(i, cells.x));
      const uint32_t h = city::hash32(seed, id);
      const glm::vec2 offset(signedChance(h), signedChance(city::hash32(h)));
      points.push_back({(glm::vec2(i, j) + 0.5F + 0.5F * jitter * offset) * cell, id});
    }
  // Distances are taken with y squashed; the nine candidates of a cell serve all of its texels.
  const float squash = 1 / stretch;
  constexpr size_t kCandidates = 9;
  std::array<float, kCandidates> qx{}, qy{}, f{};
  std::array<uint32_t, kCandidates> id{};
  glm::ivec2 loaded(-1);
  const glm::ivec2 bends(glm::max(cells.x * 2, 4), glm::max(cells.y * 2, 4));
  const Field bendX = fbm(size, bends, 3, 0.6F, city::hash32(seed, 101)),
              bendY = fbm(size, bends, 3, 0.6F, city::hash32(seed, 102));
  const glm::vec2 perTexel = 1.0F / cell;
  size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++i) {
      const glm::vec2 p(static_cast<float>(x) + 0.5F + wobble * bendX[i],
                        static_cast<float>(y) + 0.5F + wobble * bendY[i]);
      // The first of the 3 × 3 cells about p's own, counted in the bordered table; wobble may have moved p out by one.
      const glm::ivec2 c(glm::clamp(static_cast<int>(p.x * perTexel.x + 1), 0, cells.x + 1),
                         glm::clamp(static_cast<int>(p.y * perTexel.y + 1), 0, cells.y + 1));
      if (c != loaded) {
        for (size_t k = 0; k < kCandidates; ++k) {
          const Point& q = points[static_cast<size_t>((c.y + static_cast<int>(k / 3)) * stride + c.x) + k % 3];
          qx[k] = q.at.x, qy[k] = q.at.y * squash, id[k] = q.id;
        }
        loaded = c;
      }
      const float px = p.x, py = p.y * squash;
      for (size_t k = 0; k < kCandidates; ++k) f[k] = (qx[k] - px) * (qx[k] - px) + (qy[k] - py) * (qy[k] - py);
      size_t nearest = 0;
      for (size_t k = 1; k < kCandidates; ++k)
        if (f[k] < f[nearest]) nearest = k;
      // The nearest bisector lies at the smallest (f − f1) / 2|q − q1|; its square is compared without dividing.
      float over = 1e12F, under = 1;
      for (size_t k = 0; k < kCandidates; ++k) {
        const float dx = qx[k] - qx[nearest], dy = qy[k] - qy[nearest];
        const float gap = f[k] - f[nearest], between = dx * dx + dy * dy;
        if (k != nearest && gap * gap * under < over * between) over = gap * gap, under = between;
      }
      result.texels[i] = {0.5F * std::sqrt(over / under), 2 * (px - qx[nearest]) * perTexel.x,
                          2 * (py - qy[nearest]) * stretch * perTexel.y, id[nearest]};
    }
  return result;
}

Cells courses(Size size, const std::vector<Course>& rows, float corner, float wobble, uint32_t seed) {
  struct Block {
    float from, to;
    uint32_t id;
  };
  struct Row {
    float bottom, top;
    std::vector<Block> blocks;
    std::vector<uint16_t> blockAt;  ///< for each texel across
  };
  Cells result{size, 0, std::vector<CellTexel>(size.texels())};
  const auto width = static_cast<float>(size.width);
  float total = 0;
  for (const Course& row : rows) total += row.height;
  const float scale = static_cast<float>(size.height) / total;

  // Look-up tables: which course each row of texels is in, which block each texel of a course.
  std::vector<Row> laid;
  float bottom = 0;
  for (const Course& row : rows) {
    Row r{bottom, bottom + row.height * scale, {}, std::vector<uint16_t>(static_cast<size_t>(size.width))};
    for (size_t k = 0; k < row.joints.size(); ++k) {
      const float next = k + 1 < row.joints.size() ? row.joints[k + 1] : row.joints[0] + width;
      r.blocks.push_back({row.joints[k], next, result.count++});
    }
    for (int x = 0; x < size.width; ++x) {
      const float px = static_cast<float>(x) + 0.5F;
      size_t k = r.blocks.size() - 1;
      for (size_t n = 0; n < r.blocks.size(); ++n)
        if (px >= r.blocks[n].from) k = n;
      if (px < r.blocks[0].from) k = r.blocks.size() - 1;
      r.blockAt[static_cast<size_t>(x)] = static_cast<uint16_t>(k);
    }
    bottom = r.top;
    laid.push_back(std::move(r));
  }
  std::vector<size_t> rowAt(static_cast<size_t>(size.height));
  for (size_t y = 0, r = 0; y < rowAt.size(); ++y) {
    while (r + 1 < laid.size() && static_cast<float>(y) + 0.5F >= laid[r].top) ++r;
    rowAt[y] = r;
  }

  const bool bends = wobble > 0;
  const Field bendX = bends ? fbm(size, {24, 24}, 3, 0.6F, city::hash32(seed, 103)) : Field();
  const Field bendY = bends ? fbm(size, {24, 24}, 3, 0.6F, city::hash32(seed, 104)) : Field();
  const auto height = static_cast<float>(size.height);
  size_t i = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x, ++i) {
      float px = static_cast<float>(x) + 0.5F, py = static_cast<float>(y) + 0.5F;
      if (bends) {
        px += wobble * bendX[i];
        py += wobble * bendY[i];
        px += px < 0 ? width : (px >= width ? -width : 0);
        py += py < 0 ? height : (py >= height ? -height : 0);
      }
      const size_t cx = glm::min(static_cast<size_t>(px), static_cast<size_t>(size.width - 1));
      const size_t cy = glm::min(static_cast<size_t>(py), static_cast<size_t>(size.height - 1));
      const Row& r = laid[rowAt[cy]];
      const Block& b = r.blocks[r.blockAt[cx]];
      float left = px - b.from;
      if (left < 0) left += width;
      const float right = b.to - b.from - left;
      const float qx = glm::min(left, right), qy = glm::min(py - r.bottom, r.top - py);
      float edge = glm::min(qx, qy);
      if (qx < corner && qy < corner)
        edge = corner - std::sqrt((corner - qx) * (corner - qx) + (corner - qy) * (corner - qy));
      result.texels[i] = {edge, left / (b.to - b.from), (py - r.bottom) / (r.top - r.bottom), b.id};
    }
  return result;
}

std::vector<Course> runningBond(Size size, int courseCount, int perCourse, float shift, float irregular,
                                uint32_t seed) {
  std::vector<Course> rows;
  const float block = static_cast<float>(size.width) / static_cast<float>(perCourse);
  for (int r = 0; r < courseCount; ++r) {
    Course row{1, {}};
    const float start = std::fmod(shift * static_cast<float>(r), 1.0F);
    for (int k = 0; k < perCourse; ++k) {
      const uint32_t h = city::hash32(seed, static_cast<uint32_t>(r * perCourse + k));
      // Kept half a jitter inside the texture, so that the joints stay ascending and within it.
      const float at = (static_cast<float>(k) + start + irregular * (0.5F + 0.5F * signedChance(h))) * block;
      row.joints.push_back(at);
    }
    for (float& j : row.joints) j = std::fmod(j, static_cast<float>(size.width));
    std::sort(row.joints.begin(), row.joints.end());
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Course> englishBond(Size size, int courseCount, int stretchersPerCourse, uint32_t seed) {
  std::vector<Course> rows;
  for (int r = 0; r < courseCount; ++r) {
    const bool headers = r % 2 == 1;
    const int count = headers ? 2 * stretchersPerCourse : stretchersPerCourse;
    const float block = static_cast<float>(size.width) / static_cast<float>(count);
    Course row{1, {}};
    // A header is centred on each perpend of the course below: half a header, a quarter of a stretcher.
    const float start = headers ? 0.5F : 0.0F;
    for (int k = 0; k < count; ++k) {
      const uint32_t h = city::hash32(seed, static_cast<uint32_t>(r * 1024 + k));
      row.joints.push_back((static_cast<float>(k) + start) * block + 0.6F + 0.6F * signedChance(h));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<Course> ashlarCourses(Size size, int courseCount, int perCourse, float irregular, uint32_t seed) {
  city::Random random(seed);
  std::vector<Course> rows;
  for (int r = 0; r < courseCount; ++r) {
    Course row{1 + irregular * static_cast<float>(random.uniform(-1, 1)), {}};
    std::vector<float> lengths;
    float total = 0;
    const int count = perCourse + static_cast<int>(random.below(2));
    for (int k = 0; k < count; ++k) {
      lengths.push_back(1 + 1.2F * irregular * static_cast<float>(random.uniform(-1, 1)));
      total += lengths.back();
    }
    const float scale = static_cast<float>(size.width) / total;
    float at = static_cast<float>(random.uniform()) * lengths[0] * scale;
    for (const float length : lengths) {
      row.joints.push_back(at);
      at += length * scale;
    }
    for (float& j : row.joints) j = std::fmod(j, static_cast<float>(size.width));
    std::sort(row.joints.begin(), row.joints.end());
    rows.push_back(std::move(row));
  }
  return rows;
}

void drawStroke(Surface& surface, const Stroke& s) {
  overStroke(surface.size, s.from, s.to, s.widthFrom, s.widthTo, [&](size_t i, float cover, float t) {
    Texel& texel = surface.texels[i];
    texel.colour += cover * (s.colour - texel.colour);
    texel.height += cover * (s.height * t - texel.height);
  });
}

void drawLeaf(Surface& surface, const Leaf& leaf) {
  const Size size = surface.size;
  const glm::vec2 axis(std::cos(leaf.angle), std::sin(leaf.angle));
  const float reach = 0.5F * leaf.length + 1;
  const glm::ivec2 lo(glm::floor(leaf.centre - reach)), hi(glm::ceil(leaf.centre + reach));
  for (int y = lo.y; y <= hi.y; ++y) {
    const size_t row = index(size, 0, wrapped(y, size.height));
    for (int x = lo.x; x <= hi.x; ++x) {
      const glm::vec2 p = glm::vec2(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) - leaf.centre;
      const float along = 2 * (p.x * axis.x + p.y * axis.y) / leaf.length;
      if (along <= -1 || along >= 1) continue;
      const float across = 2 * (p.y * axis.x - p.x * axis.y) / leaf.width;
      // Widest a little behind the middle, pointed at the tip.
      const float outline = (1 - along * along) * (1 - 0.25F * along);
      const float out = glm::abs(across) / outline;
      if (out >= 1) continue;
      const float rib = 1 - smoothly(0.0F, 0.22F, out);
      const size_t i = row + static_cast<size_t>(wrapped(x, size.width));
      // The two halves catch the light differently.
      surface.texels[i] = {leaf.colour * (1 + 0.10F * rib + (across > 0 ? 0.05F : -0.05F)),
                           leaf.height + 0.5F * (1 - out)};
      if (!surface.cover.empty()) surface.cover[i] = 1;
    }
  }
}

Image finish(const Surface& surface, const Light& light) {
  const Size size = surface.size;
  Image image{size.width, size.height, std::vector<uint8_t>(size.texels() * 4)};
  const std::array<uint8_t, 4097>& encode = encodeTable();
  const auto encoded = [&](float v) { return encode[static_cast<size_t>(glm::clamp(v, 0.0F, 1.0F) * 4096.0F)]; };

  Field height(size);
  for (size_t i = 0; i < size.texels(); ++i) height[i] = surface.texels[i].height;
  const Field around = blurred(height, light.cavityRadius);
  for (int y = 0; y < size.height; ++y) {
    const size_t row = index(size, 0, y), above = index(size, 0, wrapped(y + 1, size.height)),
                 below = index(size, 0, wrapped(y - 1, size.height));
    for (int x = 0; x < size.width; ++x) {
      const auto column = static_cast<size_t>(x);
      const size_t i = row + column;
      const size_t left = row + static_cast<size_t>(x == 0 ? size.width - 1 : x - 1);
      const size_t right = row + static_cast<size_t>(x + 1 == size.width ? 0 : x + 1);
      const float slopeX = 0.5F * (height[right] - height[left]);
      const float slopeY = 0.5F * (height[above + column] - height[below + column]);
      const float relief = 1 + glm::clamp(light.relief * 0.7F * (slopeX - slopeY), -0.55F, 0.45F);
      const float cavity = 1 + glm::clamp(light.cavity * (height[i] - around[i]), -0.55F, 0.08F);
      const glm::vec3 colour = surface.texels[i].colour * (relief * cavity);
      uint8_t* out = image.rgba.data() + 4 * i;
      out[0] = encoded(colour.r), out[1] = encoded(colour.g), out[2] = encoded(colour.b);
      out[3] = surface.cover.empty() || surface.cover[i] ? 255 : 0;
    }
  }
  if (!surface.cover.empty()) bleed(image);
  return image;
}

glm::vec3 srgb(uint32_t hex) {
  static const std::array<float, 256> linear = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) {
      const double s = static_cast<double>(i) / 255.0;
      t[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
    }
    return t;
  }();
  return {linear[(hex >> 16) & 0xffU], linear[(hex >> 8) & 0xffU], linear[hex & 0xffU]};
}

float chance(uint32_t id, uint32_t salt) {
  return static_cast<float>(city::hash32(id, salt) >> 8) * (1.0F / 16777216.0F);
}

}  // namespace vicus::assets::pattern
