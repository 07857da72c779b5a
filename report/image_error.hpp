/// Differences between pictures, as numbers.
#pragma once

#include <span>

#include "viewer/renderer.hpp"

namespace vicus::report {

/// Over all pixels and channels of the sRGB values in 0 … 1.
struct PixelError {
  double rmse = 0;     ///< root of the mean squared difference
  double psnr = 0;     ///< 20 log10(1 / rmse) in dB; infinite for equal pictures
  double largest = 0;  ///< of any channel of any pixel
};

/// Through OpenImageIO's ImageBufAlgo::compare. Pictures of different sizes, or empty ones, give NaN.
PixelError pixelError(const viewer::Picture& reference, const viewer::Picture& test);

/// Structural similarity of the luma (Rec. 601), mean over all whole 11×11 windows: 1 the same, lower is worse. In
/// pictures smaller than 11 the window shrinks to fit. Pictures of different sizes, or empty ones, give NaN.
double ssim(const viewer::Picture& reference, const viewer::Picture& test);

/// How far a picture seems moved against the reference.
struct Shift {
  int x = 0, y = 0;      ///< pixels right and down
  double rmseThere = 0;  ///< left when it is moved back
  double rmseHere = 0;   ///< as it is, over the same pixels
};

/// Tries all whole shifts up to `reach` pixels and gives the best. A picture counts as shifted only where moving it
/// back takes away at least half of its RMSE; otherwise the shift is (0, 0). Pictures of different sizes, or smaller
/// than 4 · reach, give (0, 0).
Shift findShift(const viewer::Picture& reference, const viewer::Picture& test, int reach = 2);

/// Where a path pops most.
struct Popping {
  double jump = 0;   ///< largest |d[i] − d[i − 1]|
  size_t frame = 0;  ///< i of that jump; 0 where there is none
};

/// Popping along a path: `differences` holds, frame by frame, how different the picture is from that frame's own
/// reference (mean FLIP). The scene's own movement is in both and falls out; what remains are changes of what is drawn.
/// A technique whose error stays or grows slowly does not pop, however large the error is. Differences that are not
/// finite are skipped; fewer than two give 0.
Popping popping(std::span<const double> differences);

}  // namespace vicus::report
