/// Figures from samples, and how sure one can be of them.
#pragma once

#include <cstdint>
#include <span>

namespace vicus::report {

/// Of samples in any order. No samples give NaN.
double median(std::span<const double> samples);
double mean(std::span<const double> samples);

/// A figure with the ends of its confidence interval.
struct Estimate {
  double value = 0;
  double low = 0, high = 0;

  bool operator==(const Estimate&) const = default;
};

struct BootstrapOptions {
  int resamples = 2000;      ///< fewer: rougher ends; more: only slower
  double confidence = 0.95;  ///< of the interval, in (0, 1)
  uint32_t seed = 1;         ///< the same seed gives the same interval
};

/// Median with its bootstrap percentile interval. No samples give NaN; one sample gives an interval of no width.
Estimate medianWithInterval(std::span<const double> samples, const BootstrapOptions& options = {});

/// median(numerator) ÷ median(denominator) of two runs that were interleaved: entry i of both is the same view at
/// nearly the same moment, so entries are resampled together and what hits both alike falls out. Spans of different
/// lengths are cut to the shorter.
Estimate ratioOfMedians(std::span<const double> numerator, std::span<const double> denominator,
                        const BootstrapOptions& options = {});

/// Whether two intervals have a value in common.
bool agree(const Estimate& a, const Estimate& b);

}  // namespace vicus::report
