/// Figures over many frames, and what the process takes of memory.
#pragma once

#include <cstdint>
#include <span>

namespace vicus::viewer {

/// The value below which `fraction` (0 … 1) of the values lie, by linear interpolation between the closest ranks (the
/// value at rank fraction · (n − 1)). Orders `values` as far as needed. No values give NaN.
double percentile(std::span<double> values, double fraction);

/// Milliseconds, or whatever the values were. All 0 where there were none.
struct Percentiles {
  double median = 0, p95 = 0, p99 = 0, max = 0;
};

/// One value gives itself four times. Values that are not finite are left out.
Percentiles percentiles(std::span<const double> values);

/// Mean and largest of counts; 0 where there are none.
struct MeanMax {
  double mean = 0, max = 0;
};
MeanMax meanMax(std::span<const double> values);

/// The most memory that the process has had resident so far, bytes; 0 where the system does not tell.
uint64_t peakResidentBytes();

/// Seconds since the system started this process, to 0.01 s; 0 where the system does not tell.
double secondsSinceProcessStart();

}  // namespace vicus::viewer
