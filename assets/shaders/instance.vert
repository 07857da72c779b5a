// Buildings and trees: one vertex of one instance, placed by the instance and tile tables.
#include "vertex.glsl"
#include "materials.glsl"
#ifndef ITEM_ID
#include "lit.glsl"
#endif

// One for each instance, by the draw's base instance: an attribute, because software GL fetches those much faster than it
// reads storage blocks (GpuInstance in scenegraph/arena_drawable.hpp).
layout(location = 4) in vec3 instancePosition;  // metres from the tile's base
layout(location = 5) in uint instanceTile;
layout(location = 6) in vec2 turn;              // cosine and sine of the heading
layout(location = 7) in uvec2 seedAndItem;
#include "tiles.glsl"
#ifdef FADES
// The tile's number, which of two levels is drawn, and how far the change has gone (fadingTile in arena_drawable.hpp).
flat out vec2 kept;  // pixels whose threshold lies from x to under y
#define TILE (instanceTile & 0x7fffu)
#else
#define TILE instanceTile
#endif
#ifdef SLIDES
#include "slide.glsl"
#endif
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
out float heightAboveGround;
#ifdef PICTURES
out vec4 gloss;
#endif
#endif

void main() {
  vec3 turned = vec3(turn.x * vertexPosition.x - turn.y * vertexPosition.y,
                     turn.y * vertexPosition.x + turn.x * vertexPosition.y, vertexPosition.z);
  vec3 fromEye = tileFromEye[TILE].xyz + (instancePosition + turned);
#ifdef SLIDES
  vec3 shift = slide(length(fromEye));
  fromEye += vec3(turn.x * shift.x - turn.y * shift.y, turn.y * shift.x + turn.x * shift.y, shift.z);
#endif
  gl_Position = clipFromEyeRelative * vec4(fromEye, 1.0);
#ifdef FADES
  float share = float(instanceTile >> 16) * (1.0 / 65536.0);
  kept = (instanceTile & 0x8000u) != 0u ? vec2(0.0, share) : vec2(share, 1.0);
#endif
#ifdef ITEM_ID
  item = seedAndItem.y;
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
#ifdef SLIDES
  uint shifted = vertexMaterial.y;  // flat walls are shifted by a seed as the walls that they stand for
#else
  uint shifted = vertexMaterial.x;
#endif
#ifdef PICTURES
  // A wall's picture holds colours and gloss; a seed shifts it as the wall's own material.
  bool pictured = material.gloss.y > 0.0;
  vec3 tint = tintOf(pictured ? vec4(1.0, 1.0, 1.0, materials[shifted].tint.w) : material.tint, seedAndItem.x, shifted);
  Seen s = seen(fromEye, normal, tint, material.gloss.x);
  Seen mirror = seen(fromEye, normal, tint, 1.0);
  gloss = pictured ? vec4(mirror.add - s.add, 1.0 - mirror.scale.g / max(s.scale.g, 1e-6)) : vec4(0.0);
#else
  Seen s = seen(fromEye, normal, tintOf(material.tint, seedAndItem.x, shifted), material.gloss.x);
#endif
  show(s, fromEye, 1.0);
  heightAboveGround = vertexPosition.z + 4.0 * abs(n.z);
#endif
}
