/// The land that Norvic stands on: a gentle valley, the river in it, the castle's mound.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "assets/norvic/plan_geometry.hpp"
#include "city/city.hpp"

namespace vicus::assets::norvic {

/// A piece of ground made level: `height` within `radius`, passing into the land around over `blend` metres.
struct LevelGround {
  glm::dvec2 centre{0};
  double radius = 0, blend = 1;
  double height = 0;
};

/// A formula for the land, so that any part can be had without the rest. Heights in metres above the city's origin.
///
/// The river is the graph of a sum of sines, y = riverAt(x), of one width and one level. Beside it lies a flood plain
/// of one height, so that every bridge is alike.
class Landscape {
 public:
  /// A square of `side` metres about 0 with heights `spacing` metres apart. `river` false: no river and no valley.
  Landscape(double side, double spacing, uint32_t seed, bool river);

  double riverAt(double x) const;
  double riverSlope(double x) const;
  /// Distance to the river's middle line, metres, right within a tenth to 100 m from it; very large without river.
  double riverDistance(glm::dvec2 p) const;
  /// A unit vector along the river at its point nearest in x.
  glm::dvec2 riverDirection(double x) const;
  /// +1 north of the river, −1 south of it; +1 everywhere without river.
  int side(glm::dvec2 p) const { return !hasRiver_ || p.y > riverAt(p.x) ? 1 : -1; }

  /// Makes ground level at the height it has at its centre.
  void addLevelGround(glm::dvec2 centre, double radius, double blend);
  /// A mound with a flat top, as castles stand on. With its ditch it reaches to `footRadius` + 14.
  void setMound(glm::dvec2 centre, double topRadius, double footRadius, double rise);

  double height(glm::dvec2 p) const;

  city::HeightField heightField() const;
  /// The river's surface; meets the banks under the ground.
  city::WaterBody water() const;

  bool hasRiver() const { return hasRiver_; }
  double side() const { return side_; }
  double spacing() const { return spacing_; }
  /// Half the river's width between the feet of its banks, metres.
  double riverHalfWidth() const { return riverHalfWidth_; }
  double bankWidth() const { return bankWidth_; }
  /// Nothing may be built nearer to the river's middle.
  double dryDistance() const { return riverHalfWidth_ + bankWidth_ + 2; }

  static constexpr double kWaterLevel = 10;
  static constexpr double kPlainHeight = 12;  ///< of the flood plain, and of the ends of bridges

 private:
  double natural(glm::dvec2 p) const;

  double side_, spacing_;
  uint32_t seed_;
  bool hasRiver_;
  double riverHalfWidth_, bankWidth_;
  double phase_[3];
  double offset_ = 0;
  std::vector<LevelGround> level_;
  glm::dvec2 moundCentre_{0};
  double moundTop_ = 0, moundFoot_ = 0, moundRise_ = 0;
};

}  // namespace vicus::assets::norvic
