#include "culling/stability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "city/instance.hpp"
#include "city/random.hpp"
#include "city/view_state.hpp"
#include "culling/exact_visibility.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::InstanceSet;
using city::Random;
using city::StabilityRow;
using city::ViewState;

constexpr double kPi = std::numbers::pi;
constexpr int kViews = 40;
constexpr uint32_t kHouses = 1500;

double radians(double degrees) {
  return degrees * kPi / 180;
}

/// Houses 6 to 40 m wide and high at random places of a square, its centre at `centre`.
InstanceSet randomTown(uint32_t seed, double side, glm::dvec3 centre, uint32_t count = kHouses) {
  Random random(seed);
  std::vector<Aabbf> types;
  for (int i = 0; i < 20; ++i) {
    const glm::vec3 half(random.uniform(3, 20), random.uniform(3, 20), 0);
    types.push_back({-half, half + glm::vec3(0, 0, random.uniform(6, 40))});
  }
  std::vector<city::Instance> houses(count);
  for (city::Instance& house : houses) {
    house.position = centre + glm::dvec3(random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2),
                                         random.uniform(0, 20));
    house.heading = static_cast<float>(random.uniform(0, 2 * kPi));
    house.geometry = random.below(20);
  }
  const glm::dvec3 half(side / 2, side / 2, 100);
  return city::buildInstanceSet(std::move(houses), types, city::tileGridFor({centre - half, centre + half}));
}

/// How culling did against the reference, added up over views.
struct Tally {
  uint64_t wronglyCulled = 0;  ///< boxes that can be seen and were dropped
  uint64_t differing = 0;      ///< boxes that the hierarchy and the test of each box alone decide differently
  uint64_t visible = 0, drawn = 0;
  double slack = 0;  ///< metres, the largest

  double drawnOverVisible() const {
    return static_cast<double>(drawn) / static_cast<double>(std::max(visible, uint64_t{1}));
  }
};

std::vector<bool> drawnFlags(const city::SetPlan& plan, size_t size) {
  std::vector<bool> drawn(size, false);
  for (const city::Range& run : plan.drawn) std::fill_n(drawn.begin() + run.first, run.count, true);
  return drawn;
}

void addView(Tally& tally, const InstanceSet& town, const glm::dmat4& clipFromRelative, const glm::dvec3& origin) {
  const BoxTest test = boxTestFor(frustumFromClip(clipFromRelative, origin), town.nodes[0].bounds);
  city::SetPlan plan;
  cullInstances(town, test, plan);
  const std::vector<bool> drawn = drawnFlags(plan, town.size());
  tally.slack = std::max(tally.slack, test.slack);
  tally.drawn += plan.drawnCount;
  for (size_t i = 0; i < town.size(); ++i) {
    const bool visible = isSurfaceInClipSpace(clipFromRelative, origin, town.bounds[i]);
    uint32_t mask = test.allPlanes;
    const bool drawnAlone = classify(test, town.bounds[i], mask) != Containment::Outside;
    tally.visible += visible;
    tally.wronglyCulled += visible && !drawn[i];
    tally.differing += drawn[i] != drawnAlone;
  }
}

void addView(Tally& tally, const InstanceSet& town, const ViewState& view) {
  addView(tally, town, city::clipFromEyeRelative(view), view.eye);
}

city::ViewPose randomPose(Random& random, glm::dvec3 centre, double side, double height) {
  return {centre + glm::dvec3(random.uniform(-side / 2, side / 2), random.uniform(-side / 2, side / 2), height),
          random.uniform(0, 2 * kPi), random.uniform(-kPi / 2, kPi / 2), random.uniform(-kPi, kPi)};
}

Tally tallyOf(const InstanceSet& town, const std::function<ViewState(Random&)>& makeOne) {
  Random random(7);
  Tally tally;
  for (int k = 0; k < kViews; ++k) addView(tally, town, makeOne(random));
  return tally;
}

StabilityRow culledRow(std::string part, std::string caseName, const Tally& tally) {
  return city::stabilityRow(std::move(part), std::move(caseName), "visible boxes culled",
                            static_cast<double>(tally.wronglyCulled), 0);
}

