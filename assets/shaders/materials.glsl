// The material table: one row for each of the city's materials.

struct Material {
  vec4 repeatsAndPlace;  // repeats for each metre along u and v, layer, size class
  vec4 tint;             // rgb, and how far a seed may shift it
  vec4 gloss;            // specular
};
#ifdef MATERIALS
layout(std140, binding = 2) uniform Materials {
  Material materials[MATERIALS];
};
#else
layout(std430, binding = 2) readonly buffer Materials {
  Material materials[];
};
#endif

// Numbers in [0, 1) from a seed: the hash of city/random.hpp.
vec2 randomPair(uint seed) {
  seed ^= seed >> 16;
  seed *= 0x7feb352du;
  seed ^= seed >> 15;
  seed *= 0x846ca68bu;
  seed ^= seed >> 16;
  return vec2(seed & 0xffffu, seed >> 16) * (1.0 / 65536.0);
}

// The material's tint for an instance: its seed shifts brightness and warmth.
vec3 tintOf(vec4 tint, uint seed, uint material) {
  vec2 r = (randomPair(seed + material * 0x9e3779b9u) - 0.5) * tint.w;
  return tint.rgb * (1.0 + r.x) * vec3(1.0 + 0.5 * r.y, 1.0, 1.0 - 0.5 * r.y);
}
