// Based on: Willmott et al. 2001, §4.2.3 (the distance of the viewer decides for each house).
#include "plan/house_levels.hpp"

#include "houselod/slide.hpp"
#include "houselod/texture_plan.hpp"

namespace vicus::plan {
namespace {

/// Metres from a point to a box; 0 within.
double distanceTo(const city::Aabbf& box, const glm::dvec3& p) {
  const glm::dvec3 low(box.min), high(box.max);
  return glm::length(glm::max(glm::max(low - p, p - high), glm::dvec3(0)));
}

}  // namespace

HouseLodScene lookAtHouses(const city::City& city, const city::Knobs& knobs) {
  HouseLodScene scene;
  if (!knobs.on("house_lod") || city.buildings.empty()) return scene;
  scene.scalar = knobs["house_lod.scalar"];
  scene.slide = knobs.on("house_lod.slide");
  scene.drop = knobs.on("house_lod.drop");
  scene.types.reserve(city.buildingTypes.size());
  const double megabytes = knobs.has("house_lod.picture_mb") ? knobs["house_lod.picture_mb"] : 0;
  const houselod::TexturePlan pictures = houselod::picturesWithin(city.buildingTypes, megabytes);
  for (size_t t = 0; t < city.buildingTypes.size(); ++t) {
    scene.types.push_back(houselod::levelsOf(city.buildingTypes[t]));
    if (pictures.detail[t] > 0) scene.types.back().detail = pictures.detail[t];
    scene.flatTypes += scene.types.back().flat ? 1 : 0;
  }
  scene.on = scene.flatTypes > 0;
  return scene;
}

void chooseLevels(const city::City& city, const HouseLodScene& scene, city::FramePlan& plan) {
  const double pixels = city::pixelsPerUnitSlope(plan.view);
  const houselod::LevelView view{houselod::inverseScalar(scene.scalar, pixels), pixels};
  plan.houseLod.inverseScalar = scene.slide ? view.inverse : 0;
  if (!scene.drop) return;
  const city::InstanceSet& houses = city.buildings;
  plan.houseLod.levels.resize(houses.size());
  for (const city::Range& run : plan.buildings.drawn)
    for (uint32_t i = run.first; i < run.end(); ++i) {
      const houselod::TypeLevels& type = scene.types[houses.instances[i].geometry];
      const houselod::Level level = houselod::levelAt(type, view, distanceTo(houses.bounds[i], plan.view.eye));
      plan.houseLod.levels[i] = level;
      plan.counts.instancesFlat += type.flat && level == type.reaches.size() + 1;
    }
}

}  // namespace vicus::plan
