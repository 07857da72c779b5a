// The ground as the sun sees it: a coarse mesh that nowhere lies over the real one.
layout(location = 0) in vec3 vertexPosition;  // metres from the field's middle
uniform vec3 fieldFromCentre;
uniform mat4 clipFromCentre;
flat out uint item;

void main() {
  gl_Position = clipFromCentre * vec4(fieldFromCentre + vertexPosition, 1.0);
  item = 0u;
}
