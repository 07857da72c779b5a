// Colours of all dresses that people wear: eight parts each, linear.
layout(std140, binding = 4) uniform Dresses {
  vec4 dresses[DRESSES * 8];
};
