// The height field, lit as level ground: the ground map holds what its slopes change. ROAM: samples in any order; else
// a patch for each tile.

#ifdef ROAM
layout(location = 0) in uvec2 vertexSample;   // column, row
layout(location = 1) in float vertexHeight;   // metres above the city's origin
uniform ivec2 eyeSample;                      // the sample below the eye, to its south-west
uniform vec2 eyeBeyondSample;                 // metres from it to the eye
uniform vec2 eyeHeight;                       // metres above the city's origin, and what a float leaves of them
uniform vec2 sampleSpacing;                   // metres
uniform vec2 mapFromSample;                   // ground maps for each sample
uniform vec2 eyeDetailUv;
#else
layout(location = 0) in vec3 vertexPosition;  // metres from the tile's base
layout(location = 3) in vec4 patchUv;         // of the tile's base: in the ground map, then in the detail's repeats
layout(location = 4) in uint patchTile;
#include "tiles.glsl"
uniform vec2 mapRepeats;                      // ground maps for each metre
#endif
uniform mat4 clipFromEyeRelative;

#ifdef ITEM_ID
flat out uint item;
#else
#include "lit.glsl"
uniform float detailRepeats;
out vec2 mapUv;
out vec2 detailUv;
#endif

void main() {
#ifdef ROAM
  // Whole samples are subtracted first, so that what is near the eye is as exact as in double.
  vec3 fromEye = vec3(vec2(ivec2(vertexSample) - eyeSample) * sampleSpacing - eyeBeyondSample,
                      vertexHeight - eyeHeight.x - eyeHeight.y);
#else
  vec3 fromEye = tileFromEye[patchTile].xyz + vertexPosition;
#endif
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef ITEM_ID
  item = 0xffffffffu;
#else
#ifdef ROAM
  mapUv = vec2(vertexSample) * mapFromSample;
  detailUv = eyeDetailUv + fromEye.xy * detailRepeats;
#else
  mapUv = patchUv.xy + vertexPosition.xy * mapRepeats;
  detailUv = patchUv.zw + vertexPosition.xy * detailRepeats;
#endif
  Seen s = seen(fromEye, vec3(0.0, 0.0, 1.0), vec3(1.0), 0.0);
  show(s, fromEye, 1.0);
#endif
}
