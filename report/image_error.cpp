/// Based on: Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
/// Similarity" (§III-B, §III-C: 11×11 Gaussian window, σ = 1.5, K1 = 0.01, K2 = 0.03).
#include "report/image_error.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace vicus::report {
namespace {

bool comparable(const viewer::Picture& a, const viewer::Picture& b) {
  return !a.rgb.empty() && a.width == b.width && a.height == b.height && a.rgb.size() == b.rgb.size();
}

OIIO::ImageBuf wrap(const viewer::Picture& picture) {
  // OpenImageIO takes memory to wrap as non-const, also where it only reads.
  return {OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8),
          const_cast<uint8_t*>(picture.rgb.data())};
}

std::vector<float> luma(const viewer::Picture& picture) {
  std::vector<float> out(picture.rgb.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) {
    const uint8_t* p = picture.rgb.data() + 3 * i;
    out[i] = 0.299F * static_cast<float>(p[0]) + 0.587F * static_cast<float>(p[1]) + 0.114F * static_cast<float>(p[2]);
  }
  return out;
}

std::vector<float> gaussian(int size, double sigma) {
  std::vector<float> weights(static_cast<size_t>(size));
  double sum = 0;
  for (int i = 0; i < size; ++i) {
    const double x = i - (size - 1) / 2.0;
    weights[static_cast<size_t>(i)] = static_cast<float>(std::exp(-x * x / (2 * sigma * sigma)));
    sum += static_cast<double>(weights[static_cast<size_t>(i)]);
  }
  for (float& w : weights) w = static_cast<float>(static_cast<double>(w) / sum);
  return weights;
}

/// Weighted means over all windows that lie wholly inside.
std::vector<float> windowMeans(const std::vector<float>& in, int width, int height, const std::vector<float>& kernelX,
                               const std::vector<float>& kernelY) {
  const int outWidth = width - static_cast<int>(kernelX.size()) + 1;
  const int outHeight = height - static_cast<int>(kernelY.size()) + 1;
  const auto at = [](int columns, int y) { return static_cast<size_t>(columns) * static_cast<size_t>(y); };
  std::vector<float> rows(at(outWidth, height)), out(at(outWidth, outHeight));
  for (int y = 0; y < height; ++y)
    for (size_t k = 0; k < kernelX.size(); ++k)
      for (int x = 0; x < outWidth; ++x)
        rows[at(outWidth, y) + static_cast<size_t>(x)] += kernelX[k] * in[at(width, y) + static_cast<size_t>(x) + k];
  for (int y = 0; y < outHeight; ++y)
    for (size_t k = 0; k < kernelY.size(); ++k)
      for (int x = 0; x < outWidth; ++x)
        out[at(outWidth, y) + static_cast<size_t>(x)] +=
            kernelY[k] * rows[at(outWidth, y + static_cast<int>(k)) + static_cast<size_t>(x)];
  return out;
}

std::vector<float> product(const std::vector<float>& a, const std::vector<float>& b) {
  std::vector<float> out(a.size());
  for (size_t i = 0; i < a.size(); ++i) out[i] = a[i] * b[i];
  return out;
}

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

PixelError pixelError(const viewer::Picture& reference, const viewer::Picture& test) {
  if (!comparable(reference, test)) return {kNotANumber, kNotANumber, kNotANumber};
  const auto result = OIIO::ImageBufAlgo::compare(wrap(reference), wrap(test), 0.0F, 0.0F);
  PixelError error;
  error.rmse = result.rms_error;
  error.psnr = error.rmse > 0 ? result.PSNR : std::numeric_limits<double>::infinity();
  error.largest = result.maxerror;
  return error;
}

double ssim(const viewer::Picture& reference, const viewer::Picture& test) {
  if (!comparable(reference, test)) return kNotANumber;
  constexpr int kWindow = 11;
  constexpr double kSigma = 1.5;
  constexpr double kC1 = 0.01 * 255 * (0.01 * 255), kC2 = 0.03 * 255 * (0.03 * 255);

  const int width = reference.width, height = reference.height;
  const auto kernelX = gaussian(std::min(kWindow, width), kSigma),
             kernelY = gaussian(std::min(kWindow, height), kSigma);
  const auto mean = [&](const std::vector<float>& in) { return windowMeans(in, width, height, kernelX, kernelY); };
  const auto a = luma(reference), b = luma(test);
  const auto meanA = mean(a), meanB = mean(b), squareA = mean(product(a, a)), squareB = mean(product(b, b)),
             cross = mean(product(a, b));

  double sum = 0;
  for (size_t i = 0; i < meanA.size(); ++i) {
    const auto ma = static_cast<double>(meanA[i]), mb = static_cast<double>(meanB[i]);
    const double varianceA = static_cast<double>(squareA[i]) - ma * ma;
    const double varianceB = static_cast<double>(squareB[i]) - mb * mb;
    const double covariance = static_cast<double>(cross[i]) - ma * mb;
    sum += (2 * ma * mb + kC1) * (2 * covariance + kC2) / ((ma * ma + mb * mb + kC1) * (varianceA + varianceB + kC2));
  }
  return sum / static_cast<double>(meanA.size());
}

Shift findShift(const viewer::Picture& reference, const viewer::Picture& test, int reach) {
  Shift best;
  if (!comparable(reference, test) || reference.width < 4 * reach || reference.height < 4 * reach) return best;

  // RMSE over the pixels that every shift leaves inside both pictures; every other row is enough to tell.
  const auto rmseAt = [&](int dx, int dy) {
    uint64_t sum = 0, count = 0;
    for (int y = reach; y < reference.height - reach; y += 2)
      for (int x = reach; x < reference.width - reach; ++x)
        for (size_t c = 0; c < 3; ++c) {
          const auto pixel = [&](const viewer::Picture& p, int px, int py) {
            return static_cast<int>(
                p.rgb[3 * (static_cast<size_t>(py) * static_cast<size_t>(p.width) + static_cast<size_t>(px)) + c]);
          };
          const int difference = pixel(reference, x, y) - pixel(test, x + dx, y + dy);
          sum += static_cast<uint64_t>(difference * difference);
          ++count;
        }
    return std::sqrt(static_cast<double>(sum) / static_cast<double>(count)) / 255;
  };
  best.rmseHere = best.rmseThere = rmseAt(0, 0);
  Shift candidate = best;
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx)
      if (const double rmse = rmseAt(dx, dy); rmse < candidate.rmseThere) candidate = {dx, dy, rmse, best.rmseHere};
  return candidate.rmseThere <= 0.5 * best.rmseHere ? candidate : best;
}

Popping popping(std::span<const double> differences) {
  Popping worst;
  for (size_t i = 1; i < differences.size(); ++i) {
    const double jump = std::abs(differences[i] - differences[i - 1]);
    if (jump > worst.jump) worst = {jump, i};
  }
  return worst;
}

}  // namespace vicus::report
