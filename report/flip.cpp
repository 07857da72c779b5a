/// Based on: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A Difference Evaluator for
/// Alternating Images" (colour pipeline §4.1, feature pipeline §4.2, combination §4.3).
/// Every filter of the paper is a product of a horizontal and a vertical one, or a sum of two such products, and is run
/// as that. Pictures are continued beyond their edges by their edge pixels.
#include "report/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vicus::report {
namespace {

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // 2 r + 1 weights

constexpr double kPi = std::numbers::pi;

// Exponents and thresholds of the paper's equations 5 to 9.
constexpr float kColourExponent = 0.7F;     // q_c
constexpr float kKneeOfRange = 0.4F;        // p_c: this part of the colour range …
constexpr float kKneeOfError = 0.95F;       // p_t: … takes this part of the error range
constexpr double kFeatureWidth = 0.082;     // w: degrees that an edge or point detector spans
constexpr float kFeatureExponent = 0.5F;    // q_f
constexpr double kFilterReachInSigmas = 3;  // kernels are cut there

/// XYZ of linear sRGB (IEC 61966-2-1 primaries, D65 white).
constexpr std::array<std::array<double, 3>, 3> kXyzFromRgb{{
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382},
}};

/// XYZ relative to the white point, so that white is (1, 1, 1): rows of kXyzFromRgb divided by their sums.
glm::dmat3 whiteRelativeXyzFromRgb() {
  glm::dmat3 m;
  for (int row = 0; row < 3; ++row) {
    const auto& r = kXyzFromRgb[static_cast<size_t>(row)];
    const double sum = r[0] + r[1] + r[2];
    for (int column = 0; column < 3; ++column) m[column][row] = r[static_cast<size_t>(column)] / sum;
  }
  return m;
}

float linearFromSrgb(double s) {
  return static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

struct Lab {
  float lightness, redGreen, blueYellow;
};

/// CIE 1976 L*a*b* of white-relative XYZ, the colour axes scaled by lightness (Hunt effect: dark colours look less
/// colourful).
Lab huntLab(glm::vec3 xyz) {
  constexpr float kDelta = 6.0F / 29.0F;
  const auto f = [](float t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0F / 29.0F;
  };
  const float fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
  const float lightness = 116 * fy - 16;
  return {lightness, 0.01F * lightness * 500 * (fx - fy), 0.01F * lightness * 200 * (fy - fz)};
}

float hyab(const Lab& a, const Lab& b) {
  const float dr = a.redGreen - b.redGreen, db = a.blueYellow - b.blueYellow;
  return std::abs(a.lightness - b.lightness) + std::sqrt(dr * dr + db * db);
}

/// The largest colour difference on a screen: between pure green and pure blue, raised to q_c.
float largestColourError() {
  const glm::mat3 xyzFromRgb(whiteRelativeXyzFromRgb());
  return std::pow(hyab(huntLab(xyzFromRgb * glm::vec3(0, 1, 0)), huntLab(xyzFromRgb * glm::vec3(0, 0, 1))),
                  kColourExponent);
}

/// out += rows of `in` filtered along x.
void filterRows(const Plane& in, int width, int height, const Kernel& kernel, Plane& out) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  std::vector<float> padded(static_cast<size_t>(width + 2 * reach));
  for (int y = 0; y < height; ++y) {
    const float* row = in.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    std::fill_n(padded.begin(), reach, row[0]);
    std::copy_n(row, width, padded.begin() + reach);
    std::fill_n(padded.end() - reach, reach, row[width - 1]);
    float* sum = out.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    for (size_t k = 0; k < kernel.size(); ++k) {
      const float weight = kernel[k];
      const float* shifted = padded.data() + k;
      for (int x = 0; x < width; ++x) sum[x] += weight * shifted[x];
    }
  }
}

/// out += columns of `in` filtered along y.
void filterColumns(const Plane& in, int width, int height, const Kernel& kernel, Plane& out) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  for (int y = 0; y < height; ++y) {
    float* sum = out.data() + static_cast<size_t>(y) * static_cast<size_t>(width);
    for (int k = -reach; k <= reach; ++k) {
      const float weight = kernel[static_cast<size_t>(k + reach)];
      const float* row = in.data() + static_cast<size_t>(std::clamp(y + k, 0, height - 1)) * static_cast<size_t>(width);
      for (int x = 0; x < width; ++x) sum[x] += weight * row[x];
    }
  }
}

/// `horizontal` along x, then `vertical` along y, added to `out`. `scratch` is overwritten.
void filterSeparable(const Plane& in, int width, int height, const Kernel& horizontal, const Kernel& vertical,
                     Plane& scratch, Plane& out) {
  std::fill(scratch.begin(), scratch.end(), 0.0F);
  filterRows(in, width, height, horizontal, scratch);
  filterColumns(scratch, width, height, vertical, out);
}

/// One Gaussian of a contrast sensitivity function: a √(π/b) exp(−π² x² / b), x in degrees (the paper's table 1).
struct Sensitivity {
  double a, b;
};
constexpr Sensitivity kLuminanceSensitivity{1, 0.0047};
constexpr Sensitivity kRedGreenSensitivity{1, 0.0053};
constexpr std::array<Sensitivity, 2> kBlueYellowSensitivity{{{34.1, 0.04}, {13.5, 0.025}}};

