/// Figures over many frames, and what the process takes of memory.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <utility>

namespace vicus::viewer {

/// One stage of a frame. The name belongs to the program or to what is measured, and outlives the sample.
struct StageSample {
  std::string_view name;
  double milliseconds = 0;
};

/// The stages of one frame in the order run, kept in place: adding one never allocates. Invariant: the first `size`
/// samples are set; a frame of more stages than fit adds the rest to the last.
class StageSamples {
 public:
  static constexpr size_t kMost = 40;

  StageSamples() = default;
  StageSamples(std::initializer_list<StageSample> samples) {
    for (const StageSample& s : samples) add(s.name, s.milliseconds);
  }
  void add(std::string_view name, double milliseconds) {
    if (size_ < kMost)
      samples_[size_++] = {name, milliseconds};
    else
      samples_[kMost - 1].milliseconds += milliseconds;
  }
  const StageSample* begin() const { return samples_.data(); }
  const StageSample* end() const { return samples_.data() + size_; }
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const StageSample& operator[](size_t k) const { return samples_[k]; }

 private:
  std::array<StageSample, kMost> samples_;
  size_t size_ = 0;
};

/// Tells how long each of several steps took that follow one another.
class StageClock {
 public:
  /// Milliseconds since it was made or last asked.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double, std::milli>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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
