#include "culling/building_slabs.hpp"

#include <algorithm>
#include <limits>

namespace vicus::culling {

using glm::dvec2;
using glm::dvec3;

std::vector<BuildingSlab> slabsOf(const city::BuildingGeometry& type) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr int kRoofSlabs = 3;
  constexpr double kThinnest = 0.05;  // metres
  const auto top = static_cast<double>(type.bounds.max.z);
  double eaves = -kInfinity, ridge = -kInfinity;
  for (const city::OccluderLine& line : type.occluders) eaves = std::max(eaves, static_cast<double>(line.top));
  for (const city::Plane& plane : type.planes) {
    if (plane.kind != city::PlaneKind::Roof && plane.kind != city::PlaneKind::Gable) continue;
    for (uint32_t i = plane.cut.first; i < plane.cut.end(); ++i)
      ridge = std::max(ridge, static_cast<double>(type.vertices[type.indices[i]].position.z));
  }
  std::vector<double> heights = {static_cast<double>(type.bounds.min.z)};
  const auto add = [&](double height) {
    if (height > heights.back() + kThinnest && height < top - kThinnest) heights.push_back(height);
  };
  if (eaves > -kInfinity) {
    add(eaves);
    for (int k = 1; k <= kRoofSlabs && ridge > eaves; ++k) add(eaves + (ridge - eaves) * k / kRoofSlabs);
  }
  heights.push_back(top);

  const size_t count = heights.size() - 1;
  std::vector<BuildingSlab> slabs(count);
  for (size_t s = 0; s < count; ++s) slabs[s] = {dvec2(kInfinity), dvec2(-kInfinity), heights[s + 1]};
  for (uint32_t i = 0; i + 2 < type.indices.size(); i += 3) {
    dvec3 corners[3];
    for (uint32_t k = 0; k < 3; ++k) corners[k] = dvec3(type.vertices[type.indices[i + k]].position);
    const double least = std::min({corners[0].z, corners[1].z, corners[2].z});
    const double most = std::max({corners[0].z, corners[1].z, corners[2].z});
    for (size_t s = 0; s < count; ++s) {
      BuildingSlab& slab = slabs[s];
      const double low = s == 0 ? -kInfinity : heights[s], high = s + 1 == count ? kInfinity : heights[s + 1];
      // What only touches a height from one side belongs to that side.
      if (most <= low || (least >= high && most > high)) continue;
      const auto extend = [&](const dvec3& p) {
        slab.min = glm::min(slab.min, dvec2(p)), slab.max = glm::max(slab.max, dvec2(p));
      };
      for (int k = 0; k < 3; ++k) {
        const dvec3 &a = corners[k], &b = corners[(k + 1) % 3];
        if (a.z >= low && a.z <= high) extend(a);
        for (const double h : {low, high})
          if ((a.z < h) != (b.z < h) && a.z != b.z) extend(glm::mix(a, b, (h - a.z) / (b.z - a.z)));
      }
    }
  }
  std::erase_if(slabs, [](const BuildingSlab& s) { return s.min.x > s.max.x; });
  if (slabs.empty()) slabs = {{dvec2(type.bounds.min), dvec2(type.bounds.max), top}};
  std::reverse(slabs.begin(), slabs.end());
  return slabs;
}

}  // namespace vicus::culling
