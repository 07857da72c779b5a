#include "lighting.glsl"
in vec3 ray;
layout(location = 0) out vec4 shown;

void main() {
  vec3 direction = normalize(ray);
  vec3 light = skyToward(direction);
  float disc = smoothstep(0.99985, 0.99995, dot(direction, sunDirection)) * step(0.0, direction.z);
  shown = vec4(displayed(light + disc * 20.0 * sunLight), 1.0);
}
