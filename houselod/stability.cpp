#include "houselod/stability.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "houselod/levels.hpp"
#include "houselod/slide.hpp"

namespace vicus::houselod {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The larger of the two, infinite where one is not a number.
double worse(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? kInfinity : std::max(a, b);
}

/// Metres that points of all depths lie from where `expected` puts them, over distances from 0 to 1e300.
double worstOver(double scalar, const std::function<double(double depth, double distance)>& expected) {
  const double inverse = inverseScalar(scalar, kReferencePixels);
  double worst = 0;
  for (const double depth : {0.0, 1e-300, 1e-6, 0.03, 0.5, 5.0, 1e6})
    for (const double sign : {1.0, -1.0})
      for (const double distance : {0.0, 1e-12, 0.05, 1.0, 64.0, 1e5, 1e300}) {
        const double d = sign * depth;
        worst = worse(worst, std::abs(slidTo(d, distance, inverse) - expected(d, distance)));
      }
  return worst;
}

/// The published function where it is defined: what is left of the depth.
double published(double scalar, double depth, double distance) {
  const double near = scalar * depth, far = 4 * near;
  double t = 1 - (far / (far - near) - distance / (far - near));
  t = std::clamp(t, 0.0, 1.0);
  return (1 - t) * depth;
}

/// A wall of 10 × 6 m with an item and an opening of the given depths; the item reaches `over` metres over the wall.
city::BuildingGeometry wallWith(float item, float opening, float over = 0) {
  city::BuildingBuilder builder("wall");
  builder.beginPlane(city::PlaneKind::Wall, 0, {0, -1, 0});
  builder.addQuad({0, 0, 0}, {10, 0, 0}, {10, 0, 3}, {0, 0, 3}, 0);
  builder.addQuad({0, 0, 3}, {5, 0, 3}, {5, 0, 6}, {0, 0, 6}, 0);
  builder.addQuad({6, 0, 3}, {10, 0, 3}, {10, 0, 6}, {6, 0, 6}, 0);
  builder.beginFlat();
  builder.addQuad({0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {0, 0, 6}, 0);
  builder.beginExternalGeometry(item);
  builder.addQuad({1, -item, 4}, {2, -item, 4}, {2, -item, 6 + over}, {1, -item, 6 + over}, 0);
  builder.beginExternalOpening(opening);
  builder.addQuad({5, opening, 3}, {6, opening, 3}, {6, opening, 6}, {5, opening, 6}, 0);
  return builder.finish();
}

/// How often a level leaves something out that does not yet lie in its wall, over distances and scalars.
double leftOutTooSoon(const city::BuildingGeometry& type) {
  const TypeLevels levels = levelsOf(type);
  double count = 0;
  for (const double scalar : {0.0, 1.0, 16.0, 64.0, 1e9, kInfinity})
    for (double distance = 0.01; distance < 1e6; distance *= 1.07) {
      const LevelView view{inverseScalar(scalar, kReferencePixels), 0};
      const Level level = levelAt(levels, view, distance);
      if (level == kFullDetail) continue;
      for (const city::ExternalOpening& o : type.externalOpenings)
        count += pushedIn(static_cast<double>(o.depth), distance, view.inverse) < 1 ? 1 : 0;
      for (size_t i = 0; i < type.externalGeometry.size(); ++i)
        if (levels.stepOf[i] + 1 < level)
          count += pushedIn(static_cast<double>(type.externalGeometry[i].depth), distance, view.inverse) < 1 ? 1 : 0;
    }
  return count;
}

}  // namespace

std::vector<city::StabilityRow> houseLodStability() {
  std::vector<city::StabilityRow> rows;
  const auto add = [&](const char* name, const char* what, double figure, double bound) {
    rows.push_back(city::stabilityRow("house LOD", name, what, figure, bound));
  };
  const double usual = inverseScalar(64, kReferencePixels);
  constexpr const char* kOff = "metres from where it belongs";

  double worst = 0;
  for (const double distance : {0.0, 1e-300, 1.0, 1e300, kInfinity, kNan})
    for (const double scalar : {0.0, 64.0, kInfinity})
      worst = worse(worst, std::abs(slidTo(0, distance, inverseScalar(scalar, kReferencePixels))));
  add("depth 0", kOff, worst, 0);
  worst = 0;
  for (double distance = 0; distance < 100; distance += 0.37)
    worst = worse(worst, std::abs(slidTo(-0.2, distance, usual) + slidTo(0.2, distance, usual)));
  add("negative depth", "metres that it differs from a positive one mirrored", worst, 0);
  worst = 0;
  for (const double depth : {kInfinity, -kInfinity, kNan}) worst = worse(worst, std::abs(slidTo(depth, 10, usual)));
  add("depth infinite or NaN", kOff, worst, 0);
  add("scalar 0: all in the wall", kOff,
      worstOver(0, [](double depth, double distance) { return distance > 0 ? 0 : depth; }), 0);
  add("scalar infinite: nothing slides", kOff, worstOver(kInfinity, [](double depth, double) { return depth; }), 0);
  add("scalar negative or NaN: as 0", "of the inverse scalar",
      std::abs(inverseScalar(-3, 600) - kAllFlat) + std::abs(inverseScalar(kNan, 600) - kAllFlat), 0);
  add("scalar 1e-300 and 1e300", "inverse scalars that are not finite",
      (std::isfinite(inverseScalar(1e-300, 600)) ? 0 : 1) + (std::isfinite(inverseScalar(1e300, 600)) ? 0 : 1), 0);
  worst = 0;
  for (const double depth : {0.03, -0.5, 5.0}) worst = worse(worst, std::abs(slidTo(depth, 0, usual) - depth));
  add("distance 0", kOff, worst, 0);
  add("distance infinite", kOff, std::abs(slidTo(0.3, kInfinity, usual)), 0);
  add("distance NaN: at full detail", kOff, std::abs(slidTo(0.3, kNan, usual) - 0.3), 0);
  worst = 0;
  for (const double pixels : {0.0, -1.0, kNan, kInfinity})
    worst = worse(worst, std::abs(inverseScalar(64, pixels) - usual));
  add("pixels 0, NaN and infinite: the reference's", "of the inverse scalar", worst, 0);
  worst = 0;
  for (const double depth : {1e-6, 0.03, 0.5, 5.0})
    for (double distance = 0.01; distance < 1e4; distance *= 1.01)
      worst = worse(worst, std::abs(slidTo(depth, distance, usual) - published(64, depth, distance)));
  add("against the published formula", kOff, worst, 1e-9);
  worst = 0;
  double before = 5;
  for (double distance = 0; distance < 4000; distance += 0.5) {
    const double out = slidTo(5, distance, usual);
    worst = worse(worst, out - before), before = out;
  }
  add("goes in only, with distance", "metres that it comes back out", worst, 0);

  for (const auto& [name, type] :
       {std::pair{"item of depth 0", wallWith(0, 0.3f)}, std::pair{"opening of depth 0", wallWith(0.1f, 0)},
        std::pair{"item of 5 m", wallWith(5, 0.1f)},
        std::pair{"item that overhangs its wall by 3 m", wallWith(0.1f, 0.3f, 3)}})
    add(name, "things left out that still stand out", leftOutTooSoon(type), 0);
  const TypeLevels levels = levelsOf(wallWith(0.1f, 0.3f));
  add("levels at distance NaN", "levels under full detail", levelAt(levels, {usual, 600}, kNan), 0);
  const TypeLevels overhanging = levelsOf(wallWith(0.1f, 0.3f, 3));
  add("an item that overhangs is not missed before the sky", "metres short of its own size",
      3 - static_cast<double>(overhanging.reaches.empty() ? 0 : overhanging.reaches.back()), 1e-6);
  add("a building of nothing", "levels", static_cast<double>(levelsOf({}).reaches.size()), 0);
  return rows;
}

}  // namespace vicus::houselod
