// Things on walls slide into them with distance: the same function as houselod/slide.hpp.

layout(location = 8) in vec2 slideAxis;     // octahedral, out of the wall
layout(location = 9) in float slideDepth;   // metres before the wall's surface, negative behind it
uniform float slidePerMetre;                // inverse scalar: 0 where nothing slides

// What sticks out stays so far before its wall until it is left out, so that neither hides the other: metres.
const float kBeforeWall = 0.003;

// Metres that the vertex moves, seen from `distance` metres.
vec3 slide(float distance) {
  float size = abs(slideDepth);
  float to = clamp((4.0 * size - min(distance * slidePerMetre, 1e9)) * (1.0 / 3.0), 0.0, size);
  if (slideDepth > 0.0) to = max(to, min(size, kBeforeWall));
  return fromOctahedral(slideAxis) * (to < size ? sign(slideDepth) * (to - size) : 0.0);
}
