#include "plan/techniques.hpp"

namespace vicus::plan {
namespace {

constexpr double kColumns[] = {256, 1024, 2048, 8192, 32768};
constexpr double kMultisamples[] = {1, 2, 4, 8};

constexpr Technique kTechniques[] = {
    {.name = "frustum_culling", .switchKnob = "frustum_culling", .visibility = true},
    {.name = "cull_map", .switchKnob = "cull_map", .sweptKnob = "cull_map.size", .sweep = kColumns, .visibility = true},
    {.name = "state_ordering", .switchKnob = "state_ordering"},
    {.name = "multisampling", .sweptKnob = "viewer.multisamples", .sweep = kMultisamples},
};

}  // namespace

std::span<const Technique> techniques() {
  return kTechniques;
}

}  // namespace vicus::plan
