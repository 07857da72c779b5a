/// Based on: Efron and Tibshirani 1993, "An Introduction to the Bootstrap", chapters 8 (paired data) and 13 (percentile
/// intervals).
#include "report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "city/random.hpp"
#include "viewer/measure.hpp"

namespace vicus::report {
namespace {

using viewer::percentile;

/// Interval from figures of many resamples.
Estimate interval(double value, std::vector<double> figures, double confidence) {
  const double tail = (1 - confidence) / 2;
  return {value, percentile(figures, tail), percentile(figures, 1 - tail)};
}

}  // namespace

double median(std::span<const double> samples) {
  std::vector<double> values(samples.begin(), samples.end());
  return percentile(values, 0.5);
}

double mean(std::span<const double> samples) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (const double s : samples) sum += s;
  return sum / static_cast<double>(samples.size());
}

Estimate medianWithInterval(std::span<const double> samples, const BootstrapOptions& options) {
  const auto count = static_cast<uint32_t>(samples.size());
  city::Random random(options.seed);
  std::vector<double> figures, drawn(count);
  for (int i = 0; i < options.resamples; ++i) {
    for (double& d : drawn) d = samples[random.below(count)];
    figures.push_back(percentile(drawn, 0.5));
  }
  return interval(median(samples), std::move(figures), options.confidence);
}

Estimate ratioOfMedians(std::span<const double> numerator, std::span<const double> denominator,
                        const BootstrapOptions& options) {
  const size_t pairs = std::min(numerator.size(), denominator.size());
  const auto top = numerator.first(pairs), bottom = denominator.first(pairs);
  const auto count = static_cast<uint32_t>(pairs);
  city::Random random(options.seed);
  std::vector<double> figures, drawnTop(pairs), drawnBottom(pairs);
  for (int i = 0; i < options.resamples; ++i) {
    for (size_t k = 0; k < pairs; ++k) {
      const uint32_t pair = random.below(count);
      drawnTop[k] = top[pair];
      drawnBottom[k] = bottom[pair];
    }
    figures.push_back(percentile(drawnTop, 0.5) / percentile(drawnBottom, 0.5));
  }
  return interval(median(top) / median(bottom), std::move(figures), options.confidence);
}

bool agree(const Estimate& a, const Estimate& b) {
  return a.low <= b.high && b.low <= a.high;
}

}  // namespace vicus::report
