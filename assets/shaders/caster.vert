// What throws shadows, as the sun sees it: positions alone, and pictures with holes where there are any.
#include "vertex.glsl"

layout(location = 4) in vec3 instancePosition;  // metres from the tile's base
layout(location = 5) in uint instanceTile;
layout(location = 6) in vec2 turn;              // cosine and sine of the heading
#include "tiles.glsl"
uniform mat4 clipFromCentre;

#ifdef CUT_OUT
#include "materials.glsl"
out vec2 uv;
flat out vec2 place;
#endif
flat out uint item;

void main() {
  vec3 turned = vec3(turn.x * vertexPosition.x - turn.y * vertexPosition.y,
                     turn.y * vertexPosition.x + turn.x * vertexPosition.y, vertexPosition.z);
  // The tiles are moved to the cascade's centre here, not to the eye.
  gl_Position = clipFromCentre * vec4(tileFromEye[instanceTile].xyz + (instancePosition + turned), 1.0);
  item = 0u;
#ifdef CUT_OUT
  Material material = materials[vertexMaterial.x];
  uv = vertexUv * material.repeatsAndPlace.xy;
  place = material.repeatsAndPlace.zw;
#endif
}
