#include "viewer/recorder.hpp"

#include <utility>

namespace vicus::viewer {

void Recorder::begin(std::string name) {
  tour_.emplace();
  tour_->name = std::move(name);
}

void Recorder::add(double time, const city::ViewPose& pose) {
  tour_->keys.push_back({time - start_, pose.eye, pose.heading, pose.pitch});
}

void Recorder::note(double time, const city::ViewPose& pose) {
  if (!tour_) return;
  if (tour_->keys.empty()) start_ = time;
  lastTime_ = time, lastPose_ = pose;
  if (tour_->keys.empty() || time - start_ >= tour_->keys.back().time + kRecordEvery) add(time, pose);
}

std::optional<city::Tour> Recorder::end() {
  if (!tour_) return std::nullopt;
  if (!tour_->keys.empty() && lastTime_ - start_ > tour_->keys.back().time) add(lastTime_, lastPose_);
  std::optional<city::Tour> tour = std::exchange(tour_, std::nullopt);
  if (tour->keys.size() < 2) return std::nullopt;
  return tour;
}

}  // namespace vicus::viewer
