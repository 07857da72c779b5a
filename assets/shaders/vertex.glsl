// The vertex that all drawn surfaces of a city share (city/vertex.hpp).

layout(location = 0) in vec3 vertexPosition;
layout(location = 1) in vec2 vertexUv;
layout(location = 2) in vec2 vertexNormal;     // octahedral
layout(location = 3) in uvec2 vertexMaterial;  // material, external item

vec3 fromOctahedral(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  float fold = max(-n.z, 0.0);
  n.xy -= vec2(e.x < 0.0 ? -fold : fold, e.y < 0.0 ? -fold : fold);
  return normalize(n);
}
