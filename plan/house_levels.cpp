// Based on: Willmott et al. 2001, §4.2.3 (the distance of the viewer decides for each house).
#include "plan/house_levels.hpp"

#include "houselod/slide.hpp"

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
  scene.fade = knobs.on("house_lod.fade");
  scene.types = std::make_shared<const houselod::HouseTypes>(houselod::lookAtTypes(city.buildingTypes, knobs));
  for (const houselod::TypeLevels& type : scene.types->levels) scene.flatTypes += type.flat ? 1 : 0;
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
      const houselod::TypeLevels& type = scene.types->levels[houses.instances[i].geometry];
      const double distance = distanceTo(houses.bounds[i], plan.view.eye);
      const houselod::Level level = houselod::levelAt(type, view, distance);
      plan.houseLod.levels[i] = level;
      if (level == houselod::kFullDetail || !scene.fade) continue;
      const auto share = static_cast<float>(houselod::flatShareAt(type, view, distance));
      if (share < 1) plan.houseLod.fades.push_back({i, share});
      plan.counts.instancesFlat += type.flat && level == type.reaches.size() + 1;
    }
}

}  // namespace vicus::plan
