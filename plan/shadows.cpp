#include "plan/shadows.hpp"

#include <algorithm>
#include <cmath>

#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"

namespace vicus::plan {
namespace {

constexpr city::Knob kKnobs[] = {
    {"shadows.cascades", 0, 0, kMostCascades, "maps",
     "Shadow maps about the eye, each of a larger square than the one before: 4 with a graphics card. 0: none.",
     "0: shadows only where they are painted onto the ground", "more memory, and more to draw where the eye moves"},
    {"shadows.size", 1024, 64, 8192, "texels to a side", "How fine each shadow map is.", "shadows with steps",
     "memory grows with the square, and so does the time that a map takes"},
    {"shadows.distance", 1200, 20, 20000, "metres", "How far from the eye shadow maps reach.",
     "what is far away has no shadows", "coarser shadows at every distance"},
};

constexpr double kNearestReach = 24;  ///< metres: of the first of several cascades
constexpr double kCellsInReach = 4;   ///< a square moves on when the eye has come so far of its reach
constexpr double kLowestSun = 0.014;  ///< radians (0.8°): below it is down, as scenegraph/light.cpp has it

/// Whether any slope of the ground is steeper than the sun stands, looked at on a grid that is no finer than 512².
bool throwsShadows(const city::HeightField& field, double sunElevation) {
  if (field.size.x < 2 || field.size.y < 2) return false;
  const glm::ivec2 stride = glm::max(field.size / 512, glm::ivec2(1));
  const double steepest = std::tan(sunElevation);
  const auto at = [&](int c, int r) {
    return static_cast<double>(
        field.heights[static_cast<size_t>(r) * static_cast<size_t>(field.size.x) + static_cast<size_t>(c)]);
  };
  for (int r = 0; r + stride.y < field.size.y; r += stride.y)
    for (int c = 0; c + stride.x < field.size.x; c += stride.x) {
      const double east = (at(c + stride.x, r) - at(c, r)) / (field.spacing.x * stride.x);
      const double north = (at(c, r + stride.y) - at(c, r)) / (field.spacing.y * stride.y);
      if (std::hypot(east, north) > steepest) return true;
    }
  return false;
}

/// Square of the least distance from a place to a box.
double distance2(const city::Aabbf& box, const glm::dvec3& p) {
  const glm::dvec3 out = glm::max(glm::max(glm::dvec3(box.min) - p, p - glm::dvec3(box.max)), glm::dvec3(0));
  return glm::dot(out, out);
}

/// Whether anything at all stands nearer to the eye than `reach`.
bool anythingWithin(const city::City& city, const glm::dvec3& eye, double reach) {
  const auto near = [&](const city::Aabbf& box) { return !box.empty() && distance2(box, eye) <= reach * reach; };
  return std::any_of(city.tiles.begin(), city.tiles.end(), [&](const city::Tile& t) { return near(t.bounds); }) ||
         std::any_of(city.monuments.begin(), city.monuments.end(),
                     [&](const city::Monument& m) { return near(m.bounds); });
}

/// The cascade's square for an eye: its centre lies on a grid fixed in the world, whose step is a whole number of
/// texels, so that an edge's texels stay where they are while the square moves.
city::ShadowView viewFor(const ShadowScene& scene, double reach, const glm::dvec3& eye) {
  city::ShadowView view;
  view.lightFromWorld = scene.lightFromWorld;
  view.reach = reach;
  view.halfDepth = scene.halfDepth;
  // The eye is at most half a step from the centre; the filter looks two texels beyond its place.
  constexpr double kFilter = 2;
  view.halfExtent = reach * (1 + 0.5 / kCellsInReach) / (1 - 2 * (kFilter + 0.5) / scene.texels);
  const double texel = 2 * view.halfExtent / scene.texels;
  const double step = std::max(std::floor(reach / kCellsInReach / texel), 1.0) * texel;
  const glm::dvec3 inLight = scene.lightFromWorld * eye;
  const glm::dvec2 cell = glm::round(glm::dvec2(inLight) / step);
  view.centre = glm::transpose(scene.lightFromWorld) * glm::dvec3(cell * step, scene.middle);
  return view;
}

/// The four sides of the square, without ends: what stands nearer to the sun than the map's depth begins throws its
/// shadow too.
culling::Frustum sidesOf(const city::ShadowView& view) {
  culling::Frustum sides;
  sides.origin = view.centre;
  const glm::dmat3 worldFromLight = glm::transpose(view.lightFromWorld);
  for (const glm::dvec3& inward : {worldFromLight[0], -worldFromLight[0], worldFromLight[1], -worldFromLight[1]})
    sides.planes[sides.count++] = {inward, view.halfExtent};
  return sides;
}

void drawAll(const city::InstanceSet& set, city::SetPlan& out) {
  if (set.empty()) return;
  out.drawn = {{0, static_cast<uint32_t>(set.size())}};
  out.drawnCount = out.inFrustumCount = set.size();
}

void fill(const city::City& city, const ShadowScene& scene, const city::Aabbf& reach, city::ShadowPlan& plan) {
  plan.ground = scene.ground;
  if (!scene.culling) {
    drawAll(city.buildings, plan.buildings);
    drawAll(city.trees, plan.trees);
    for (uint32_t i = 0; i < city.monuments.size(); ++i) plan.monuments.push_back(i);
    return;
  }
  const culling::BoxTest test = culling::boxTestFor(sidesOf(plan.view), reach);
  culling::cullInstances(city.buildings, test, plan.buildings);
  culling::cullInstances(city.trees, test, plan.trees);
  for (uint32_t i = 0; i < city.monuments.size(); ++i) {
    uint32_t mask = test.allPlanes;
    if (culling::classify(test, city.monuments[i].bounds, mask) != culling::Containment::Outside)
      plan.monuments.push_back(i);
  }
}

}  // namespace

std::span<const city::Knob> shadowKnobs() {
  return kKnobs;
}

size_t cascadeCount(const city::City& city, const city::Knobs& knobs) {
  const double azimuth = city.environment.sunAzimuth, elevation = city.environment.sunElevation;
  const bool up = std::isfinite(azimuth) && std::isfinite(elevation) && std::sin(elevation) > std::sin(kLowestSun);
  const bool stands = !city.buildings.empty() || !city.monuments.empty() || !city.trees.empty() || !city.people.empty();
  if (!up || !stands) return 0;
  return static_cast<size_t>(std::clamp(std::round(knobs["shadows.cascades"]), 0.0, 1.0 * kMostCascades));
}

ShadowScene lookAtShadows(const city::City& city, const city::Knobs& knobs, const city::Aabbf& reach) {
  ShadowScene scene;
  const size_t cascades = cascadeCount(city, knobs);
  if (cascades == 0 || reach.empty()) return scene;
  const double azimuth = city.environment.sunAzimuth, elevation = city.environment.sunElevation;
  const double farthest = knobs["shadows.distance"], nearest = std::min(kNearestReach, farthest);
  for (size_t k = 0; k < cascades; ++k)
    scene.reaches.push_back(
        cascades == 1
            ? farthest
            : nearest * std::pow(farthest / nearest, static_cast<double>(k) / static_cast<double>(cascades - 1)));
  scene.texels = std::round(knobs["shadows.size"]);
  scene.culling = knobs.on("frustum_culling");

  // Right is level, so that a sun in the zenith is as good as any other.
  const glm::dvec3 toSun(std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                         std::sin(elevation));
  const glm::dvec3 right(-std::cos(azimuth), std::sin(azimuth), 0);
  scene.lightFromWorld = glm::transpose(glm::dmat3(right, glm::cross(toSun, right), toSun));
  double lowest = INFINITY, highest = -INFINITY;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) ? reach.max.x : reach.min.x, (corner & 2) ? reach.max.y : reach.min.y,
                       (corner & 4) ? reach.max.z : reach.min.z);
    lowest = std::min(lowest, glm::dot(toSun, p));
    highest = std::max(highest, glm::dot(toSun, p));
  }
  constexpr double kAbout = 4;  // metres: ground that lies a little lower, people
  scene.middle = (lowest + highest) / 2;
  scene.halfDepth = (highest - lowest) / 2 + kAbout;
  scene.ground = city.terrain && !city.terrain->empty() && throwsShadows(*city.terrain, elevation);
  return scene;
}

void planShadows(const city::City& city, const ShadowScene& scene, const city::Aabbf& reach, ShadowState& state,
                 city::FramePlan& plan) {
  state.cascades.resize(scene.reaches.size());
  for (size_t k = 0; k < scene.reaches.size(); ++k) {
    std::shared_ptr<const city::ShadowPlan>& cascade = state.cascades[k];
    if (!anythingWithin(city, plan.view.eye, scene.reaches[k])) {
      plan.shadows.push_back(nullptr);
      continue;
    }
    const city::ShadowView view = viewFor(scene, scene.reaches[k], plan.view.eye);
    if (!cascade || cascade->view.centre != view.centre) {
      const auto fresh = std::make_shared<city::ShadowPlan>();
      fresh->view = view;
      fill(city, scene, reach, *fresh);
      cascade = fresh;
    }
    plan.shadows.push_back(cascade);
  }
}

}  // namespace vicus::plan
