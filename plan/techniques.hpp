/// The techniques by name, with what a report turns on and off and sweeps.
#pragma once

#include <span>
#include <string_view>

#include "city/frame_plan.hpp"

namespace vicus::plan {

/// One way of trading error for run time. Its row in `techniques` is all that it takes to appear in every report.
struct Technique {
  std::string_view name{};
  std::string_view switchKnob{};    ///< turns it on and off; empty: it cannot be off
  std::string_view sweptKnob{};     ///< goes from fast to faithful; empty: nothing to turn
  std::span<const double> sweep{};  ///< values of that knob, ascending, the default among them
  bool visibility = false;          ///< only leaves out what cannot be seen: belongs to the configuration `visibility`
  /// The largest displacement of anything drawn in a plan, in pixels, as the technique itself bounds it; null: it
  /// displaces nothing.
  double (*geometricErrorPixels)(const city::FramePlan&) = nullptr;
};

/// All techniques, in the order in which people are told of them.
std::span<const Technique> techniques();

}  // namespace vicus::plan
