/// Motion capture in Biovision's BVH files.
///
/// Based on: Meredith and Maddock 2001, "Motion Capture File Formats Explained".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "city/avatars.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets::people {

/// A recorded motion with the skeleton that it was recorded for, in our frame: metres, z up, facing +x.
struct Motion {
  city::Skeleton skeleton;  ///< end sites are joints of their own, "EndSite_" and their parent's name
  city::Clip clip;          ///< does not loop
  double metresPerUnit = 1;
  double frameTime = 0;  ///< seconds
};

struct BvhOptions {
  /// Metres for each unit of the file. Not positive: of metres, feet, inches, centimetres, millimetres and CMU's unit
  /// (0.45 inches to a hundredth) the one in which the skeleton comes nearest to 1.7 m.
  double metresPerUnit = 0;
};

/// Rotations in any order of channels, each applied to what comes after it in the file; positions of any joint take the
/// place of its offset. The file's y (or z, where its skeleton rests along that) is up, and the skeleton faces +z (or
/// −y). Nothing, with an error that names the line, where the hierarchy or the frames' head is broken; frames that are
/// cut short or hold what is no number end the motion, with a warning. A frame time that is not positive counts as
/// 1/30 s, with a warning.
std::optional<Motion> parseBvh(std::string_view text, const std::string& file, const BvhOptions& options,
                               city::Diagnostics& diagnostics);
std::optional<Motion> readBvh(const std::string& file, const BvhOptions& options, city::Diagnostics& diagnostics);

}  // namespace vicus::assets::people
