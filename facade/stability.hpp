/// Rules in stiff and extreme cases: figures for the report's table, which the tests check too.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::facade {

/// The rows of the part "rules". Deterministic; takes under a second.
std::vector<city::StabilityRow> rulesStability();

}  // namespace vicus::facade