/// What blurs each opponent channel as the eye does.
struct EyeFilters {
  Kernel luminance, redGreen;
  std::array<Kernel, 2> blueYellow;  // the filter is the sum of both products
};

EyeFilters eyeFilters(double pixelsPerDegree) {
  const double widest = kBlueYellowSensitivity[0].b;
  const int reach =
      static_cast<int>(std::ceil(kFilterReachInSigmas * std::sqrt(widest / (2 * kPi * kPi)) * pixelsPerDegree));
  // One factor of the two-dimensional Gaussian: its amplitude is shared between x and y.
  const auto factor = [&](Sensitivity s) {
    std::vector<double> weights;
    for (int i = -reach; i <= reach; ++i) {
      const double x = i / pixelsPerDegree;
      weights.push_back(std::sqrt(s.a * std::sqrt(kPi / s.b)) * std::exp(-kPi * kPi * x * x / s.b));
    }
    return weights;
  };
  const auto sumOf = [](const std::vector<double>& weights) {
    double sum = 0;
    for (const double w : weights) sum += w;
    return sum;
  };
  const auto scaled = [](const std::vector<double>& weights, double scale) {
    Kernel kernel;
    for (const double w : weights) kernel.push_back(static_cast<float>(w * scale));
    return kernel;
  };

  // The two-dimensional weights of each filter add up to 1.
  EyeFilters filters;
  const auto luminance = factor(kLuminanceSensitivity), redGreen = factor(kRedGreenSensitivity);
  filters.luminance = scaled(luminance, 1 / sumOf(luminance));
  filters.redGreen = scaled(redGreen, 1 / sumOf(redGreen));
  const auto first = factor(kBlueYellowSensitivity[0]), second = factor(kBlueYellowSensitivity[1]);
  const double scale = 1 / std::hypot(sumOf(first), sumOf(second));
  filters.blueYellow = {scaled(first, scale), scaled(second, scale)};
  return filters;
}

/// Detectors of edges (first derivative of a Gaussian) and points (second derivative), and the Gaussian across them.
struct FeatureFilters {
  Kernel smooth, edge, point;
};

FeatureFilters featureFilters(double pixelsPerDegree) {
  const double sigma = 0.5 * kFeatureWidth * pixelsPerDegree;
  const int reach = static_cast<int>(std::ceil(kFilterReachInSigmas * sigma));
  std::vector<double> smooth, edge, point;
  for (int i = -reach; i <= reach; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    smooth.push_back(g);
    edge.push_back(-i * g);
    point.push_back((i * i / (sigma * sigma) - 1) * g);
  }
  // Positive weights add up to 1, negative ones to −1.
  const auto balanced = [](const std::vector<double>& weights) {
    double positive = 0, negative = 0;
    for (const double w : weights) (w > 0 ? positive : negative) += w;
    Kernel kernel;
    for (const double w : weights) kernel.push_back(static_cast<float>(w > 0 ? w / positive : w / -negative));
    if (negative == 0)
      for (float& w : kernel) w = positive > 0 ? w : 0.0F;
    return kernel;
  };
  return {balanced(smooth), balanced(edge), balanced(point)};
}

void toMagnitude(Plane& x, const Plane& y) {
  for (size_t i = 0; i < x.size(); ++i) x[i] = std::sqrt(x[i] * x[i] + y[i] * y[i]);
}

}  // namespace

