/// A knob's setting as a scene description gives it.
#pragma once

#include <string>

namespace vicus::assets {

/// To be checked by who knows the knobs.
struct SceneSetting {
  std::string text;   ///< "name=value"
  std::string place;  ///< "line 3, column 1"
};

}  // namespace vicus::assets
