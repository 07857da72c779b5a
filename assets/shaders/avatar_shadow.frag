in vec2 inOval;
layout(location = 0) out vec4 shown;

void main() {
  float inside = 1.0 - dot(inOval, inOval);
  // Softer and lighter towards the head.
  shown = vec4(0.0, 0.0, 0.0, clamp(2.0 * inside, 0.0, 1.0) * mix(0.5, 0.3, 0.5 + 0.5 * inOval.y));
}
