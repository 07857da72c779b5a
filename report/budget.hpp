/// How much of what is wanted fits into the time that there is.
#pragma once

#include <algorithm>
#include <chrono>

namespace vicus::report {

/// The seconds of a report that is in a hurry, from when it was made. Parts of the report end by shares of the whole,
/// so that what one part leaves over is the next one's.
class Budget {
 public:
  /// 0 seconds: no hurry.
  explicit Budget(double seconds) : seconds_(seconds) {}

  bool hurried() const { return seconds_ > 0; }
  double seconds() const { return seconds_; }
  /// More or less time than was thought at first; without effect where there is no hurry.
  void setSeconds(double seconds) {
    if (hurried()) seconds_ = seconds;
  }
  double elapsed() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
  /// Seconds until `share` (0 to 1) of all are spent; negative when that is past, large where there is no hurry.
  double left(double share) const { return hurried() ? share * seconds_ - elapsed() : 1e9; }

  /// As many as wanted, or as many as fit until `share` at `each` seconds for one, but never fewer than `least`.
  int affordable(int wanted, int least, double share, double each) const {
    if (!hurried() || each <= 0) return wanted;
    const double fit = std::clamp(left(share) / each, 0.0, 1e6);
    return std::clamp(static_cast<int>(fit), std::min(least, wanted), wanted);
  }

 private:
  double seconds_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace vicus::report
