// The ground beyond the terrain, or under a city that has none: rings out to the horizon.

layout(location = 0) in vec3 vertexPosition;  // metres from the mesh's centre
layout(location = 1) in vec2 vertexUv;        // in the ground map
layout(location = 2) in float vertexBeyond;   // 0 at the terrain's edge, 1 in open country

uniform vec3 groundFromEye;   // metres from the eye to the mesh's centre, subtracted in double
uniform mat4 clipFromEyeRelative;

#ifdef ITEM_ID
flat out uint item;
#else
#include "lit.glsl"
uniform float detailRepeats;
uniform vec2 groundDetailUv;  // at the mesh's centre
out vec2 mapUv;
out vec2 detailUv;
out float beyond;
#endif

void main() {
  vec3 fromEye = groundFromEye + vertexPosition;
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef ITEM_ID
  item = 0xffffffffu;
#else
  mapUv = vertexUv;
  detailUv = groundDetailUv + vertexPosition.xy * detailRepeats;
  beyond = vertexBeyond;
  Seen s = seen(fromEye, vec3(0.0, 0.0, 1.0), vec3(1.0), 0.0);
  show(s, fromEye, 1.0);
#endif
}
