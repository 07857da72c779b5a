// A colour for each pixel over the picture; its rows begin at the top.
uniform sampler2D tints;
layout(location = 0) out vec4 pixel;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  pixel = texelFetch(tints, ivec2(at.x, textureSize(tints, 0).y - 1 - at.y), 0);
}
