// Buildings and trees: one vertex of one instance, placed by the instance and tile tables.
#include "vertex.glsl"
#include "materials.glsl"
#include "lighting.glsl"

struct Instance {
  vec4 positionAndTile;  // metres from the tile's base; the tile's index in the bits of w
  vec4 turnSeedItem;     // cosine and sine of the heading; seed and item id in the bits of z and w
};
layout(std430, binding = 0) readonly buffer Instances {
  Instance instances[];
};
layout(std430, binding = 1) readonly buffer Tiles {
  vec4 tileFromEye[];  // metres from the eye to each tile's base, subtracted in double
};
uniform mat4 clipFromEyeRelative;

#ifdef ITEM_ID
flat out uint item;
#ifdef CUT_OUT
out vec2 uv;
flat out vec2 place;
#endif
#else
out vec2 uv;
flat out vec2 place;
out vec3 scale;
out vec3 add;
out float heightAboveGround;
#endif

void main() {
  Instance instance = instances[gl_BaseInstanceARB];
  vec2 turn = instance.turnSeedItem.xy;
  vec3 turned = vec3(turn.x * vertexPosition.x - turn.y * vertexPosition.y,
                     turn.y * vertexPosition.x + turn.x * vertexPosition.y, vertexPosition.z);
  vec3 fromEye = tileFromEye[floatBitsToUint(instance.positionAndTile.w)].xyz + (instance.positionAndTile.xyz + turned);
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef ITEM_ID
  item = floatBitsToUint(instance.turnSeedItem.w);
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
  vec3 normal = vec3(turn.x * n.x - turn.y * n.y, turn.y * n.x + turn.x * n.y, n.z);
#ifdef CUT_OUT
  // Leaves are seen from both sides and let light through: light them as the crown's surface, not as their card.
  normal = normalize(normal + vec3(0.0, 0.0, 0.6));
#endif
  Seen s = seen(fromEye, normal, tintOf(material.tint, floatBitsToUint(instance.turnSeedItem.z), vertexMaterial.x),
                material.gloss.x);
  scale = s.scale;
  add = s.add;
  heightAboveGround = vertexPosition.z + 4.0 * abs(n.z);
#endif
}
