// One triangle over the whole picture at depth 0, the far end of reversed depth.
uniform mat4 eyeRelativeFromClip;
out vec3 ray;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
  // Both ends of the pixel's ray lie at finite places for depth 1; depth 0 is infinitely far.
  ray = (eyeRelativeFromClip * vec4(corner, 1.0, 1.0)).xyz;
}
