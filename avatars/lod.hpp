/// How finely a person is drawn and how often posed anew, by distance: the technique `avatar_lod`.
///
/// Based on: Willmott et al. 2001, §5.2 ("a variable number of animations per second for each avatar", and a level of
/// detail by distance as what they meant to do next).
#pragma once

#include <array>
#include <span>

#include "city/avatars.hpp"
#include "city/knob.hpp"

namespace vicus::avatars {

/// Knobs: avatars.shown, avatars.number, avatar_lod, avatar_lod.rate, avatar_lod.pixel_error.
std::span<const city::Knob> avatarKnobs();

struct LodSettings {
  bool on = true;         ///< off: everybody is posed for every frame and drawn with the full mesh
  double rate = 60;       ///< poses a second within 10 m; beyond, so many that the error in pixels stays the same
  double pixelError = 1;  ///< largest distance of a coarser mesh from the full one, in pixels
};

/// Poses a second at that distance in metres: the rate, halved for each doubling of the distance beyond 10 m, at least
/// 1. Steps of whole halves, so that somebody who comes nearer keeps the times at which he is posed.
double poseRate(const LodSettings& settings, double distance);

/// The last time at or before `time` at which somebody who is posed `rate` times a second is posed; `offset` (0 to 1)
/// spreads people over the frames. Off, or not a positive rate: the time itself.
double poseTime(const LodSettings& settings, double rate, double offset, double time);

/// What the levels of a character are off by, worked out once.
struct LevelErrors {
  std::array<double, city::kAvatarMeshLevels + 1> metres{};  ///< of each mesh from the full one, then of the impostor
  double fastest = 0;  ///< metres a second that a joint moves in the character's frame in any of its clips
};
LevelErrors levelErrorsOf(const city::Character& character);

/// The coarsest level that is off by at most the wanted pixels; kAvatarMeshLevels is the impostor.
uint8_t levelFor(const LodSettings& settings, const LevelErrors& errors, double pixelsPerMetre);

/// Largest distance of a vertex of the full mesh from the triangles of another, metres.
double meshDistance(const city::AvatarMesh& full, const city::AvatarMesh& coarse);

}  // namespace vicus::avatars
