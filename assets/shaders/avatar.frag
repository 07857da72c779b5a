#ifdef ITEM_ID
flat in uint item;
layout(location = 0) out uint shownItem;

void main() {
  shownItem = item;
}
#else
#include "lit.glsl"
layout(location = 0) out vec4 shown;

void main() {
  shown = vec4(displayed(lit(vec3(1.0), 1.0)), 1.0);
}
#endif
