/// What a scene description says beyond its files.
#pragma once

#include <glm/glm.hpp>

#include "assets/scene/scene_description.hpp"
#include "city/city.hpp"
#include "city/diagnostics.hpp"
#include "light/sun_position.hpp"

namespace vicus::assets {

/// Puts the description's views (as tours of one key), tours, light and people into a finished city. `shift` is what
/// was added to all coordinates. Says what of the description has no part in this city.
void applyScene(city::City& city, const SceneDescription& scene, glm::dvec3 shift, city::Diagnostics& diagnostics);

/// Where the city lies by its CRS; light::kNorwich where that says nothing.
light::Place placeOf(const city::City& city, glm::dvec3 shift);

}  // namespace vicus::assets
