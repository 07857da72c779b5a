/// Pictures of a person from all sides: what stands for him far away.
///
/// Based on: Maciel and Shirley 1995, "Visual Navigation of Large Environments Using Textured Clusters"; Tecchia and
/// Chrysanthou 2000, "Real-Time Rendering of Densely Populated Urban Environments" (people as cards by direction and
/// phase).
#pragma once

#include <cstdint>
#include <vector>

#include "city/avatars.hpp"

namespace vicus::avatars {

constexpr int kImpostorDirections = 8, kImpostorPhases = 4;
constexpr int kImpostorWidth = 32, kImpostorHeight = 64;  ///< texels of one picture

/// Columns of pictures are directions (the eye stands k eighths of a turn counter-clockwise from where the person
/// faces), rows are role × kImpostorPhases + phase, rows of texels from the feet up.
struct Impostor {
  int width = kImpostorWidth * kImpostorDirections;
  int height = kImpostorHeight * kImpostorPhases * static_cast<int>(city::kRoles);
  /// Texels: red, green, blue the square root of linear colour; alpha 0 nothing, else (1 + part) · 28.
  std::vector<uint8_t> rgba;
  float halfWidth = 0.5F;     ///< metres that a picture shows to either side of the middle
  float bottom = 0, top = 2;  ///< metres over the ground that its rows span
};

Impostor makeImpostor(const city::Character& character);

}  // namespace vicus::avatars
