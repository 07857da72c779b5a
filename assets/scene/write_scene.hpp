/// A first scene description for data files, to be edited by hand.
#pragma once

#include <span>
#include <string>

#include "assets/load_city.hpp"

namespace vicus::assets {

struct DraftScene {
  std::string text;  ///< TOML with comments; empty where nothing could be read
  city::Diagnostics diagnostics;
};

/// Reads the files as `loadCity` would and describes the scene that they make: each file as source, terrain or
/// monument, with what was found in it as comments, paths relative to `outputFile`, and a view of the whole from the
/// air.
DraftScene draftScene(std::span<const std::string> inputs, const LoadOptions& options, const std::string& outputFile);

}  // namespace vicus::assets
