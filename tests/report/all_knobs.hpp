/// The program's knobs at their defaults, for the report's tests.
#pragma once

#include "city/knob.hpp"
#include "plan/planner.hpp"
#include "scenegraph/scene.hpp"
#include "viewer/frame_loop.hpp"

namespace vicus::report {

inline city::Knobs allKnobs() {
  city::Knobs knobs;
  knobs.declare(plan::planKnobs());
  knobs.declare(scenegraph::sceneKnobs());
  knobs.declare(viewer::viewerKnobs());
  return knobs;
}

}  // namespace vicus::report
