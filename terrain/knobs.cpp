#include "terrain/roam.hpp"

namespace vicus::terrain {
namespace {

constexpr city::Knob kRoamKnobs[] = {
    {"roam", 1, 0, 1, "on/off", "Draws the ground coarser where the eye cannot tell.",
     "off: every sample of the height field is drawn", "on is the most"},
    {"roam.pixel_error", 2, 0.05, 100, "px", "Largest error of the drawn ground in pixels.",
     "triangles grow about as its power −1.75", "hills change their outline"},
    {"roam.budget", 100'000, 0, 1e8, "triangles", "Most triangles of the ground; the error grows where it is spent.",
     "two triangles for each patch are always drawn", "never reached"},
    {"roam.milliseconds", 0, 0, 1000, "ms",
     "Most time of a frame for the ground's mesh, 0 for no limit; what is left waits for the next frame.",
     "the ground sharpens late after turning round", "frames stutter where the eye jumps"},
};

}  // namespace

std::span<const city::Knob> roamKnobs() {
  return kRoamKnobs;
}

}  // namespace vicus::terrain
