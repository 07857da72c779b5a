#include "plan/techniques.hpp"

#include "houselod/slide.hpp"

namespace vicus::plan {
namespace {

constexpr double kColumns[] = {64, 128, 256, 512, 1024, 8192};
constexpr double kPixelErrors[] = {0.5, 1, 2, 4, 8, 16};
constexpr double kHouseScalars[] = {16, 64, 128, 256, 512, 1024};
constexpr double kPoseRates[] = {4, 8, 15, 30, 60, 120};
constexpr double kMultisamples[] = {1, 2, 4, 8};

constexpr Technique kTechniques[] = {
    {.name = "frustum_culling", .switchKnob = "frustum_culling", .visibility = true},
    {.name = "cull_map", .switchKnob = "cull_map", .sweptKnob = "cull_map.size", .sweep = kColumns, .visibility = true},
    {.name = "roam",
     .switchKnob = "roam",
     .sweptKnob = "roam.pixel_error",
     .sweep = kPixelErrors,
     .geometricErrorPixels = [](const city::FramePlan& plan) { return plan.roam ? plan.roam->pixelError : 0.0; }},
    {.name = "house_lod",
     .switchKnob = "house_lod",
     .sweptKnob = "house_lod.scalar",
     .sweep = kHouseScalars,
     .geometricErrorPixels =
         [](const city::FramePlan& plan) {
           return houselod::largestErrorPixels(plan.houseLod.inverseScalar, city::pixelsPerUnitSlope(plan.view));
         }},
    {.name = "avatar_lod",
     .switchKnob = "avatar_lod",
     .sweptKnob = "avatar_lod.rate",
     .sweep = kPoseRates,
     .geometricErrorPixels = [](const city::FramePlan& plan) { return plan.avatars.pixelError; }},
    {.name = "state_ordering", .switchKnob = "state_ordering"},
    {.name = "multisampling", .sweptKnob = "viewer.multisamples", .sweep = kMultisamples},
};

}  // namespace

std::span<const Technique> techniques() {
  return kTechniques;
}

}  // namespace vicus::plan
