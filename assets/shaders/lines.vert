// Lines in the scene, positions relative to a fixed place.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 vertexColour;
uniform mat4 clipFromEyeRelative;
uniform vec3 placeFromEye;
out vec4 colour;

void main() {
  gl_Position = clipFromEyeRelative * vec4(position + placeFromEye, 1.0);
  colour = vertexColour;
}
