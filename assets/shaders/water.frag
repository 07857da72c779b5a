#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
  shownItem = item;
}
#else
#include "lighting.glsl"
uniform sampler2D ripples;  // slope of the surface, 0.5 is level
in vec3 fromEye;
in vec4 ripplesUv;
layout(location = 0) out vec4 shown;

void main() {
  float distance = length(fromEye);
  vec3 direction = fromEye / distance;
  vec2 slope = texture(ripples, ripplesUv.xy).xy + texture(ripples, ripplesUv.zw).xy - 1.0;
  vec3 normal = normalize(vec3(0.16 * slope, 1.0));
  float facing = clamp(-dot(direction, normal), 0.0, 1.0);
  float grazing = 1.0 - facing;
  float fresnel = 0.02 + 0.98 * grazing * grazing * grazing * grazing * grazing;
  vec3 mirrored = reflect(direction, normal);
  mirrored.z = abs(mirrored.z);
  float glint = max(dot(mirrored, sunDirection), 0.0);
  glint *= glint, glint *= glint, glint *= glint, glint *= glint, glint *= glint, glint *= glint, glint *= glint;
  vec3 deep = vec3(0.030, 0.040, 0.028) * lightOn(vec3(0.0, 0.0, 1.0));
  vec3 light = mix(deep, skyToward(mirrored), fresnel) + sunLight * (4.0 * fresnel * glint);
  float haze = hazeAt(distance);
  // Where one looks straight down the bed shows through a little.
  shown = vec4(displayed(mix(light, horizonToward(direction), haze)), max(mix(0.8, 1.0, fresnel), haze));
}
#endif
