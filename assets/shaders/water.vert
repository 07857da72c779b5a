// Level water, one body under one transform.

layout(location = 0) in vec3 vertexPosition;

uniform mat4 osg_ModelViewMatrix;
uniform mat4 osg_ProjectionMatrix;

#ifdef ITEM_ID
flat out uint item;
#else
uniform mat3 worldFromEye;
uniform float time;
out vec3 fromEye;
out vec4 ripplesUv;
#endif

void main() {
  vec4 inEyeAxes = osg_ModelViewMatrix * vec4(vertexPosition, 1.0);
  gl_Position = osg_ProjectionMatrix * inEyeAxes;
#ifdef ITEM_ID
  item = 0xffffffffu;
#else
  fromEye = worldFromEye * inEyeAxes.xyz;
  // Two layers of ripples of different size that drift across each other.
  ripplesUv = vec4(vertexPosition.xy / 3.7 + vec2(112.0, 61.0) / 3600.0 * time, vertexPosition.yx / 11.3 - vec2(47.0, 32.0) / 3600.0 * time);
#endif
}
