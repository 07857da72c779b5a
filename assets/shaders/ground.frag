// Ground: a colour map of the whole field times a tiling detail. GROUND_MAP: the scene has such a map; BEYOND: this is
// the country about it.
#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
  shownItem = item;
}
#else
#include "lit.glsl"
#ifdef GROUND_MAP
uniform sampler2D groundMap;  // square root of linear colour; alpha: 0 grass, 0.5 earth, 1 stones
in vec2 mapUv;
#endif
uniform sampler2DArray groundDetail;  // half of the detail's colour over its mean, both square roots
in vec2 detailUv;
#ifdef BEYOND
uniform vec4 countryside;  // as a texel of the ground map
in float beyond;
#endif
layout(location = 0) out vec4 shown;

void main() {
#if defined(GROUND_MAP) && defined(BEYOND)
  vec4 ground = mix(texture(groundMap, mapUv), countryside, beyond);
#elif defined(GROUND_MAP)
  vec4 ground = texture(groundMap, mapUv);
#else
  vec4 ground = countryside;
#endif
  vec3 colour = ground.rgb * (2.0 * texture(groundDetail, vec3(detailUv, floor(2.0 * ground.a + 0.5))).rgb);
  shown = vec4(displayed(lit(colour * colour, 1.0)), 1.0);
}
#endif
