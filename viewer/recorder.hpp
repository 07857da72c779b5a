/// Keeps the way that a visitor goes, as a tour.
#pragma once

#include <optional>
#include <string>

#include "city/city.hpp"
#include "city/view_state.hpp"

namespace vicus::viewer {

/// Seconds between two keys of a recorded tour: at a run's turn the spline between them strays by centimetres.
constexpr double kRecordEvery = 0.25;

/// Invariant: the keys' times increase.
class Recorder {
 public:
  bool recording() const { return tour_.has_value(); }
  void begin(std::string name);
  /// A pose of this moment, `time` in seconds on any clock that goes forward. Does nothing while not recording.
  void note(double time, const city::ViewPose& pose);
  /// Ends; the tour with its times from 0, its last pose included. Nothing where there are fewer than two keys.
  std::optional<city::Tour> end();

 private:
  void add(double time, const city::ViewPose& pose);
  std::optional<city::Tour> tour_;
  double start_ = 0, lastTime_ = 0;
  city::ViewPose lastPose_;
};

}  // namespace vicus::viewer