void coordinates(std::vector<StabilityRow>& rows) {
  const std::string part = "coordinates";
  constexpr double kSide = 2048;
  // Whole metres, so that the same town can stand 10 000 km away: floats there are a metre apart.
  const auto townAt = [&](glm::dvec3 place) {
    InstanceSet town = randomTown(1, kSide, {0, 0, 0});
    const glm::vec3 shift(place);
    for (Aabbf& box : town.bounds) box = {glm::floor(box.min) + shift, glm::ceil(box.max) + shift};
    for (city::BoundsNode& node : town.nodes)
      node.bounds = {glm::floor(node.bounds.min) + shift, glm::ceil(node.bounds.max) + shift};
    return town;
  };
  const auto plansAt = [&](double easting) {
    const glm::dvec3 place(easting, easting / 2, 0);
    const InstanceSet town = townAt(place);
    std::vector<std::vector<bool>> drawn;
    Random random(7);
    for (int k = 0; k < kViews; ++k) {
      const ViewState view = city::makeView(randomPose(random, place, kSide, 1.7), radians(60), {1280, 720});
      city::SetPlan plan;
      cullInstances(town, boxTestFor(frustumOf(view), town.nodes[0].bounds), plan);
      drawn.push_back(drawnFlags(plan, town.size()));
    }
    return drawn;
  };
  const std::vector<std::vector<bool>> atZero = plansAt(0);
  for (const double easting : {0.0, 1e6, 1e7}) {
    const glm::dvec3 place(easting, easting / 2, 0);
    const Tally tally = tallyOf(townAt(place), [&](Random& random) {
      return city::makeView(randomPose(random, place, kSide, 1.7), radians(60), {1280, 720});
    });
    const std::string name = "boxes " + std::to_string(static_cast<int>(easting / 1000)) + " km from the origin";
    rows.push_back(culledRow(part, name, tally));
    if (easting == 0) continue;
    const std::vector<std::vector<bool>> here = plansAt(easting);
    uint64_t differing = 0;
    for (size_t k = 0; k < here.size(); ++k)
      for (size_t i = 0; i < here[k].size(); ++i) differing += here[k][i] != atZero[k][i];
    // A decision may turn over only where an edge of the picture comes within the slack of a box: at 2 mm in 2 km one
    // in 10 000 is generous.
    rows.push_back(city::stabilityRow(part, name, "share of decisions that differ from those at 0",
                                      static_cast<double>(differing) / (kViews * static_cast<double>(kHouses)), 1e-4));
  }

  const InstanceSet wide = randomTown(2, 100e3, {0, 0, 0});
  const Tally wideTally = tallyOf(wide, [&](Random& random) {
    return city::makeView(randomPose(random, {0, 0, 0}, 100e3, 1.7), radians(60), {1280, 720});
  });
  rows.push_back(culledRow(part, "extent of 100 km", wideTally));
  rows.push_back(city::stabilityRow(part, "extent of 100 km", "slack of the planes, metres", wideTally.slack, 0.15));

  const InstanceSet town = randomTown(3, kSide, {0, 0, 0});
  rows.push_back(culledRow(part, "eye 0.05 m from a wall", tallyOf(town, [&](Random& random) {
                             const Aabbf& box = town.bounds[random.below(static_cast<uint32_t>(town.size()))];
                             city::ViewPose pose;
                             pose.eye = {
                                 static_cast<double>(box.min.x) - 0.05,
                                 random.uniform(static_cast<double>(box.min.y), static_cast<double>(box.max.y)),
                                 random.uniform(static_cast<double>(box.min.z), static_cast<double>(box.max.z))};
                             pose.heading = random.uniform(-kPi / 2, kPi / 2);
                             return city::makeView(pose, radians(60), {1280, 720});
                           })));
  const Tally high = tallyOf(town, [&](Random& random) {
    city::ViewPose pose = randomPose(random, {0, 0, 0}, kSide, 50e3);
    pose.pitch = radians(-90 + random.uniform(-2, 2));
    return city::makeView(pose, radians(1), {1280, 720});
  });
  rows.push_back(culledRow(part, "eye at 50 km", high));
  rows.push_back(city::stabilityRow(part, "eye at 50 km", "slack of the planes, metres", high.slack, 0.06));
}

