/// Every stiff and extreme case of the program in one list.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::report {

/// The rows of all parts. Deterministic; takes a few seconds.
std::vector<city::StabilityRow> allStability();

}  // namespace vicus::report