FlipAppearance flipAppearance(const viewer::Picture& picture, double pixelsPerDegree) {
  FlipAppearance out;
  const int width = picture.width, height = picture.height;
  out.width = width;
  out.height = height;
  out.pixelsPerDegree = pixelsPerDegree;
  const size_t pixels = static_cast<size_t>(std::max(width, 0)) * static_cast<size_t>(std::max(height, 0));
  if (pixels == 0) return out;

  // Into a linear opponent space: luminance, red against green, blue against yellow.
  std::array<float, 256> linear;
  for (size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(static_cast<double>(i) / 255);
  const glm::mat3 xyzFromRgb(whiteRelativeXyzFromRgb());
  Plane luminance(pixels), redGreen(pixels), blueYellow(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const uint8_t* p = picture.rgb.data() + 3 * i;
    const glm::vec3 xyz = xyzFromRgb * glm::vec3(linear[p[0]], linear[p[1]], linear[p[2]]);
    luminance[i] = xyz.y;
    redGreen[i] = xyz.x - xyz.y;
    blueYellow[i] = xyz.y - xyz.z;
  }

  // What edges and points the eye finds, in luminance.
  Plane scratch(pixels), across(pixels);
  const FeatureFilters features = featureFilters(pixelsPerDegree);
  out.edges.assign(pixels, 0);
  out.points.assign(pixels, 0);
  filterSeparable(luminance, width, height, features.edge, features.smooth, scratch, out.edges);
  filterSeparable(luminance, width, height, features.smooth, features.edge, scratch, across);
  toMagnitude(out.edges, across);
  std::fill(across.begin(), across.end(), 0.0F);
  filterSeparable(luminance, width, height, features.point, features.smooth, scratch, out.points);
  filterSeparable(luminance, width, height, features.smooth, features.point, scratch, across);
  toMagnitude(out.points, across);

  // The eye's blur.
  const EyeFilters eye = eyeFilters(pixelsPerDegree);
  out.lightness.assign(pixels, 0);
  out.redGreen.assign(pixels, 0);
  out.blueYellow.assign(pixels, 0);
  filterSeparable(luminance, width, height, eye.luminance, eye.luminance, scratch, out.lightness);
  filterSeparable(redGreen, width, height, eye.redGreen, eye.redGreen, scratch, out.redGreen);
  for (const Kernel& k : eye.blueYellow) filterSeparable(blueYellow, width, height, k, k, scratch, out.blueYellow);

  // Back inside what a screen can show, then to a space in which distances are what they look like.
  const glm::mat3 rgbFromXyz(glm::inverse(whiteRelativeXyzFromRgb()));
  for (size_t i = 0; i < pixels; ++i) {
    const float y = out.lightness[i];
    const glm::vec3 rgb = rgbFromXyz * glm::vec3(y + out.redGreen[i], y, y - out.blueYellow[i]);
    const Lab lab = huntLab(xyzFromRgb * glm::clamp(rgb, 0.0F, 1.0F));
    out.lightness[i] = lab.lightness;
    out.redGreen[i] = lab.redGreen;
    out.blueYellow[i] = lab.blueYellow;
  }
  return out;
}

FlipResult flip(const FlipAppearance& reference, const FlipAppearance& test) {
  FlipResult result;
  const size_t pixels = reference.lightness.size();
  if (pixels == 0 || test.width != reference.width || test.height != reference.height ||
      test.pixelsPerDegree != reference.pixelsPerDegree) {
    result.mean = result.exactMean = result.max = std::numeric_limits<double>::quiet_NaN();
    return result;
  }
  result.map = {reference.width, reference.height, std::vector<float>(pixels)};
  const float largest = largestColourError();
  const float knee = kKneeOfRange * largest;

  float sum = 0;
  double exactSum = 0;
  for (size_t i = 0; i < pixels; ++i) {
    // How different the colours look, most of the range given to small differences.
    const float distance = std::pow(hyab({reference.lightness[i], reference.redGreen[i], reference.blueYellow[i]},
                                         {test.lightness[i], test.redGreen[i], test.blueYellow[i]}),
                                    kColourExponent);
    const float colour = distance < knee ? kKneeOfError / knee * distance
                                         : kKneeOfError + (distance - knee) / (largest - knee) * (1 - kKneeOfError);
    // How different the edges and points are; they raise the colour error.
    const float feature =
        std::max(std::abs(reference.edges[i] - test.edges[i]), std::abs(reference.points[i] - test.points[i]));
    const float featureError = std::pow(feature * std::numbers::sqrt2_v<float> / 2, kFeatureExponent);
    const float error = std::clamp(std::pow(colour, 1 - featureError), 0.0F, 1.0F);
    result.map.values[i] = error;
    sum += error;
    exactSum += static_cast<double>(error);
    result.max = std::max(result.max, static_cast<double>(error));
  }
  result.mean = static_cast<double>(sum / static_cast<float>(pixels));
  result.exactMean = exactSum / static_cast<double>(pixels);
  return result;
}

FlipResult flip(const viewer::Picture& reference, const viewer::Picture& test, double pixelsPerDegree) {
  return flip(flipAppearance(reference, pixelsPerDegree), flipAppearance(test, pixelsPerDegree));
}

glm::u8vec3 errorColour(float error) {
  // Every 32nd colour of the map "magma" (S. van der Walt and N. Smith 2015, public domain), which the paper uses too.
  constexpr std::array<std::array<float, 3>, 9> kStops{{{0, 0, 4},
                                                        {28, 16, 68},
                                                        {79, 18, 123},
                                                        {129, 37, 129},
                                                        {181, 54, 122},
                                                        {229, 80, 100},
                                                        {251, 135, 97},
                                                        {254, 194, 135},
                                                        {252, 253, 191}}};
  const float at = std::isfinite(error) ? std::clamp(error, 0.0F, 1.0F) * (kStops.size() - 1) : 0.0F;
  const auto low = std::min(static_cast<size_t>(at), kStops.size() - 2);
  const float t = at - static_cast<float>(low);
  glm::u8vec3 colour;
  for (int k = 0; k < 3; ++k) {
    const auto c = static_cast<size_t>(k);
    colour[k] = static_cast<uint8_t>(std::lround((1 - t) * kStops[low][c] + t * kStops[low + 1][c]));
  }
  return colour;
}

viewer::Picture paintErrors(const ErrorMap& map) {
  viewer::Picture picture{map.width, map.height, {}};
  picture.rgb.reserve(map.values.size() * 3);
  for (const float error : map.values) {
    const glm::u8vec3 colour = errorColour(error);
    picture.rgb.insert(picture.rgb.end(), {colour.r, colour.g, colour.b});
  }
  return picture;
}

}  // namespace vicus::report
