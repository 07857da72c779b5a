/// What covers the ground of a city whose sources do not say.
#pragma once

#include <optional>

#include "city/city.hpp"

namespace vicus::assets {

/// A guess from where the buildings stand, for a finished city with terrain: in the dense town (a fifth and more of the
/// ground within 60 m built on) the open ground is paved beside walls and street up to 14 m from them; outside it each
/// building has a paved edge and a garden of up to 12 m about it. The rest is grass. Cells of 1 to 4 m. Nothing where
/// there is no terrain or no building with a footprint.
std::optional<city::GroundCover> guessGroundCover(const city::City& city);

}  // namespace vicus::assets
