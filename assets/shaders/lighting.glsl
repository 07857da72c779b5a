// Light and air: the one file that every surface includes, so that near and far agree.
// Linear light inside; `displayed` turns it into what the screen shows.

uniform vec3 sunDirection;   // unit, towards the sun
uniform vec3 sunLight;       // irradiance on a surface that faces the sun, over pi
uniform vec3 skyLight;       // from the upper half of the sphere, over pi
uniform vec3 bounceLight;    // from the ground below, over pi
uniform vec3 zenithRadiance;
uniform vec3 horizonRadiance;
uniform vec3 glowRadiance;   // added about the sun
uniform float hazeDensity;   // 1 / metres

// Radiance of the sky's lower edge in a direction: what everything fades to.
vec3 horizonToward(vec3 direction) {
  vec2 across = direction.xy * inversesqrt(max(dot(direction.xy, direction.xy), 1e-12));
  float towardSun = max(dot(across, sunDirection.xy), 0.0);
  towardSun *= towardSun;
  return horizonRadiance + glowRadiance * (0.5 * towardSun * towardSun);
}

// Radiance of the sky in a unit direction without the sun's disc. At and below the horizon it is horizonToward.
vec3 skyToward(vec3 direction) {
  float above = 1.0 - clamp(direction.z, 0.0, 1.0);
  float lower = above * above;
  lower *= lower;
  float towardSun = max(dot(direction, sunDirection), 0.0);
  towardSun *= towardSun;
  towardSun *= towardSun;
  return mix(zenithRadiance + glowRadiance * (towardSun * towardSun), horizonToward(direction), lower);
}

// Part of a surface's light that the air at `distance` metres replaces by its own.
float hazeAt(float distance) {
  return 1.0 - exp2(-1.442695 * hazeDensity * distance);
}

// Light that a matt surface with this unit normal reflects for albedo 1.
vec3 lightOn(vec3 normal) {
  float up = 0.5 + 0.5 * normal.z;
  return sunLight * max(dot(normal, sunDirection), 0.0) + mix(bounceLight, skyLight, up);
}

// Its two parts: what the sun brings where it shines, and what comes from sky and ground.
vec3 sunOn(vec3 normal) {
  return sunLight * max(dot(normal, sunDirection), 0.0);
}
vec3 skyOn(vec3 normal) {
  return mix(bounceLight, skyLight, 0.5 + 0.5 * normal.z);
}

// How a surface is seen: shown = albedo * (scale + sun where it shines) + add. Without shadow maps the sun is in the
// scale.
struct Seen {
  vec3 scale;
#ifdef SHADOWS
  vec3 sun;
#endif
  vec3 add;
};

// `fromEye`: metres from the eye to the surface. `specular` 0 is matt, 1 is glass.
Seen seen(vec3 fromEye, vec3 normal, vec3 tint, float specular) {
  float distance = max(length(fromEye), 1e-6);
  vec3 direction = fromEye / distance;
  float haze = hazeAt(distance);
  float facing = clamp(-dot(direction, normal), 0.0, 1.0);
  float grazing = 1.0 - facing;
  grazing *= grazing;
  float mirrored = specular * (0.12 + 0.88 * grazing * grazing * (1.0 - facing));
  vec3 bounced = direction + 2.0 * facing * normal;
  vec3 mirror = mix(bounceLight, mix(horizonRadiance, zenithRadiance, max(bounced.z, 0.0)),
                    clamp(0.5 + 2.0 * bounced.z, 0.0, 1.0));
  float clear = 1.0 - haze;
  Seen result;
#ifdef SHADOWS
  vec3 through = tint * ((1.0 - mirrored) * clear);
  result.scale = skyOn(normal) * through;
  result.sun = sunOn(normal) * through;
#else
  result.scale = lightOn(normal) * tint * ((1.0 - mirrored) * clear);
#endif
  result.add = horizonToward(direction) * haze + mirror * (mirrored * clear);
  return result;
}

// Linear light to what the screen shows: a film's curve with the display's gamma in it
// (Hejl and Burgess-Dawson 2010): one division, no power.
vec3 displayed(vec3 light) {
  vec3 x = max(light - 0.004, 0.0);
  return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
}
