/// Height fields for tests and benchmarks of terrain, made from seeds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "city/height_field.hpp"
#include "city/random.hpp"

namespace vicus::terrain {

enum class Landscape { Hills, Cliffs };

/// Gradient noise: unit gradients at whole places, their angles hashed from place and octave, blended by the quintic.
inline double gradientNoise(double x, double y, int octave) {
  const auto seed = [&](int column, int row) {
    const uint32_t o = city::hash32(static_cast<uint32_t>(octave) * 0xC2B2AE3DU + 1U);
    const uint32_t r = city::hash32(static_cast<uint32_t>(row) * 0x85EBCA77U ^ o);
    return city::hash32(static_cast<uint32_t>(column) * 0x9E3779B1U ^ r);
  };
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const double fx = x - column, fy = y - row;
  const auto slope = [&](int dx, int dy) {
    const double angle = seed(column + dx, row + dy) * (6.283185307179586 / 4294967296.0);
    return std::cos(angle) * (fx - dx) + std::sin(angle) * (fy - dy);
  };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  const double south = slope(0, 0) + (slope(1, 0) - slope(0, 0)) * fade(fx);
  const double north = slope(0, 1) + (slope(1, 1) - slope(0, 1)) * fade(fx);
  return south + (north - south) * fade(fy);
}

/// 4 096 m × 4 096 m at any resolution: eleven octaves of noise from 2 048 m, 320 m high, halving. Cliffs make terraces
/// of it every 40 m, with steep risers, and cut a canyon 30 m deep.
inline city::HeightField makeLandscape(int samples, Landscape kind) {
  constexpr double kSide = 4096;
  city::HeightField field;
  field.size = {samples, samples};
  field.spacing = glm::dvec2(kSide / (samples - 1));
  field.heights.resize(static_cast<size_t>(samples) * static_cast<size_t>(samples));
  for (int row = 0; row < samples; ++row)
    for (int column = 0; column < samples; ++column) {
      const double x = column * field.spacing.x, y = row * field.spacing.y;
      double height = 0, amplitude = 320, wavelength = 2048;
      for (int octave = 0; octave < 11; ++octave) {
        height += amplitude * gradientNoise(x / wavelength + 0.37, y / wavelength + 0.73, octave);
        amplitude *= 0.5;
        wavelength *= 0.5;
      }
      if (kind == Landscape::Cliffs) {
        const double terraces = height / 40, step = std::floor(terraces), within = terraces - step;
        const double riser = std::clamp((within - 0.90) / 0.10, 0.0, 1.0), tread = 0.12 * within;
        height = 40.0 * (step + tread + (1.0 - 0.12) * riser);
        const double canyon = std::abs((y - 2048) - 300 * std::sin(x / 500.0));
        if (canyon < 25) height -= 30.0;
      }
      field.at(column, row) = static_cast<float>(height);
    }
  field.updateRange();
  return field;
}

/// FNV-1a of the heights' bytes.
inline uint64_t hashOf(const city::HeightField& field) {
  uint64_t hash = 1469598103934665603ULL;
  for (const float h : field.heights) {
    std::array<unsigned char, sizeof h> bytes{};
    std::memcpy(bytes.data(), &h, sizeof h);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  }
  return hash;
}

}  // namespace vicus::terrain
