// libFuzzer's entry point for scene descriptions.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "assets/scene/scene_description.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  vicus::city::Diagnostics diagnostics;
  vicus::assets::parseScene({reinterpret_cast<const char*>(data), size}, "fuzz.toml", diagnostics);
  return 0;
}
