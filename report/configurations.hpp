/// Which settings a report compares.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "city/knob.hpp"
#include "plan/techniques.hpp"

namespace vicus::report {

/// Settings with the name that a report gives them.
struct Configuration {
  std::string name;
  city::Knobs knobs;
  bool limit = false;  ///< draws only what the item buffer shows
};

/// all_off, only_X, all_on, all_on_less_X, visibility, limit, in this order. Techniques are switched by their knobs;
/// all others keep the values of `knobs`. "All on" is what the scene is drawn with: every technique that `knobs` has
/// on. A technique that is off there has its only_X, so that people see what it would bring, and no part in the others.
/// Techniques whose switch `knobs` does not know are passed over.
std::vector<Configuration> configurations(const city::Knobs& knobs, std::span<const plan::Technique> techniques);

/// All on, and the technique too where it is off, but for one knob, for each of at most `points` values of the
/// technique's sweep: both ends, the default and others spread evenly between. Empty where the technique has nothing to
/// turn.
struct SweepPoint {
  double value = 0;
  bool isDefault = false;
  Configuration configuration;
};
std::vector<SweepPoint> sweepOf(const plan::Technique& technique, const city::Knobs& knobs,
                                std::span<const plan::Technique> techniques, size_t points);

}  // namespace vicus::report
