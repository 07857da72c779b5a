#include "lighting.glsl"
uniform sampler2D clouds;  // how much cloud, 0 to 1
uniform float time;        // seconds, from 0 again after an hour
in vec3 ray;
layout(location = 0) out vec4 shown;

void main() {
  vec3 direction = normalize(ray);
  vec3 light = skyToward(direction);
  // A layer of clouds on a plane overhead; lower down it thins out into the haze.
  // They drift by whole pictures in an hour, so that nothing jumps then.
  vec2 drift = time * vec2(3.0, 2.0) / 3600.0;
  float cloud = texture(clouds, direction.xy * (0.21 / (max(direction.z, 0.0) + 0.14)) + 0.31 + drift).r;
  cloud *= smoothstep(0.02, 0.30, direction.z);
  light = mix(light, 0.42 * sunLight + 0.75 * skyLight, 0.85 * cloud);
  float disc = smoothstep(0.99985, 0.99995, dot(direction, sunDirection)) * step(0.0, direction.z);
  shown = vec4(displayed(light + disc * 20.0 * sunLight), 1.0);
}
