#include "culling/plan_map.hpp"

#include <bit>

namespace vicus::culling {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;

constexpr float kOpen = -std::numeric_limits<float>::infinity();
constexpr double kStray = 1e-3;  ///< metres by which what is drawn may stray

double cross(dvec2 a, dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// The plane through the eye and the wall's top: z = dot(it, p).
dvec2 heightsOf(const ShadowWall& wall) {
  const dvec2 r(wall.right), l(wall.left);
  return dvec2(wall.right.z * l.y - wall.left.z * r.y, wall.left.z * r.x - wall.right.z * l.x) / cross(r, l);
}

}  // namespace

PlanMap::PlanMap(uint32_t cells, double finest, double reach, double sway, bool published)
    : cells_(std::bit_ceil(std::max(cells, 4U))), sway_(sway), published_(published) {
  double cell = published ? std::max(2 * reach / cells_, finest) : finest;
  for (;; cell *= 2) {
    Grid& grid = grids_.emplace_back();
    grid.cell = cell;
    for (uint32_t side = cells_; side > 0 && (!published || grid.mips.empty()); side /= 2)
      grid.mips.emplace_back(static_cast<size_t>(side) * side, kOpen);
    if (0.5 * cell * cells_ >= reach) break;
  }
}

void PlanMap::add(const ShadowWall& wall) {
  const dvec2 r(wall.right), l(wall.left), along = l - r;
  if (!(cross(r, l) > 1e-9)) return;
  // Away from the eye, which lies on the left of left → right.
  const dvec2 away = glm::normalize(dvec2(along.y, -along.x));
  const dvec2 heights = heightsOf(wall);
  const HalfPlane behind{away, glm::dot(away, r)};
  draw({HalfPlane{glm::normalize(dvec2(-r.y, r.x)), 0}, HalfPlane{glm::normalize(dvec2(l.y, -l.x)), 0}, behind, behind},
       {heights, heights});
}

void PlanMap::addJoint(const ShadowWall& first, const ShadowWall& second) {
  const dvec2 r(first.right), l(second.left);
  if (published_ || !(cross(r, l) > 1e-9)) return;
  const auto behind = [](const ShadowWall& wall) {
    const dvec2 along = dvec2(wall.left) - dvec2(wall.right), away = glm::normalize(dvec2(along.y, -along.x));
    return HalfPlane{away, glm::dot(away, dvec2(wall.right))};
  };
  draw({HalfPlane{glm::normalize(dvec2(-r.y, r.x)), 0}, HalfPlane{glm::normalize(dvec2(l.y, -l.x)), 0}, behind(first),
        behind(second)},
       {heightsOf(first), heightsOf(second)});
}

void PlanMap::draw(const std::array<HalfPlane, 4>& edges, const std::array<dvec2, 2>& heights) {
  for (Grid& grid : grids_) {
    const double half = 0.5 * grid.cell, side = 0.5 * grid.cell * cells_;
    // Whole cells only: their centres lie inside by half a cell, measured along each edge's normal.
    std::array<double, 4> least{};
    for (size_t k = 0; k < edges.size(); ++k) {
      const dvec2 n = glm::abs(edges[k].normal);
      least[k] = edges[k].distance + (published_ ? 0 : (n.x + n.y) * half + kStray + 2 * sway_ * side);
    }
    for (uint32_t row = 0; row < cells_; ++row) {
      const double y = (row + 0.5) * grid.cell - side;
      double from = -side, to = side;
      for (size_t k = 0; k < edges.size(); ++k) {
        const double a = edges[k].normal.x, b = least[k] - edges[k].normal.y * y;  // a · x ≥ b
        if (a > 1e-12)
          from = std::max(from, b / a);
        else if (a < -1e-12)
          to = std::min(to, b / a);
        else if (b > 0)
          to = -2 * side;
      }
      if (from > to) continue;
      const int first = std::max(0, static_cast<int>(std::ceil((from + side) / grid.cell - 0.5)));
      const int last =
          std::min(static_cast<int>(cells_) - 1, static_cast<int>(std::floor((to + side) / grid.cell - 0.5)));
      if (first > last) continue;
      std::array<float, 2> start{}, step{};
      for (size_t h = 0; h < 2; ++h) {
        const dvec2 g = heights[h];
        const double drop = published_ ? 0 : (std::abs(g.x) + std::abs(g.y)) * half;
        start[h] = static_cast<float>(g.x * ((first + 0.5) * grid.cell - side) + g.y * y - drop);
        step[h] = static_cast<float>(g.x * grid.cell);
      }
      // Without a branch, so that the compiler takes eight cells at once.
      float* const out = grid.mips.front().data() + static_cast<size_t>(row) * cells_ + first;
      for (int i = 0; i <= last - first; ++i) {
        const auto at = static_cast<float>(i);
        out[i] = std::max(out[i], std::min(start[0] + at * step[0], start[1] + at * step[1]));
      }
    }
  }
}

void PlanMap::finish(double lowest, double highest) {
  for (Grid& grid : grids_) {
    if (published_) {
      const double unit = std::max(highest - lowest, 1e-6) / 65535;
      for (float& h : grid.mips.front())
        if (h != kOpen)
          h = static_cast<float>(lowest +
                                 unit * std::clamp(std::round((static_cast<double>(h) - lowest) / unit), 0.0, 65535.0));
    }
    for (size_t m = 1; m < grid.mips.size(); ++m) {
      const std::vector<float>& below = grid.mips[m - 1];
      const size_t side = cells_ >> m;
      for (size_t y = 0; y < side; ++y)
        for (size_t x = 0; x < side; ++x) {
          const float* at = below.data() + 4 * y * side + 2 * x;
          grid.mips[m][y * side + x] = std::min({at[0], at[1], at[2 * side], at[2 * side + 1]});
        }
    }
  }
}

bool PlanMap::hides(const PlanBox& box, double top) const {
  if (published_) {
    const Grid& grid = grids_.front();
    const ivec2 at(glm::floor(0.5 * (box.min + box.max) / grid.cell + 0.5 * cells_));
    const auto side = static_cast<int>(cells_);
    if (at.x < 0 || at.y < 0 || at.x >= side || at.y >= side) return false;
    return top < static_cast<double>(grid.mips.front()[static_cast<size_t>(at.y) * cells_ + static_cast<size_t>(at.x)]);
  }
  const double reach = std::max(largerOf(box.min), largerOf(box.max)), pad = kStray + 2 * sway_ * reach;
  for (const Grid& grid : grids_) {
    if (reach + pad > 0.5 * grid.cell * cells_) continue;
    const ivec2 first(glm::floor((box.min - pad) / grid.cell + 0.5 * cells_));
    const ivec2 last =
        glm::min(ivec2(glm::floor((box.max + pad) / grid.cell + 0.5 * cells_)), ivec2(static_cast<int>(cells_) - 1));
    const int span = std::max({last.x - first.x, last.y - first.y, 0}) + 1;
    const size_t mip = std::min(static_cast<size_t>(std::bit_width(static_cast<unsigned>(span))), grid.mips.size() - 1);
    auto height = static_cast<float>(top + 1e-6 * std::abs(top) + 2 * sway_ * reach + kStray);
    for (int y = first.y >> mip; y <= last.y >> mip; ++y)
      for (int x = first.x >> mip; x <= last.x >> mip; ++x)
        if (!covered(grid, mip, {x, y}, first, last, height)) return false;
    return true;
  }
  return false;
}

bool PlanMap::covered(const Grid& grid, size_t mip, ivec2 cell, ivec2 first, ivec2 last, float height) const {
  const size_t side = cells_ >> mip;
  if (grid.mips[mip][static_cast<size_t>(cell.y) * side + static_cast<size_t>(cell.x)] > height) return true;
  if (mip == 0) return false;
  for (int k = 0; k < 4; ++k) {
    const ivec2 child = 2 * cell + ivec2(k & 1, k >> 1);
    const auto shift = static_cast<int>(mip - 1);
    if (child.x < first.x >> shift || child.y < first.y >> shift || child.x > last.x >> shift ||
        child.y > last.y >> shift)
      continue;
    if (!covered(grid, mip - 1, child, first, last, height)) return false;
  }
  return true;
}

}  // namespace vicus::culling