void views(std::vector<StabilityRow>& rows) {
  const std::string part = "view";
  constexpr double kSide = 2048;
  const InstanceSet town = randomTown(4, kSide, {0, 0, 0});
  struct Lens {
    std::string name;
    double fov;
    glm::ivec2 viewport;
  };
  for (const Lens& lens :
       {Lens{"field of view 0.1°", radians(0.1), {1280, 720}}, Lens{"field of view 179°", radians(179), {1280, 720}},
        Lens{"viewport 1×1", radians(60), {1, 1}}, Lens{"viewport 16384×1", radians(60), {16384, 1}},
        Lens{"viewport 1×16384", radians(60), {1, 16384}},
        Lens{"field of view 179°, viewport 16384×1", radians(179), {16384, 1}},
        Lens{"field of view 0.1°, viewport 1×16384", radians(0.1), {1, 16384}}})
    rows.push_back(culledRow(part, lens.name, tallyOf(town, [&](Random& random) {
                               return city::makeView(randomPose(random, {0, 0, 0}, kSide, 20), lens.fov, lens.viewport);
                             })));

  struct Place {
    std::string name;
    std::function<city::ViewPose(Random&)> pose;
  };
  const std::vector<Place> places = {
      {"looking straight up",
       [](Random& random) {
         city::ViewPose pose = randomPose(random, {0, 0, 0}, kSide, 1.7);
         pose.pitch = kPi / 2;
         return pose;
       }},
      {"looking straight down",
       [](Random& random) {
         city::ViewPose pose = randomPose(random, {0, 0, 0}, kSide, 300);
         pose.pitch = -kPi / 2;
         return pose;
       }},
      {"roll",
       [](Random& random) {
         city::ViewPose pose = randomPose(random, {0, 0, 0}, kSide, 1.7);
         pose.pitch = 0;
         return pose;
       }},
      {"eye inside a building",
       [&](Random& random) {
         city::ViewPose pose = randomPose(random, {0, 0, 0}, kSide, 0);
         pose.eye = town.bounds[random.below(static_cast<uint32_t>(town.size()))].centre();
         return pose;
       }},
      {"eye under the ground",
       [](Random& random) {
         return randomPose(random, {0, 0, 0}, kSide, -200);
       }},
      {"eye outside the city",
       [](Random& random) {
         return randomPose(random, {3 * kSide, 0, 0}, kSide, 1.7);
       }},
  };
  for (const Place& place : places) {
    double skew = 0;
    const Tally tally = tallyOf(town, [&](Random& random) {
      const ViewState view = city::makeView(place.pose(random), radians(60), {1280, 720});
      const glm::dmat3 frame(view.right, view.up, -view.forward);
      const glm::dmat3 identity = glm::transpose(frame) * frame;
      for (glm::length_t i = 0; i < 3; ++i)
        for (glm::length_t k = 0; k < 3; ++k) skew = std::max(skew, std::abs(identity[i][k] - (i == k ? 1 : 0)));
      return view;
    });
    rows.push_back(culledRow(part, place.name, tally));
    rows.push_back(city::stabilityRow(part, place.name, "largest error of the frame's orthonormality", skew, 1e-15));
  }

  // A device that gives NaN leaves the view as it was.
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const ViewState before = city::makeView({{10, 20, 1.7}, 1, 0.1, 0}, radians(60), {1280, 720});
  const ViewState after = city::makeView({{kNan, kNan, kNan}, kNan, kNan, kNan}, kNan, {1280, 720}, before);
  const double change = glm::distance(before.eye, after.eye) + glm::distance(before.forward, after.forward) +
                        glm::distance(before.right, after.right) + glm::distance(before.up, after.up) +
                        std::abs(before.verticalFov - after.verticalFov);
  rows.push_back(city::stabilityRow(part, "NaN from a device", "change of the view", change, 0));
}

/// A matrix whose rows are random, of random size, and `rank` of them independent to within `noise`.
glm::dmat4 nearSingular(Random& random, int rank, double noise) {
  glm::dmat4 rows(0);
  for (glm::length_t i = 0; i < 4; ++i)
    for (glm::length_t k = 0; k < 4; ++k) rows[i][k] = random.uniform(-1, 1) * (k == 3 ? 100 : 1);
  for (int i = rank; i < 4; ++i) {
    const glm::dvec4 perturbation(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                                  random.uniform(-1, 1));
    rows[i] = random.uniform(-2, 2) * rows[0] + (rank > 1 ? random.uniform(-2, 2) : 0) * rows[1] + noise * perturbation;
  }
  return glm::transpose(rows);
}

