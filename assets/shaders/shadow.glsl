// SHADOWS: the number of shadow maps; not there where the scene has none. For fragment shaders.
#ifdef SHADOWS
uniform sampler2DArrayShadow shadowMaps;  // 1 is nearest to the sun
uniform vec4 shadowFit[SHADOWS];          // from light's axes to the map: scale, then offsets of x, y and depth
uniform float shadowReach2[SHADOWS];      // square of the distance from the eye to which a map counts, ascending
uniform float shadowDepth;                // 1 / metres
in vec3 sun;                              // what the sun adds where it shines, for albedo 1
in vec3 inLight;                          // metres from the eye, in light's axes

// Part of the sun's light that comes through.
float sunlit() {
  // Where one map ends the next begins bit by bit, by a pattern that stands still (Jimenez 2014, "Next Generation Post
  // Processing in Call of Duty": interleaved gradient noise).
  float pattern = fract(52.9829189 * fract(dot(floor(gl_FragCoord.xy), vec2(0.06711056, 0.00583715))));
  float far2 = dot(inLight, inLight) * (1.0 + 0.3 * pattern);
  vec4 fit = shadowFit[0];
  float map = 0.0;
#if SHADOWS > 1
  if (far2 > shadowReach2[0]) fit = shadowFit[1], map = 1.0;
#endif
#if SHADOWS > 2
  if (far2 > shadowReach2[1]) fit = shadowFit[2], map = 2.0;
#endif
#if SHADOWS > 3
  if (far2 > shadowReach2[2]) fit = shadowFit[3], map = 3.0;
#endif
  vec2 at = inLight.xy * fit.x + fit.yz;
  float depth = clamp(inLight.z * shadowDepth + fit.w, 0.0, 1.0);
  float open = texture(shadowMaps, vec4(at, map, depth));
  return far2 > shadowReach2[SHADOWS - 1] ? 1.0 : open;
}
#endif
