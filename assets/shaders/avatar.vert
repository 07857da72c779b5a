// People: one vertex of one body, posed by the matrices of its joints.
#ifndef ITEM_ID
#include "lit.glsl"
#endif

layout(location = 0) in vec3 vertexPosition;  // metres in the character's frame at rest
layout(location = 1) in vec2 vertexNormal;    // octahedral
layout(location = 2) in uvec4 vertexJoints;
layout(location = 3) in vec4 vertexWeights;
layout(location = 4) in uvec4 vertexColour;   // bytes: square root of linear colour, part of the dress
// One for each person, by the draw's base instance (GpuAvatar in scenegraph/avatar_drawable.hpp).
layout(location = 5) in vec4 fromEyeAndScale;
layout(location = 6) in vec2 turn;            // cosine and sine of the heading
layout(location = 7) in uvec4 person;         // first matrix, dress, item, picture of the impostor

// Skin matrices of all who are drawn, three rows each.
layout(std430, binding = 3) readonly buffer Poses {
  vec4 poseRows[];
};
#include "dresses.glsl"
uniform mat4 clipFromEyeRelative;

#ifdef ITEM_ID
flat out uint item;
#endif

vec3 fromOctahedral(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  float fold = max(-n.z, 0.0);
  n.xy -= vec2(e.x < 0.0 ? -fold : fold, e.y < 0.0 ? -fold : fold);
  return normalize(n);
}

void main() {
  // The rows of the weighted mean of up to four joints' matrices.
  uint first = 3u * (person.x + vertexJoints.x);
  vec4 x = poseRows[first] * vertexWeights.x, y = poseRows[first + 1u] * vertexWeights.x,
       z = poseRows[first + 2u] * vertexWeights.x;
  for (int k = 1; k < 4 && vertexWeights[k] > 0.0; ++k) {
    uint row = 3u * (person.x + vertexJoints[k]);
    x += poseRows[row] * vertexWeights[k];
    y += poseRows[row + 1u] * vertexWeights[k];
    z += poseRows[row + 2u] * vertexWeights[k];
  }
  vec4 p = vec4(vertexPosition, 1.0);
  vec3 posed = fromEyeAndScale.w * vec3(dot(x, p), dot(y, p), dot(z, p));
  vec3 fromEye = fromEyeAndScale.xyz + vec3(turn.x * posed.x - turn.y * posed.y, turn.y * posed.x + turn.x * posed.y, posed.z);
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef ITEM_ID
  item = person.z;
#else
  vec3 n = fromOctahedral(vertexNormal);
  n = normalize(vec3(dot(x.xyz, n), dot(y.xyz, n), dot(z.xyz, n)));
  vec3 normal = vec3(turn.x * n.x - turn.y * n.y, turn.y * n.x + turn.x * n.y, n.z);
  vec3 own = vec3(vertexColour.rgb) / 255.0;
  Seen s = seen(fromEye, normal, own * own * dresses[8u * person.y + vertexColour.a].rgb, 0.0);
  // Darker towards the feet, where the ground hides the sky.
  show(s, fromEye, 1.0 - 0.3 * clamp(1.0 - posed.z, 0.0, 1.0));
#endif
}