void frusta(std::vector<StabilityRow>& rows) {
  const std::string part = "frustum";
  constexpr double kSide = 2048;
  const InstanceSet town = randomTown(5, kSide, {0, 0, 0});

  for (const double noise : {0.0, 1e-18, 1e-15, 1e-12, 1e-9, 1e-6}) {
    Random random(11);
    Tally tally;
    for (int k = 0; k < kViews; ++k)
      addView(tally, town, nearSingular(random, 1 + k % 3, noise), {random.uniform(-500, 500), 0, 0});
    std::string name =
        "near-singular matrices, off by 1e" + std::to_string(static_cast<int>(std::round(std::log10(noise))));
    rows.push_back(culledRow(part, noise == 0 ? "singular matrices" : name, tally));
  }

  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ViewState view = city::makeView({{0, 0, 20}, 1, -0.1, 0.2}, radians(60), {1280, 720});
  for (const auto& [name, value] : {std::pair{"NaN", kNan}, {"infinite", kInfinity}, {"1e300", 1e300}}) {
    Tally tally;
    for (glm::length_t i = 0; i < 16; ++i) {
      glm::dmat4 matrix = city::clipFromEyeRelative(view);
      matrix[i / 4][i % 4] = value;
      addView(tally, town, matrix, view.eye);
    }
    rows.push_back(culledRow(part, std::string("a matrix with one entry ") + name, tally));
  }
  Tally zero;
  addView(zero, town, glm::dmat4(0), {0, 0, 0});
  rows.push_back(
      city::stabilityRow(part, "matrix of zeros", "boxes culled", static_cast<double>(town.size() - zero.drawn), 0));
  Tally nowhere;
  addView(nowhere, town, city::clipFromEyeRelative(view), {kNan, kNan, kNan});
  rows.push_back(
      city::stabilityRow(part, "eye at NaN", "boxes culled", static_cast<double>(town.size() - nowhere.drawn), 0));

  // Boxes without volume: points, lines and rectangles, in a hierarchy like any others.
  for (const auto& [name, flat] :
       {std::pair{"boxes that are rectangles", 1}, {"boxes that are lines", 2}, {"boxes that are points", 3}}) {
    InstanceSet thin = town;
    for (Aabbf& box : thin.bounds)
      for (glm::length_t axis = 0; axis < flat; ++axis) box.max[axis] = box.min[axis];
    rows.push_back(
        culledRow(part, name, tallyOf(thin, [&](Random& random) {
                    return city::makeView(randomPose(random, {0, 0, 0}, kSide, 20), radians(60), {1280, 720});
                  })));
  }

  // Boxes around the eye may have no face in the picture, but once they reach past the near plane they must not be
  // lost: what they contain is all around.
  Random random(13);
  uint64_t lost = 0;
  for (int k = 0; k < 1000; ++k) {
    const ViewState around = city::makeView(randomPose(random, {0, 0, 0}, kSide, 20), radians(60), {1280, 720});
    const double reach = std::pow(10.0, random.uniform(-1, 6));
    const Aabbf box = city::outward({around.eye - reach, around.eye + reach});
    const BoxTest test = boxTestFor(frustumOf(around), box);
    uint32_t mask = test.allPlanes;
    lost += classify(test, box, mask) == Containment::Outside;
  }
  rows.push_back(city::stabilityRow(part, "boxes around the eye", "boxes culled", static_cast<double>(lost), 0));

  Tally infinite, finite;
  for (int k = 0; k < kViews; ++k) {
    ViewState shown = city::makeView(randomPose(random, {0, 0, 0}, kSide, 20), radians(60), {1280, 720});
    addView(infinite, town, shown);
    shown.farDistance = random.uniform(1, 1000);
    addView(finite, town, shown);
  }
  rows.push_back(culledRow(part, "infinite far plane", infinite));
  rows.push_back(culledRow(part, "finite far plane", finite));
  rows.push_back(city::stabilityRow(part, "infinite far plane",
                                    "boxes that hierarchy and single test decide differently",
                                    static_cast<double>(infinite.differing + finite.differing), 0));
  // Planes keep a box that lies beyond a corner of the frustum without touching it: 1.002 on this town.
  rows.push_back(
      city::stabilityRow(part, "infinite far plane", "boxes drawn ÷ boxes visible", infinite.drawnOverVisible(), 1.01));
}

}  // namespace

std::vector<StabilityRow> frustumStability() {
  std::vector<StabilityRow> rows;
  coordinates(rows);
  views(rows);
  frusta(rows);
  return rows;
}

}  // namespace vicus::culling
