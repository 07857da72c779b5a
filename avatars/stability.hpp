/// The stiff and extreme cases of people, as rows of the report's stability table.
#pragma once

#include <vector>

#include "city/stability.hpp"

namespace vicus::avatars {

/// Runs every avatar case; takes well under a second. Deterministic.
std::vector<city::StabilityRow> avatarStability();

}  // namespace vicus::avatars
