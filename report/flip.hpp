/// How different two pictures look to a person who flips between them.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "viewer/renderer.hpp"

namespace vicus::report {

/// Pixels that one degree of the visual field covers: 67.02 is a screen 0.7 m wide and 3 840 pixels across, seen from
/// 0.7 m (3 840 · π/180). Smaller stands nearer and sees fine differences, larger stands further off and forgives them.
constexpr double kFlipPixelsPerDegree = 67.0206433;

/// One value for each pixel, row 0 at the top.
struct ErrorMap {
  int width = 0, height = 0;
  std::vector<float> values;  ///< width · height
};

/// What one picture looks like to the eye: kept where many pictures are compared with one reference.
struct FlipAppearance {
  int width = 0, height = 0;
  double pixelsPerDegree = kFlipPixelsPerDegree;
  std::vector<float> lightness, redGreen, blueYellow;  ///< filtered by the eye, in L*a*b*, the last two Hunt-adjusted
  std::vector<float> edges, points;                    ///< magnitude of the edge and the point detector's response
};

struct FlipResult {
  ErrorMap map;  ///< 0 the same … 1 as different as can be
  /// Of the map, added up row by row in single precision as the authors' program does, so that figures can be compared
  /// with published ones. On pictures in which most pixels hold the same error that alone moves it by up to 1e-3. NaN
  /// where the two cannot be compared.
  double mean = 0;
  double exactMean = 0;  ///< added up in double: for telling means apart that hardly differ
  double max = 0;
};

/// Prepares one picture. An empty picture gives an empty appearance.
FlipAppearance flipAppearance(const viewer::Picture& picture, double pixelsPerDegree = kFlipPixelsPerDegree);

/// LDR-FLIP of two prepared pictures. Different sizes or pixels per degree, or no pixels, give an empty map and NaN.
FlipResult flip(const FlipAppearance& reference, const FlipAppearance& test);
FlipResult flip(const viewer::Picture& reference, const viewer::Picture& test,
                double pixelsPerDegree = kFlipPixelsPerDegree);

/// Colour for an error in 0 … 1: black, violet, red, orange, pale yellow, lightness rising evenly; NaN is black.
glm::u8vec3 errorColour(float error);
/// The map in those colours.
viewer::Picture paintErrors(const ErrorMap& map);

}  // namespace vicus::report
