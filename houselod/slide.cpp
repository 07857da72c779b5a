#include "houselod/slide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vicus::houselod {

double inverseScalar(double scalar, double pixels) {
  if (!(scalar > 0)) return kAllFlat;
  if (!(pixels > 0) || !std::isfinite(pixels)) pixels = kReferencePixels;
  return std::min(kReferencePixels / (scalar * pixels), kAllFlat);
}

double slidTo(double depth, double distance, double inverseScalar) {
  if (!std::isfinite(depth)) return 0;
  if (!(distance > 0)) return depth;  // at the wall, or not a number
  const double size = std::abs(depth);
  // What never slides stays where it is, also at an infinite distance.
  const double gone = inverseScalar > 0 ? distance * inverseScalar : 0;
  return std::copysign(std::clamp((4 * size - gone) / 3, 0.0, size), depth);
}

double pushedIn(double depth, double distance, double inverseScalar) {
  const double size = std::abs(depth);
  if (!(size > 0) || !std::isfinite(size)) return distance > 0 && inverseScalar > 0 ? 1 : 0;
  return 1 - std::abs(slidTo(depth, distance, inverseScalar)) / size;
}

double flatFrom(double depth, double inverseScalar) {
  const double size = std::abs(depth);
  if (!(inverseScalar > 0)) return std::numeric_limits<double>::infinity();
  return std::isfinite(size) ? 4 * size / inverseScalar : 0;
}

double largestErrorPixels(double inverseScalar, double pixels) {
  return inverseScalar < kAllFlat ? inverseScalar * pixels / 4 : std::numeric_limits<double>::infinity();
}

}  // namespace vicus::houselod
