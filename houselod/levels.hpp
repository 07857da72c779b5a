/// What of a building type is drawn from how far: all of it, flat walls with those items that still stand out, or flat
/// walls alone.
///
/// Based on: Willmott et al. 2001, §4.2 (external geometry and openings are left out where the viewer is too far to see
/// them, and the wall's picture stands for them).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "city/building_geometry.hpp"
#include "city/knob.hpp"

namespace vicus::houselod {

/// Items of about the same reach go together: a step. The steps of a type ascend by reach.
struct TypeLevels {
  std::vector<float> reaches;   ///< metres, one for each step: none of its items reaches farther
  std::vector<uint8_t> stepOf;  ///< for each of the type's externalGeometry
  float openings = 0;           ///< depth of the deepest opening, metres
  float detail = 0;             ///< metres: the finest that its flat walls show; from nearer they look wrong
  bool flat = false;            ///< its flat walls differ from those of full detail
};

/// The level of an instance: 0 is full detail; k > 0 flat walls with the items of the steps k − 1 and up, so that
/// `reaches.size() + 1` is flat walls alone.
using Level = uint8_t;
constexpr Level kFullDetail = 0;
constexpr size_t kMostSteps = 64;

/// What flat walls without a picture of their items show of these: nothing, or others. Where a pixel covers so many
/// metres that is hardly seen: half a window.
constexpr float kDetailWithoutPicture = 0.5f;

/// A wall without a surface of its own behind its openings is drawn with all that is on it at every level.
inline bool staysWhole(const city::Plane& plane) {
  return plane.flat == plane.cut && plane.externalOpenings.count > 0;
}

/// An item reaches as far as its depth, or as far as it overhangs the outline of its wall where that is more (a gable's
/// steps stand before the sky, and only their own size says from where they are not missed).
TypeLevels levelsOf(const city::BuildingGeometry& type);

/// A view as the levels see it.
struct LevelView {
  double inverse = 0;           ///< inverseScalar of the picture
  double pixelsPerSlope = 624;  ///< pixels per unit slope
};

/// The level for an instance no point of which is nearer than `distance` metres. An item is left out only where it lies
/// in its wall; a distance that is not a number gives full detail.
Level levelAt(const TypeLevels& type, const LevelView& view, double distance);

/// From the distance at which a type's walls become flat to so many times that, full detail fades into flat walls: at
/// a walk some seconds, so that no frame changes more than a few pixels of a wall.
constexpr double kFadeBand = 1.15;

/// Share of its pixels that show flat walls, the rest full detail: 0 at the switch and nearer, a straight line to 1 at
/// kFadeBand times the switch's distance. A distance that is not a number, and a type that is never flat: 0; where
/// walls are flat from everywhere, 1.
double flatShareAt(const TypeLevels& type, const LevelView& view, double distance);

/// house_lod, house_lod.scalar, …
std::span<const city::Knob> houseLodKnobs();
/// house_lod.picture_mb: shapes what is drawn from, not the plan alone.
std::span<const city::Knob> pictureKnobs();

}  // namespace vicus::houselod
