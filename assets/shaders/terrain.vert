// The height field: a patch for each tile.

layout(location = 0) in vec3 vertexPosition;  // metres from the tile's base
layout(location = 2) in vec2 vertexNormal;    // octahedral

layout(location = 3) in vec4 patchUv;         // of the tile's base: in the ground map, then in the detail's repeats
layout(location = 4) in uint patchTile;
#include "tiles.glsl"
uniform mat4 clipFromEyeRelative;

#ifdef ITEM_ID
flat out uint item;
#else
#include "lighting.glsl"
uniform vec2 mapRepeats;     // ground maps for each metre
uniform float detailRepeats;
out vec2 mapUv;
out vec2 detailUv;
out vec3 scale;
out vec3 add;
#endif

vec3 fromOctahedral(vec2 e) {
  return normalize(vec3(e, 1.0 - abs(e.x) - abs(e.y)));  // the ground never faces down
}

void main() {
  vec3 fromEye = tileFromEye[patchTile].xyz + vertexPosition;
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef ITEM_ID
  item = 0xffffffffu;
#else
  mapUv = patchUv.xy + vertexPosition.xy * mapRepeats;
  detailUv = patchUv.zw + vertexPosition.xy * detailRepeats;
  Seen s = seen(fromEye, fromOctahedral(vertexNormal), vec3(1.0), 0.0);
  scale = s.scale;
  add = s.add;
#endif
}
