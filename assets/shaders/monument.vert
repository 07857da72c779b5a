// Monuments: ordinary geometry under OpenSceneGraph's transforms, multiplied in double with the eye's.
#include "vertex.glsl"
#include "materials.glsl"
#ifndef ITEM_ID
#include "lit.glsl"
#endif

uniform mat4 osg_ModelViewMatrix;
uniform mat4 osg_ProjectionMatrix;
uniform mat3 worldFromEye;

#ifdef ITEM_ID
uniform uint itemId;
flat out uint item;
#ifdef CUT_OUT
out vec2 uv;
flat out vec2 place;
#endif
#else
out vec2 uv;
flat out vec2 place;
out float heightAboveGround;
#endif

void main() {
  vec4 inEyeAxes = osg_ModelViewMatrix * vec4(vertexPosition, 1.0);
  gl_Position = osg_ProjectionMatrix * inEyeAxes;
#ifdef ITEM_ID
  item = itemId;
#ifdef CUT_OUT
  Material material = materials[vertexMaterial.x];
  uv = vertexUv * material.repeatsAndPlace.xy;
  place = material.repeatsAndPlace.zw;
#endif
#else
  Material material = materials[vertexMaterial.x];
  uv = vertexUv * material.repeatsAndPlace.xy;
  place = material.repeatsAndPlace.zw;
  vec3 n = fromOctahedral(vertexNormal);
  vec3 normal = worldFromEye * (mat3(osg_ModelViewMatrix) * n);
  vec3 fromEye = worldFromEye * inEyeAxes.xyz;
  Seen s = seen(fromEye, normal, material.tint.rgb, material.gloss.x);
  show(s, fromEye, 1.0);
  heightAboveGround = vertexPosition.z + 4.0 * abs(n.z);
#endif
}
