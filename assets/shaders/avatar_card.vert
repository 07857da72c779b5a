// People far away: a card that faces the eye, with the picture of the body from that side.
#include "lighting.glsl"

layout(location = 0) in vec2 corner;          // -1 or 1 across, 0 or 1 up
layout(location = 5) in vec4 fromEyeAndScale;
layout(location = 6) in vec2 turn;
layout(location = 7) in uvec4 person;         // -, dress, item, row of pictures + 16 x character

uniform mat4 clipFromEyeRelative;
uniform vec3 cardSizes[CHARACTERS];           // half its width, its bottom and top: metres

flat out uvec2 dressAndLayer;
out vec2 texel;                               // in the character's layer
out float across;
#ifdef ITEM_ID
flat out uint item;
#else
flat out vec2 toEye;
flat out vec3 clear;
flat out vec3 add;
#ifdef SHADOWS
uniform mat3 lightFromWorld;
out vec3 sun;
out vec3 inLight;
#endif
#endif

void main() {
  uint character = person.w / 16u;
  vec3 size = cardSizes[character] * fromEyeAndScale.w;
  vec2 eye = -fromEyeAndScale.xy / max(length(fromEyeAndScale.xy), 1e-6);
  vec3 fromEye = fromEyeAndScale.xyz + vec3(corner.x * size.x * vec2(-eye.y, eye.x), mix(size.y, size.z, corner.y));
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
  // Which eighth of a turn the eye stands at, from where the person faces.
  vec2 seen8 = vec2(turn.x * eye.x + turn.y * eye.y, turn.x * eye.y - turn.y * eye.x);
  float eighth = mod(floor(atan(seen8.y, seen8.x) * (4.0 / 3.14159265) + 0.5), 8.0);
  texel = vec2((eighth + 0.5 + 0.5 * corner.x) * 32.0, (float(person.w % 16u) + corner.y) * 64.0);
  across = corner.x;
  dressAndLayer = uvec2(person.y, character);
#ifdef ITEM_ID
  item = person.z;
#else
  toEye = eye;
  Seen s = seen(fromEye, vec3(eye, 0.0), vec3(1.0), 0.0);
  clear = vec3(1.0 - hazeAt(length(fromEye)));
  add = s.add;
#ifdef SHADOWS
  sun = sunLight;
  inLight = lightFromWorld * (fromEye + vec3(0.3 * eye, 0.0));
#endif
#endif
}
