/// Stage times as a file that trace viewers open (chrome://tracing, Perfetto).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "viewer/frame_loop.hpp"

namespace vicus::report {

/// One stage of a frame.
struct TracedStage {
  std::string name;
  double milliseconds = 0;
};

/// One frame: its stages follow each other from its start.
struct TracedFrame {
  double start = 0;  ///< milliseconds since the first frame
  std::vector<TracedStage> stages;
};

/// Records of a run as frames that follow each other without a gap.
std::vector<TracedFrame> tracedFrames(std::span<const viewer::FrameRecord> records);

/// The frames in the Trace Event Format's JSON object form: a bar for each frame, below it one for each stage. Times in
/// the file are microseconds. Values that are not finite or are negative become 0.
std::string chromeTrace(std::span<const TracedFrame> frames);

}  // namespace vicus::report
