/// Cycles that can be walked for ever, cut out of recorded motions; and how well feet hold the ground.
///
/// Based on: Kovar, Gleicher and Pighin 2002, "Motion Graphs" (transitions where poses are alike, drift over the ground
/// taken out).
#pragma once

#include <array>
#include <optional>

#include "city/avatars.hpp"

namespace vicus::avatars {

struct CycleOptions {
  double shortest = 0.7, longest = 1.7;  ///< seconds
  /// Of the fastest second of the motion: slower parts (starting, stopping) are no cycle.
  double leastSpeed = 0.6;
};

/// The part of a clip whose end is most like its beginning, as a clip that loops on the spot: the way over the ground
/// is taken out and turned to +x (`stride` tells it), what is left of the difference is spread over the last third.
/// Nothing where the hips never move ahead, or the clip is shorter than two of the shortest cycles.
std::optional<city::Clip> cutCycle(const city::Skeleton& skeleton, const city::Clip& clip,
                                   const CycleOptions& options = {});

/// Moves the hips up or down, the same throughout, so that the lowest that the feet's joints come in the clip is as
/// high as at rest. A skeleton without legs leaves the clip as it is.
void settleFeet(const city::Skeleton& skeleton, city::Clip& clip);

/// Metres that the body of somebody who walks on the spot would go ahead in one run of the clip: how far the foot that
/// bears moves back. 0 where the skeleton has no legs that it knows.
double strideOf(const city::Skeleton& skeleton, const city::Clip& clip);

/// How feet hold the ground in a cycle of `stride` metres.
struct FootContact {
  double slip = 0;     ///< metres that a foot slides over the ground during a step, mean of both feet
  double lowest = 0;   ///< metres that the lowest joint of the feet comes below its height at rest, or (negative) above
  double highest = 0;  ///< largest height over that at rest of the foot that is lower: floating
};
/// `stride` takes the place of the clip's own where given: who is walked faster than his legs go, slides.
FootContact footContact(const city::Skeleton& skeleton, const city::Clip& clip, std::optional<double> stride = {});

}  // namespace vicus::avatars
