// What the vertices of a lit surface hand to its fragments, and what these make of it. VERTEX: this is the vertex
// shader's side.
#include "lighting.glsl"
#ifdef VERTEX
out vec3 scale;
out vec3 add;
#ifdef SHADOWS
uniform mat3 lightFromWorld;
out vec3 sun;
out vec3 inLight;
#endif

// `open`: part of the sky that is open to the surface.
void show(Seen s, vec3 fromEye, float open) {
  scale = s.scale * open;
  add = s.add;
#ifdef SHADOWS
  sun = s.sun;
  inLight = lightFromWorld * fromEye;
#endif
}
#else
in vec3 scale;
in vec3 add;
#include "shadow.glsl"

// The light from a surface of this albedo; `open` as above.
vec3 lit(vec3 albedo, float open) {
#ifdef SHADOWS
  return albedo * (scale * open + sun * sunlit()) + add;
#else
  return albedo * (scale * open) + add;
#endif
}
#endif
