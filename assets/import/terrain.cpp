// Based on: Gortler et al. 1996, "The Lumigraph", §3.4 (pull-push, for the first guess of the fill); successive
// over-relaxation of the five-point Laplacian after it.
#include "assets/import/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vicus::assets {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Grid {
  int width = 0, height = 0;
  std::vector<float> values;
  float& at(int x, int y) {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  float at(int x, int y) const {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

/// Fills the NaNs of a grid from coarser and coarser means of what is known.
void pullPush(Grid& fine) {
  if (std::none_of(fine.values.begin(), fine.values.end(), [](float v) { return std::isnan(v); })) return;
  if (fine.width <= 1 && fine.height <= 1) return;
  Grid coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  coarse.values.assign(static_cast<size_t>(coarse.width) * static_cast<size_t>(coarse.height), kNan);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      double sum = 0;
      int count = 0;
      for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
          const int fx = 2 * x + dx, fy = 2 * y + dy;
          if (fx >= fine.width || fy >= fine.height || std::isnan(fine.at(fx, fy))) continue;
          sum += static_cast<double>(fine.at(fx, fy)), ++count;
        }
      if (count > 0) coarse.at(x, y) = static_cast<float>(sum / count);
    }
  pullPush(coarse);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x) {
      if (!std::isnan(fine.at(x, y))) continue;
      // Bilinear between the centres of the coarse cells.
      const float cx = std::clamp((static_cast<float>(x) - 0.5f) / 2, 0.0f, static_cast<float>(coarse.width - 1));
      const float cy = std::clamp((static_cast<float>(y) - 0.5f) / 2, 0.0f, static_cast<float>(coarse.height - 1));
      const int x0 = static_cast<int>(cx), y0 = static_cast<int>(cy);
      const int x1 = std::min(x0 + 1, coarse.width - 1), y1 = std::min(y0 + 1, coarse.height - 1);
      const float u = cx - static_cast<float>(x0), v = cy - static_cast<float>(y0);
      fine.at(x, y) = (1 - v) * ((1 - u) * coarse.at(x0, y0) + u * coarse.at(x1, y0)) +
                      v * ((1 - u) * coarse.at(x0, y1) + u * coarse.at(x1, y1));
    }
}

double cross(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

city::HeightField fieldOver(const city::Aabb& extent, double spacing) {
  city::HeightField field;
  const glm::dvec2 side = glm::max(glm::dvec2(extent.size()), glm::dvec2(1e-3));
  // One spacing is kept back for the rounding to whole multiples at either end.
  const double least = std::max(side.x, side.y) / (kLargestField - 3);
  spacing = std::max(spacing, std::ceil(least * 64) / 64);
  field.spacing = glm::dvec2(spacing);
  const glm::dvec2 first = glm::floor(glm::dvec2(extent.min) / spacing);
  const glm::dvec2 last = glm::max(glm::ceil(glm::dvec2(extent.max) / spacing), first + 1.0);
  field.origin = first * spacing;
  field.size = glm::ivec2(last - first) + 1;
  field.heights.assign(static_cast<size_t>(field.size.x) * static_cast<size_t>(field.size.y), kNan);
  return field;
}

uint64_t fillByMembrane(city::HeightField& field) {
  std::vector<size_t> unknown;
  for (size_t i = 0; i < field.heights.size(); ++i)
    if (!std::isfinite(field.heights[i])) {
      field.heights[i] = kNan;
      unknown.push_back(i);
    }
  if (unknown.size() == field.heights.size()) return 0;

  Grid grid{field.size.x, field.size.y, std::move(field.heights)};
  pullPush(grid);
  // The guess is right at large scales; the sweeps take out its steps between cells. A fixed number of them: what is
  // left after 40 is under a centimetre on Périgueux, a bound that no one can see on a surface made up between
  // buildings.
  constexpr int kSweeps = 40;
  constexpr float kRelaxation = 1.5f;
  const auto width = static_cast<size_t>(field.size.x);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (const size_t i : unknown) {
      const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
      float sum = 0, count = 0, low = grid.values[i], high = grid.values[i];
      const auto add = [&](int nx, int ny) {
        if (nx < 0 || ny < 0 || nx >= grid.width || ny >= grid.height) return;
        const float h = grid.at(nx, ny);
        sum += h, count += 1, low = std::min(low, h), high = std::max(high, h);
      };
      add(x - 1, y), add(x + 1, y), add(x, y - 1), add(x, y + 1);
      // Over-relaxed, yet never beyond its neighbours: the maximum principle holds at each step.
      if (count > 0)
        grid.values[i] = std::clamp(grid.values[i] + kRelaxation * (sum / count - grid.values[i]), low, high);
    }
  field.heights = std::move(grid.values);
  return unknown.size();
}

uint64_t rasteriseTin(const Tin& tin, city::HeightField& field) {
  uint64_t covered = 0;
  for (const glm::uvec3& t : tin.triangles) {
    const glm::dvec3 corners[3] = {tin.points[t.x], tin.points[t.y], tin.points[t.z]};
    glm::dvec2 p[3];
    for (int k = 0; k < 3; ++k) p[k] = (glm::dvec2(corners[k]) - field.origin) / field.spacing;
    const double twice = cross(p[1] - p[0], p[2] - p[0]);
    if (!(std::abs(twice) > 1e-12)) continue;
    const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])), high = glm::max(p[0], glm::max(p[1], p[2]));
    const int x0 = static_cast<int>(std::ceil(std::max(low.x - 1e-9, 0.0)));
    const int y0 = static_cast<int>(std::ceil(std::max(low.y - 1e-9, 0.0)));
    const int x1 = static_cast<int>(std::floor(std::min(high.x + 1e-9, static_cast<double>(field.size.x - 1))));
    const int y1 = static_cast<int>(std::floor(std::min(high.y + 1e-9, static_cast<double>(field.size.y - 1))));
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const glm::dvec2 q(x, y);
        const double a = cross(p[1] - q, p[2] - q) / twice, b = cross(p[2] - q, p[0] - q) / twice, c = 1 - a - b;
        constexpr double kEdge = -1e-9;  // samples on a shared edge belong to both
        if (a < kEdge || b < kEdge || c < kEdge) continue;
        const auto h = static_cast<float>(a * corners[0].z + b * corners[1].z + c * corners[2].z);
        float& sample = field.at(x, y);
        if (std::isnan(sample)) ++covered;
        if (!(sample >= h)) sample = h;
      }
  }
  return covered;
}

