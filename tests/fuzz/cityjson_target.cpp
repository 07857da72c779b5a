// libFuzzer's entry point for CityJSON: reading must end, whatever the bytes.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "assets/import/read_cityjson.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  vicus::city::Diagnostics diagnostics;
  vicus::assets::readCityJson({reinterpret_cast<const char*>(data), size}, "fuzz.city.json", {}, diagnostics);
  return 0;
}
