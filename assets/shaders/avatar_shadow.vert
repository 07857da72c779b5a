// The shadow of a person: a soft oval on the ground, away from the sun.
#include "lighting.glsl"

layout(location = 0) in vec2 corner;          // -1 or 1 across, 0 or 1 away from the sun
layout(location = 5) in vec4 fromEyeAndScale;
layout(location = 8) in vec2 slope;           // of the ground: metres up for each metre east and north

uniform mat4 clipFromEyeRelative;
out vec2 inOval;

void main() {
  vec2 away = -sunDirection.xy / max(length(sunDirection.xy), 1e-6);
  float reach = min(1.6 * length(sunDirection.xy) / max(sunDirection.z, 0.1), 3.0) * fromEyeAndScale.w;
  const float wide = 0.32;
  vec2 onGround = corner.x * wide * vec2(-away.y, away.x) + (mix(-wide, reach + wide, corner.y)) * away;
  // A little over the ground, so that it does not flicker.
  vec3 fromEye = fromEyeAndScale.xyz + vec3(onGround, dot(slope, onGround) + 0.025);
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
  inOval = vec2(corner.x, 2.0 * corner.y - 1.0);
}
