/// Small pictures and the shared test data.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>

#include "city/random.hpp"
#include "viewer/renderer.hpp"

namespace vicus::report::testing {

inline std::filesystem::path dataFolder() {
  const char* named = std::getenv("VICUS_DATA");
  return named != nullptr ? named : "../shared/data";
}

using Pixel = std::array<uint8_t, 3>;

inline viewer::Picture picture(int width, int height, const std::function<Pixel(int, int)>& at) {
  viewer::Picture out{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const uint8_t c : at(x, y)) out.rgb.push_back(c);
  return out;
}

inline viewer::Picture flat(int width, int height, Pixel colour) {
  return picture(width, height, [&](int, int) { return colour; });
}

/// Blocks of 4×4 pixels in random colours: edges, texture and colour, like a town from above.
inline viewer::Picture town(int width, int height, int moved = 0) {
  return picture(width, height, [&](int x, int y) -> Pixel {
    const auto block = city::hash32(static_cast<uint32_t>((x + 64 - moved) / 4), static_cast<uint32_t>(y / 4));
    return {static_cast<uint8_t>(40 + block % 160), static_cast<uint8_t>(40 + block / 256 % 160),
            static_cast<uint8_t>(40 + block / 65536 % 160)};
  });
}

}  // namespace vicus::report::testing
