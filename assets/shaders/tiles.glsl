// Where each tile's base lies from the eye: metres, subtracted in double. 32 x 32 tiles at most.
layout(std140, binding = 1) uniform Tiles {
  vec4 tileFromEye[1024];
};