double spacingOf(const Tin& tin) {
  double area = 0;
  for (const glm::uvec3& t : tin.triangles)
    area +=
        std::abs(cross(glm::dvec2(tin.points[t.y] - tin.points[t.x]), glm::dvec2(tin.points[t.z] - tin.points[t.x]))) /
        2;
  if (tin.triangles.empty() || !(area > 0)) return 1;
  // The edge of an equilateral triangle of the mean area. Few large triangles have sharp folds between them, so even
  // then samples stay near enough to follow these: 4 m was tuned on Jerusalem's 26 triangles over 500 m.
  const double edge = std::sqrt(area / static_cast<double>(tin.triangles.size()) * 4 / std::sqrt(3.0));
  return std::clamp(std::floor(edge) / 4, 0.5, 4.0);
}

city::HeightField fieldThrough(std::span<const glm::dvec3> points, const city::Aabb& extent, double spacing) {
  city::HeightField field = fieldOver(extent, spacing);
  std::vector<double> sums(field.heights.size(), 0), weights(field.heights.size(), 0);
  for (const glm::dvec3& p : points) {
    if (!std::isfinite(p.x + p.y + p.z)) continue;
    const glm::dvec2 place = (glm::dvec2(p) - field.origin) / field.spacing;
    const glm::dvec2 cell = glm::floor(place), t = place - cell;
    for (int corner = 0; corner < 4; ++corner) {
      const double x = cell.x + (corner & 1), y = cell.y + (corner >> 1);
      if (x < 0 || y < 0 || x >= field.size.x || y >= field.size.y) continue;
      // A point on the far edge of the cell still counts a little: the surface under it hangs on all four corners.
      constexpr double kLeast = 1e-3;
      const double w = std::max(kLeast, (corner & 1 ? t.x : 1 - t.x) * (corner >> 1 ? t.y : 1 - t.y));
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(field.size.x) + static_cast<size_t>(x);
      sums[i] += w * p.z, weights[i] += w;
    }
  }
  for (size_t i = 0; i < sums.size(); ++i)
    if (weights[i] > 0) field.heights[i] = static_cast<float>(sums[i] / weights[i]);
  fillByMembrane(field);
  field.updateRange();
  return field;
}

void limitSlope(city::HeightField& field, double steepest) {
  // Projections onto one pair of neighbours after another: each half of the excess from either. 100 sweeps settle steps
  // of 20 m on Lyon's slopes to within 5 % of the bound.
  constexpr int kSweeps = 100;
  const auto width = static_cast<size_t>(field.size.x);
  const auto settle = [&](size_t a, size_t b, double most) {
    const double excess = static_cast<double>(field.heights[b]) - static_cast<double>(field.heights[a]);
    if (!(std::abs(excess) > most)) return false;
    const auto half = static_cast<float>((std::abs(excess) - most) / 2 * (excess > 0 ? 1 : -1));
    field.heights[a] += half, field.heights[b] -= half;
    return true;
  };
  bool moved = true;
  for (int sweep = 0; sweep < kSweeps && moved; ++sweep) {
    moved = false;
    for (int y = 0; y < field.size.y; ++y)
      for (int x = 0; x < field.size.x; ++x) {
        const size_t i = static_cast<size_t>(y) * width + static_cast<size_t>(x);
        if (x + 1 < field.size.x) moved = settle(i, i + 1, steepest * field.spacing.x) || moved;
        if (y + 1 < field.size.y) moved = settle(i, i + width, steepest * field.spacing.y) || moved;
      }
  }
  field.updateRange();
}

GroundUnder groundUnder(const city::HeightField& field, std::span<const glm::dvec2> outline) {
  GroundUnder out;
  double sum = 0;
  int count = 0;
  const auto take = [&](glm::dvec2 p) {
    const auto h = field.heightAt(p.x, p.y);
    if (!h) return;
    out.lowest = count ? std::min(out.lowest, *h) : *h;
    out.highest = count ? std::max(out.highest, *h) : *h;
    sum += *h, ++count;
  };
  const double step = std::min(field.spacing.x, field.spacing.y) / 2;
  for (size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    const int pieces = std::clamp(static_cast<int>(std::ceil(glm::length(b - a) / step)), 1, 1000);
    for (int k = 0; k < pieces; ++k) take(glm::mix(a, b, static_cast<double>(k) / pieces));
  }
  out.known = count > 0;
  if (count > 0) out.mean = sum / count;
  return out;
}

}  // namespace vicus::assets
