/// Clips at other rates and with fewer keys.
#pragma once

#include <vector>

#include "city/avatars.hpp"

namespace vicus::avatars {

/// The clip as poses at equal steps: `count` of them from 0 to its duration, both ends included where it does not loop;
/// where it loops the step after the last is the first again. At least one.
std::vector<city::Pose> posesOf(const city::Skeleton& skeleton, const city::Clip& clip, size_t count);

/// A clip of linear keys from poses at equal steps over `duration` seconds (as `posesOf` gives them; a looping clip
/// gets its first pose once more at its end). Parts of joints that never leave their rest get no keys.
city::Clip clipOf(const city::Skeleton& skeleton, const std::vector<city::Pose>& poses, double duration, bool loops);

/// The clip with keys `framesPerSecond` apart, at most 100 000 of them. Frames whose rate is not positive give the clip
/// as it is.
city::Clip resample(const city::Skeleton& skeleton, const city::Clip& clip, double framesPerSecond);

/// Largest distance in metres between where two clips put any joint, at `samples` times from 0 to the longer duration.
double largestDistance(const city::Skeleton& skeleton, const city::Clip& a, const city::Clip& b, size_t samples);

struct Compressed {
  city::Clip clip;
  double error = 0;  ///< metres: the largest distance of a joint from where it was, at the clip's own keys and between
  size_t keysBefore = 0, keysAfter = 0;
};

/// Leaves out keys that linear interpolation gives back: no joint is then farther than `tolerance` metres (≥ 0) from
/// where it was. Stepped tracks stay as they are. The error is measured, not estimated.
Compressed compress(const city::Skeleton& skeleton, const city::Clip& clip, double tolerance);

/// Number of keys of all tracks.
size_t keyCount(const city::Clip& clip);

}  // namespace vicus::avatars
