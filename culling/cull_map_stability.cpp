#include "culling/cull_map_stability.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "city/city.hpp"
#include "city/random.hpp"
#include "culling/cull_map.hpp"
#include "culling/frustum.hpp"
#include "culling/hierarchy.hpp"

namespace vicus::culling {
namespace {

using city::Aabbf;
using city::City;
using city::Random;
using city::StabilityRow;
using city::ViewState;
using glm::dvec2;
using glm::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr int kViews = 8;
constexpr uint32_t kCells = 128;  // of the grids on the plan, to a side

/// A house that is a box, every wall of it an occluder, from `foot` to `top`.
city::BuildingGeometry boxHouse(glm::vec2 half, float foot, float top) {
  city::BuildingGeometry g;
  g.bounds = {{-half.x, -half.y, foot}, {half.x, half.y, top}};
  const glm::vec2 corners[] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
  for (size_t k = 0; k < 4; ++k) g.occluders.push_back({corners[k], corners[(k + 1) % 4], foot, top});
  return g;
}

struct House {
  dvec2 centre, half;
  double height;
};

City cityOf(const std::vector<House>& houses) {
  City city;
  city::CityParts parts;
  for (const House& h : houses) {
    city::Instance& instance = parts.buildings.emplace_back();
    instance.position = dvec3(h.centre, 0);
    instance.geometry = static_cast<uint32_t>(city.buildingTypes.size());
    city.buildingTypes.push_back(boxHouse(glm::vec2(h.half), 0, static_cast<float>(h.height)));
  }
  city::finishCity(city, std::move(parts));
  return city;
}

/// Terraces about straight streets: rows of touching houses 4 to 9 m wide, streets 8 m wide.
std::vector<House> terraces(uint32_t seed, dvec2 place = {0, 0}, double scale = 1) {
  Random random(seed);
  std::vector<House> houses;
  for (int row = -6; row < 6; ++row)
    for (double x = -150; x < 150;) {
      const double width = random.uniform(4, 9);
      const dvec2 half(width / 2, 5);
      houses.push_back(
          {place + scale * dvec2(x + width / 2, 9 + row * 18), scale * half, scale * random.uniform(5, 12)});
      x += width + (random.uniform() < 0.1 ? 4 : 0);
    }
  return houses;
}

struct Box {
  dvec3 min, max;
};

/// A house's box in double: its bounds are floats, a metre apart far from the origin.
Box boxOf(const City& city, size_t building) {
  const city::Instance& instance = city.buildings.instances[building];
  const Aabbf& local = city.buildingTypes[instance.geometry].bounds;
  return {instance.position + dvec3(local.min), instance.position + dvec3(local.max)};
}

/// All houses' boxes relative to the eye.
std::vector<Box> boxesAbout(const City& city, dvec3 eye) {
  std::vector<Box> boxes;
  for (size_t k = 0; k < city.buildings.size(); ++k) {
    const Box box = boxOf(city, k);
    boxes.push_back({box.min - eye, box.max - eye});
  }
  return boxes;
}

/// Whether the straight line from the eye to a point relative to it meets a box before it arrives; boxes that only
/// touch the line do not count, nor does the target's own box.
bool blocked(const std::vector<Box>& boxes, size_t target, dvec3 way) {
  for (size_t k = 0; k < boxes.size(); ++k) {
    const Box& box = boxes[k];
    double from = 0, to = 1;
    for (glm::length_t axis = 0; axis < 3 && from <= to; ++axis) {
      const double lo = box.min[axis], hi = box.max[axis];
      if (way[axis] == 0) {
        if (lo > 0 || hi < 0) to = -1;
        continue;
      }
      const double t0 = lo / way[axis], t1 = hi / way[axis];
      from = std::max(from, std::min(t0, t1)), to = std::min(to, std::max(t0, t1));
    }
    if (from <= to && to > 0 && k != target) return true;
  }
  return false;
}

/// What culling did, added up over views.
struct Tally {
  uint64_t wronglyCulled = 0, culled = 0, inFrustum = 0, off = 0;
};

void addView(Tally& tally, const City& city, const Occluders& occluders, const ViewState& view,
             const CullMapOptions& options) {
  city::FramePlan plan;
  plan.view = view;
  cullInstances(city.buildings, boxTestFor(frustumOf(view), city.buildings.nodes[0].bounds), plan.buildings);
  tally.inFrustum += plan.buildings.drawnCount;
  const CullMapStats stats = cullOccluded(city, occluders, options, plan);
  tally.off += !stats.off.empty();
  const std::vector<Box> boxes = boxesAbout(city, view.eye);
  const glm::dmat4 clipFromEye = city::clipFromEyeRelative(view);
  for (const city::DroppedRange& run : plan.buildings.dropped) {
    if (run.reason != city::DropReason::Occluded) continue;
    tally.culled += run.range.count;
    for (uint32_t i = run.range.first; i < run.range.end(); ++i) {
      const Box& box = boxes[i];
      constexpr int kSteps = 4;
      bool seen = false;
      for (int s = 0; s < (kSteps + 1) * (kSteps + 1) * 3 && !seen; ++s) {
        // Points all over the box, most of them on its roof: what shows first.
        const dvec3 t(s % (kSteps + 1) / static_cast<double>(kSteps),
                      s / (kSteps + 1) % (kSteps + 1) / static_cast<double>(kSteps),
                      1 - s / ((kSteps + 1) * (kSteps + 1)) * 0.5);
        const dvec3 point = glm::mix(box.min, box.max, t);
        const glm::dvec4 clip = clipFromEye * glm::dvec4(point, 1);
        const bool inPicture = clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
        seen = inPicture && !blocked(boxes, i, point);
      }
      tally.wronglyCulled += seen;
    }
  }
}

ViewState viewFrom(dvec3 eye, double heading, double pitch = 0) {
  return city::makeView({eye, heading, pitch, 0}, kPi / 3, {1280, 720});
}

using MakeView = std::function<ViewState(Random&, const City&)>;

Tally addUp(const City& city, const MakeView& makeOne, const CullMapOptions& options) {
  const Occluders occluders = occludersOf(city);
  Random random(3);
  Tally tally;
  for (int k = 0; k < kViews; ++k) addView(tally, city, occluders, makeOne(random, city), options);
  return tally;
}

const Aabbf& anyHouse(Random& random, const City& city) {
  return city.buildings.bounds[random.below(static_cast<uint32_t>(city.buildings.size()))];
}

ViewState inStreet(Random& random, const City&) {
  const double street = 18 * (static_cast<double>(random.below(11)) - 5);
  return viewFrom({random.uniform(-150, 150), street + random.uniform(-3.5, 3.5), 1.7}, random.uniform(0, 2 * kPi));
}

/// Every case for one kind of map; `kept`: the largest share of the boxes in a street's picture that it may keep.
void addRows(const std::string& part, CullMapKind kind, double kept, std::vector<StabilityRow>& rows) {
  const auto tallyOf = [kind](const City& city, const MakeView& makeOne, uint32_t size = 0) {
    CullMapOptions options{.kind = kind, .cells = kCells};
    if (size > 0) options.columns = size, options.cells = std::clamp(size, 16U, 512U);
    return addUp(city, makeOne, options);
  };
  const auto culledRow = [&](const std::string& name, const Tally& tally) {
    rows.push_back(city::stabilityRow(part, name, "visible boxes culled", static_cast<double>(tally.wronglyCulled), 0));
  };
  /// The case culls at all, or its row says nothing.
  const auto keptRow = [&](const std::string& name, const Tally& tally, double bound) {
    rows.push_back(city::stabilityRow(part, name, "share of the boxes in the picture that is kept",
                                      static_cast<double>(tally.inFrustum - tally.culled) /
                                          static_cast<double>(std::max(tally.inFrustum, uint64_t{1})),
                                      bound));
  };
  const City town = cityOf(terraces(1));

  const Tally street = tallyOf(town, inStreet);
  culledRow("terraced streets", street);
  keptRow("terraced streets", street, kept);

  culledRow("eye on an occluder line", tallyOf(town, [](Random& random, const City& city) {
              const Aabbf& box = anyHouse(random, city);
              const double x =
                  glm::mix(static_cast<double>(box.min.x), static_cast<double>(box.max.x), random.uniform());
              return viewFrom({x, static_cast<double>(box.min.y), 1.7}, random.uniform(0, 2 * kPi));
            }));
  culledRow("eye on an occluder line's end point", tallyOf(town, [](Random& random, const City& city) {
              const Aabbf& box = anyHouse(random, city);
              return viewFrom(
                  {static_cast<double>(random.below(2) ? box.min.x : box.max.x), static_cast<double>(box.min.y), 1.7},
                  random.uniform(0, 2 * kPi));
            }));
  culledRow("eye in line with an occluder line", tallyOf(town, [](Random& random, const City& city) {
              const Aabbf& box = anyHouse(random, city);
              return viewFrom({random.uniform(-160, 160), static_cast<double>(box.min.y), 1.7},
                              random.below(2) * kPi + random.uniform(-0.2, 0.2));
            }));
  culledRow("eye in line with a party wall", tallyOf(town, [](Random& random, const City& city) {
              const Aabbf& box = anyHouse(random, city);
              return viewFrom({static_cast<double>(box.max.x), static_cast<double>(box.min.y) - 4, 1.7}, kPi / 2);
            }));
  culledRow("eye 0.05 m from a wall", tallyOf(town, [](Random& random, const City& city) {
              const Aabbf& box = anyHouse(random, city);
              return viewFrom({static_cast<double>(box.centre().x), static_cast<double>(box.min.y) - 0.05, 1.7},
                              random.uniform(0, 2 * kPi));
            }));
  culledRow("eye in a house", tallyOf(town, [](Random& random, const City& city) {
              return viewFrom(dvec3(anyHouse(random, city).centre()), random.uniform(0, 2 * kPi));
            }));

  // The horizon has no outer edge; its faces meet on the diagonals through the eye.
  const Tally diagonals = tallyOf(town, [](Random& random, const City& city) {
    const Aabbf& box = anyHouse(random, city);
    const double away = random.uniform(5, 60);
    return viewFrom(
        {static_cast<double>(box.min.x) + (random.below(2) ? away : -away), static_cast<double>(box.min.y) - away, 1.7},
        (2 * random.below(4) + 1) * kPi / 4);
  });
  culledRow("occluder lines that end on the map's edges", diagonals);
  culledRow("eye outside the city", tallyOf(town, [](Random& random, const City&) {
              const double angle = random.uniform(0, 2 * kPi), far = std::pow(10, random.uniform(2.5, 5));
              return viewFrom({far * std::cos(angle), far * std::sin(angle), 1.7}, angle + kPi);
            }));

  // A column each 5.6°: hardly a wall covers one.
  culledRow("occluder lines narrower than a column", tallyOf(town, inStreet, 64));
  culledRow("the fewest columns", tallyOf(town, inStreet, 4));
  culledRow("the most columns", tallyOf(town, inStreet, 65536));

  City pointed = town;
  for (city::BuildingGeometry& type : pointed.buildingTypes) {
    const glm::vec2 corner = type.occluders[0].a;
    type.occluders.push_back({corner, corner, 0, 50});
    type.occluders.push_back({corner, corner + glm::vec2(0, 1e-6f), 0, 50});
  }
  culledRow("occluder lines without length", tallyOf(pointed, inStreet));
  City turned = town;
  for (city::BuildingGeometry& type : turned.buildingTypes)
    for (city::OccluderLine& line : type.occluders) std::swap(line.a, line.b);
  culledRow("occluder lines that face inward", tallyOf(turned, inStreet));

  // One wall 4 km long, 3 m before the eye: its shadow is all that lies north, over three faces of the map.
  std::vector<House> walled = terraces(2, {0, 120});
  walled.push_back({{0, 0}, {2000, 1}, 20});
  const auto beforeWall = [](Random& random, const City&) {
    return viewFrom({random.uniform(-20, 20), -4, 1.7}, kPi / 2 + random.uniform(-1, 1));
  };
  const Tally crossing = tallyOf(cityOf(walled), beforeWall);
  culledRow("a shadow across the whole map", crossing);
  keptRow("a shadow across the whole map", crossing, 0.05);

  for (const auto& [name, height] : {std::pair{"houses 65 535 m high", 65535.0}, {"houses 0.6 m high", 0.6}}) {
    std::vector<House> houses = terraces(4);
    for (size_t k = 0; k < houses.size(); k += 3) houses[k].height = height;
    culledRow(name, tallyOf(cityOf(houses), inStreet));
  }

  const auto above = [](double height) {
    return [height](Random& random, const City&) {
      return viewFrom({random.uniform(-100, 100), random.uniform(-90, 90), height}, random.uniform(0, 2 * kPi),
                      random.uniform(-1.2, 0));
    };
  };
  const Tally high = tallyOf(town, above(50));
  culledRow("eye above all roofs", high);
  rows.push_back(city::stabilityRow(part, "eye above all roofs", "boxes culled", static_cast<double>(high.culled), 0));
  culledRow("eye among the roofs", tallyOf(town, above(10)));
  rows.push_back(city::stabilityRow(part, "eye under the ground", "boxes culled",
                                    static_cast<double>(tallyOf(town, above(-1)).culled), 0));
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  rows.push_back(city::stabilityRow(part, "eye at NaN", "boxes culled",
                                    static_cast<double>(tallyOf(town,
                                                                [&](Random&, const City&) {
                                                                  ViewState view = viewFrom({0, 0, 1.7}, 0);
                                                                  view.eye.x = kNan;
                                                                  return view;
                                                                })
                                                            .culled),
                                    0));
  for (const auto& [name, pitch] : {std::pair{"looking straight up", kPi / 2}, {"looking straight down", -kPi / 2}})
    culledRow(name, tallyOf(town, [angle = pitch](Random& random, const City& city) {
                ViewState view = inStreet(random, city);
                return city::makeView({view.eye, random.uniform(0, 2 * kPi), angle, 0}, 2.5, {1280, 720});
              }));
  culledRow("field of view 179°, viewport 16384×1", tallyOf(town, [](Random& random, const City& city) {
              return city::makeView({inStreet(random, city).eye, random.uniform(0, 2 * kPi), 0, 0}, city::kLargestFov,
                                    {16384, 1});
            }));

  // Whole metres, so that the same town can stand 10 000 km away, where floats are a metre apart.
  std::vector<House> far = terraces(5);
  for (House& h : far) {
    h.centre = glm::round(h.centre) + dvec2(1e7, 5e6);
    h.half = glm::round(h.half), h.height = std::round(h.height);
  }
  culledRow("city 10 000 km from the origin", tallyOf(cityOf(far), [](Random& random, const City& city) {
              ViewState view = inStreet(random, city);
              view.eye += dvec3(1e7, 5e6, 0);
              return view;
            }));
}

}  // namespace

std::vector<StabilityRow> cullMapStability() {
  std::vector<StabilityRow> rows;
  addRows("cull map", CullMapKind::Horizon, 0.25, rows);
  addRows("cull map on the plan", CullMapKind::Plan, 0.5, rows);
  return rows;
}

}  // namespace vicus::culling
