// Everything that is textured from the material arrays: buildings, trees, monuments.
// TEXTURE_CLASSES: number of size classes that the scene has; each is one array on units 0, 1, …

#if !defined(ITEM_ID) || defined(CUT_OUT)
uniform sampler2DArray materialClass0;
#if TEXTURE_CLASSES > 1
uniform sampler2DArray materialClass1;
#endif
#if TEXTURE_CLASSES > 2
uniform sampler2DArray materialClass2;
#endif
#if TEXTURE_CLASSES > 3
uniform sampler2DArray materialClass3;
#endif
in vec2 uv;
flat in vec2 place;  // layer, class

// The material's colour as stored: the square root of linear light, and alpha.
vec4 texel() {
#if TEXTURE_CLASSES == 1
  return texture(materialClass0, vec3(uv, place.x));
#else
  vec2 du = dFdx(uv), dv = dFdy(uv);
  vec4 t = vec4(0.0);
  if (place.y == 0.0) t = textureGrad(materialClass0, vec3(uv, place.x), du, dv);
  if (place.y == 1.0) t = textureGrad(materialClass1, vec3(uv, place.x), du, dv);
#if TEXTURE_CLASSES > 2
  if (place.y == 2.0) t = textureGrad(materialClass2, vec3(uv, place.x), du, dv);
#endif
#if TEXTURE_CLASSES > 3
  if (place.y == 3.0) t = textureGrad(materialClass3, vec3(uv, place.x), du, dv);
#endif
  return t;
#endif
}
#endif

#ifdef FADES
flat in vec2 kept;

// Leaves the pixel to the other of two levels: each threshold, the same for a pixel in every frame, is kept by one of
// them. Interleaved gradient noise (Jimenez 2014) spreads thresholds evenly over any few neighbours.
void fade() {
  float threshold = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  if (threshold < kept.x || threshold >= kept.y) discard;
}
#endif

#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
#ifdef FADES
  fade();
#endif
#ifdef CUT_OUT
  if (texel().a < 0.5) discard;
#endif
  shownItem = item;
}
#else
#include "lit.glsl"
in float heightAboveGround;
#ifdef PICTURES
in vec4 gloss;  // what full gloss adds, and the share of the light that it takes; the picture's alpha is its gloss
#endif
layout(location = 0) out vec4 shown;

void main() {
  vec4 t = texel();
#ifdef FADES
  fade();
#endif
  float cover = 1.0;
#ifdef CUT_OUT
  // The edge lies where alpha is one half; over a pixel's width it becomes coverage of the pixel's samples.
  cover = clamp((t.a - 0.5) / max(fwidth(t.a), 1e-4) + 0.5, 0.0, 1.0);
  if (cover < (gl_NumSamples > 1 ? 0.0625 : 0.5)) discard;
#endif
  // Walls are darker near the ground, where the ground and what stands on it hide the sky.
  float open = 1.0 - 0.35 * clamp(1.0 - 0.4 * heightAboveGround, 0.0, 1.0);
#ifdef PICTURES
  shown = vec4(displayed(lit(t.rgb * t.rgb * (1.0 - gloss.a * t.a), open) + gloss.rgb * t.a), cover);
#else
  shown = vec4(displayed(lit(t.rgb * t.rgb, open)), cover);
#endif
}
#endif
