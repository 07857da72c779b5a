uniform sampler2DArray avatarCards;  // colour as its square root; alpha 0 nothing, else (1 + part) x 28
flat in uvec2 dressAndLayer;
in vec2 texel;
in float across;

#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
  if (texelFetch(avatarCards, ivec3(ivec2(texel), int(dressAndLayer.y)), 0).a == 0.0) discard;
  shownItem = item;
}
#else
#include "lighting.glsl"
#include "dresses.glsl"
#include "shadow.glsl"
flat in vec2 toEye;
flat in vec3 clear;
flat in vec3 add;
layout(location = 0) out vec4 shown;

void main() {
  vec4 t = texelFetch(avatarCards, ivec3(ivec2(texel), int(dressAndLayer.y)), 0);
  if (t.a == 0.0) discard;
  uint part = uint(t.a * (255.0 / 28.0) + 0.5) - 1u;
  // Lit like a pillar.
  vec3 normal = vec3(across * vec2(-toEye.y, toEye.x) + sqrt(max(1.0 - across * across, 0.0)) * toEye, 0.0);
  vec3 albedo = t.rgb * t.rgb * dresses[8u * dressAndLayer.x + part].rgb;
#ifdef SHADOWS
  vec3 light = skyOn(normal) + sun * (max(dot(normal, sunDirection), 0.0) * sunlit());
#else
  vec3 light = lightOn(normal);
#endif
  shown = vec4(displayed(albedo * light * clear + add), 1.0);
}
#endif
