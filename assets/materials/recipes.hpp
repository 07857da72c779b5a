/// The recipes of the built-in textures, grouped as a builder would group them. Each is deterministic and tileable.
#pragma once

#include <glm/glm.hpp>

#include "assets/materials/pattern.hpp"

namespace vicus::assets::recipes {

inline constexpr pattern::Size kFull{512, 512};
inline constexpr pattern::Size kHalf{256, 256};

// Walls. `metres` is the size of the whole picture: facades lay the same walls over another size.

/// Lime plaster over rubble; `base` linear.
pattern::Surface plasterWall(pattern::Size size, glm::vec2 metres, glm::vec3 base, uint32_t seed);
/// English bond; `dark` for the old, burnt bricks.
pattern::Surface brickWall(pattern::Size size, glm::vec2 metres, bool dark, uint32_t seed);
/// Dressed limestone in courses.
pattern::Surface ashlarWall(pattern::Size size, glm::vec2 metres, uint32_t seed);

Image plaster();
Image limewash();
Image brick();
Image brickDark();
Image rubble();
Image ashlar();
Image flint();
Image concrete();

// Roofs; the slope rises with y.
Image tile();
Image slate();
Image thatch();
Image lead();

// Joinery; the grain runs along y.
Image timber();
Image oak();
Image planks();
Image door();
Image shutter();

// Ground.
Image cobbles();
Image earth();
Image grass();
Image field();
Image garden();
Image bank();
Image water();

// The rest.
Image glass();
Image leadGlass();
Image bark();
Image leaves();
Image leavesDark();
Image iron();
Image wool();

// One opening from jamb to jamb and from sill to head.
Image windowCasement();
Image windowFramed();
Image windowShuttered();
Image windowSashFramed();
Image windowSash();
Image windowLeaded();
Image windowArched();
Image windowTracery();
Image portal();
Image doorPanelled();
Image doorArched();
Image shopFront();

// One bay of one storey with a window.
Image facadeLimestone();
Image facadePlaster();
Image facadeBrick();
Image facadePlasterShutters();

/// Colour of the lime plaster on houses, linear.
glm::vec3 plasterColour();
/// Grain of wood along y, rms about 0.5: `rings` streaks across the picture.
pattern::Field woodGrain(pattern::Size size, int rings, uint32_t seed);

}  // namespace vicus::assets::recipes
