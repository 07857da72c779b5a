#include "houselod/texture_plan.hpp"

#include "houselod/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicus::houselod {
namespace {

using glm::ivec2;
using glm::vec2;
using glm::vec3;

bool hasItems(const city::Plane& plane) {
  return plane.externalGeometry.count > 0 || plane.externalOpenings.count > 0;
}

/// Texels of a side, and the room that they take with what keeps pictures apart.
int texelsOf(float metres, double perMetre, int pageSize) {
  const double wanted = std::ceil(static_cast<double>(metres) * perMetre);
  return static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(pageSize)));
}
int roomFor(int texels, int pageSize) {
  return std::min((texels + kPictureGrid - 1) / kPictureGrid * kPictureGrid, pageSize);
}

struct Sized {
  uint32_t picture = 0;
  vec2 metres{0};
};

/// Places all pictures in rows of falling height; returns the pages that this takes.
uint32_t place(std::span<const Sized> byHeight, double perMetre, int pageSize, std::vector<PlanePicture>& pictures) {
  uint32_t page = 0;
  ivec2 next(0);
  int rowHeight = 0;
  for (const Sized& s : byHeight) {
    PlanePicture& p = pictures[s.picture];
    p.size = {texelsOf(s.metres.x, perMetre, pageSize), texelsOf(s.metres.y, perMetre, pageSize)};
    const ivec2 room(roomFor(p.size.x, pageSize), roomFor(p.size.y, pageSize));
    if (next.x + room.x > pageSize) next = {0, next.y + rowHeight}, rowHeight = 0;
    if (next.y + room.y > pageSize) ++page, next = ivec2(0), rowHeight = 0;
    p.page = page, p.corner = next;
    next.x += room.x, rowHeight = std::max(rowHeight, room.y);
  }
  return byHeight.empty() ? 0 : page + 1;
}

}  // namespace

PlaneFrame planeFrame(const city::BuildingGeometry& type, const city::Plane& plane) {
  PlaneFrame frame;
  if (plane.flat.count == 0) return frame;
  const vec3 n = glm::normalize(plane.normal);
  frame.normal = n;
  frame.u = glm::normalize(glm::cross(std::abs(n.z) > 0.9f ? vec3(0, 1, 0) : vec3(0, 0, 1), n));
  frame.v = glm::cross(n, frame.u);
  vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (uint32_t i = plane.flat.first; i < plane.flat.end(); ++i) {
    const vec3& p = type.vertices[type.indices[i]].position;
    const vec2 at(glm::dot(p, frame.u), glm::dot(p, frame.v));
    low = glm::min(low, at), high = glm::max(high, at);
  }
  const float level = glm::dot(type.vertices[type.indices[plane.flat.first]].position, n);
  frame.origin = low.x * frame.u + low.y * frame.v + level * n;
  frame.size = high - low;
  return frame;
}

TexturePlan planPictures(std::span<const city::BuildingGeometry> types, uint32_t pages, int pageSize) {
  TexturePlan plan;
  plan.detail.assign(types.size(), 0);
  plan.pageSize = pageSize;
  if (pages == 0 || pageSize <= 0) return plan;
  std::vector<Sized> sized;
  double area = 0;
  for (uint32_t t = 0; t < types.size(); ++t)
    for (uint32_t p = 0; p < types[t].planes.size(); ++p) {
      const city::Plane& plane = types[t].planes[p];
      if (!hasItems(plane) || staysWhole(plane)) continue;
      const vec2 size = planeFrame(types[t], plane).size;
      if (!(size.x > 0 && size.y > 0) || !std::isfinite(size.x * size.y)) continue;
      sized.push_back({static_cast<uint32_t>(plan.pictures.size()), size});
      plan.pictures.push_back({t, p, 0, {}, {}});
      area += static_cast<double>(size.x) * static_cast<double>(size.y);
    }
  if (sized.empty()) return plan;
  std::stable_sort(sized.begin(), sized.end(), [](const Sized& a, const Sized& b) { return a.metres.y > b.metres.y; });

  // As fine as the pages' texels allow, then coarser until rows and margins fit, too.
  const double texels = static_cast<double>(pages) * pageSize * pageSize;
  double perMetre = std::min(kFinestPicture, std::sqrt(texels / area));
  while ((plan.pages = place(sized, perMetre, pageSize, plan.pictures)) > pages) {
    // Each picture takes room for at least one cell of the grid: more pictures than cells cannot be had.
    if (perMetre * static_cast<double>(sized[0].metres.y) < 1e-3) return {{}, std::move(plan.detail), 0, pageSize, 0};
    perMetre *= 0.97;
  }
  plan.texelsPerMetre = perMetre;
  for (const Sized& s : sized) {
    const PlanePicture& p = plan.pictures[s.picture];
    const vec2 texel = s.metres / vec2(p.size);
    plan.detail[p.type] = std::max({plan.detail[p.type], texel.x, texel.y});
  }
  return plan;
}

TexturePlan picturesWithin(std::span<const city::BuildingGeometry> types, double megabytes) {
  constexpr double kPageBytes = 4.0 / 3 * 4 * kPageSize * kPageSize;
  constexpr double kMostPages = 1024;
  const double pages = std::clamp(std::floor(megabytes * 1e6 / kPageBytes), 0.0, kMostPages);
  TexturePlan plan = planPictures(types, static_cast<uint32_t>(pages), kPageSize);
  if (plan.pages > 0 && plan.texelsPerMetre < kCoarsestPicture) {
    plan.pictures.clear();
    plan.pages = 0;
    std::fill(plan.detail.begin(), plan.detail.end(), 0.0f);
  }
  return plan;
}

vec2 onPage(const TexturePlan& plan, const PlanePicture& picture, const PlaneFrame& frame, vec3 point) {
  const vec2 metres(glm::dot(point - frame.origin, frame.u), glm::dot(point - frame.origin, frame.v));
  // The outermost texels' centres lie on the wall's edges, so that nothing beside them is mixed in.
  const vec2 texel = vec2(picture.corner) + 0.5f + metres / frame.size * vec2(glm::max(picture.size - 1, ivec2(0)));
  return texel / static_cast<float>(plan.pageSize);
}

}  // namespace vicus::houselod
