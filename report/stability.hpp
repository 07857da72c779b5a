/// Every stiff and extreme case of the program in one list.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::report {

/// The rows of all parts. `quick` leaves out cases that take longer than a second or two. Deterministic.
std::vector<city::StabilityRow> allStability(bool quick);

}  // namespace vicus::report
